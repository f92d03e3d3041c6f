//! `pilotage study` of work on a map: the same to the bit as the command that does it whole, however it is cut.

use pilotage_core::frames::{Altitude, AltitudeFrame, Geodetic, GroundPoint, GroundRect};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{
    FrameLabels, MapReference, Mission, Route, WayPoint, read_mission, write_mission,
};
use pilotage_core::raster::{Picture, encode_png};
use pilotage_core::simulate::Scenario;
use serde_json::Value;

use super::folder::Folder;

/// Rough green ground of 1.4 by 1.4 km with smooth bright roofs.
fn map(folder: &Folder) {
    let picture = Picture::from_fn(1400, 1400, |x, y| {
        let noise = ((x * 7919 + y * 104_729) % 37) as u8;
        let is_roof = (20..32).contains(&(x % 130)) && (30..46).contains(&(y % 110));
        if is_roof {
            [165, 110, 95]
        } else {
            [70 + noise, 92 + noise, 48 + noise]
        }
    });
    folder.write("map.png", encode_png(&picture).expect("a picture"));
    folder.write("map.pgw", b"1\n0\n0\n-1\n100.5\n-50.5\n");
}

const TABLE: &str = "name = \"county\"\nwork = \"reference-table\"\nmap = \"map.png\"\n";

impl Folder {
    fn work(&self, words: &[&str]) -> Result<String, String> {
        self.run(&[&["study", "work.toml"], words].concat())
    }

    fn bytes(&self, path: &str) -> Vec<u8> {
        std::fs::read(self.0.join(path)).unwrap_or_else(|why| panic!("{path}: {why}"))
    }
}

#[test]
fn the_table_of_a_map_is_the_same_by_pieces_of_two_programs_and_whole() {
    let folder = Folder::new("map-work-table");
    map(&folder);
    folder.write("work.toml", TABLE);
    folder
        .run(&["reference-map", "map.png", "-o", "whole.table"])
        .unwrap();
    let whole = folder.bytes("whole.table");
    let said = folder.work(&["--out", "one"]).unwrap();
    assert!(said.contains("landmarks of 16 tiles"), "{said}");
    assert!(folder.bytes("one/landmarks.table") == whole && whole.len() > 200);

    // By two programs on one folder, the second first.
    let share = |share| ["--out", "two", "--shares", "2", "--share", share];
    assert_eq!(folder.work(&share("1")), Ok(String::new()));
    let described = folder.work(&["--out", "two", "--describe"]).unwrap();
    let described: Value = serde_json::from_str(&described).unwrap();
    assert_eq!(
        (&described["shards"], &described["is_complete"]),
        (&4.into(), &false.into())
    );
    assert_eq!(described["missing"], serde_json::json!([0, 2]));
    let lacking = folder.work(&["--out", "two", "--merge"]).unwrap_err();
    assert!(lacking.contains("2 of 4 shards are missing"), "{lacking}");
    folder.work(&share("0")).unwrap();
    folder
        .work(&["--out", "two", "--merge", "--quiet"])
        .unwrap();
    assert_eq!(folder.bytes("two/landmarks.table"), whole);

    // Sent to another machine, which sees the map under the same name.
    folder.work(&["--pack", "packed.toml"]).unwrap();
    let elsewhere = Folder::new("map-work-elsewhere");
    elsewhere.write("work.toml", folder.bytes("packed.toml"));
    elsewhere
        .work(&["--out", "there", "--only", "3", "--quiet"])
        .unwrap();
    assert_eq!(
        elsewhere.bytes("there/shards/000003.piece"),
        folder.bytes("one/shards/000003.piece")
    );

    // Another map under the same name is other work.
    folder.write(
        "map.png",
        encode_png(&Picture::from_fn(1400, 1400, |_, _| [9; 3])).unwrap(),
    );
    let other = folder.work(&["--out", "one"]).unwrap_err();
    assert!(other.contains("begun with another plan"), "{other}");
}

/// A mission of the first landmark of a scenario over its own generated map.
fn mission_of_one() -> String {
    let name = "distinct-400ft-calm";
    let mut mission = Scenario::named(name).expect("it is there").mission();
    mission.landmarks.truncate(1);
    mission.map = Some(MapReference::Scenario(name.to_owned()));
    write_mission(&mission)
}

#[test]
fn a_detector_by_pieces_is_the_one_that_is_trained_at_once() {
    let folder = Folder::new("map-work-detectors");
    folder.write("one.geojson", mission_of_one());
    folder.write(
        "work.toml",
        "name = \"cascades\"\nwork = \"detectors\"\nmission = \"one.geojson\"\nphotos = 6\n",
    );
    folder.work(&["--out", "pieces", "--quiet"]).unwrap();
    let words = "train --mission one.geojson --positives 6 --write-mission whole.geojson";
    folder.run(&words.split(' ').collect::<Vec<_>>()).unwrap();
    assert_eq!(
        folder.bytes("pieces/mission.geojson"),
        folder.bytes("whole.geojson")
    );
    let words = String::from_utf8(folder.bytes("pieces/summary.txt")).unwrap();
    assert!(words.contains("held-out photos"), "{words}");
}

#[test]
fn a_detector_that_cannot_be_trained_holds_up_none_of_the_others() {
    let folder = Folder::new("map-work-untrainable");
    let name = "distinct-400ft-calm";
    let mut mission = Scenario::named(name).expect("it is there").mission();
    mission.landmarks.truncate(2);
    let large = &mut mission.landmarks[0];
    large.name = "Everything".to_owned();
    large.bounds = large.bounds.grown(2000.0);
    mission.map = Some(MapReference::Scenario(name.to_owned()));
    folder.write("two.geojson", write_mission(&mission));
    let plan = "name = \"cascades\"\nwork = \"detectors\"\nmission = \"two.geojson\"\nphotos = 6\n";
    folder.write("work.toml", plan);
    let said = folder.work(&["--out", "two"]).unwrap();
    let why = "not trained: landmark \"Everything\" does not fit into a picture";
    assert!(
        said.contains(why) && said.contains("held-out photos"),
        "{said}"
    );
    let described = folder.work(&["--out", "two", "--describe"]).unwrap();
    assert!(described.contains("\"is_complete\": true"), "{described}");
    let trained = read_mission(&folder.bytes("two/mission.geojson")).unwrap();
    let has_one = |index: usize| trained.landmarks[index].trained_text().is_some();
    assert_eq!((has_one(0), has_one(1)), (false, true));
    // Where none can be trained, it ends with the reasons.
    mission.landmarks.truncate(1);
    folder.write("two.geojson", write_mission(&mission));
    let none = folder.work(&["--out", "none"]).unwrap_err();
    assert!(
        none.contains("no detector could be trained") && none.contains(why),
        "{none}"
    );
}

/// Fields of many sizes and greys, none like another, 200 by 200 m.
fn patchwork(folder: &Folder) {
    let picture = Picture::from_fn(400, 400, |x, y| {
        let (column, row) = (x / (17 + y / 90), y / (13 + x / 120));
        let drawn = (column * 7919 + row * 104_729 + column * row * 31) % 197;
        [drawn as u8, 40 + drawn as u8, 20 + (drawn / 2) as u8]
    });
    folder.write("map.png", encode_png(&picture).expect("a picture"));
    folder.write("map.pgw", b"0.5\n0\n0\n-0.5\n-99.75\n99.75\n");
}

#[test]
fn landmarks_proposed_by_shares_are_those_that_are_proposed_at_once() {
    let folder = Folder::new("map-work-suggestions");
    patchwork(&folder);
    let altitude = Altitude::new(60.0, AltitudeFrame::AboveGround);
    let at = |north| WayPoint::new(GroundPoint::new(north, 0.0), altitude);
    let mut mission = Mission::new("Fields", Geodetic::from_degrees(0.0, 0.0, 0.0));
    mission.routes.push(Route {
        name: "Over the fields".to_owned(),
        way_points: vec![at(-60.0), at(60.0)],
        ..Route::default()
    });
    folder.write("fields.geojson", write_mission(&mission));
    folder.write(
        "work.toml",
        "name = \"fields\"\nwork = \"suggestions\"\nmission = \"fields.geojson\"\nmap = \"map.png\"\ncount = 2\n",
    );
    let said = folder.work(&["--out", "pieces"]).unwrap();
    let words = "plan --mission fields.geojson --map map.png --suggest 2 --out whole.geojson";
    let whole = folder.run(&words.split(' ').collect::<Vec<_>>()).unwrap();
    assert_eq!(
        folder.bytes("pieces/mission.geojson"),
        folder.bytes("whole.geojson")
    );
    let first = whole
        .lines()
        .find(|line| line.starts_with("  1  north"))
        .unwrap();
    assert!(said.contains(first), "{said}");
}

/// A flight of two frames with a camera, as a folder.
fn flight(folder: &Folder, focal: f64) {
    let time = r#""time": { "column": "when", "format": "iso" }"#;
    let json = format!(
        r#"{{
        "pilotage_flight": 1,
        "name": "flown",
        "origin": {{ "latitude_deg": 0.0, "longitude_deg": 0.0 }},
        "camera": {{ "width": 40, "height": 30, "focal_px": {focal} }},
        "start": {{ "standard_deviation_m": 3 }},
        "frames": {{ "file": "log.csv", "name": "photo", "directory": "frames", {time} }},
        "channels": [
            {{ "name": "gps", "file": "log.csv", {time},
              "latitude": {{ "column": "lat" }}, "longitude": {{ "column": "lon" }} }}
        ] }}"#
    );
    std::fs::create_dir_all(folder.0.join("flown/frames")).expect("it can be made");
    folder.write("flown/flight.json", json);
    let rows = "2020-01-01T00:00:10Z,0.001,0.0,a.png\n2020-01-01T00:00:11Z,0.002,0.0,b.png\n";
    folder.write("flown/log.csv", format!("when,lat,lon,photo\n{rows}"));
    for name in ["a.png", "b.png"] {
        photo(folder, name, 90);
    }
}

fn photo(folder: &Folder, name: &str, grey: u8) {
    let picture = encode_png(&Picture::from_fn(40, 30, |_, _| [grey; 3])).expect("a picture");
    folder.write(&format!("flown/frames/{name}"), picture);
}

#[test]
fn pieces_are_of_the_files_beside_the_map_and_of_the_flight_that_they_were_made_of() {
    let folder = Folder::new("map-work-files");
    patchwork(&folder);
    flight(&folder, 30.0);
    let mut mission = Mission::new("Fields", Geodetic::from_degrees(0.0, 0.0, 0.0));
    let bounds = GroundRect::centered(GroundPoint::default(), 30.0, 30.0);
    mission.landmarks.push(Landmark::new(1, "Field", bounds));
    mission.labels.push(FrameLabels {
        frame: "a.png".to_owned(),
        size: (40, 30),
        absent: vec![1],
        ..FrameLabels::default()
    });
    folder.write("fields.geojson", write_mission(&mission));
    let plan = "name = \"fields\"\nwork = \"detectors\"\nmission = \"fields.geojson\"\nmap = \"map.png\"\n";
    folder.write("work.toml", format!("{plan}flight = \"flown\"\n"));
    // In the folder of the flight, of which it is no part.
    let work = || folder.work(&["--out", "flown/out", "--describe"]);
    let described: Value = serde_json::from_str(&work().expect("it can be done")).unwrap();
    // Begun as who fills it with pieces of others begins it.
    std::fs::create_dir_all(folder.0.join("flown/out/shards")).unwrap();
    let begun = described["begun"].as_str().expect("a text");
    folder.write("flown/out/study.json", begun);
    work().expect("it goes on");
    folder.write("flown/notes.txt", "windy");
    photo(&folder, "b.png", 20);
    work().expect("what is not read is another matter");

    let moved = "0.5\n0\n0\n-0.5\n-89.75\n99.75\n";
    let elsewhere = "when,lat,lon,photo\n2020-01-01T00:00:10Z,0.003,0.0,a.png\n";
    let changes: [(&str, &dyn Fn()); 4] = [
        ("place of the map", &|| folder.write("map.pgw", moved)),
        ("camera", &|| flight(&folder, 45.0)),
        ("log", &|| folder.write("flown/log.csv", elsewhere)),
        ("labelled photo", &|| photo(&folder, "a.png", 20)),
    ];
    for (what, change) in changes {
        change();
        let why = work().expect_err(what);
        assert!(why.contains("begun with another plan"), "{what}: {why}");
        patchwork(&folder);
        flight(&folder, 30.0);
        work().expect("it is as it was");
    }
}

#[test]
fn work_that_cannot_be_done_is_refused_with_the_file_and_the_place() {
    let folder = Folder::new("map-work-refused");
    for (text, words) in [
        (TABLE.to_owned(), "map.png: there is no such file"),
        (
            TABLE.replace("reference-table", "tables"),
            "unknown variant",
        ),
        (TABLE.replace("county", "a county"), "name: give a word"),
        (
            TABLE.replace("map = \"map.png\"", "count = 3"),
            "map: say the map",
        ),
        (
            TABLE.replace("reference-table", "detectors"),
            "mission: say the mission",
        ),
    ] {
        folder.write("work.toml", &text);
        let why = folder.work(&[]).unwrap_err();
        assert!(why.contains("work.toml") && why.contains(words), "{why}");
    }
}
