use egui::Key;
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{ExplainOrder, ExplainedBy, Job};

use super::support::{Rig, rig};

/// Matches asked for so far.
fn asked(rig: &mut Rig) -> usize {
    let of_match = |job: &Job| match job {
        Job::ExplainMatch(ExplainOrder { by, .. }) => *by == ExplainedBy::Template,
        _ => false,
    };
    let jobs = &rig.host().jobs;
    jobs.iter().filter(|(_, job)| of_match(job)).count()
}

#[test]
fn the_pictures_of_a_match_are_asked_for_once_in_each_run_and_shown() {
    let mut rig = rig();
    rig.key(Key::End);
    rig.open_tab("Match");
    rig.frames(6);
    let once = asked(&mut rig);
    rig.frames(20);
    assert_eq!(asked(&mut rig), once, "asked once for each run");
    let state = rig.state();
    assert_eq!(state["side_tab"], "match");
    assert_eq!(state["match"]["time"], state["drawn"]["match"]["content"]);
    rig.harness
        .get_by_label("Map patch, rectified picture, and score at every place");
    // Over another run of the flight it is another match.
    rig.key(Key::R);
    rig.settle();
    assert!(asked(&mut rig) > once);
}
