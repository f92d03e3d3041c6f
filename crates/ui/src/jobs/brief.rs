//! The pictures of a mission brief, as a job.

use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::{Imagery, Window};
use pilotage_core::raster::encode_jpeg;
use serde::{Deserialize, Serialize};

use super::{Advance, JobEvent, MapSource, RunningJob, Workshop, whole_bytes};

/// Pixels across the picture of the map, and a thumbnail.
const MAP: f64 = 1500.0;
const THUMBNAIL: f64 = 160.0;
/// Quality of the pictures, 1 to 100.
const QUALITY: u8 = 85;

/// Which pictures are wanted.
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
    /// One for each box, in order.
    pub thumbnails: Vec<EncodedPicture>,
}

/// Pictures being made.
pub struct Brief {
    order: BriefOrder,
    done: Vec<EncodedPicture>,
}

impl Brief {
    /// Nothing made yet.
    pub fn new(order: BriefOrder) -> Self {
        let done = Vec::new();
        Self { order, done }
    }

    /// Makes the next picture; the first is the map. None is left if `None`.
    fn next(&mut self, map: &dyn Imagery) -> Result<Option<f32>, String> {
        let windows = self.order.windows();
        let Some(window) = windows.get(self.done.len()) else {
            return Ok(None);
        };
        let pixels = map.window(window);
        // Paper is white where the map has nothing.
        let opaque = |[r, g, b, a]: [u8; 4]| if a == 0 { [255; 3] } else { [r, g, b] };
        let bytes = encode_jpeg(&pixels.map(opaque), QUALITY).map_err(|e| e.to_string())?;
        self.done.push(EncodedPicture(bytes));
        Ok(Some(self.done.len() as f32 / windows.len() as f32))
    }
}

impl RunningJob for Brief {
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let map = workshop.map(&self.order.map)?;
        if let Some(fraction) = self.next(map.as_ref())? {
            emit(JobEvent::Progress(fraction, "Drawing the brief".to_owned()));
            return Ok(Advance::More);
        }
        let mut done = std::mem::take(&mut self.done).into_iter();
        let pictures = BriefPictures {
            map: done.next().unwrap_or_default(),
            thumbnails: done.collect(),
        };
        emit(JobEvent::BriefPictures(Box::new(pictures)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}
