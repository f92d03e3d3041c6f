//! How the picture beside the map is looked at.

use egui::Rect;

use crate::jobs::MapInfo;
use crate::map::{MapCamera, TileCache};

/// How the picture is looked at.
#[derive(Default)]
pub struct PictureCanvas {
    /// Where and how near.
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

    /// Where it was drawn last.
    pub fn rect(&self) -> Option<Rect> {
        self.rect
    }
}
