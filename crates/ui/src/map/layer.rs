//! Layers that others draw on the map.

use egui::{Painter, Pos2, Rect};
use pilotage_core::frames::{GroundPoint, LocalFrame};

use super::layers::Layer;
use super::transform::ScreenFromWorld;
use crate::context::ViewContext;
use crate::tokens::Tokens;

/// Something that is drawn on the map, over the tracks.
pub trait MapLayer {
    /// Draws it into the world `frame`, if that has a place on the globe.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        frame: Option<LocalFrame>,
    );

    /// Row of the legend that switches it, if one does.
    fn row(&self) -> Option<Layer> {
        None
    }

    /// Whether it draws the recorded track of the flight in the map's place.
    fn replaces_truth(&self) -> bool {
        false
    }

    /// Whether it is shown without the flight in the world `frame`, if that has a place on the globe.
    fn hides_flight(&self, _frame: Option<LocalFrame>) -> bool {
        false
    }

    /// Draws a scale for it with its left top corner at `corner`; what that covers.
    fn paint_scale(&self, _painter: &Painter, _corner: Pos2, _tokens: &Tokens) -> Option<Rect> {
        None
    }

    /// Places in the world of the flight that are shown where the map is fitted to that.
    fn places(&self) -> Vec<GroundPoint> {
        Vec::new()
    }
}
