//! Layers that others draw on the map.

use egui::Painter;

use super::transform::ScreenFromWorld;
use crate::context::ViewContext;

/// Something that is drawn on the map, over the tracks.
pub trait MapLayer {
    /// Draws it.
    fn paint(&self, painter: &Painter, view: &ScreenFromWorld, context: &ViewContext<'_>);
}
