//! Tools with which people work on the map: they take the pointer first, and draw what they work on.

use egui::{Painter, Pos2, Rect, Response, Ui};
use pilotage_core::mission::Mission;

use super::labels::LandmarkLabel;
use super::layers::Layers;
use super::transform::ScreenFromWorld;
use crate::context::ViewContext;
use crate::tokens::Tokens;

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

    /// Names that find their places together with those of landmarks.
    fn labels(&self, _canvas: &MapCanvas<'_>) -> Vec<LandmarkLabel> {
        Vec::new()
    }

    /// Draws what belongs to a stage.
    fn paint(&self, stage: MapStage, canvas: &MapCanvas<'_>);
}
