//! Windows of phones, and of people who zoom to 200 %; fingers.

use egui::{Key, Modifiers, Rect, Vec2, accesskit::Role, pos2, vec2};
use egui_kittest::kittest::{By, NodeT as _, Queryable as _};

use super::support::{Pointing, Rig, ScriptedHost, rig_on};

fn touched(size: Vec2) -> Rig {
    let host = ScriptedHost {
        pointer: Pointing::Fingers,
        ..ScriptedHost::default()
    };
    rig_on(host, size)
}

#[test]
fn a_phone_has_every_workspace_the_next_step_and_the_map() {
    let size = vec2(390.0, 844.0);
    let mut rig = touched(size);
    let window = Rect::from_min_size(pos2(8.0, 8.0), size);
    rig.key_with(Modifiers::SHIFT, Key::P);
    rig.key(Key::I);
    rig.key(Key::I);
    let labels = ["Replay", "Plan", "Learn", "Rehearse route", "Open", "More"];
    let rects = labels.map(|label| rig.harness.get_by_label(label).rect());
    for (label, rect) in labels.iter().zip(rects) {
        assert!(window.contains_rect(rect), "{label} {rect:?}");
        assert!(rect.height() >= 43.9, "{label} {rect:?}");
    }
    for pair in rects.windows(2) {
        assert!(
            pair[0].right() <= pair[1].left() + 0.5 || pair[0].left() >= pair[1].right() - 0.5,
            "{rects:?}"
        );
    }
    let map = rig.rect("/map/rect");
    assert!(map.height() > 300.0, "{map:?}");
    rig.menu("More", "Filter settings");
    assert_eq!(rig.state()["dialogs"]["settings"], true);
}

#[test]
fn at_two_hundred_percent_the_map_keeps_the_room_until_the_column_is_wanted() {
    let size = vec2(720.0, 450.0);
    let mut rig = rig_on(ScriptedHost::default(), size);
    rig.harness.get_by_label("Take the tour");
    let map = rig.rect("/map/rect");
    assert!(map.height() > 300.0, "{map:?}");
    rig.key(Key::V);
    assert!(rig.rect("/map/rect").height() < map.height() - 100.0);
}

#[test]
fn fingers_have_larger_buttons_until_a_mouse_moves() {
    let mut rig = touched(vec2(820.0, 1180.0));
    let buttons = |rig: &Rig| -> Vec<(String, Rect)> {
        let all = By::new().predicate(|node| node.role() == Role::Button);
        let all = rig.harness.root().query_all(all);
        all.map(|node| {
            (
                node.accesskit_node().label().unwrap_or_default(),
                node.rect(),
            )
        })
        .collect()
    };
    let small: Vec<_> = buttons(&rig)
        .into_iter()
        .filter(|(_, rect)| rect.height() < 43.9)
        .collect();
    assert!(small.is_empty(), "{small:?}");
    rig.harness.hover_at(pos2(300.0, 300.0));
    rig.frames(3);
    let zoom = rig.harness.get_by_label("Zoom in").rect();
    assert_eq!(zoom.size(), vec2(32.0, 32.0));
}
