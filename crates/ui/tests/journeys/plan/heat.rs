use egui::Key;
use egui_kittest::kittest::Queryable as _;

use pilotage_jobs::{Job, JobEvent};
use pilotage_ui::host::OpenedFile;

use super::{number, planning, type_number};
use crate::open_map::a_map;

#[test]
fn the_heat_map_is_shown_by_its_key_and_tells_how_much_of_the_map_is_blind() {
    let mut rig = planning();
    rig.key(Key::H);
    rig.settle();
    assert_eq!(rig.state()["plan"]["heat"]["shown"], true);
    assert_eq!(number(&rig, "/heat/known"), 1.0);
    assert!((number(&rig, "/heat/blind_share") - 0.5).abs() < 0.01);
    rig.harness
        .get_by_label_contains("Legend: Probability of a fix");
    rig.harness
        .get_by_label_contains("A fix is less likely than 0.2 over 50 % of the map");
    rig.harness.get_by_label("Blind areas only").click();
    rig.settle();
    assert_eq!(rig.state()["plan"]["heat"]["blind"], true);
    rig.harness.get_by_label_contains("Legend: Blind areas");
    rig.key(Key::H);
    rig.settle();
    assert_eq!(rig.state()["plan"]["heat"]["shown"], false);
}

#[test]
fn another_uncertainty_is_computed_anew_and_so_are_fixes_from_the_map_alone() {
    let mut rig = planning();
    rig.key(Key::H);
    rig.settle();
    let position = |rig: &super::Rig| {
        let jobs = rig.harness.state().host.jobs.iter().rev();
        let mut orders = jobs.filter_map(|(_, job)| match job {
            pilotage_jobs::Job::Field(order) => Some(order.view.position),
            _ => None,
        });
        orders.next()
    };
    let fields = |rig: &super::Rig| {
        let jobs = &rig.harness.state().host.jobs;
        let field = |j: &&(u64, pilotage_jobs::Job)| matches!(j.1, pilotage_jobs::Job::Field(_));
        jobs.iter().filter(field).count()
    };
    assert_eq!((fields(&rig), position(&rig)), (1, Some(10.0)));
    rig.open_tab("Ground");
    type_number(&mut rig, "Uncertainty of the position", "25");
    rig.settle();
    rig.settle();
    assert_eq!((fields(&rig), position(&rig)), (2, Some(25.0)));
    rig.harness.get_by_label("the map alone").click();
    rig.settle();
    rig.harness.state_mut().host.now += 1000.0;
    rig.settle();
    assert_eq!(fields(&rig), 3);
    rig.harness.get_by_label_contains("map alone, 0 to 1");
    // No landmark is asked of the map alone.
    rig.harness
        .get_by_label_contains("A fix is less likely than 0.2");
    let of_landmarks = rig.harness.query_by_label_contains("No landmark in view");
    assert!(of_landmarks.is_none());
}

#[test]
fn the_heat_map_of_another_map_is_not_left_on_the_one_that_is_opened() {
    let mut rig = planning();
    rig.key(Key::H);
    rig.settle();
    assert_eq!(number(&rig, "/heat/known"), 1.0);
    rig.host().left = Some(|job| matches!(job, Job::Field(_)));
    rig.host().opens = Some(a_map(None));
    rig.host().opened.push(vec![OpenedFile {
        path: "county.tif".into(),
        content: vec![1, 2, 3].into(),
    }]);
    rig.settle();
    let heat = rig.state()["plan"]["heat"].clone();
    assert!(heat["known"].is_null(), "{heat}");
    assert_eq!(heat["complete"], false);
}

#[test]
fn the_heat_map_of_another_plan_is_not_left_where_that_of_now_fails() {
    let mut rig = planning();
    rig.key(Key::H);
    rig.settle();
    rig.host().left = Some(|job| matches!(job, Job::Field(_)));
    rig.open_tab("Ground");
    type_number(&mut rig, "Uncertainty of the position", "25");
    rig.settle();
    let asked = rig.host().jobs.last().cloned();
    let Some((id, Job::Field(_))) = asked else {
        panic!("a heat map was asked for, not {asked:?}");
    };
    let shown = |rig: &super::Rig| rig.state()["plan"]["heat"]["blind_share"].clone();
    assert!(shown(&rig).is_number(), "until there is another");
    let why = "the map cannot be read".to_owned();
    rig.host().events.push((id, JobEvent::Failed(why)));
    rig.settle();
    assert!(shown(&rig).is_null());
}
