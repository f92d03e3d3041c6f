//! A file to be written for another program.

use pilotage_core::exchange::labels::LabelFormat;
use pilotage_core::exchange::{FlownTrack, Format};
use pilotage_core::frames::Geodetic;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::{FrameLabels, NoFlyZone, RallyPoint, Route};
use serde::{Deserialize, Serialize};

use super::SeriesName;

/// Content of the file, and its format.
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
        /// Areas that must not be flown over.
        no_fly: Vec<NoFlyZone>,
        /// Places to land at when the aircraft cannot go on.
        rally: Vec<RallyPoint>,
        /// Origin of the world in which they lie.
        origin: Geodetic,
    },
    /// A flown track.
    Track {
        /// The format.
        format: Format,
        /// The track.
        track: FlownTrack,
        /// The series whose values stand beside its points, if any does; they are called as the track says.
        beside: Option<TrackSeries>,
    },
    /// Labels of pictures.
    Labels {
        /// The format.
        format: LabelFormat,
        /// Labels of each picture.
        frames: Vec<FrameLabels>,
        /// The landmarks, whose names are written.
        landmarks: Vec<Landmark>,
    },
}

/// A series of a log whose values stand beside the points of a track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrackSeries {
    /// Key of the files with the log.
    pub key: String,
    /// Name of the log among them.
    pub file: String,
    /// Name of the series.
    pub series: SeriesName,
}
