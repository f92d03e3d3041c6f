use egui::{Key, Modifiers};

use super::support::{Rig, rig};

#[test]
fn several_presses_of_a_key_within_a_frame_all_count() {
    let selection = |rig: &Rig| rig.state()["selection"].as_u64();
    let scale = |rig: &Rig| rig.state()["map"]["metres_per_point"].as_f64().unwrap();
    let ([mut slow, mut fast], [one, several]) = (std::array::from_fn(|_| rig()), [1, 3]);
    for (rig, at_once) in [(&mut slow, one), (&mut fast, several)] {
        rig.frames(6);
        rig.settle();
        for _ in 0..3 / at_once {
            rig.key_times(Key::Plus, at_once);
        }
        rig.key(Key::K);
        rig.frames(3);
        for _ in 0..3 / at_once {
            rig.key_times(Key::ArrowDown, at_once);
        }
    }
    assert!(selection(&slow).is_some(), "{}", slow.state());
    assert_eq!(selection(&fast), selection(&slow));
    assert!(
        (scale(&fast) / scale(&slow) - 1.0).abs() < 1e-9,
        "{} {}",
        scale(&fast),
        scale(&slow)
    );
}

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
