//! Pictures of a mission brief: the order and the result.

use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::Window;
use serde::{Deserialize, Serialize};

use super::{MapSource, whole_bytes};

/// Pixels across the picture of the map, and a thumbnail.
const MAP: f64 = 1500.0;
const THUMBNAIL: f64 = 160.0;

/// Pictures wanted for a mission brief.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BriefOrder {
    /// The map.
    pub map: MapSource,
    /// The ground that the picture of the map shows.
    pub area: GroundRect,
    /// The boxes of which there are thumbnails.
    pub boxes: Vec<GroundRect>,
}

impl BriefOrder {
    /// The pictures that are taken of the map: it itself, then each box with a margin.
    pub fn windows(&self) -> Vec<Window> {
        let window = |area: &GroundRect, across: f64| {
            let gsd = (area.width().max(area.height()) / across).max(0.02);
            Window::covering(area, gsd)
        };
        let thumbnails = self.boxes.iter().map(|rect| {
            let margin = 0.2 * rect.width().max(rect.height());
            window(&rect.grown(margin), THUMBNAIL)
        });
        std::iter::once(window(&self.area, MAP))
            .chain(thumbnails)
            .collect()
    }
}

/// A JPEG.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EncodedPicture(#[serde(with = "whole_bytes")] pub Vec<u8>);

/// The pictures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BriefPictures {
    /// The map.
    pub map: EncodedPicture,
    /// Thumbnail of each box, in order.
    pub thumbnails: Vec<EncodedPicture>,
}
