use pilotage_jobs::JobEvent;
use pilotage_ui::job_owners::JobOwner;

use super::support::{Rig, rig};

/// Titles of notices about faults of the program.
fn faults(rig: &Rig) -> Vec<String> {
    let state = rig.state_at_fault();
    let toasts = state["toasts"].as_array().expect("a list").iter();
    let faults = toasts.filter(|toast| {
        let text = toast["text"].as_str();
        text.is_some_and(|text| text.ends_with("This is a fault of the program."))
    });
    faults.map(|toast| toast["title"].to_string()).collect()
}

#[test]
fn an_answer_of_a_job_that_nobody_started_is_told() {
    let mut rig = rig();
    rig.host().events.push((9_999, JobEvent::Finished));
    rig.frames(3);
    assert_eq!(faults(&rig), ["\"An answer was not used\""]);
}

#[test]
fn an_answer_for_which_its_owner_does_not_wait_is_told() {
    let mut rig = rig();
    let host = rig.host();
    host.owners.own(9_999, JobOwner::Feature("photos"));
    host.events.push((9_999, JobEvent::Places(Vec::new())));
    rig.frames(3);
    assert_eq!(faults(&rig), ["\"An answer was not used\""]);
}
