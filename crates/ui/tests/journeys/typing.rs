use egui::{Key, Modifiers};

use super::support::rig;

#[test]
fn letters_typed_into_a_field_are_not_commands() {
    let mut rig = rig();
    rig.key_with(Modifiers::COMMAND, Key::K);
    rig.frames(2);
    let before = rig.state();
    for key in [Key::N, Key::T, Key::L, Key::Space] {
        rig.key(key);
    }
    let after = rig.state();
    for kept in ["/map/picking", "/map/track_up", "/loop", "/playing"] {
        assert_eq!(before.pointer(kept), after.pointer(kept), "{kept}");
    }
}
