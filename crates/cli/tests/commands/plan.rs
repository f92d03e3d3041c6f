//! `pilotage plan` over a small map, as a user calls it.

use std::path::Path;

use nalgebra::Matrix3;
use pilotage_core::camera::CameraModel;
use pilotage_core::frames::{
    Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect, ReferenceSystem,
};
use pilotage_core::imagery::{Georeference, WorldFile};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::package::{MissionPackage, write_package};
use pilotage_core::mission::{
    Mission, NoFlyZone, Route, WayPoint, place_files, read_mission, write_mission,
};
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::raster::{Picture, encode_png};
use serde_json::Value;

use super::folder::Folder;
use super::map::heights_from;

/// Metres per pixel of the map, and its size in pixels.
const GSD: f64 = 0.5;
const SIDE: usize = 700;

fn utm() -> ReferenceSystem {
    ReferenceSystem::from_epsg(32_615).expect("a UTM zone")
}

/// The middle of the map.
fn origin() -> Geodetic {
    let half = 0.5 * SIDE as f64 * GSD;
    utm()
        .geodetic(570_000.0 + half, 5_190_000.0 - half)
        .expect("a place")
}

/// Blocks of brightness, no two places alike.
fn map() -> Vec<u8> {
    let block = |x: usize, y: usize| {
        let mixed = (x as u32).wrapping_mul(0x9e37_79b9) ^ (y as u32).wrapping_mul(0x85eb_ca6b);
        (mixed.wrapping_mul(0xc2b2_ae35) >> 24) as u8
    };
    let shade = |x: usize, y: usize| {
        let (fine, coarse) = (block(x / 5, y / 5), block(1000 + x / 17, y / 17));
        [fine / 2 + coarse / 2, coarse, fine / 3 + 60]
    };
    encode_png(&Picture::from_fn(SIDE, SIDE, shade)).expect("a picture")
}

fn place() -> WorldFile {
    WorldFile {
        a: GSD,
        d: 0.0,
        b: 0.0,
        e: -GSD,
        c: 570_000.0 + 0.5 * GSD,
        f: 5_190_000.0 - 0.5 * GSD,
    }
}

/// A line of 240 m over three landmarks, the second of which is switched off.
pub fn mission() -> Mission {
    let altitude = Altitude {
        metres: 60.0,
        frame: AltitudeFrame::AboveGround,
    };
    let at = |east| WayPoint::new(GroundPoint::new(0.0, east), altitude);
    let landmark = |id, name: &str, east| {
        let bounds = GroundRect::centered(GroundPoint::new(0.0, east), 16.0, 16.0);
        Landmark::new(id, name, bounds)
    };
    let mut off = landmark(2, "Off", 0.0);
    off.enabled = false;
    Mission {
        name: "Small".to_owned(),
        origin: origin(),
        map: None,
        landmarks: vec![landmark(1, "West", -60.0), off, landmark(3, "East", 60.0)],
        routes: vec![Route {
            id: 1,
            name: "Line".to_owned(),
            way_points: vec![at(-120.0), at(120.0)],
            ..Route::default()
        }],
        no_fly: Vec::new(),
        rally: Vec::new(),
        roads: Vec::new().into(),
        labels: Vec::new(),
        camera: Some(CameraModel::pinhole(320, 240, 0.8)),
        camera_to_log: None,
        navigator: NavigatorSettings::default(),
        properties: std::collections::BTreeMap::new(),
    }
}

/// Files beside the map's picture that say where it is.
pub fn placed() -> Vec<(String, Vec<u8>)> {
    let place = Georeference::Projected {
        system: utm(),
        file: place(),
    };
    place_files("area.png", &place)
}

/// A mission in a file as the page saves it, with what lies beside the map's picture.
pub fn saved(mission: Mission, beside: Vec<(String, Vec<u8>)>) -> Vec<u8> {
    let mut files = vec![("area.png".to_owned(), map())];
    files.extend(beside);
    let package = MissionPackage {
        mission,
        settings: std::collections::BTreeMap::new(),
        files,
    };
    write_package(&package).expect("a mission file")
}

impl Folder {
    /// The summary of a plan.
    fn plan(&self, words: &[&str]) -> Value {
        let mut all = vec!["plan", "--summary", "summary.json"];
        all.extend(words);
        let done = self.call(&all);
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{said}");
        let text = std::fs::read(self.0.join("summary.json")).expect("a summary");
        serde_json::from_slice(&text).expect("JSON")
    }
}

fn is_whole(folder: &Path) -> bool {
    let names = std::fs::read_dir(folder).expect("the folder");
    let mut names = names.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    !names.any(|name| name.ends_with(".unfinished"))
}

#[test]
fn a_mission_saved_over_an_opened_map_is_predicted_with_a_probability_for_every_landmark_that_is_on()
 {
    let folder = Folder::new("plan-predict");
    folder.write("small.pilotage.zip", saved(mission(), placed()));
    let summary = folder.plan(&[
        "--mission",
        "small.pilotage.zip",
        "--predict",
        "--limit",
        "3",
    ]);
    let landmarks: Vec<&str> = (summary["landmarks"].as_array().expect("landmarks").iter())
        .filter_map(Value::as_str)
        .collect();
    assert_eq!(landmarks, ["West", "East"]);
    let samples = summary["samples"].as_array().expect("samples");
    assert!(samples.len() > 10, "{} samples", samples.len());
    let number = |sample: &Value, name: &str| {
        let value = sample[name].as_f64();
        value.unwrap_or_else(|| panic!("{name} in {sample}"))
    };
    let mut before = -1.0;
    for sample in samples {
        let distance = number(sample, "distance_m");
        assert!(distance > before, "{distance} after {before}");
        before = distance;
        let (major, minor) = (
            number(sample, "sigma_major_m"),
            number(sample, "sigma_minor_m"),
        );
        assert!(major >= minor && minor > 0.0, "{major} and {minor}");
        assert!(number(sample, "heading_of_major_deg").abs() <= 360.0);
        let found = sample["p_detect"].as_array().expect("p_detect");
        assert_eq!(found.len(), landmarks.len());
    }
    // Each is found where it lies: 60 m and 180 m along the line.
    let best = |index: usize| {
        let by = |s: &&Value| s["p_detect"][index].as_f64().unwrap_or(0.0);
        let best = samples.iter().max_by(|a, b| by(a).total_cmp(&by(b)));
        let best = best.expect("a sample");
        (number(best, "distance_m"), by(&best))
    };
    for (index, along) in [(0, 60.0), (1, 180.0)] {
        let (distance, probability) = best(index);
        assert!((distance - along).abs() < 45.0, "{index}: {distance} m");
        assert!(probability > 0.05, "{index}: {probability}");
        let far = samples
            .iter()
            .filter(|s| (number(s, "distance_m") - along).abs() > 110.0);
        for sample in far {
            assert_eq!(sample["p_detect"][index], 0.0, "{sample}");
        }
    }
    let worst = &summary["worst_stretch"];
    let (begin, end) = (number(worst, "begin"), number(worst, "end"));
    assert!(begin < end && number(worst, "sigma") > 3.0, "{worst}");
    assert!(is_whole(&folder.0));
}

#[test]
fn a_route_is_found_over_a_picture_that_was_put_on_the_ground_and_replaces_the_plan_whole() {
    let folder = Folder::new("plan-find");
    let (c, f) = (570_000.0, 5_190_000.0);
    let place = Georeference::Projective {
        system: utm(),
        plane_from_pixel: Matrix3::new(GSD, 0.0, c, 0.0, -GSD, f, 0.0, 1e-13, 1.0),
    };
    let mut beside = place_files("area.png", &place);
    // A picture that lies nowhere is not the map.
    beside.push(("aaa.png".to_owned(), map()));
    // Nor are heights.
    let middle = origin();
    let corner = (
        middle.longitude.to_degrees() - 0.002,
        middle.latitude.to_degrees() + 0.002,
    );
    let heights = heights_from(corner, true, 8);
    beside.push(("heights.tif".to_owned(), heights.clone()));
    folder.write("small.pilotage.zip", saved(mission(), beside));
    folder.write("found.json", "an older file");
    let ends = ["--find", "0,-120", "0,120", "--out", "found.json"];
    let summary = folder.plan(&[&["--mission", "small.pilotage.zip"], &ends[..]].concat());
    let compared = summary["found"]["comparison"]
        .as_array()
        .expect("two routes");
    assert_eq!(compared.len(), 2);
    for route in compared {
        assert!(
            route["worst_sigma_m"].as_f64().is_some_and(|s| s > 0.0),
            "{route}"
        );
        assert!(
            route["length_m"].as_f64().is_some_and(|l| l > 230.0),
            "{route}"
        );
    }
    let text = std::fs::read(folder.0.join("found.json")).expect("the mission");
    let found = read_mission(&text).expect("a mission");
    assert_eq!(found.routes[0].name, "Found route");
    assert!(found.routes[0].way_points.len() >= 2 && found.routes.len() == 2);
    assert!(is_whole(&folder.0));
    // Ground that is level is not too high to fly over; of ground that cannot be read nobody knows.
    folder.write("level.tif", heights);
    folder.write("cut.tif", heights_from(corner, true, 1 << 20));
    let over = |dem| {
        let all = ["plan", "--mission", "small.pilotage.zip", "--dem", dem];
        folder.run(&[&all[..], &["--ground-clearance", "30"], &ends[..]].concat())
    };
    over("level.tif").unwrap();
    let refused = over("cut.tif").unwrap_err();
    assert!(refused.contains("cut.tif"), "{refused}");
}

#[test]
fn a_file_that_cannot_be_written_leaves_the_old_one_and_nothing_half() {
    let folder = Folder::new("plan-refused");
    folder.write("plain.json", write_mission(&mission()));
    let done = folder.call(&["convert", "plain.json", "no/such/folder/out.kml"]);
    assert!(!done.status.success());
    assert!(String::from_utf8_lossy(&done.stderr).contains("no/such/folder"));
    // A plain mission without a map says what to do.
    let done = folder.call(&["plan", "--mission", "plain.json", "--predict"]);
    assert!(String::from_utf8_lossy(&done.stderr).contains("--map"));
    assert!(is_whole(&folder.0));
}

/// A no-fly area between two places.
fn area(name: &str, (south, west): (f64, f64), (north, east): (f64, f64)) -> NoFlyZone {
    let corners = [(south, west), (south, east), (north, east), (north, west)];
    NoFlyZone {
        name: name.to_owned(),
        corners: corners.map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
        ..NoFlyZone::default()
    }
}

#[test]
fn no_fly_areas_under_the_route_and_within_its_corridor_are_told() {
    let folder = Folder::new("plan-no-fly");
    let mission = Mission {
        no_fly: vec![
            area("Village", (-30.0, -20.0), (30.0, 20.0)),
            area("Garden", (0.5, 70.0), (40.0, 100.0)),
            area("Far", (110.0, -50.0), (150.0, 50.0)),
        ],
        ..mission()
    };
    folder.write("small.pilotage.zip", saved(mission, placed()));
    let plan = ["plan", "--mission", "small.pilotage.zip"];
    let said = folder.run(&plan).unwrap();
    assert_eq!(said, "Leg 1 crosses Village for 40 m.\n");
    let said = folder.run(&[&plan[..], &["--predict"]].concat()).unwrap();
    let of = |name: &str| {
        let lines = said.lines().filter(|line| line.contains(name));
        lines.collect::<Vec<_>>()
    };
    assert_eq!(of("Village").len(), 2, "{said}");
    assert!(of("Far").is_empty(), "{said}");
    let reached = "The 95 % corridor reaches into Garden from ";
    let garden = of("Garden");
    assert!(
        garden.len() == 1 && garden[0].starts_with(reached),
        "{said}"
    );
    // It lies from 190 m to 220 m along the line, half a metre beside it.
    let numbers: Vec<f64> = garden[0][reached.len()..]
        .split(' ')
        .filter_map(|word| word.parse().ok())
        .collect();
    let [from, to] = numbers[..] else {
        panic!("{said}");
    };
    assert!((100.0..195.0).contains(&from) && to > 215.0, "{said}");
}
