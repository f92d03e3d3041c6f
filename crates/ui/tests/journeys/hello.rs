use egui_kittest::kittest::Queryable as _;

use super::support::rig;

#[test]
fn hello_is_said_by_a_worker() {
    let mut rig = rig();
    rig.open_tab("Hello");
    rig.harness.get_by_label("Say hello").click();
    rig.frames(4);
    assert_eq!(rig.state()["hello"], "Hello from Invented ground");
}
