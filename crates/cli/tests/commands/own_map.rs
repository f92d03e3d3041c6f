//! `pilotage simulate` over a map of one's own.

use std::process::Output;

use pilotage_core::mission::write_mission;
use pilotage_core::navigator::{Run, decode_run};
use pilotage_core::raster::{Picture, decode_picture, encode_png};
use serde_json::Value;

use super::folder::Folder;

impl Folder {
    /// A folder with a map of 1.2 km by 1.2 km: red in its west, green in its east.
    pub fn with_map(name: &str) -> Self {
        let folder = Self::new(&format!("own-map-{name}"));
        let map = Picture::from_fn(600, 600, |x, y| {
            let grain = ((x * 7 + y * 13) % 40) as u8;
            if x < 300 {
                [160 + grain, 40 + grain, 40]
            } else {
                [40, 160 + grain, 40 + grain]
            }
        });
        folder.write("map.png", encode_png(&map).expect("a picture"));
        // Two metres a pixel in UTM zone 32 north.
        let world = "2\n0\n0\n-2\n400001\n5200999\n";
        folder.write("map.pgw", world);
        let system = "PROJCS[\"WGS_1984_UTM_Zone_32N\",GEOGCS[\"GCS_WGS_1984\",";
        folder.write("map.prj", system);
        folder
    }

    fn simulate(&self, words: &[&str]) -> Output {
        let flown = ["simulate", "--map", "map.png", "--out", "flown"];
        self.call(&[&flown, words].concat())
    }
}

/// Degrees of places in UTM zone 32 north, 400300 m east, by the series of Krüger (1912).
const WEST: [&str; 2] = ["46.946033,7.689910", "46.952331,7.689756"];

#[test]
fn a_route_over_the_west_of_a_map_sees_the_west_of_it() {
    let folder = Folder::with_map("west");
    let route = WEST.join(";");
    let words = [
        "--route", &route, "--height", "100", "--day", "same", "--wind", "270,3",
    ];
    let done = folder.simulate(&words);
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(done.status.success(), "{said}");
    let text = std::fs::read_to_string(folder.0.join("flown/flight.json")).expect("a flight");
    let flight: Value = serde_json::from_str(&text).expect("JSON");
    let origin = flight["origin"]["latitude_deg"].as_f64().expect("degrees");
    assert!((origin - 46.9497).abs() < 1e-3, "{origin}");
    let mut pictures = 0;
    for entry in std::fs::read_dir(folder.0.join("flown"))
        .expect("a folder")
        .flatten()
    {
        pictures += look(&entry.path());
    }
    assert!(pictures > 20, "{pictures}");
}

/// Looks at the pictures at or below a path; how many there are.
fn look(path: &std::path::Path) -> usize {
    if path.is_dir() {
        let all = std::fs::read_dir(path).expect("a folder").flatten();
        return all.map(|entry| look(&entry.path())).sum();
    }
    if path.extension().is_none_or(|ending| ending != "jpg") {
        return 0;
    }
    let picture = decode_picture(&std::fs::read(path).expect("a file")).expect("a picture");
    let [red, green, _] = picture.get(picture.width() / 2, picture.height() / 2);
    assert!(red > green, "{}: {red}, {green}", path.display());
    1
}

#[test]
fn a_folder_with_the_mission_of_another_flight_is_refused_and_one_with_its_own_is_not() {
    let folder = Folder::with_map("others");
    let route = format!("{};46.947383,7.689877", WEST[0]);
    let words = ["--route", &route, "--height", "100", "--day", "same"];
    assert!(folder.simulate(&words).status.success());
    // The same once more is another flight of the same folder.
    assert!(folder.simulate(&words).status.success());
    folder.write("flown/hall.geojson", write_mission(&super::plan::mission()));
    let done = folder.simulate(&words);
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(!done.status.success());
    assert!(said.contains("holds hall.geojson"), "{said}");
    std::fs::remove_file(folder.0.join("flown/hall.geojson")).expect("it was written");
    for name in ["map.png", "map.pgw", "map.prj"] {
        std::fs::copy(folder.0.join(name), folder.0.join("flown").join(name)).expect("a copy");
    }
    let done = folder.simulate(&words);
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(said.contains("holds map.png"), "{said}");
    // Beside the map that it is flown over it may lie.
    let beside = ["simulate", "--map", "flown/map.png", "--out", "flown"];
    assert!(
        folder
            .call(&[&beside, &words[..]].concat())
            .status
            .success()
    );
}

#[test]
fn a_route_beside_the_map_is_refused() {
    let folder = Folder::with_map("beside");
    let done = folder.simulate(&["--route", "46.95,7.69;47.2,7.69"]);
    let said = String::from_utf8_lossy(&done.stderr).into_owned();
    assert!(
        !done.status.success() && said.contains("is not on it"),
        "{said}"
    );
}

#[test]
fn a_flight_is_replayed_over_the_map_in_its_folder_and_by_the_mission_there() {
    let folder = Folder::with_map("replayed");
    // Some 150 m.
    let route = format!("{};46.947383,7.689877", WEST[0]);
    let words = ["--route", &route, "--height", "100", "--day", "same"];
    assert!(folder.simulate(&words).status.success());
    let replay = |out: &str| {
        let done = folder.call(&["replay", "flown", "--out", out, "--verbose"]);
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert!(done.status.success(), "{said}");
        let run = std::fs::read(folder.0.join(out)).expect("a run");
        (decode_run(out, &run).expect("a run"), said)
    };
    let looked = |run: &Run| {
        let frames = run.steps.iter().filter_map(|step| step.frame.as_ref());
        frames.filter(|frame| frame.laid.is_some()).count()
    };
    let (run, said) = replay("bare.run");
    assert_eq!(looked(&run), 0);
    assert!(said.contains("No map of the ground"), "{said}");
    for name in ["map.png", "map.pgw", "map.prj"] {
        std::fs::copy(folder.0.join(name), folder.0.join("flown").join(name)).expect("a copy");
    }
    let (run, said) = replay("laid.run");
    assert!(looked(&run) > 3, "{said}");
    assert!(said.contains("laid on the map as a whole"), "{said}");
    let mut mission = super::plan::mission();
    mission.navigator.whole_frames = None;
    mission.landmarks.clear();
    folder.write("flown/mission.geojson", write_mission(&mission));
    let (run, said) = replay("mission.run");
    assert_eq!(looked(&run), 0, "{said}");
    assert!(!said.contains("as a whole"), "{said}");
    let without = folder.call(&["replay", "flown", "--no-mission", "--out", "x.run"]);
    let said = String::from_utf8_lossy(&without.stderr).into_owned();
    assert!(said.contains("laid on the map as a whole"), "{said}");
}
