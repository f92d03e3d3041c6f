//! Actions of people while they plan.

mod areas;
mod assess;
mod brief;
mod corridor;
mod drag;
mod draw;
mod ends;
mod files;
mod find;
mod ground;
mod heat;
mod incursion;
mod insert;
mod keyboard;
mod landmarks;
mod patterns;
mod rally;
mod rehearse;
mod remedy;
mod route_tab;
mod study;
mod suggest;
mod training;
mod undo;
mod workspace;

use egui::{Key, Modifiers, Pos2, Vec2};
use egui_kittest::kittest::Queryable as _;

use super::support::{Rig, rig};

/// The Plan workspace, with nothing in it but the landmarks of the flight.
pub fn planning() -> Rig {
    let mut rig = rig();
    rig.open_tab("Plan");
    rig.settle();
    rig
}

/// Place on the screen of a place on the ground, metres north and east.
pub fn screen(rig: &Rig, north: f64, east: f64) -> Pos2 {
    let state = rig.state();
    let map = &state["map"];
    let scale = map["metres_per_point"].as_f64().expect("a scale");
    let center = |i: usize| map["center"][i].as_f64().expect("a centre");
    let right = (east - center(1)) / scale;
    let down = (center(0) - north) / scale;
    rig.rect("/map/rect").center() + Vec2::new(right as f32, down as f32)
}

/// Clicks a place on the ground, late enough to be no double click.
pub fn click(rig: &mut Rig, north: f64, east: f64) {
    let at = screen(rig, north, east);
    rig.harness.state_mut().host.now += 1000.0;
    rig.harness.hover_at(at);
    rig.frames(30);
    rig.harness.drag_at(at);
    rig.frames(1);
    rig.harness.drop_at(at);
    rig.frames(2);
}

/// Sets a number by its accessible name, in the unit that is shown.
pub fn set(rig: &mut Rig, name: &str, value: f64) {
    rig.harness
        .get_by_role_and_label(egui::accesskit::Role::SpinButton, name)
        .set_value_accesskit(value);
    rig.settle();
}

/// Number of things that are called like that, by the beginning of the name.
pub fn count(rig: &Rig, beginning: &str) -> usize {
    let named = |n: &egui_kittest::kittest::AccessKitNode<'_>| {
        [n.label(), n.value()]
            .into_iter()
            .flatten()
            .any(|l| l.starts_with(beginning))
    };
    rig.harness.query_all_by(named).count()
}

/// Opens the settings of a way-point, counted from 1.
pub fn choose(rig: &mut Rig, number: usize) {
    let name = format!("Way-point {number}: ");
    rig.harness
        .get_by(|n| n.label().is_some_and(|l| l.starts_with(&name)))
        .click_accesskit();
    rig.frames(3);
}

/// Scrolls the column beside the map, points.
pub fn scroll(rig: &mut Rig, down: f32) {
    let map = rig.rect("/map/rect");
    let at = map.right_top() + Vec2::new(120.0, 300.0);
    rig.harness.hover_at(at);
    rig.frames(1);
    rig.harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: Vec2::new(0.0, -down),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: egui::Modifiers::NONE,
    });
    rig.frames(30);
}

/// Draws a route over these places.
pub fn draw(rig: &mut Rig, places: &[(f64, f64)]) {
    rig.key(Key::W);
    for (north, east) in places {
        click(rig, *north, *east);
    }
    rig.key(Key::Enter);
    rig.settle();
}

/// Draws a no-fly area of 240 by 120 m about the origin.
pub fn draw_area(rig: &mut Rig) {
    rig.harness.key_press_modifiers(Modifiers::SHIFT, Key::A);
    rig.settle();
    for (north, east) in [
        (-120.0, -60.0),
        (120.0, -60.0),
        (120.0, 60.0),
        (-120.0, 60.0),
    ] {
        click(rig, north, east);
    }
    rig.key(Key::Enter);
    rig.settle();
}

/// A place of a way-point of the first route, metres north and east.
pub fn place(rig: &Rig, index: usize) -> (f64, f64) {
    let state = rig.state();
    let at = &state["plan"]["routes"][0]["way_points"][index];
    let metres = |k: &str| at[k].as_f64().expect("metres");
    (metres("north"), metres("east"))
}

/// Types a number into a field that shows one.
pub fn type_number(rig: &mut Rig, label: &str, text: &str) {
    rig.harness.get_by_label(label).focus();
    rig.frames(2);
    rig.harness.event(egui::Event::Text(text.into()));
    rig.frames(2);
    rig.key(Key::Enter);
}

/// A number of the plan.
pub fn number(rig: &Rig, pointer: &str) -> f64 {
    let state = rig.state();
    let found = state["plan"].pointer(pointer);
    found
        .and_then(serde_json::Value::as_f64)
        .unwrap_or_else(|| panic!("no {pointer} in {}", state["plan"]))
}
