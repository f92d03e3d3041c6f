//! View of the picture beside the map.

use egui::Rect;

use crate::map::{MapCamera, TileCache};
use pilotage_jobs::MapInfo;

/// View of the picture.
#[derive(Default)]
pub struct PictureCanvas {
    /// Middle and scale of the view.
    pub camera: MapCamera,
    /// Its pixels.
    pub tiles: TileCache,
    pub(super) info: Option<MapInfo>,
    pub(super) rect: Option<Rect>,
    pub(super) fitted: bool,
    pub(super) dragged: Option<usize>,
}

impl PictureCanvas {
    /// Takes what is known of the picture.
    pub fn know(&mut self, info: MapInfo) {
        self.info = Some(info);
    }

    /// Part of the screen on which the picture was drawn last.
    pub fn rect(&self) -> Option<Rect> {
        self.rect
    }
}
