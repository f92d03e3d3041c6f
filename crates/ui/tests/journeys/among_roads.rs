//! The place of a picture is found among the roads of the mission.

use std::fmt::Write as _;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use pilotage_core::frames::{Geodetic, GroundPoint};
use pilotage_core::raster::Picture;
use pilotage_jobs::{
    FindAmongRoadsOrder, FoundAmongRoads, Job, JobEvent, JobId, PlaceAmongRoads, SoughtPicture,
};
use serde_json::Value;

use super::open_map::a_map;
use super::photos::{CORNER, DEGREES, file, map, photo_of, town};
use super::support::{Rig, rig};

/// Name of the command and of the buttons.
const FIND: &str = "Find this place among the roads";
/// Metres a pixel of the photo.
const GSD: f64 = 0.5;
/// Blocks along a side of the town, and the length of one, metres.
const BLOCKS: (i32, f64) = (12, 110.0);

/// Streets of a town without regular blocks, each two places: metres south and east of the map's corner.
fn streets() -> Vec<[[f64; 2]; 2]> {
    let off = |row: i32, column: i32, k: i32| {
        let value = f64::from(row * 37 + column * 101 + k * 53).sin() * 43_758.5;
        70.0 * (value - value.floor() - 0.5)
    };
    let corner = |row: i32, column: i32| {
        [(row, 1), (column, 2)].map(|(it, k)| BLOCKS.1 * f64::from(it) + off(row, column, k))
    };
    let blocks = (0..BLOCKS.0).flat_map(|row| (0..BLOCKS.0).map(move |column| (row, column)));
    let streets = blocks.flat_map(|(row, column)| {
        let own = corner(row, column);
        [
            [own, corner(row + 1, column)],
            [own, corner(row, column + 1)],
        ]
    });
    streets.collect()
}

/// The roads as GeoJSON.
fn geojson() -> Vec<u8> {
    let mut features = String::new();
    for street in streets() {
        let [from, to] = street.map(|[south, east]| {
            [
                CORNER[1] + east * DEGREES[1],
                CORNER[0] - south * DEGREES[0],
            ]
        });
        let comma = if features.is_empty() { "" } else { "," };
        write!(
            features,
            r#"{comma}{{"type":"Feature","properties":{{"highway":"residential"}},"geometry":{{"type":"LineString","coordinates":[{from:?},{to:?}]}}}}"#
        )
        .expect("memory");
    }
    format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#).into_bytes()
}

/// A photo of the streets, 8 m wide, around a place, metres south and east of the map's corner.
fn photo_at(middle: [f64; 2]) -> Vec<u8> {
    let (width, height) = (900, 720);
    let mut seen = Picture::from_fn(width, height, |x, y| {
        let grass = ((x * 7 + y * 13) % 11) as u8;
        [84 + grass, 104 + grass, 62 + grass]
    });
    for [from, to] in streets() {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        for step in 0..=(length / GSD) as usize {
            let share = GSD * step as f64 / length;
            let at = |i: usize| (from[i] + share * (to[i] - from[i]) - middle[i]) / GSD;
            let (row, column) = (at(0) + 0.5 * height as f64, at(1) + 0.5 * width as f64);
            for (dy, dx) in (-8..=8).flat_map(|dy| (-8..=8).map(move |dx| (dy, dx))) {
                let (y, x) = (row + f64::from(dy), column + f64::from(dx));
                let is_seen = x >= 0.0 && y >= 0.0 && x < width as f64 && y < height as f64;
                if is_seen && dx * dx + dy * dy <= 64 {
                    seen.set(x as usize, y as usize, [128, 127, 124]);
                }
            }
        }
    }
    // It says that it was taken somewhere else.
    photo_of(&seen, [CORNER[0], CORNER[1]])
}

fn open(rig: &mut Rig, name: &str, bytes: Vec<u8>) {
    rig.host().opened.push(vec![file(name, bytes)]);
    rig.settle();
}

/// A small map of which nothing is seen in the photo, and the roads of the town around it.
fn with_roads() -> Rig {
    let mut rig = rig();
    rig.host().really_open = true;
    rig.host().opened.push(map(&town(720, 600, 7)));
    rig.settle();
    open(&mut rig, "roads.geojson", geojson());
    assert!(rig.state()["roads"]["count"].as_u64() > Some(200));
    rig
}

fn of(rig: &Rig, what: &str) -> Value {
    rig.state()["among_roads"][what].clone()
}

/// Latitude and longitude in the first row of the list, degrees.
fn first_place(rig: &Rig) -> [f64; 2] {
    let row = rig.harness.get_by_label_contains("1: ");
    let label = row.accesskit_node().label().expect("a row");
    let place = label.split_once('\n').expect("a place").1;
    let mut parts = place.split("°, ").map(|it| it.parse().expect("degrees"));
    [0, 1].map(|_| parts.next().expect("two angles"))
}

#[test]
fn a_photo_that_is_not_laid_on_the_map_is_found_among_the_roads_of_the_mission() {
    let mut rig = with_roads();
    let middle = [620.0, 700.0];
    open(&mut rig, "lost.jpg", photo_at(middle));
    assert_eq!(rig.state()["side_tab"], "photos");
    let find = rig.harness.query_all_by_role_and_label(Role::Button, FIND);
    find.last().expect("in the sheet").click();
    rig.settle();
    assert_eq!(
        of(&rig, "verdict"),
        "Found",
        "{}",
        rig.state()["among_roads"]
    );
    rig.harness.get_by_label("Found");
    rig.harness.get_by_label("Photo lost.jpg");
    let place = first_place(&rig);
    let off = [0, 1].map(|i| {
        let sign = if i == 0 { -1.0 } else { 1.0 };
        (place[i] - CORNER[i]) / DEGREES[i] - sign * middle[i]
    });
    assert!(off[0].hypot(off[1]) < 10.0, "{off:?}");
    // The map shows it.
    let found = of(&rig, "places")[0]["place"].clone();
    assert_eq!(rig.state()["map"]["center"], found);
    // Another photo is another place.
    open(&mut rig, "other.jpg", photo_at([400.0, 500.0]));
    assert!(rig.state()["among_roads"].is_null());
}

/// Roads of a mission drawn by hand, and the camera picture at the cursor sought among them; the job is left.
fn sought() -> (Rig, JobId, FindAmongRoadsOrder) {
    let mut rig = super::plan::planning();
    rig.key_with(Modifiers::SHIFT, Key::Y);
    rig.frames(2);
    for (north, east) in [(0.0, -80.0), (20.0, 0.0), (0.0, 80.0)] {
        super::plan::click(&mut rig, north, east);
    }
    rig.key(Key::Enter);
    rig.frames(3);
    rig.open_tab("Replay");
    rig.host().left = Some(|job| matches!(job, Job::FindAmongRoads(_)));
    rig.harness
        .get_by_role_and_label(Role::Button, FIND)
        .click();
    rig.frames(3);
    let jobs = rig.host().jobs.iter().rev();
    let mut orders = jobs.filter_map(|(id, job)| match job {
        Job::FindAmongRoads(order) => Some((*id, (**order).clone())),
        _ => None,
    });
    let (job, order) = orders.next().expect("it is sought");
    (rig, job, order)
}

/// Answers a search with places 300 m from each other, of these probabilities.
fn answer(rig: &mut Rig, job: JobId, likely: &[f64], elsewhere: f64) {
    let place = |(number, probability): (usize, &f64)| {
        let below = GroundPoint::new(300.0 * number as f64, 50.0);
        PlaceAmongRoads {
            below,
            heading: 1.0,
            probability: *probability,
            outline: vec![below],
        }
    };
    let found = FoundAmongRoads {
        places: likely.iter().enumerate().map(place).collect(),
        elsewhere,
        assumed: "120 m above level ground, any heading".to_owned(),
    };
    let figures = JobEvent::of_figures(&found).expect("figures");
    let events = [
        JobEvent::Progress(0.5, "Half".into()),
        figures,
        JobEvent::Finished,
    ];
    rig.host().events.extend(events.map(|event| (job, event)));
    rig.frames(3);
}

#[test]
fn places_that_look_alike_are_listed_each_with_its_probability_and_chosen_by_keyboard() {
    let (mut rig, job, order) = sought();
    assert!(
        matches!(order.picture, SoughtPicture::Frame(..)),
        "{:?}",
        order.picture
    );
    assert_eq!(order.mission.roads.len(), 1);
    assert_eq!(of(&rig, "at_work"), true);
    answer(&mut rig, job, &[0.6, 0.396, 0.002], 0.002);
    rig.harness.get_by_label("Two places look alike");
    rig.harness
        .get_by_label_contains("Elsewhere, or not on these roads: < 1 %");
    assert_eq!(of(&rig, "chosen"), 0);
    let second = rig.harness.get_by_label_contains("2: 40 %");
    assert!(
        second
            .accesskit_node()
            .label()
            .is_some_and(|it| it.contains("heading 57°"))
    );
    second.focus();
    rig.frames(2);
    rig.key(Key::Enter);
    assert_eq!(of(&rig, "chosen"), 1);
    assert_eq!(rig.state()["map"]["center"][0], 300.0);
    rig.harness
        .get_by_label("Close the place among the roads")
        .click();
    rig.frames(3);
    assert!(rig.state()["among_roads"].is_null());
}

#[test]
fn a_search_is_stopped_and_what_it_did_not_find_is_not_believed() {
    let (mut rig, job, _) = sought();
    rig.harness.get_by_label("Stop").click();
    rig.frames(3);
    assert!(rig.host().cancelled.contains(&job));
    assert_eq!(of(&rig, "at_work"), false);
    rig.harness.get_by_label("Stopped.");
    rig.harness
        .get_by_role_and_label(Role::Button, FIND)
        .click();
    rig.frames(3);
    let host = rig.host();
    let last = host.jobs.last().expect("it is sought again").0;
    assert_ne!(last, job);
    answer(&mut rig, last, &[0.001], 0.999);
    rig.harness.get_by_label("Not found here");
    assert!(of(&rig, "chosen").is_null());
}

#[test]
fn what_was_found_is_of_its_roads_and_of_its_flight() {
    let (mut rig, job, _) = sought();
    answer(&mut rig, job, &[0.995], 0.005);
    rig.harness.get_by_label("Found");
    assert!(of(&rig, "of_before").is_null());
    // The road is taken back.
    rig.key_with(Modifiers::COMMAND, Key::Z);
    rig.frames(3);
    rig.harness.get_by_label_contains("Of the roads before");
    rig.host().opens = Some(a_map(Some(Geodetic::from_degrees(46.86, -92.08, 0.0))));
    open(&mut rig, "far.tif", vec![7; 3]);
    assert!(rig.state()["among_roads"].is_null());
}

#[test]
fn without_roads_the_command_says_what_is_missing() {
    let mut rig = rig();
    assert!(rig.harness.query_by_label(FIND).is_none());
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.harness
        .event(egui::Event::Text("among the roads".into()));
    rig.frames(3);
    rig.harness
        .get_by_label_contains("The mission has no roads");
}
