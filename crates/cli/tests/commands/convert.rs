//! `pilotage convert` as a user calls it.

use std::collections::BTreeMap;
use std::process::{Command, Output};

use pilotage_core::flight::files::{FileSink as _, ZipSink};
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::{read_mission, write_mission};
use pilotage_core::roads::{RoadClass, RoadLine};
use pilotage_core::simulate::Scenario;

use super::folder::Folder;

impl Folder {
    fn convert(&self, from: &str, to: &str, more: &[&str]) -> Output {
        self.call(&[&["convert", from, to], more].concat())
    }
}

fn words(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn a_route_goes_through_all_formats_and_comes_back() {
    let folder = Folder::new("convert-chain");
    let table = "route,lat,lon,alt_amsl_m,speed_m/s\nR,47.4,8.5,500,\nR,47.41,8.51,510,20\n";
    folder.write("a.csv", table);
    let chain = [
        "a.csv",
        "b.plan",
        "c.waypoints",
        "d.kml",
        "e.kmz",
        "f.gpx",
        "g.geojson",
        "h.csv",
    ];
    for pair in chain.windows(2) {
        let output = folder.convert(pair[0], pair[1], &[]);
        assert!(output.status.success(), "{}", words(&output.stderr));
    }
    let text = std::fs::read_to_string(folder.0.join("h.csv")).expect("it was written");
    let row = text.lines().nth(2).expect("there are two way-points");
    assert!(row.contains(",47.41,8.51,510,amsl,20,fly_by,,"), "{text}");
}

#[test]
fn notes_go_to_the_error_stream_and_one_of_several_routes_is_chosen() {
    let folder = Folder::new("convert-choose");
    let gpx = r#"<gpx><wpt lat="47" lon="8"/><rte><name>A</name><rtept lat="47.4" lon="8.5"/></rte>
        <rte><name>B</name><rtept lat="47.5" lon="8.5"/></rte></gpx>"#;
    folder.write("a.gpx", gpx);
    let output = folder.convert("a.gpx", "b.plan", &[]);
    assert!(!output.status.success());
    assert!(words(&output.stderr).contains("choose by --route one of: A, B"));
    for route in ["B", "2"] {
        let output = folder.convert("a.gpx", "b.plan", &["--route", route]);
        assert!(output.status.success(), "{}", words(&output.stderr));
        assert!(words(&output.stderr).contains("note: a.gpx: points without elevation"));
        assert!(words(&output.stderr).contains("note: b.plan: without 1 landmark"));
        let plan = std::fs::read_to_string(folder.0.join("b.plan")).expect("it was written");
        assert!(plan.contains("47.5") && !plan.contains("47.4"), "{plan}");
    }
    let output = folder.convert("a.gpx", "b.plan", &["--route", "3"]);
    assert!(words(&output.stderr).contains("there is no route `3`; there are: A, B"));
    let output = folder.convert("a.gpx", "b.doc", &[]);
    assert!(words(&output.stderr).contains("the extension names no format"));
    let output = folder.convert("a.gpx", "points.csv", &["--landmarks"]);
    assert!(words(&output.stdout).contains("0 routes and 1 landmark"));
}

#[test]
fn labels_go_from_one_format_into_the_other_and_are_counted() {
    let folder = Folder::new("convert-labels");
    let coco = r#"{"images": [{"id": 1, "file_name": "a.jpg", "width": 100, "height": 80}],
        "annotations": [{"id": 1, "image_id": 1, "category_id": 7, "bbox": [10, 20, 30, 40]}],
        "categories": [{"id": 7, "name": "barn"}]}"#;
    folder.write("a.json", coco);
    for pair in [["a.json", "b.zip"], ["b.zip", "c.json"]] {
        let output = folder.convert(pair[0], pair[1], &[]);
        assert!(output.status.success(), "{}", words(&output.stderr));
    }
    let text = std::fs::read_to_string(folder.0.join("c.json")).expect("it was written");
    let found: serde_json::Value = serde_json::from_str(&text).expect("it is JSON");
    assert_eq!(
        found["annotations"][0]["bbox"],
        serde_json::json!([10.0, 20.0, 30.0, 40.0])
    );
    let inspect = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .current_dir(&folder.0)
        .args(["inspect", "b.zip"])
        .output()
        .expect("the program starts");
    let said = words(&inspect.stdout);
    assert!(
        said.contains("1 boxes in 1 pictures") && said.contains("barn"),
        "{said}"
    );
}

#[test]
fn geojson_of_others_is_no_mission_to_inspect_and_one_of_ours_is() {
    let folder = Folder::new("inspect-geojson");
    let point = r#"{ "type": "Point", "coordinates": [8.5, 47.4] }"#;
    let feature = format!(r#"{{ "type": "Feature", "properties": {{}}, "geometry": {point} }}"#);
    let all = format!(r#"{{ "type": "FeatureCollection", "features": [{feature}] }}"#);
    for (name, text) in [
        ("a.geojson", all),
        ("b.geojson", point.to_owned()),
        ("c.geojsonl", format!("{feature}\n{feature}\n")),
    ] {
        folder.write(name, text);
        let told = folder.run(&["inspect", name]).unwrap_err();
        assert!(
            told.contains("GeoJSON") && told.contains("pilotage convert"),
            "{told}"
        );
    }
    let ours = folder.convert("a.geojson", "ours.geojson", &[]);
    assert!(ours.status.success(), "{}", words(&ours.stderr));
    let mission = write_mission(
        &read_mission(br#"{ "type": "FeatureCollection", "features": [] }"#).expect("it is empty"),
    );
    folder.write("mission.json", mission);
    let told = folder
        .run(&["inspect", "mission.json"])
        .expect("it is ours");
    assert!(told.starts_with("mission "), "{told}");
}

#[test]
fn files_of_other_programs_are_named_whatever_their_ending() {
    let folder = Folder::new("named");
    folder.write("a.ntf", "NITF02.1003BF01");
    folder.write(
        "b.tif",
        "version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
    );
    folder.write("c.xml", "<annotations><version>1.1</version></annotations>");
    for (command, file, name) in [
        (&["map", "info"][..], "a.ntf", "NITF"),
        (&["map", "info"], "b.tif", "Git LFS"),
        (&["inspect"], "c.xml", "CVAT"),
    ] {
        let told = folder.run(&[command, &[file]].concat()).unwrap_err();
        assert!(told.contains(name), "{told}");
    }
}

#[test]
fn rally_points_go_through_geojson_into_a_file_of_way_points_of_their_own() {
    let folder = Folder::new("convert-rally");
    let lines = "QGC WPL 110\n0\t0\t3\t5100\t0\t40\t0\t0\t47.4\t8.5\t60\t1\n";
    folder.write("a.waypoints", lines);
    for pair in [["a.waypoints", "b.geojson"], ["b.geojson", "c.waypoints"]] {
        let [from, to] = pair;
        let output = folder.convert(from, to, &[]);
        assert!(output.status.success(), "{}", words(&output.stderr));
        let said = words(&output.stdout);
        assert!(said.contains("1 rally point"), "{said}");
    }
    let back = std::fs::read_to_string(folder.0.join("c.waypoints")).unwrap();
    assert_eq!(back, lines);
}

#[test]
fn plain_text_of_another_kind_is_called_by_its_name_and_a_plan_by_its_line() {
    let folder = Folder::new("convert-text");
    let told = |content: &str| {
        folder.write("a.txt", content);
        let output = folder.convert("a.txt", "b.geojson", &[]);
        assert!(!output.status.success());
        words(&output.stderr)
    };
    let points = told("ply\nformat ascii 1.0\nelement vertex 3\n");
    assert!(points.contains("cloud of points"), "{points}");
    let later = told("QGC WPL 130\n0\t1\t0\t16\t0\t0\t0\t0\t47.4\t8.5\t60\t1\n");
    assert!(
        later.contains("line 1") && later.contains("QGC WPL 110"),
        "{later}"
    );
}

#[test]
fn a_mission_says_what_it_leaves_behind_and_is_not_written_over_itself() {
    let folder = Folder::new("convert-mission");
    let brighton = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/flights/brighton/mission.geojson"
    );
    let mut mission =
        read_mission(&std::fs::read(brighton).expect("it is there")).expect("a mission");
    mission.camera = Some(Scenario::camera());
    mission.navigator.alpha = 0.5;
    mission.roads = vec![RoadLine {
        name: "A 1".into(),
        class: RoadClass::Track,
        width: 3.0,
        course: vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(90.0, 10.0)],
        properties: BTreeMap::new(),
    }]
    .into();
    let before = write_mission(&mission);
    folder.write("m.geojson", &before);
    for target in ["out.geojson", "out.kml"] {
        let output = folder.convert("m.geojson", target, &[]);
        assert!(output.status.success());
        let said = words(&output.stderr);
        for part in ["its camera", "settings of the navigator", "1 road"] {
            assert!(said.contains(part), "{target}: {said}");
        }
    }
    let output = folder.convert("m.geojson", "./m.geojson", &[]);
    assert!(!output.status.success() && words(&output.stderr).contains("another file"));
    let after = std::fs::read_to_string(folder.0.join("m.geojson")).expect("it stays");
    assert_eq!(after.as_bytes(), before.as_bytes());
}

#[test]
fn the_mission_in_a_zip_is_converted_as_inspect_advises_and_files_without_a_flight_are_named() {
    let folder = Folder::new("convert-zip");
    let zip = |name: &str, files: &[(&str, &str)]| {
        let mut sink = ZipSink::default();
        for (inner, text) in files {
            sink.write(inner, text.as_bytes()).expect("memory");
        }
        folder.write(name, sink.finish().expect("memory"));
    };
    folder.write(
        "a.csv",
        "route,lat,lon,alt_amsl_m\nR,47.4,8.5,500\nR,47.41,8.51,510\n",
    );
    let made = folder.convert("a.csv", "a.plan", &[]);
    assert!(made.status.success(), "{}", words(&made.stderr));
    let plan = std::fs::read_to_string(folder.0.join("a.plan")).expect("it was written");
    zip(
        "m.zip",
        &[("out/a.plan", &plan), ("out/readme.md", "words")],
    );
    let told = folder.run(&["inspect", "m.zip"]).unwrap_err();
    assert!(
        told.contains("a plan of QGroundControl") && told.contains("pilotage convert"),
        "{told}"
    );
    let read = folder.convert("m.zip", "b.csv", &[]);
    let said = words(&read.stderr);
    assert!(read.status.success(), "{said}");
    assert!(
        said.contains("out/a.plan is read, which is in it"),
        "{said}"
    );
    let table = std::fs::read_to_string(folder.0.join("b.csv")).expect("it was written");
    assert!(table.contains(",47.41,8.51,510,amsl"), "{table}");

    let dump = r#"{"type": "FeatureCollection", "features": []}"#;
    zip(
        "other.zip",
        &[("x/fence.geojson", dump), ("x/readme.md", "words")],
    );
    let told = folder.run(&["inspect", "other.zip"]).unwrap_err();
    assert!(
        told.contains("x/fence.geojson is GeoJSON") && told.contains("pilotage convert"),
        "{told}"
    );
}
