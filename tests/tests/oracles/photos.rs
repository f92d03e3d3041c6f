//! Photos of recorded flights and others: what is read of them beside what `ExifRead` and an XML reader see.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pilotage_core::flight::photo::{Photo, read_photo};
use pilotage_core::frames::Attitude;
use pilotage_core::imagery::MemoryBytes;
use pilotage_tests::{data::shared, oracle::ask};
use serde::{Deserialize, Serialize};

#[derive(Serialize)]
struct Files {
    paths: Vec<PathBuf>,
    folder: PathBuf,
}

#[derive(Debug, Deserialize)]
struct Read {
    size: (usize, usize),
    taken: (i64, f64, bool),
    place: Option<(f64, f64, f64)>,
    focal: Option<f64>,
    focal_35: Option<f64>,
    orientation: u8,
    camera: (String, String),
    xmp: BTreeMap<String, String>,
}

fn read(path: &Path) -> Photo {
    let bytes = std::fs::read(path).expect("the file can be read");
    read_photo(&MemoryBytes::new("photo.jpg", bytes)).expect("it is a photo")
}

fn is_near(found: Option<f64>, expected: Option<f64>) -> bool {
    match (found, expected) {
        (Some(found), Some(expected)) => (found - expected).abs() < 1e-9,
        (found, expected) => found == expected,
    }
}

fn compare(photo: &Photo, expected: &Read) {
    assert_eq!((photo.width, photo.height), expected.size);
    let (seconds, fraction, is_utc) = expected.taken;
    assert_eq!(
        (photo.taken, photo.is_utc),
        (Some((seconds, fraction)), is_utc)
    );
    let place = photo.place.map(|p| {
        let [north, east] = [p.latitude, p.longitude].map(f64::to_degrees);
        (north, east, p.altitude.expect("each has an altitude"))
    });
    match (place, expected.place) {
        (Some(a), Some(b)) => {
            let differences = [a.0 - b.0, a.1 - b.1, a.2 - b.2];
            assert!(differences.iter().all(|d| d.abs() < 1e-10), "{a:?} {b:?}");
        }
        (place, expected) => assert_eq!(place, expected),
    }
    let millimetres = |length: Option<f64>| length.map(|length| 1e3 * length);
    assert!(is_near(millimetres(photo.focal_length), expected.focal));
    assert!(is_near(
        millimetres(photo.focal_length_35),
        expected.focal_35
    ));
    assert_eq!(photo.orientation, expected.orientation);
    let (make, model) = &expected.camera;
    assert!(
        photo.camera.starts_with(make) && photo.camera.ends_with(model),
        "{}",
        photo.camera
    );
    let said = |name: &str| {
        expected
            .xmp
            .get(name)
            .map(|text| text.parse().expect("a number"))
    };
    assert_eq!(photo.height_above_take_off, said("RelativeAltitude"));
    let part = |attitude: Option<Attitude>, part: fn(Attitude) -> f64| {
        attitude.map(|a| part(a).to_degrees())
    };
    for (found, name) in [
        (part(photo.gimbal, |a| a.roll), "GimbalRollDegree"),
        (part(photo.gimbal, |a| a.pitch), "GimbalPitchDegree"),
        (part(photo.gimbal, |a| a.yaw), "GimbalYawDegree"),
        (part(photo.aircraft, |a| a.pitch), "FlightPitchDegree"),
        (part(photo.aircraft, |a| a.yaw), "FlightYawDegree"),
    ] {
        assert!(is_near(found, said(name)), "{name} {found:?}");
    }
}

#[test]
fn photos_say_what_they_say_to_others() {
    let names = [
        "brighton_beach/DJI_0026_original.JPG",
        "caliterra/IMG_9360_original.jpg",
        "caliterra/IMG_9400_original.jpg",
    ];
    let paths: Vec<PathBuf> = names.into_iter().filter_map(shared).collect();
    let count = paths.len();
    let folder = std::env::temp_dir().join(format!("pilotage-photos-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("there is room for photos");
    let question = Files {
        paths,
        folder: folder.clone(),
    };
    let answer: Option<BTreeMap<PathBuf, Read>> = ask("exifread_photos.py", &question);
    let answer = answer.unwrap_or_default();
    for (path, expected) in &answer {
        compare(&read(path), expected);
    }
    std::fs::remove_dir_all(&folder).ok();
    assert!(answer.is_empty() || answer.len() == count + 60);
}

/// A row of the table that the owner of the flight made of the photo.
fn row(table: &str, name: &str) -> Option<Vec<String>> {
    let text = std::fs::read_to_string(shared(table)?).expect("the table can be read");
    let row = text
        .lines()
        .find(|line| line.starts_with(name))
        .expect("the photo has a row");
    Some(row.split(',').map(str::to_owned).collect())
}

#[test]
fn a_photo_of_a_camera_drone_says_what_the_table_of_its_flight_says() {
    let (Some(path), Some(row)) = (
        shared("brighton_beach/DJI_0026_original.JPG"),
        row("brighton_beach/frames.csv", "DJI_0026"),
    ) else {
        return;
    };
    let photo = read(&path);
    let place = photo.place.expect("it has a place");
    let gimbal = photo.gimbal.expect("it has a gimbal");
    let aircraft = photo.aircraft.expect("it was in an aircraft");
    let degrees = f64::to_degrees;
    let found = [
        degrees(place.latitude),
        degrees(place.longitude),
        place.altitude.expect("it has an altitude"),
        photo.height_above_take_off.expect("it has a height"),
        degrees(gimbal.roll),
        degrees(gimbal.pitch),
        degrees(gimbal.yaw),
        degrees(aircraft.roll),
        degrees(aircraft.pitch),
        degrees(aircraft.yaw),
    ];
    for (found, said) in found.iter().zip(&row[2..12]) {
        let said: f64 = said.parse().expect("a number");
        assert!((found - said).abs() < 1e-8, "{found} {said}");
    }
    // date -u -d '2016-06-23 16:32:57' +%s
    assert_eq!(
        (row[1].as_str(), photo.taken),
        ("2016:06:23 16:32:57", Some((1_466_699_577, 0.0)))
    );
    // It came from a program that had turned it by half: the reason why its heading is not that of its pixels.
    assert!(
        photo
            .saved_again_by
            .is_some_and(|program| program.contains("Photo Viewer"))
    );
}

#[test]
fn a_photo_of_a_plain_camera_says_what_the_table_of_its_flight_says() {
    let (Some(path), Some(row)) = (
        shared("caliterra/IMG_9360_original.jpg"),
        row("caliterra/frames.csv", "IMG_9360"),
    ) else {
        return;
    };
    let photo = read(&path);
    let place = photo.place.expect("it has a place");
    let [north, east, altitude]: [f64; 3] =
        [2, 3, 4].map(|i: usize| row[i].parse().expect("a number"));
    assert!((place.latitude.to_degrees() - north).abs() < 1e-8);
    assert!((place.longitude.to_degrees() - east).abs() < 1e-8);
    assert_eq!(place.altitude, Some(altitude));
    assert_eq!(
        (photo.gimbal, photo.aircraft, photo.saved_again_by),
        (None, None, None)
    );
    // The README of the flight: 4.5 mm, a sensor of 6.17 mm.
    let sensor = photo.pixel_pitch.expect("it tells its pixels") * photo.width as f64;
    assert!((sensor - 6.17e-3).abs() < 0.05e-3, "{sensor}");
}
