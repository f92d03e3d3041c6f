use egui_kittest::kittest::Queryable as _;
use pilotage_core::exchange::{Format, read_any};
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Route;
use pilotage_core::roads::RoadLine;
use pilotage_jobs::{ImportedFile, Job, OpenOrder, OpenedFiles};
use pilotage_ui::host::OpenedFile;

use super::super::support::{Rig, flight::mission, rig};
use super::{choose, draw, planning};

fn opened(rig: &mut Rig, file: ImportedFile) {
    rig.host().opens = Some(OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: None,
        terrain: None,
        mission: None,
        run: None,
        unplaced: None,
        photos: Vec::new(),
        imports: vec![file],
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "trip.plan".into(),
        content: vec![1].into(),
    }]);
    rig.frames(4);
    rig.settle();
}

fn file() -> ImportedFile {
    let at = |north, east| {
        let altitude = pilotage_core::mission::USUAL_ALTITUDE;
        pilotage_core::mission::WayPoint::new(GroundPoint::new(north, east), altitude)
    };
    let bounds = GroundRect::centered(GroundPoint::new(40.0, 40.0), 20.0, 20.0);
    ImportedFile {
        name: "trip.plan".into(),
        format: "QGroundControl plan".into(),
        routes: vec![Route {
            id: 9,
            name: "There".into(),
            way_points: vec![at(0.0, -200.0), at(0.0, 200.0)],
            ..Route::default()
        }],
        landmarks: vec![Landmark::new(1, "Silo", bounds)],
        no_fly: Vec::new(),
        rally: Vec::new(),
        roads: Vec::new(),
        notes: vec!["1 command is kept but not understood: command 31000".into()],
    }
}

#[test]
fn an_opened_plan_is_added_to_the_mission_with_a_word_on_what_is_not_understood() {
    let mut rig = planning();
    let landmarks = |rig: &Rig| rig.state()["landmarks"].as_array().map_or(0, Vec::len);
    let before = landmarks(&rig);
    opened(&mut rig, file());
    let state = rig.state();
    assert_eq!(state["plan"]["routes"][0]["name"], "There");
    assert_eq!(landmarks(&rig), before + 1);
    let toast = state["toasts"].as_array().and_then(|t| t.last()).cloned();
    let toast = toast.expect("a word on it");
    let text = format!("{} {}", toast["title"], toast["text"]);
    assert!(text.contains("1 route and 1 landmark"), "{text}");
    assert!(text.contains("not understood: command 31000"), "{text}");
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    let state = rig.state();
    assert_eq!(state["plan"]["routes"].as_array().map(Vec::len), Some(0));
    assert_eq!(landmarks(&rig), before, "one step back takes all of it");
}

/// Two roads, 60 m from each other.
fn town() -> ImportedFile {
    let road = |north: f64| RoadLine {
        width: 6.0,
        course: [-200.0, 200.0]
            .map(|east| GroundPoint::new(north, east))
            .to_vec(),
        ..RoadLine::default()
    };
    ImportedFile {
        name: "town.osm".into(),
        format: "OpenStreetMap".into(),
        roads: vec![road(0.0), road(60.0)],
        notes: vec!["By class: 2 residential".into()],
        ..ImportedFile::default()
    }
}

#[test]
fn roads_that_are_opened_again_are_left_out_and_that_is_said() {
    let mut rig = planning();
    for title in ["Added 2 roads from town.osm", "Added nothing from town.osm"] {
        opened(&mut rig, town());
        let state = rig.state();
        assert_eq!(state["roads"]["count"], 2);
        let toast = state["toasts"].as_array().and_then(|t| t.last()).cloned();
        let toast = toast.expect("a word on it");
        let text = format!("{} {}", toast["title"], toast["text"]);
        assert!(text.contains(title), "{text}");
        let is_again = title.contains("nothing");
        let is_said = text.contains("2 roads left out that the mission has");
        assert_eq!(is_said, is_again, "{text}");
    }
}

#[test]
fn opened_roads_are_added_with_a_word_on_their_classes_and_leave_people_where_they_are() {
    let mut rig = rig();
    let file = town();
    rig.harness.get_by_label("Legend").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label("Roads").is_none());
    opened(&mut rig, file);
    let state = rig.state();
    assert_eq!(state["workspace"], "Replay");
    let toast = state["toasts"].as_array().and_then(|t| t.last()).cloned();
    let toast = toast.expect("a word on it");
    let text = format!("{} {}", toast["title"], toast["text"]);
    assert!(
        text.contains("Added 2 roads from town.osm (OpenStreetMap)"),
        "{text}"
    );
    assert!(text.contains("By class: 2 residential"), "{text}");
    assert!(rig.harness.query_by_label("Roads").is_some());
    rig.key_with(egui::Modifiers::COMMAND, egui::Key::Z);
    rig.frames(2);
    assert!(rig.harness.query_by_label("Roads").is_none());
}

#[test]
fn files_are_placed_around_the_open_mission() {
    let mut rig = planning();
    opened(&mut rig, file());
    let jobs = &rig.host().jobs;
    let origin = jobs.iter().find_map(|(_, job)| match job {
        Job::Open(OpenOrder { origin, .. }) => Some(*origin),
        _ => None,
    });
    assert_eq!(origin, Some(mission().origin));
}

#[test]
fn the_route_is_exported_from_a_menu_of_formats_behind_what_can_be_saved() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 300.0)]);
    let label = "Export the route as a QGroundControl plan";
    rig.harness.get_by_label("Save").click();
    rig.frames(3);
    assert!(rig.harness.query_by_label(label).is_none());
    rig.harness.get_by_label("Export the route as …").click();
    rig.frames(3);
    rig.harness.get_by_label(label).click();
    rig.frames(3);
    let (name, _) = rig.host().saved.pop().expect("a file");
    assert_eq!(name, "Route-1.plan");
    assert!(rig.harness.query_by_label("Save the run").is_none());
}

#[test]
fn the_route_is_exported_from_the_menu_and_reads_again() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, -300.0), (60.0, 300.0)]);
    rig.harness.get_by_label("Export").click();
    rig.frames(3);
    let label = "Export the route as a QGroundControl plan";
    rig.harness.get_by_label(label).click();
    rig.frames(3);
    let (name, bytes) = rig.host().saved.pop().expect("a file");
    assert_eq!(name, "Route-1.plan");
    let frame = LocalFrame::new(mission().origin);
    let back = read_any(&name, &bytes, Some(frame)).expect("a plan");
    assert_eq!(back.format, Format::Plan);
    assert_eq!(back.routes[0].way_points.len(), 2);
    assert!((back.routes[0].way_points[1].position.north - 60.0).abs() < 2.0);
}

#[test]
fn the_landmarks_are_exported_from_the_palette() {
    let mut rig = planning();
    for (words, format) in [
        ("export the landmarks as kml", Format::Kml),
        ("export the landmarks as csv", Format::Csv),
        ("export the landmarks as geojson", Format::GeoJson),
    ] {
        rig.key_with(egui::Modifiers::COMMAND, egui::Key::K);
        rig.harness.event(egui::Event::Text(words.into()));
        rig.frames(2);
        rig.key(egui::Key::Enter);
        let (name, bytes) = rig.host().saved.pop().expect("a file");
        let frame = LocalFrame::new(mission().origin);
        let back = read_any(&name, &bytes, Some(frame)).expect("landmarks");
        assert_eq!(back.format, format, "{name}");
        let names: Vec<_> = back.landmarks.iter().map(|l| l.name.as_str()).collect();
        assert_eq!(names, ["Barn", "Chapel", "Pool", "Mill"], "{name}");
    }
}

#[test]
fn way_points_of_a_file_that_are_looked_at_stay_what_they_are() {
    let mut rig = planning();
    let mut slow = file();
    slow.routes[0].way_points[1].speed = Some(3.0);
    slow.routes[0].way_points[0].altitude.metres = 2.0 / 3.0;
    opened(&mut rig, slow);
    let now = |rig: &Rig| {
        let state = rig.state();
        let way_points = state["plan"]["routes"][0]["way_points"].as_array();
        let numbers = way_points.expect("a route").iter();
        let numbers = numbers.map(|it| (it["altitude"].clone(), it["speed"].clone()));
        (numbers.collect::<Vec<_>>(), state["undo"].clone())
    };
    let before = now(&rig);
    assert_eq!(before.0[1].1, 3.0);
    for _ in 0..2 {
        for way_point in [2, 1] {
            choose(&mut rig, way_point);
            rig.settle();
            let field = "Altitude of the way-point";
            rig.harness.get_by_label(field).focus();
            rig.frames(2);
            for _ in 0..4 {
                rig.key(egui::Key::Tab);
            }
            rig.settle();
            assert_eq!(now(&rig), before, "way-point {way_point}");
        }
        // The same in feet and knots.
        rig.harness.get_by_label("Name of the route").focus();
        rig.key(egui::Key::Escape);
        rig.key(egui::Key::U);
    }
}
