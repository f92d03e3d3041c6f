use super::support::rig;

#[test]
fn a_lost_worker_is_told_and_nothing_is_lost() {
    let mut rig = rig();
    let before = rig.state();
    rig.host().lost = 1;
    rig.frames(3);
    let after = rig.state();
    assert_eq!(after["toasts"].as_array().map(Vec::len), Some(1));
    assert_eq!(before["run_steps"], after["run_steps"]);
    assert_eq!(before["landmarks"], after["landmarks"]);
}
