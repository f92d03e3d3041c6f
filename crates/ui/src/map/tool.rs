//! Tools with which people work on the map: they take the pointer first, and draw what they work on.

use egui::{
    EventFilter, Key, Modifiers, Painter, PointerButton, Pos2, Rect, Response, Ui, Vec2, vec2,
};
use pilotage_core::mission::Mission;

use super::labels::LandmarkLabel;
use super::layers::Layers;
use super::transform::ScreenFromWorld;
use crate::context::ViewContext;
use crate::shell::keys::ShortcutListener;
use crate::tokens::Tokens;

/// Way that an arrow of the keyboard moves a view, points of the screen.
const ARROW_STEP: f32 = 48.0;

/// Stage of the drawing of the map at which a tool may draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapStage {
    /// On the ground, below the tracks.
    Ground,
    /// Below landmarks and the aircraft.
    BelowMarks,
    /// Above them.
    AboveMarks,
    /// Above everything but controls.
    Last,
}

/// Canvas on which a tool draws.
pub struct MapCanvas<'a> {
    /// Painter, clipped to the map.
    pub painter: &'a Painter,
    /// Transform to the screen.
    pub view: &'a ScreenFromWorld,
    /// Part of the screen that the map takes.
    pub rect: Rect,
    /// Place of the pointer on the screen, over the map.
    pub pointer: Option<Pos2>,
    /// Mission that people author.
    pub mission: &'a Mission,
    /// The selected route's id.
    pub route: Option<u32>,
    /// Layers that are on.
    pub layers: &'a Layers,
    /// The look.
    pub tokens: &'a Tokens,
}

/// Something with which people work on the map.
pub trait MapTool {
    /// Whether the flight is not shown meanwhile: it is about something else.
    fn hides_flight(&self) -> bool {
        false
    }

    /// Takes the pointer; true if it is busy with the tool, so that the map shall not use it.
    fn interact(
        &mut self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) -> bool;

    /// Whether a key takes the middle of the map, now that the map has the keyboard (`has_keyboard`) or nobody has it.
    fn takes_middle(&self, _has_keyboard: bool) -> bool {
        false
    }

    /// Names that find their places together with those of landmarks.
    fn labels(&self, _canvas: &MapCanvas<'_>) -> Vec<LandmarkLabel> {
        Vec::new()
    }

    /// Draws what belongs to a stage.
    fn paint(&self, stage: MapStage, canvas: &MapCanvas<'_>);
}

/// Keys of `keys` that are pressed and taken for a tool of the map that `response` is of: none while they are for somebody
/// else, who writes, asks or lets choose, and Enter only where no button has it.
pub(crate) fn tool_keys<const N: usize>(ui: &Ui, response: &Response, keys: [Key; N]) -> [bool; N] {
    if ShortcutListener::is_covered(ui.ctx()) {
        return [false; N];
    }
    let focused = ui.memory(egui::Memory::focused);
    let takes_enter = focused.is_none_or(|id| id == response.id);
    ui.input_mut(|input| {
        keys.map(|key| {
            (takes_enter || key != Key::Enter) && input.consume_key(Modifiers::NONE, key)
        })
    })
}

/// Way, in points of the screen, by which the arrows of the keyboard ask to look farther on, while a view that `response` is
/// of has the keyboard.
pub(crate) fn arrow_way(ui: &Ui, response: &Response) -> Vec2 {
    ui.memory_mut(|memory| {
        let arrows = EventFilter {
            horizontal_arrows: true,
            vertical_arrows: true,
            ..EventFilter::default()
        };
        memory.set_focus_lock_filter(response.id, arrows);
    });
    ui.input(|input| {
        let along = |minus: Key, plus: Key| {
            input.num_presses(plus) as f32 - input.num_presses(minus) as f32
        };
        ARROW_STEP
            * vec2(
                along(Key::ArrowLeft, Key::ArrowRight),
                along(Key::ArrowUp, Key::ArrowDown),
            )
    })
}

/// Place of the screen at which a drag begins: where the button went down, not where egui was sure that it is a drag.
pub(crate) fn drag_origin(ui: &Ui, response: &Response) -> Option<Pos2> {
    let begins = response.drag_started_by(PointerButton::Primary);
    let origin = begins.then(|| ui.input(|input| input.pointer.press_origin()))?;
    origin.or(response.interact_pointer_pos())
}
