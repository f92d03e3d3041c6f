use egui::Key;

use super::support::rig;

#[test]
fn a_bookmark_is_dropped_and_found_again() {
    let mut rig = rig();
    rig.key_with(egui::Modifiers::SHIFT, Key::ArrowRight);
    rig.key(Key::B);
    let marked = rig.state()["time"].as_f64().expect("a time");
    rig.key(Key::Home);
    assert_eq!(rig.state()["time"], 0.0);
    rig.key(Key::CloseBracket);
    assert_eq!(rig.state()["time"].as_f64(), Some(marked));
}
