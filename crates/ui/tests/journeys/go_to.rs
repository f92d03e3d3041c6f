use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::Geodetic;
use pilotage_jobs::{DescribeMapOrder, Job, MapSource};

use super::support::{Rig, rig};

/// Types a place into the dialog, and enters it.
fn go(rig: &mut Rig, place: &str) {
    if rig.state()["go_to"]["open"] != true {
        rig.key_with(Modifiers::SHIFT, Key::W);
        rig.frames(2);
    }
    rig.key_with(Modifiers::COMMAND, Key::A);
    rig.harness.event(Event::Text(place.to_owned()));
    rig.frames(2);
    rig.key(Key::Enter);
    rig.frames(4);
}

/// Opens the dialog, for which the file of places that the page has arrives.
fn open_with_towns(rig: &mut Rig) {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../www/places.bin");
    let bytes = std::fs::read(file).expect("a file of the page");
    rig.key_with(Modifiers::SHIFT, Key::W);
    rig.frames(2);
    rig.host().own_files.insert("places.bin".into(), bytes);
    rig.frames(2);
}

fn type_text(rig: &mut Rig, text: &str) {
    rig.key_with(Modifiers::COMMAND, Key::A);
    rig.harness.event(Event::Text(text.to_owned()));
    rig.frames(4);
}

fn offered(rig: &Rig) -> Vec<String> {
    let state = rig.state();
    let rows = state["go_to"]["offered"].as_array().expect("rows").iter();
    rows.map(|row| row.as_str().unwrap_or_default().to_owned())
        .collect()
}

fn center(rig: &Rig) -> [f64; 2] {
    let state = rig.state();
    [0, 1].map(|i| state["map"]["center"][i].as_f64().expect("metres"))
}

fn why(rig: &Rig) -> String {
    let state = rig.state();
    assert_eq!(state["go_to"]["open"], true);
    state["go_to"]["why"]
        .as_str()
        .unwrap_or_default()
        .to_owned()
}

/// Origin of the map of the web that was asked for last, degrees.
fn origin_of_web_map(rig: &mut Rig) -> Option<[f64; 2]> {
    let jobs = rig.host().jobs.iter().rev();
    let origin = jobs.clone().find_map(|(_, job)| match job {
        Job::DescribeMap(DescribeMapOrder(MapSource::Web(map))) => Some(map.origin),
        _ => None,
    });
    origin.map(
        |Geodetic {
             latitude,
             longitude,
             ..
         }| [latitude, longitude].map(f64::to_degrees),
    )
}

/// The world lies at 47° N 8° E, where a degree of latitude has 111,171 m and one of longitude 76,056 m (the radii of
/// curvature of WGS 84). The reference is that of mgrs 1.6.0, the code that of openlocationcode 1.0.1, whose square is
/// 14 m high.
#[test]
fn the_map_goes_to_a_place_in_every_form() {
    for (place, tolerance) in [
        ("47.001, 8.002", 0.1),
        ("8°0.12' E 47°0.06' N", 0.1),
        ("32TMT2412805758", 1.0),
        ("8FVC2222+CR", 10.0),
        // The nearest one of that name to the middle of the map.
        ("2222+CR", 10.0),
    ] {
        let mut rig = rig();
        go(&mut rig, place);
        assert_eq!(rig.state()["go_to"]["open"], false, "{place}");
        let [north, east] = center(&rig);
        let off = (north - 111.171).hypot(east - 152.11);
        assert!(off < tolerance, "{place}: {north} {east}");
        rig.settle();
        assert_eq!(center(&rig), [north, east], "the map stays there");
    }
}

#[test]
fn what_names_no_place_is_told_with_its_reason_and_moves_nothing() {
    let mut rig = rig();
    let before = center(&rig);
    for (place, reason) in [
        ("32TAT4811", "no column of zone 32"),
        ("32T 448251 5411932", "outside of band T"),
        ("9G8F+6X Zürich", "No town of the list is called Zürich"),
        ("here", "46.8571"),
    ] {
        go(&mut rig, place);
        assert!(why(&rig).contains(reason), "{place}: {}", why(&rig));
    }
    assert_eq!(center(&rig), before);
    rig.key(Key::Escape);
    assert_eq!(rig.state()["go_to"]["open"], false);
}

#[test]
fn a_place_without_pixels_of_the_open_map_is_gone_to_and_told() {
    let mut rig = rig();
    go(&mut rig, "47.3, 8");
    assert!(
        (center(&rig)[0] - 33_350.0).abs() < 20.0,
        "{:?}",
        center(&rig)
    );
    rig.harness.get_by_label_contains("does not reach there");
}

#[test]
fn a_place_far_away_is_told_and_a_map_of_the_web_is_offered_there() {
    let mut rig = rig();
    let before = rig.state();
    go(&mut rig, "46.8571, -92.0765");
    // 7,200 km over the ground are 6,800 km through it.
    assert!(
        why(&rig).contains(" km from the world that is open"),
        "{}",
        why(&rig)
    );
    assert_eq!(before["map"]["center"], rig.state()["map"]["center"]);
    rig.harness
        .get_by_label("Open a map from the web there…")
        .click();
    rig.frames(6);
    let state = rig.state();
    assert_eq!(
        (&state["go_to"]["open"], &state["web_map"]["open"]),
        (&false.into(), &true.into())
    );
    rig.harness.get_by_label_contains("USGS imagery: ").click();
    rig.frames(4);
    rig.harness.get_by_label("Open the map").click();
    rig.settle();
    let state = rig.state();
    assert_eq!(state["workspace"], "Plan");
    assert!((state["origin"][0].as_f64().unwrap_or(0.0) - 46.8571).abs() < 1e-6);
    let found = origin_of_web_map(&mut rig).expect("a map");
    assert!((found[0] - 46.8571).abs() < 1e-6 && (found[1] + 92.0765).abs() < 1e-6);
    // From there, the map that is open moves in one click.
    go(&mut rig, "32TMT4825111932");
    assert!(why(&rig).contains("km from the world"));
    let label = "Show the map of basemap.nationalmap.gov there";
    rig.harness.get_by_label(label).click();
    rig.settle();
    let found = origin_of_web_map(&mut rig).expect("a map");
    assert!((found[0] - 47.058_88).abs() < 1e-5 && (found[1] - 8.318_58).abs() < 1e-5);
    assert_eq!(center(&rig), [0.0, 0.0]);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(
        rig.state()["landmarks"],
        before["landmarks"],
        "two steps back is what was open"
    );
}

/// Zug lies at 47.17° N 8.52° E in the list of towns: 18.9 km north and 39.5 km east of 47° N 8° E by the radii of curvature.
#[test]
fn towns_are_offered_by_the_beginnings_of_their_names_those_of_the_open_world_first() {
    let mut rig = rig();
    open_with_towns(&mut rig);
    type_text(&mut rig, "zür");
    let rows = offered(&rig);
    assert!(rows[0].starts_with("Zürich, Switzerland · "), "{rows:?}");
    // None of the larger ones far away comes before a small one nearby.
    type_text(&mut rig, "b");
    let rows = offered(&rig);
    let far = rows
        .iter()
        .map(|row| row.rsplit(' ').nth(1).and_then(|km| km.parse().ok()));
    let far: Vec<u32> = far.flatten().collect();
    assert!(
        far.len() == 8 && far.is_sorted() && far[7] < 100,
        "{rows:?}"
    );
    type_text(&mut rig, "Duluth");
    assert!(offered(&rig)[0].starts_with("Duluth, Minnesota, United States · 7"));
    // Coordinates are no town.
    type_text(&mut rig, "47.001, 8.002");
    assert!(offered(&rig).is_empty());
    type_text(&mut rig, "zug");
    let row = offered(&rig)[0].clone();
    rig.harness.get_by_label(&row);
    rig.key(Key::Enter);
    rig.frames(4);
    let [north, east] = center(&rig);
    assert!(
        (north - 19_000.0).abs() < 1_500.0 && (east - 39_400.0).abs() < 1_500.0,
        "{north} {east}"
    );
    assert_eq!(rig.state()["go_to"]["mark"], "Zug");
    assert_eq!(rig.host().asked_files, ["places.bin"], "once");
}

#[test]
fn arrows_choose_among_the_towns_and_a_click_takes_one() {
    let mut rig = rig();
    open_with_towns(&mut rig);
    type_text(&mut rig, "zu");
    let rows = offered(&rig);
    rig.key(Key::ArrowDown);
    rig.key(Key::ArrowDown);
    rig.key(Key::ArrowUp);
    rig.frames(2);
    assert_eq!(rig.state()["go_to"]["chosen"], 1);
    rig.key(Key::Enter);
    rig.frames(4);
    let chosen = rig.state()["go_to"]["mark"]
        .as_str()
        .unwrap_or_default()
        .to_owned();
    assert!(
        rows[1].starts_with(&chosen) && !rows[0].starts_with(&chosen),
        "{chosen}: {rows:?}"
    );
    rig.key_with(Modifiers::SHIFT, Key::W);
    rig.frames(4);
    // The distances are those from where the map is.
    let rows = offered(&rig);
    rig.harness.get_by_label(&rows[1]).click();
    rig.frames(4);
    let clicked = rig.state()["go_to"]["mark"]
        .as_str()
        .unwrap_or_default()
        .to_owned();
    assert!(rows[1].starts_with(&clicked), "{clicked}: {rows:?}");
}

#[test]
fn a_town_far_away_is_told_and_a_map_of_the_web_is_offered_there() {
    let mut rig = rig();
    open_with_towns(&mut rig);
    type_text(&mut rig, "duluth");
    rig.key(Key::Enter);
    rig.frames(4);
    assert!(
        why(&rig).contains(" km from the world that is open"),
        "{}",
        why(&rig)
    );
    rig.harness.get_by_label("Open a map from the web there…");
    go(&mut rig, "zzz");
    assert!(
        why(&rig).starts_with("No town of the list begins so."),
        "{}",
        why(&rig)
    );
}

/// The middle of the square by openlocationcode 1.0.1: 47.365562° N, 8.524937° E.
#[test]
fn a_short_code_lies_near_the_town_behind_it() {
    let mut rig = rig();
    open_with_towns(&mut rig);
    go(&mut rig, "9G8F+6X Zürich");
    let [north, east] = center(&rig);
    assert!(
        (north - 40_700.0).abs() < 150.0 && (east - 39_650.0).abs() < 100.0,
        "{north} {east}"
    );
}

#[test]
fn without_the_list_of_towns_coordinates_are_gone_to_and_the_list_is_asked_for_again() {
    let mut rig = rig();
    rig.key_with(Modifiers::SHIFT, Key::W);
    rig.frames(2);
    rig.harness
        .get_by_label_contains("The list of towns is loading.");
    rig.host().own_files.insert("places.bin".into(), Vec::new());
    rig.frames(2);
    rig.harness
        .get_by_label_contains("The list of towns cannot be loaded.");
    go(&mut rig, "47.001, 8.002");
    assert_eq!(rig.state()["go_to"]["open"], false);
    open_with_towns(&mut rig);
    rig.harness.get_by_label_contains("GeoNames, CC BY 4.0");
    assert_eq!(rig.host().asked_files.len(), 2);
}

#[test]
fn the_mark_stays_until_the_next_one_or_escape() {
    let mut rig = rig();
    for place in ["47.001, 8.002", "32TMT2412805758"] {
        go(&mut rig, place);
        assert_eq!(rig.state()["go_to"]["mark"], place);
    }
    rig.key_with(Modifiers::SHIFT, Key::W);
    rig.frames(2);
    rig.key(Key::Escape);
    rig.frames(2);
    let state = rig.state();
    assert_eq!(state["go_to"]["open"], false);
    assert_eq!(
        state["go_to"]["mark"], "32TMT2412805758",
        "Escape was the dialog's"
    );
    rig.key(Key::Escape);
    rig.frames(2);
    assert_eq!(rig.state()["go_to"]["mark"], serde_json::Value::Null);
}
