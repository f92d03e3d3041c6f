use egui::{Modifiers, Vec2};
use egui_kittest::kittest::Queryable as _;
use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect};
use pilotage_jobs::{DescribeMapOrder, Job, JobEvent, MapInfo, MapSource, OpenOrder, OpenedFiles};
use pilotage_ui::host::OpenedFile;

use super::plan::{click, draw, planning};
use super::support::{Rig, ScriptedHost, rig, rig_on};

pub fn a_map(origin: Option<Geodetic>) -> OpenedFiles {
    OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: Some(MapInfo {
            name: "county.tif".into(),
            bounds: GroundRect::centered(GroundPoint::new(0.0, 0.0), 600.0, 800.0),
            native_gsd: 0.5,
            is_coarse_cheap: true,
            origin,
            attribution: None,
        }),
        terrain: None,
        mission: None,
        run: None,
        unplaced: None,
        photos: Vec::new(),
        imports: Vec::new(),
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    }
}

fn drop(rig: &mut Rig, opened: OpenedFiles) {
    rig.host().opens = Some(opened);
    rig.host().opened.push(vec![OpenedFile {
        path: "county.tif".into(),
        content: vec![1, 2, 3].into(),
    }]);
    rig.frames(6);
}

#[test]
fn a_map_far_away_begins_a_plan_of_its_own_and_undo_brings_the_mission_back() {
    let mut rig = rig();
    let before = rig.state();
    let there = Geodetic::from_degrees(46.86, -92.08, 0.0);
    drop(&mut rig, a_map(Some(there)));
    let state = rig.state();
    assert_eq!(state["workspace"], "Plan");
    assert_eq!(state["landmarks"].as_array().map(Vec::len), Some(0));
    assert!((state["origin"][0].as_f64().unwrap_or(0.0) - 46.86).abs() < 1e-9);
    rig.key_with(Modifiers::COMMAND, egui::Key::Z);
    let back = rig.state();
    assert_eq!(back["landmarks"], before["landmarks"]);
    assert_eq!(back["origin"], before["origin"]);
    // The map follows the mission into its world.
    let placed = rig.host().jobs.iter().rev().find_map(|(_, job)| match job {
        Job::DescribeMap(DescribeMapOrder(MapSource::Placed { origin, .. })) => Some(*origin),
        _ => None,
    });
    let latitude = placed.map(|origin| origin.latitude.to_degrees());
    let wanted = before["origin"][0].as_f64();
    assert!((latitude.unwrap_or(0.0) - wanted.unwrap_or(1.0)).abs() < 1e-9);
}

#[test]
fn proposals_for_one_map_are_gone_when_another_is_open() {
    let mut rig = rig();
    rig.key_with(Modifiers::SHIFT, egui::Key::P);
    rig.settle();
    rig.open_tab("Landmarks");
    rig.harness.get_by_label_contains(" landmarks for ").click();
    rig.settle();
    let count = |rig: &Rig| {
        rig.state()["plan"]["suggested"]["list"]
            .as_array()
            .map(Vec::len)
    };
    assert_eq!(count(&rig), Some(2));
    drop(
        &mut rig,
        a_map(Some(Geodetic::from_degrees(46.86, -92.08, 0.0))),
    );
    assert_eq!(count(&rig), Some(0));
}

#[test]
fn a_route_that_was_found_over_one_map_and_its_rehearsal_are_gone_when_another_is_open() {
    let mut rig = planning();
    draw(&mut rig, &[(0.0, 0.0), (90.0, 0.0)]);
    rig.harness.get_by_label("Rehearse this route").click();
    rig.settle();
    rig.key_with(Modifiers::SHIFT, egui::Key::F);
    rig.settle();
    click(&mut rig, 0.0, -300.0);
    click(&mut rig, 0.0, 300.0);
    rig.settle();
    rig.harness.get_by_label("Find the route").click();
    rig.settle();
    let plan = |rig: &Rig| rig.state()["plan"].clone();
    assert!(plan(&rig)["find"]["surest"].is_object());
    assert!(plan(&rig)["rehearsal"]["flown"].as_u64() > Some(0));
    let here = match opened_near(&mut rig) {
        Some(Job::Open(OpenOrder { near, .. })) => near,
        _ => None,
    };
    drop(&mut rig, a_map(here));
    rig.settle();
    let after = plan(&rig);
    assert!(after["find"]["surest"].is_null(), "it was found elsewhere");
    assert!(
        after["find"]["from"].is_array(),
        "it can be looked for again"
    );
    assert_eq!(after["rehearsal"]["flown"].as_u64().unwrap_or(0), 0);
}

#[test]
fn that_nothing_was_proposed_on_one_map_is_not_said_of_another() {
    let mut rig = rig();
    rig.key_with(Modifiers::SHIFT, egui::Key::P);
    rig.settle();
    rig.open_tab("Landmarks");
    rig.host().left = Some(|job| matches!(job, Job::Suggest(_)));
    rig.harness.get_by_label_contains(" landmarks for ").click();
    rig.settle();
    let mut jobs = rig.host().jobs.iter().rev();
    let asked = jobs.find(|(_, job)| matches!(job, Job::Suggest(_)));
    let asked = asked.map(|it| it.0).expect("what was asked for");
    let none = [JobEvent::Suggestions(Vec::new()), JobEvent::Finished];
    let none = none.map(|event| (asked, event));
    rig.host().events.extend(none);
    rig.settle();
    let is_said = |rig: &Rig| {
        let words = "no other place that the camera sees";
        rig.harness.query_by_label_contains(words).is_some()
    };
    assert!(is_said(&rig));
    let origin = rig.state()["origin"].clone();
    let at = |i: usize| origin[i].as_f64().unwrap_or(0.0);
    let here = Geodetic::from_degrees(at(0), at(1), 0.0);
    drop(&mut rig, a_map(Some(here)));
    rig.settle();
    assert!(!is_said(&rig));
}

#[test]
fn a_map_in_the_world_that_is_open_leaves_flight_and_mission_alone() {
    let mut rig = rig();
    let before = rig.state();
    let at = |i: usize| before["origin"][i].as_f64().unwrap_or(0.0);
    let mut origin = Geodetic::from_degrees(at(0), at(1), 0.0);
    // The world's own numbers, not those of their text.
    if let Some(Job::Open(OpenOrder {
        near: Some(near), ..
    })) = opened_near(&mut rig)
    {
        origin = near;
    }
    drop(&mut rig, a_map(Some(origin)));
    let after = rig.state();
    for kept in ["landmarks", "flight", "run_steps", "workspace"] {
        assert_eq!(before[kept], after[kept], "{kept}");
    }
    assert_eq!(after["title"], before["title"]);
}

/// Job that is asked for when a file of no use is dropped: it names the world that is open.
fn opened_near(rig: &mut Rig) -> Option<Job> {
    rig.host().opened.push(vec![OpenedFile {
        path: "x".into(),
        content: vec![0].into(),
    }]);
    rig.frames(3);
    let jobs = rig.host().jobs.iter().rev();
    jobs.map(|(_, job)| job.clone())
        .find(|job| matches!(job, Job::Open(_)))
}

#[test]
fn a_map_that_was_opened_is_there_again_after_a_reload() {
    let mut rig = rig();
    drop(
        &mut rig,
        a_map(Some(Geodetic::from_degrees(46.86, -92.08, 0.0))),
    );
    rig.settle();
    let host = ScriptedHost {
        stored: rig.host().stored.clone(),
        ..ScriptedHost::default()
    };
    let mut again = rig_on(host, Vec2::new(1440.0, 900.0));
    assert_eq!(again.host().flights(), 0, "nothing was flown over it");
    let placed = |job: &Job| {
        matches!(
            job,
            Job::DescribeMap(DescribeMapOrder(MapSource::Placed { .. }))
        )
    };
    assert!(again.host().jobs.iter().any(|(_, job)| placed(job)));
    assert_eq!(again.state()["landmarks"].as_array().map(Vec::len), Some(0));
}
