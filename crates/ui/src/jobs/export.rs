//! Files for other programs, as a job: the page needs no writer of theirs.

use pilotage_core::exchange::labels::{LabelFormat, write_labels};
use pilotage_core::exchange::{Format, Written, write_routes_and_landmarks};
use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{FrameLabels, Route};
use serde::{Deserialize, Serialize};

/// What is written, and how.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum ExportOrder {
    /// Routes and landmarks.
    Places {
        /// The format.
        format: Format,
        /// Routes.
        routes: Vec<Route>,
        /// Landmarks.
        landmarks: Vec<Landmark>,
        /// Origin of the world in which they lie.
        origin: Geodetic,
    },
    /// Labels of pictures.
    Labels {
        /// The format.
        format: LabelFormat,
        /// What was said of each picture.
        frames: Vec<FrameLabels>,
        /// The landmarks, whose names are written.
        landmarks: Vec<Landmark>,
    },
}

impl ExportOrder {
    /// The file; the error says in words why there is none.
    pub fn write(&self) -> Result<Written, String> {
        match self {
            Self::Places {
                format,
                routes,
                landmarks,
                origin,
            } => {
                let frame = LocalFrame::new(*origin);
                write_routes_and_landmarks(*format, routes, landmarks, &frame)
                    .map_err(|cause| cause.to_string())
            }
            Self::Labels {
                format,
                frames,
                landmarks,
            } => write_labels(*format, frames, landmarks).map_err(|cause| cause.to_string()),
        }
    }
}
