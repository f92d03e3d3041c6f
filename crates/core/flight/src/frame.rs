//! Camera frames of a flight.

use serde::{Deserialize, Serialize};

use pilotage_raster::raster::Picture;

/// A camera frame: when it was taken and how to find it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Seconds in the flight's time base.
    pub time: f64,
    /// File name or number, for people and for the frame source; empty where there is no picture.
    pub name: String,
    /// Turn of the stored picture against the mount, radians clockwise: π for a picture stored
    /// upside down.
    pub stored_turn: f64,
}

/// Why a frame cannot be shown.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameError {
    /// There is no such frame.
    #[error("there is no frame number {0}")]
    OutOfRange(usize),
    /// The picture is missing or unreadable.
    #[error("{name}: {cause}")]
    Unreadable {
        /// Name of the frame.
        name: String,
        /// Error of the picture, and its place, in words.
        cause: String,
    },
}

/// Source of the pictures of a flight: files, a zip, or the aerial camera simulator.
pub trait FrameSource {
    /// The picture of frame `index` of the flight.
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError>;

    /// The same as JPEG or PNG bytes, as stored where it is stored.
    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError>;

    /// A source of the same pictures for another thread, of those that are stored.
    fn another(&self) -> Option<SharedFrames> {
        None
    }
}

/// Source of pictures that goes to another thread.
pub type SharedFrames = Box<dyn FrameSource + Send + Sync>;

/// The pictures of a flight without a camera: none.
pub struct NoPictures;

impl FrameSource for NoPictures {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        Err(FrameError::OutOfRange(index))
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        Err(FrameError::OutOfRange(index))
    }

    fn another(&self) -> Option<SharedFrames> {
        Some(Box::new(Self))
    }
}
