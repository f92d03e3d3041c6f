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

/// Such as a phone on its side leaves beside its keyboard.
#[test]
fn the_page_is_drawn_in_a_window_of_little_height() {
    for size in [vec2(390.0, 200.0), vec2(1200.0, 200.0)] {
        let mut rig = touched(size);
        rig.key(Key::V);
        rig.key_with(Modifiers::SHIFT, Key::P);
        rig.frames(3);
        assert_eq!(rig.state()["workspace"], "Plan");
    }
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

/// Shows the tab of that name without a mouse that moves.
fn tap(rig: &mut Rig, label: &str) {
    rig.harness
        .get_by_role_and_label(Role::Tab, label)
        .click_accesskit();
    rig.frames(4);
}

/// Nodes of a role with their labels and places.
fn all_of(rig: &Rig, role: Role) -> Vec<(String, Rect)> {
    let all = By::new().predicate(move |node| node.role() == role);
    let all = rig.harness.root().query_all(all);
    all.map(|node| {
        let label = node.accesskit_node().label().unwrap_or_default();
        (label, node.rect())
    })
    .collect()
}

#[test]
fn on_a_phone_small_switches_are_as_high_as_a_finger() {
    let mut rig = touched(vec2(390.0, 844.0));
    for label in ["Compare", "Plots", "GPS outage"] {
        tap(&mut rig, label);
        let switches = all_of(&rig, Role::CheckBox);
        assert!(!switches.is_empty(), "{label}");
        for (name, rect) in switches {
            assert!(rect.height() >= 43.9, "{label}: {name} {rect:?}");
        }
    }
}

#[test]
fn on_a_phone_the_rows_of_the_comparison_have_room_for_their_names() {
    let mut rig = touched(vec2(390.0, 844.0));
    tap(&mut rig, "Compare");
    let rows: Vec<_> = all_of(&rig, Role::Button)
        .into_iter()
        .filter(|(name, _)| name.starts_with("Compare with "))
        .collect();
    assert!(rows.len() > 1, "{rows:?}");
    for pair in rows.windows(2) {
        let [(name, above), (_, below)] = pair else {
            continue;
        };
        assert!(above.bottom() <= below.top() + 0.5, "{name}: {rows:?}");
    }
}

#[test]
fn on_a_phone_every_button_of_the_map_can_be_reached() {
    let mut rig = touched(vec2(390.0, 844.0));
    let map = rig.rect("/map/rect");
    let last = |rig: &Rig| {
        let compass = rig.harness.get_by_label("North up. Change to track up");
        compass.rect()
    };
    assert!(
        last(&rig).bottom() > map.bottom() - 16.0,
        "all fit, so that this shows nothing"
    );
    rig.harness
        .get_by_label("North up. Change to track up")
        .focus();
    rig.frames(30);
    let reached = last(&rig);
    assert!(map.contains_rect(reached), "{reached:?} on {map:?}");
}

#[test]
fn on_a_phone_nothing_of_a_route_is_cut_off() {
    let size = vec2(390.0, 844.0);
    let mut rig = touched(size);
    rig.key_with(Modifiers::SHIFT, Key::P);
    rig.key(Key::I);
    rig.key(Key::I);
    rig.frames(4);
    let right = 8.0 + size.x;
    for label in ["Delete the route", "Limit (1σ)", "Name of the route"] {
        let rect = rig.harness.get_by_label(label).rect();
        assert!(rect.right() <= right, "{label} {rect:?}");
    }
}

#[test]
fn on_a_phone_the_way_to_the_next_stop_of_the_tour_is_whole() {
    let mut rig = touched(vec2(390.0, 844.0));
    tap(&mut rig, "Learn");
    let timeline = rig.rect("/timeline");
    let next = rig.harness.get_by_label("Next").rect();
    assert!(next.bottom() <= timeline.top(), "{next:?} {timeline:?}");
    assert!(next.height() >= 43.9, "{next:?}");
}

#[test]
fn fingers_are_not_told_to_press_keys() {
    let mut rig = touched(vec2(390.0, 844.0));
    let told =
        |rig: &Rig, words: &'static str| rig.harness.query_all_by_label_contains(words).count();
    assert_eq!(told(&rig, "press N"), 0);
    assert_eq!(told(&rig, "the first button at the right"), 1);
    tap(&mut rig, "GPS outage");
    assert_eq!(told(&rig, "hold Shift"), 0);
    rig.harness.hover_at(pos2(200.0, 300.0));
    rig.frames(3);
    assert_eq!(told(&rig, "press N"), 1);
    assert_eq!(told(&rig, "hold Shift"), 1);
}

#[test]
fn what_is_under_way_never_lies_over_the_next_step() {
    for (width, fits) in [
        (640.0, false),
        (720.0, false),
        (820.0, false),
        (1440.0, true),
    ] {
        let host = ScriptedHost {
            pointer: Pointing::Fingers,
            silent_flights: true,
            ..ScriptedHost::default()
        };
        let mut rig = rig_on(host, vec2(width, 700.0));
        let id = rig.host().last_flight().expect("a flight").0;
        let progress = pilotage_jobs::JobEvent::Progress(0.5, "Flying".into());
        rig.host().events.push((id, progress));
        rig.frames(3);
        let next = rig.harness.get_by_label("Take the tour").rect();
        let stop = rig.harness.query_by_label("Stop computing");
        assert_eq!(stop.is_some(), fits, "{width}");
        assert!(stop.is_none_or(|it| !it.rect().intersects(next)), "{width}");
    }
}
