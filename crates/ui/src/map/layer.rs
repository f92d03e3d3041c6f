//! Layers that others draw on the map.

use egui::Painter;
use pilotage_core::frames::LocalFrame;

use super::transform::ScreenFromWorld;
use crate::context::ViewContext;

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
}
