use egui::Key;
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{ExplainOrder, ExplainedBy, FlyOrder, Job, JobEvent, MapSource};
use pilotage_ui::host::OpenedFile;

use super::open_map::a_map;
use super::support::{Rig, ScriptedHost, rig, rig_on};

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

#[test]
fn pictures_of_a_match_that_cannot_be_made_say_why() {
    let host = ScriptedHost {
        left: Some(|job| matches!(job, Job::ExplainMatch(_))),
        ..ScriptedHost::default()
    };
    let mut rig = rig_on(host, egui::vec2(1440.0, 900.0));
    rig.key(Key::End);
    rig.open_tab("Match");
    rig.frames(6);
    let on_their_way = "The pictures of this match are on their way";
    rig.harness.get_by_label(on_their_way);
    let host = rig.host();
    let mut jobs = host.jobs.iter().rev();
    let asked = jobs.find(|(_, job)| matches!(job, Job::ExplainMatch(_)));
    let asked = asked.expect("asked for").0;
    let why = JobEvent::Failed("The picture is there no more.".to_owned());
    host.events.push((asked, why));
    rig.frames(3);
    rig.harness
        .get_by_label("No pictures: The picture is there no more.");
}

/// Opens a map of the world in which the flight is; nothing is flown anew.
fn open_map(rig: &mut Rig) {
    rig.host().opens = Some(a_map(None));
    rig.host().opened.push(vec![OpenedFile {
        path: "county.tif".to_owned(),
        content: vec![1, 2, 3].into(),
    }]);
    rig.settle();
}

/// Map over which the last flight was asked for.
fn flown_over(rig: &mut Rig) -> MapSource {
    let flown = rig.host().last_flight().cloned();
    let Some((_, Job::Fly(FlyOrder { map, .. }))) = flown else {
        panic!("nothing was flown");
    };
    map
}

#[test]
fn a_match_is_explained_with_the_map_of_its_run_while_another_one_is_open() {
    let mut rig = rig();
    open_map(&mut rig);
    rig.key(Key::R);
    rig.settle();
    let over = flown_over(&mut rig);
    let key = over.key().expect("an opened map").to_owned();
    open_map(&mut rig);
    assert_eq!(flown_over(&mut rig), over, "nothing was flown anew");
    assert!(rig.host().in_use.contains(&key), "its files stay");
    rig.key(Key::End);
    rig.open_tab("Match");
    rig.frames(6);
    let jobs = rig.host().jobs.iter().rev();
    let mut explained = jobs.filter_map(|(_, job)| match job {
        Job::ExplainMatch(order) => Some(order.map.clone()),
        _ => None,
    });
    assert_eq!(explained.next(), Some(over));
}
