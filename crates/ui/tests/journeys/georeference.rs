use egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_jobs::{
    Job, JobEvent, JobId, MapInfo, MapSource, OpenedFiles, ReadControlPoints, Unplaced,
};
use pilotage_ui::host::OpenedFile;

use super::support::{Rig, rig};

/// The app after a picture without a place was dropped on it. The scripted host says that every map
/// reaches 1000 m to all sides.
fn rig_with_a_picture() -> Rig {
    let mut rig = rig();
    rig.host().opens = Some(OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: None,
        terrain: None,
        mission: None,
        run: None,
        unplaced: Some(Unplaced {
            name: "photo.png".into(),
            points: None,
        }),
        photos: Vec::new(),
        imports: Vec::new(),
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    });
    rig.host().opened.push(vec![OpenedFile {
        path: "photo.png".into(),
        content: vec![1].into(),
    }]);
    rig.frames(8);
    rig
}

fn click(rig: &mut Rig, at: Pos2) {
    rig.harness.hover_at(at);
    rig.frames(1);
    rig.harness.drag_at(at);
    rig.frames(1);
    rig.harness.drop_at(at);
    rig.host().now += 800.0;
    rig.frames(3);
}

/// Clicks places in the picture and the same in the same arrangement on the map.
fn pick(rig: &mut Rig, places: &[(f32, f32)]) {
    for (x, y) in places {
        let (picture, map) = (rig.rect("/georeferencer/picture"), rig.rect("/map/rect"));
        let offset = egui::vec2(*x, *y);
        click(rig, picture.center() + offset);
        click(rig, map.center() + offset);
    }
}

const PLACES: [(f32, f32); 4] = [(-90.0, -80.0), (100.0, -60.0), (80.0, 120.0), (-70.0, 90.0)];

#[test]
fn a_picture_without_a_place_is_put_on_the_ground_by_clicks() {
    let mut rig = rig_with_a_picture();
    pick(&mut rig, &PLACES);
    let it = rig.state()["georeferencer"].clone();
    assert_eq!(it["points"], 4, "{it}");
    // Both are the same plane at their own scales: the fit is as good as the pointer's pixels.
    let scale = rig.state()["map"]["metres_per_point"]
        .as_f64()
        .unwrap_or(0.0);
    assert!(
        it["rms_metres"]
            .as_f64()
            .is_some_and(|rms| rms < 2.0 * scale),
        "{it}"
    );
    assert!(it["rms_left_out"].is_number(), "{it}");
    assert!(rig.harness.query_all_by_label_contains("RMS").count() > 0);
    rig.harness
        .get_by_label_contains("Also stretched and skewed");
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(rig.state()["georeferencer"]["points"], 3);
    // Any three points fit: no error of theirs is told.
    rig.harness.get_by_label_contains("nothing is checked yet");
    assert!(rig.harness.query_by_label_contains("RMS").is_none());
    assert!(rig.harness.query_by_label("0.00").is_none());
    rig.key_with(Modifiers::COMMAND, Key::Y);
    rig.harness.get_by_label("Save world file").click();
    rig.harness.get_by_label("Save points").click();
    rig.frames(3);
    let names: Vec<String> = rig
        .host()
        .saved
        .iter()
        .map(|(name, _)| name.clone())
        .collect();
    assert_eq!(names, ["photo.pgw", "photo.prj", "photo.points"]);
    rig.harness.get_by_label("Use as the map").click();
    rig.frames(3);
    assert!(rig.state()["georeferencer"].is_null());
    rig.harness.get_by_label_contains("Open the picture again");
    // Opened again, it has its points, which undo takes away.
    let content = vec![1];
    open(&mut rig, "photo.png", content);
    rig.frames(6);
    assert_eq!(rig.state()["georeferencer"]["points"], 4);
    rig.key_with(Modifiers::COMMAND, Key::Z);
    assert_eq!(rig.state()["georeferencer"]["points"], 0);
}

#[test]
fn another_picture_of_the_same_name_does_not_have_the_points_of_the_one_that_was_left() {
    let mut rig = rig_with_a_picture();
    pick(&mut rig, &PLACES);
    rig.harness.get_by_label("Close").click();
    rig.frames(3);
    rig.host().left = Some(|job| matches!(job, Job::DescribeMap(_)));
    open(&mut rig, "photo.png", vec![2]);
    rig.frames(6);
    let is_of_picture = |job: &Job| {
        let of = |map: &MapSource| matches!(map, MapSource::Picture { .. });
        matches!(job, Job::DescribeMap(order) if of(&order.0))
    };
    let mut jobs = rig.host().jobs.iter().rev();
    let describe = jobs.find(|(_, job)| is_of_picture(job)).unwrap().0;
    let info = MapInfo {
        name: "photo.png".into(),
        bounds: GroundRect::centered(GroundPoint::new(0.0, 0.0), 200.0, 800.0),
        native_gsd: 1.0,
        is_coarse_cheap: true,
        origin: None,
        attribution: None,
    };
    let events = [JobEvent::MapInfo(info), JobEvent::Finished];
    let events = events.map(|event| (describe, event));
    rig.host().events.extend(events);
    rig.frames(3);
    assert_eq!(rig.state()["georeferencer"]["points"], 0);
    rig.harness.get_by_label("Close").click();
    rig.frames(3);
    // The same picture again still has them.
    rig.host().left = None;
    open(&mut rig, "photo.png", vec![1]);
    rig.frames(6);
    assert_eq!(rig.state()["georeferencer"]["points"], 4);
}

#[test]
fn coordinates_can_be_typed_and_wrong_ones_are_told() {
    let mut rig = rig_with_a_picture();
    let picture = rig.rect("/georeferencer/picture");
    click(&mut rig, picture.center());
    rig.harness.get_by_label("Coordinates of the place").focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text("somewhere".into()));
    rig.key(Key::Enter);
    assert_eq!(rig.state()["georeferencer"]["points"], 0);
    assert!(
        rig.harness
            .query_by_label_contains("type latitude and longitude")
            .is_some()
    );
}

#[test]
fn a_point_is_picked_by_keyboard_alone_and_taken_back_half_picked() {
    let mut rig = rig_with_a_picture();
    let of = |rig: &Rig, what: &str| rig.state()["georeferencer"][what].clone();
    let is_picking = |rig: &Rig| of(rig, "pending")[0] == true;
    rig.harness.get_by_label("Picture photo.png").focus();
    rig.frames(2);
    let (before, scale) = (of(&rig, "picture_center"), of(&rig, "pixels_per_point"));
    rig.key(Key::ArrowRight);
    rig.key(Key::Plus);
    assert_ne!(of(&rig, "picture_center"), before);
    assert!(of(&rig, "pixels_per_point").as_f64() < scale.as_f64());
    rig.key(Key::Enter);
    assert!(is_picking(&rig));
    rig.harness.get_by_label("Undo").click();
    rig.frames(3);
    assert!(!is_picking(&rig), "what is half picked is taken back");
    rig.harness.get_by_label("Picture photo.png").focus();
    rig.frames(2);
    rig.key(Key::Enter);
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::Canvas, "Map")
        .focus();
    rig.frames(2);
    rig.key(Key::Enter);
    assert_eq!(of(&rig, "points"), 1);
}

#[test]
fn closing_leaves_everything_as_it_was() {
    let mut rig = rig_with_a_picture();
    let before = rig.state();
    pick(&mut rig, &PLACES[..2]);
    rig.harness.get_by_label("Close").click();
    rig.frames(3);
    let after = rig.state();
    assert!(after["georeferencer"].is_null());
    for kept in ["landmarks", "flight", "run_steps", "origin"] {
        assert_eq!(before[kept], after[kept], "{kept}");
    }
}

#[test]
fn another_flight_is_shown_in_the_place_of_a_picture_without_points_and_behind_one_with_some() {
    for (points, stays) in [(0, false), (2, true)] {
        let mut rig = rig_with_a_picture();
        pick(&mut rig, &PLACES[..points]);
        rig.menu("Open", "Simulate a flight…");
        rig.frames(8);
        rig.harness.get_by_label("Fly").click();
        rig.frames(8);
        assert_eq!(rig.state()["georeferencer"].is_object(), stays, "{points}");
    }
}

/// Opens a file.
fn open(rig: &mut Rig, path: &str, content: Vec<u8>) {
    let (path, content) = (path.to_owned(), content.into());
    rig.host().opened.push(vec![OpenedFile { path, content }]);
    rig.frames(3);
}

/// Jobs that read control points, in the order in which they were asked for.
fn points_asked_for(rig: &mut Rig) -> Vec<JobId> {
    let jobs = rig.host().jobs.iter();
    let jobs = jobs.filter(|(_, job)| matches!(job, Job::ReadControlPoints(_)));
    jobs.map(|(id, _)| *id).collect()
}

#[test]
fn points_and_places_that_are_opened_go_to_the_picture_that_is_put_on_the_ground() {
    let mut rig = rig_with_a_picture();
    pick(&mut rig, &PLACES);
    rig.harness.get_by_label("Save points").click();
    rig.frames(3);
    let (_, points) = rig.host().saved[0].clone();
    pick(&mut rig, &[(0.0, 0.0)]);
    assert_eq!(rig.state()["georeferencer"]["points"], 5);
    let text = String::from_utf8(points.clone()).unwrap();
    open(&mut rig, "photo.points", points.clone());
    let read = ReadControlPoints::read("photo.points", &text, None, None, "").unwrap();
    let asked = points_asked_for(&mut rig)[0];
    rig.host()
        .events
        .push((asked, JobEvent::ControlPoints(Box::new(read))));
    rig.frames(3);
    assert_eq!(rig.state()["georeferencer"]["points"], 4);
    open(&mut rig, "other.points", b"nothing".to_vec());
    let asked = points_asked_for(&mut rig)[1];
    let why = "other.points, line 1: no".to_owned();
    rig.host().events.push((asked, JobEvent::Failed(why)));
    rig.frames(3);
    assert_eq!(rig.state()["georeferencer"]["points"], 4);
    let notices = rig.state()["toasts"].to_string();
    assert!(notices.contains("other.points, line 1"), "{notices}");
    open(&mut rig, "places.kml", vec![1]);
    let jobs = &rig.host().jobs;
    let is_of_places =
        |(_, job): &(_, Job)| matches!(job, Job::ReadPlaces(order) if order.key == "opened-4");
    assert!(jobs.iter().any(is_of_places));
    let opens = jobs.iter().filter(|(_, job)| matches!(job, Job::Open(_)));
    assert_eq!(
        opens.count(),
        1,
        "files for the picture were opened as others"
    );
}

#[test]
fn files_without_places_that_are_opened_beside_a_picture_are_opened_as_anything_else() {
    let no_places: [JobEvent; 2] = [
        JobEvent::Failed("It has no places.".to_owned()),
        JobEvent::Places(Vec::new()),
    ];
    for answer in no_places {
        let mut rig = rig_with_a_picture();
        let path = "flight.csv".to_owned();
        let content = vec![1].into();
        rig.host().opened.push(vec![OpenedFile { path, content }]);
        rig.frames(3);
        let jobs = &rig.host().jobs;
        let asked = jobs
            .iter()
            .find(|(_, job)| matches!(job, Job::ReadPlaces(_)));
        let id = asked.expect("places are looked for first").0;
        rig.host().events.push((id, answer));
        rig.frames(5);
        let jobs = &rig.host().jobs;
        let count = |is: fn(&Job) -> bool| jobs.iter().filter(|(_, job)| is(job)).count();
        assert_eq!(count(|job| matches!(job, Job::ReadPlaces(_))), 1);
        assert_eq!(count(|job| matches!(job, Job::Open(_))), 2);
        let notices = rig.state()["toasts"].to_string();
        assert!(!notices.contains("No places"), "{notices}");
    }
}
