use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{ExplainOrder, ExplainedBy, FileContent, Job, OpenedFiles};
use pilotage_ui::host::OpenedFile;

use super::support::flight::mission;
use super::support::{Rig, rig};

/// Searches of trained detectors asked for so far.
fn asked(rig: &mut Rig) -> usize {
    let of_detector = |job: &Job| match job {
        Job::ExplainMatch(ExplainOrder { by, .. }) => *by == ExplainedBy::Cascade,
        _ => false,
    };
    let jobs = &rig.host().jobs;
    jobs.iter().filter(|(_, job)| of_detector(job)).count()
}

/// Opens the mission with something trained for each landmark.
fn open_trained(rig: &mut Rig) {
    let mut trained = mission();
    for landmark in &mut trained.landmarks {
        let b = landmark.bounds;
        let text = format!(
            "{{\"bounds\":{{\"south\":{},\"north\":{},\"west\":{},\"east\":{}}}}}",
            b.south, b.north, b.west, b.east
        );
        let name = "trained_detector".to_owned();
        landmark.properties.insert(name, text);
    }
    rig.host().opens = Some(OpenedFiles {
        key: String::new(),
        log: None,
        flight: None,
        map: None,
        terrain: None,
        mission: Some(trained),
        run: None,
        unplaced: None,
        photos: Vec::new(),
        imports: Vec::new(),
        tables: Vec::new(),
        labels: None,
        beside: None,
        remarks: Vec::new(),
    });
    let content = FileContent::Bytes([].into());
    let path = "trained.geojson".to_owned();
    rig.host().opened.push(vec![OpenedFile { path, content }]);
    rig.settle();
}

#[test]
fn the_detector_tab_says_to_train_one_and_then_asks_what_it_saw_but_not_again_and_again() {
    let mut rig = rig();
    rig.key(Key::End);
    rig.key(Key::Z);
    rig.frames(3);
    assert_eq!(rig.state()["side_tab"], "Detector");
    rig.harness
        .get_by_label_contains("No detector was trained for");
    assert_eq!(asked(&mut rig), 0);
    open_trained(&mut rig);
    rig.frames(6);
    let once = asked(&mut rig);
    assert!(once > 0);
    rig.frames(20);
    assert_eq!(asked(&mut rig), once, "asked once for each run");
    let shown = rig.state()["detector"]["shown"].clone();
    assert_eq!(shown["trouble"], "the picture is gone");
    rig.harness.get_by_label("the picture is gone");
    // Another frame is another search.
    for _ in 0..40 {
        rig.key(Key::ArrowLeft);
    }
    rig.frames(4);
    assert!(asked(&mut rig) > once);
}

#[test]
fn stages_are_stepped_through_from_anywhere_in_replay() {
    let mut rig = rig();
    rig.open_tab("Filter");
    rig.key_with(Modifiers::SHIFT, Key::Z);
    assert_eq!(rig.state()["side_tab"], "Detector");
    rig.open_tab("Filter");
    rig.key(Key::Comma);
    assert_eq!(rig.state()["side_tab"], "Detector");
}
