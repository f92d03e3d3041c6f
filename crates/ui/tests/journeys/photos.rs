//! Photos are laid on a map one by one.

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use pilotage_core::flight::photo::PhotoSearch;
use pilotage_core::raster::{Picture, encode_jpeg, encode_png};
use pilotage_jobs::Job;
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::support::{Rig, rig};

/// Metres per pixel of the map and of the photos.
const GSD: f64 = 0.5;
/// Degrees of latitude and longitude per metre where the map lies.
pub const DEGREES: [f64; 2] = [1.0 / 111_170.0, 1.0 / 76_057.0];
/// Latitude and longitude of the map's north-west corner, degrees.
pub const CORNER: [f64; 2] = [47.0, 8.0];
/// Pixels of the map, and of a photo.
const MAP: (usize, usize) = (720, 600);
const PHOTO: (usize, usize) = (300, 240);

/// A town of grey and red roofs, another one for another seed.
pub fn town(width: usize, height: usize, seed: u64) -> Picture {
    let mut state = seed;
    let mut draw = |most: usize| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % most
    };
    let mut ground = Picture::filled(width, height, [104, 118, 84]);
    for _ in 0..width * height / 900 {
        let (left, top) = (draw(width), draw(height));
        let (across, down) = (10 + draw(34), 10 + draw(34));
        let light = 50 + draw(180) as u8;
        let roof = if draw(2) == 0 {
            [light; 3]
        } else {
            [light, light / 2, light / 3]
        };
        for row in top..(top + down).min(height) {
            for column in left..(left + across).min(width) {
                ground.set(column, row, roof);
            }
        }
    }
    ground
}

/// The part of `ground` that begins at (left, top), as a photo that a drone took from above its middle, looking down,
/// top to the north. It says that it was taken `off` metres north and east of there.
pub fn photo(ground: &Picture, (left, top): (usize, usize), off: [f64; 2]) -> Vec<u8> {
    let (width, height) = PHOTO;
    let seen = Picture::from_fn(width, height, |x, y| ground.get(left + x, top + y));
    let middle = middle((left, top));
    let told = [0, 1].map(|i| middle[i] + off[i] * DEGREES[i]);
    photo_of(&seen, told)
}

/// A photo of what is `seen`, half a metre a pixel, that a drone took looking down, top to the north. It says at which
/// latitude and longitude, degrees.
pub fn photo_of(seen: &Picture, [latitude, longitude]: [f64; 2]) -> Vec<u8> {
    let jpeg = encode_jpeg(seen, 92).expect("memory");
    // Without a word about its lens its focal length counts as 0.6 of its width.
    let above = 0.6 * seen.width() as f64 * GSD;
    let xmp = format!(
        "<x:xmpmeta><rdf:Description drone-dji:GpsLatitude=\"{latitude:.8}\" drone-dji:GpsLongitude=\"{longitude:.8}\" \
         drone-dji:RelativeAltitude=\"+{above:.2}\" drone-dji:FlightYawDegree=\"+4.0\" \
         drone-dji:FlightPitchDegree=\"-3.0\" drone-dji:FlightRollDegree=\"+1.0\" drone-dji:GimbalYawDegree=\"0.0\" \
         drone-dji:GimbalPitchDegree=\"0.0\" drone-dji:GimbalRollDegree=\"0.0\"/></x:xmpmeta>"
    );
    let body = [b"http://ns.adobe.com/xap/1.0/\0", xmp.as_bytes()].concat();
    let length = (body.len() as u16 + 2).to_be_bytes();
    let segment = [&[0xff, 0xe1], &length[..], &body].concat();
    [&jpeg[..2], &segment, &jpeg[2..]].concat()
}

/// Latitude and longitude of the middle of the part that begins at (left, top).
fn middle((left, top): (usize, usize)) -> [f64; 2] {
    let (width, height) = PHOTO;
    let south = GSD * (top as f64 + 0.5 * height as f64);
    let east = GSD * (left as f64 + 0.5 * width as f64);
    [
        CORNER[0] - south * DEGREES[0],
        CORNER[1] + east * DEGREES[1],
    ]
}

pub fn file(name: &str, bytes: Vec<u8>) -> OpenedFile {
    OpenedFile {
        path: name.to_owned(),
        content: bytes.into(),
    }
}

/// The map and the files that say where it lies.
pub fn map(ground: &Picture) -> Vec<OpenedFile> {
    let [down, across] = DEGREES.map(|degrees| GSD * degrees);
    let [north, west] = CORNER;
    let world = format!(
        "{across:.12}\n0\n0\n-{down:.12}\n{:.12}\n{:.12}\n",
        west + 0.5 * across,
        north - 0.5 * down
    );
    vec![
        file("map.png", encode_png(ground).expect("memory")),
        file("map.pgw", world.into_bytes()),
        file("map.prj", b"EPSG:4326".to_vec()),
    ]
}

fn rows(rig: &mut Rig) -> Vec<Value> {
    let state = rig.state();
    state["photos"]["rows"]
        .as_array()
        .cloned()
        .unwrap_or_default()
}

/// Metres between a row's place and the middle of the part that begins at `corner`.
fn error(row: &Value, corner: (usize, usize)) -> f64 {
    let truth = middle(corner);
    let off = [0, 1].map(|i| (row["place"][i].as_f64().expect("a place") - truth[i]) / DEGREES[i]);
    off[0].hypot(off[1])
}

#[test]
fn photos_dropped_with_a_map_are_laid_on_it_or_refused_with_a_reason() {
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(MAP.0, MAP.1, 7);
    let elsewhere = town(MAP.0, MAP.1, 8);
    let mut files = map(&ground);
    files.push(file("first.jpg", photo(&ground, (120, 100), [9.0, -7.0])));
    files.push(file(
        "second.jpg",
        photo(&elsewhere, (150, 120), [0.0, 0.0]),
    ));
    // Another map of the place is no photo, and a table of the photos is not read: both are told.
    let other = map(&ground).into_iter().map(|it| OpenedFile {
        path: it.path.replace("map", "march"),
        ..it
    });
    files.extend(other);
    let table = b"file,time,heading\nfirst.jpg,0.0,3\nsecond.jpg,1.0,4\n";
    files.push(file("frames.csv", table.to_vec()));
    rig.host().opened.push(files);
    rig.settle();
    let rows = rows(&mut rig);
    assert_eq!(rows.len(), 2, "{rows:?}");
    let toasts = rig.state()["toasts"].to_string().to_lowercase();
    assert!(
        toasts.contains("march.png was left out: it lies"),
        "{toasts}"
    );
    assert!(toasts.contains("frames.csv was left out: only"), "{toasts}");
    assert_eq!(rig.state()["side_tab"], "photos");
    let (first, second) = (&rows[0], &rows[1]);
    assert!(error(first, (120, 100)) < 1.5, "{first}");
    assert!(first["probability"].as_f64() > Some(0.9), "{first}");
    assert!(
        first["deviation"].as_f64() >= Some(3.0),
        "the map's own error counts: {first}"
    );
    let assumed = first["assumed"].as_str().expect("words");
    assert!(
        assumed.contains("gimbal's angles are all zero") && assumed.contains("focal length 180"),
        "{assumed}"
    );
    assert!(second["place"].is_null(), "{second}");
    let why = second["refused"].as_str().expect("a reason");
    assert!(why.contains("look") || why.contains("place"), "{why}");
    rig.harness.get_by_label_contains("second.jpg: not laid");
    // The first one lies over the map.
    let photos = &rig.state()["photos"];
    assert_eq!(photos["chosen"], 0);
    assert_eq!(photos["draped"], true);
}

#[test]
fn photos_that_say_nothing_are_a_flight_and_are_laid_by_the_table_dropped_with_them() {
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(MAP.0, MAP.1, 7);
    let mut files = map(&ground);
    let corners = [(120, 100), (260, 220)];
    let mut table = "EPSG:4326\n".to_owned();
    for (number, corner) in (1..).zip(corners) {
        let (width, height) = PHOTO;
        let seen = Picture::from_fn(width, height, |x, y| ground.get(corner.0 + x, corner.1 + y));
        let jpeg = encode_jpeg(&seen, 92).expect("memory");
        files.push(file(&format!("{number}.jpg"), jpeg));
        let [latitude, longitude] = middle(corner);
        let row = format!("{number}.JPG {longitude:.8} {latitude:.8} 590 0 0 0\n");
        table.push_str(&row);
    }
    files.push(file("geo.txt", table.into_bytes()));
    rig.host().opened.push(files);
    rig.settle();
    let rows = rows(&mut rig);
    assert_eq!(rows.len(), 2, "{rows:?}");
    for (row, corner) in rows.iter().zip(corners) {
        let assumed = row["assumed"].as_str().expect("words");
        assert!(assumed.contains("as the table beside it says"), "{row}");
        assert!(error(row, corner) < 1.5, "{row}");
    }
    let toasts = rig.state()["toasts"].to_string().to_lowercase();
    assert!(!toasts.contains("left out"), "{toasts}");
    assert!(toasts.contains("a table beside them tells"), "{toasts}");
}

#[test]
fn limits_are_changed_and_the_photos_laid_again() {
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(MAP.0, MAP.1, 7);
    rig.host().opened.push(map(&ground));
    rig.settle();
    // One photo alone, over the map that is open; it says that it was taken 70 m away.
    let far = photo(&ground, (120, 100), [50.0, -50.0]);
    rig.host().opened.push(vec![file("far.jpg", far)]);
    rig.settle();
    let refused = rows(&mut rig);
    assert_eq!(refused.len(), 1, "{refused:?}");
    assert!(refused[0]["place"].is_null(), "{refused:?}");
    let role = egui::accesskit::Role::SpinButton;
    let name = "Place, to each side";
    rig.harness.get_by_role_and_label(role, name).click();
    rig.frames(2);
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::A);
    rig.harness.event(egui::Event::Text("90".to_owned()));
    rig.frames(1);
    rig.key(egui::Key::Enter);
    rig.frames(3);
    assert_eq!(rig.state()["photos"]["within"], 90.0);
    rig.harness.get_by_label("Lay again").click();
    rig.settle();
    let laid = rows(&mut rig);
    assert!(error(&laid[0], (120, 100)) < 1.5, "{laid:?}");
}

/// Orders of a kind that were given so far.
fn orders(rig: &mut Rig, of_kind: fn(&Job) -> bool) -> usize {
    let jobs = &rig.host().jobs;
    jobs.iter().filter(|(_, job)| of_kind(job)).count()
}

/// Answers the last job of a kind that was left without an answer, and all that are asked for from now on.
fn answer_left(rig: &mut Rig, of_kind: fn(&Job) -> bool) {
    let host = rig.host();
    host.left = None;
    let left = host.jobs.iter().rev().find(|(_, job)| of_kind(job));
    let (id, job) = left.cloned().expect("it was asked for");
    host.answer(id, &job);
}

#[test]
fn the_picture_of_an_earlier_laying_is_not_shown_at_the_new_place() {
    let is_drape = |job: &Job| matches!(job, Job::DrapePhoto(_));
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(MAP.0, MAP.1, 7);
    let mut files = map(&ground);
    files.push(file("a.jpg", photo(&ground, (120, 100), [9.0, -7.0])));
    rig.host().left = Some(is_drape);
    rig.host().opened.push(files);
    rig.settle();
    assert_eq!(orders(&mut rig, is_drape), 1);
    rig.host().left = Some(|job| matches!(job, Job::LayPhotos(_)));
    rig.harness.get_by_label("Lay again").click();
    rig.frames(3);
    let host = rig.host();
    let drape = host.jobs.iter().find(|(_, job)| is_drape(job));
    let (drape, _) = drape.expect("it was asked for");
    assert!(
        host.cancelled.contains(drape),
        "its answer would be of another place"
    );
    answer_left(&mut rig, |job| matches!(job, Job::LayPhotos(_)));
    rig.settle();
    assert_eq!(
        orders(&mut rig, is_drape),
        2,
        "it is shown where it lies now"
    );
    assert_eq!(rig.state()["photos"]["draped"], true);
}

/// A map with a photo on it, and that photo.
fn with_a_photo() -> (Rig, Vec<u8>) {
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(MAP.0, MAP.1, 7);
    rig.host().opened.push(map(&ground));
    rig.settle();
    let photo = photo(&ground, (120, 100), [0.0, 0.0]);
    rig.host().opened.push(vec![file("a.jpg", photo.clone())]);
    rig.settle();
    (rig, photo)
}

/// Opens the section for what people know better than the photos tell.
fn show_what_is_known(rig: &mut Rig) {
    let known = "Known better than by the photos";
    rig.harness.get_by_label(known).click();
    rig.frames(30);
}

/// Search of the last laying.
fn last_search(rig: &mut Rig) -> PhotoSearch {
    let jobs = rig.host().jobs.iter().rev();
    let mut orders = jobs.filter_map(|(_, job)| match job {
        Job::LayPhotos(order) => Some(order.search),
        _ => None,
    });
    orders.next().expect("photos were laid")
}

#[test]
fn a_fact_about_photos_does_not_count_for_those_that_are_opened_next() {
    let (mut rig, photo) = with_a_photo();
    show_what_is_known(&mut rig);
    rig.harness
        .get_by_label("Around the middle of the map view")
        .click();
    rig.frames(3);
    rig.harness.get_by_label("Focal length").click();
    rig.frames(3);
    rig.harness.get_by_label("Lay again").click();
    rig.settle();
    let stated = last_search(&mut rig);
    assert!(stated.at.is_some() && stated.focal.is_some(), "{stated:?}");
    rig.host().opened.push(vec![file("b.jpg", photo)]);
    rig.settle();
    assert_eq!(last_search(&mut rig), PhotoSearch::default());
}

#[test]
fn photos_that_were_laid_on_another_map_say_so() {
    const OF_ANOTHER: &str = "Of another map";
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(MAP.0, MAP.1, 7);
    let mut files = map(&ground);
    files.push(file("a.jpg", photo(&ground, (120, 100), [9.0, -7.0])));
    rig.host().opened.push(files);
    rig.settle();
    assert_eq!(rig.state()["photos"]["of_another_map"], false);
    assert!(rig.harness.query_by_label_contains(OF_ANOTHER).is_none());
    // Another map of the same place.
    rig.host().opened.push(map(&town(MAP.0, MAP.1, 8)));
    rig.settle();
    assert_eq!(rows(&mut rig).len(), 1);
    assert_eq!(rig.state()["photos"]["of_another_map"], true);
    rig.harness.get_by_label_contains(OF_ANOTHER);
    rig.harness.get_by_label("Lay again").click();
    rig.settle();
    assert_eq!(rig.state()["photos"]["of_another_map"], false);
    assert!(rig.harness.query_by_label_contains(OF_ANOTHER).is_none());
}

#[test]
fn a_known_height_has_the_same_limits_in_feet() {
    let (mut rig, _) = with_a_photo();
    rig.key(egui::Key::U);
    show_what_is_known(&mut rig);
    rig.harness.get_by_label("Height").click();
    rig.frames(3);
    let role = egui::accesskit::Role::SpinButton;
    let field = rig.harness.get_by_role_and_label(role, "Height");
    let most = field.accesskit_node().max_numeric_value();
    let most = most.expect("a limit");
    // 5000 m.
    assert!((most - 16_404.2).abs() < 0.1, "{most} ft");
}

#[test]
fn pictures_without_a_map_to_lay_them_on_are_told_in_words_and_laid_on_the_map_that_comes() {
    let mut rig = rig();
    rig.host().really_open = true;
    let ground = town(320, 260, 7);
    let files = ["a.png", "b.png"].map(|name| file(name, encode_png(&ground).expect("memory")));
    rig.host().opened.push(files.to_vec());
    rig.settle();
    let is_laying = |job: &Job| matches!(job, Job::LayPhotos(_));
    assert_eq!(orders(&mut rig, is_laying), 0);
    let toasts = rig.state()["toasts"].to_string().to_lowercase();
    assert!(toasts.contains("a.png and 1 more wait for it"), "{toasts}");
    rig.host().opened.push(map(&town(MAP.0, MAP.1, 7)));
    rig.settle();
    assert_eq!((orders(&mut rig, is_laying), rows(&mut rig).len()), (1, 2));
    assert_eq!(rig.state()["side_tab"], "photos");
}
