//! The flight that is open, as it was measured.

use pilotage_core::calibration::CameraAdjustment;
use pilotage_core::flight::Flight;
use pilotage_jobs::FlightSource;

use super::{FramePictures, LogFile};

/// Bookmarks closer than this are one, seconds.
pub const SAME_BOOKMARK: f64 = 0.05;

/// Flight that is open, with what was read and kept beside it.
#[derive(Debug)]
pub struct FlightDocument {
    /// The flight as it was measured, once it is there.
    pub measured: Option<Flight>,
    /// Its source.
    pub source: FlightSource,
    /// Counts flights: whatever was found out about another one is of no use any more.
    pub generation: u64,
    /// Encoded camera pictures by frame index.
    pub pictures: FramePictures,
    /// The log that it was read from.
    pub log: Option<LogFile>,
    /// Adjustment of the camera with which it was flown.
    pub flown_camera: CameraAdjustment,
    /// Bookmarks in time order, seconds in the flight's time base.
    pub bookmarks: Vec<f64>,
}

impl FlightDocument {
    /// A flight of which only the source is known.
    pub fn of_source(source: FlightSource) -> Self {
        Self {
            measured: None,
            source,
            generation: 0,
            pictures: FramePictures::default(),
            log: None,
            flown_camera: CameraAdjustment::default(),
            bookmarks: Vec::new(),
        }
    }

    /// Adds bookmarks that were saved for it.
    pub fn add_bookmarks(&mut self, saved: Vec<f64>) {
        let marks = &mut self.bookmarks;
        marks.extend(saved);
        marks.sort_by(f64::total_cmp);
        marks.dedup_by(|later, kept| *later - *kept <= SAME_BOOKMARK);
    }

    /// Leaves it for none.
    pub fn leave(&mut self) {
        self.left();
    }

    /// Leaves it for that of `source`. Log and bookmarks stay if it is the same.
    pub fn leave_for(&mut self, source: &FlightSource) {
        let left = self.left();
        if left.source == *source {
            self.log = left.log;
            self.bookmarks = left.bookmarks;
        }
        self.source.clone_from(source);
    }

    /// The flight that is left for none.
    fn left(&mut self) -> Self {
        let left = std::mem::replace(self, Self::of_source(FlightSource::Nothing));
        self.generation = left.generation + 1;
        left
    }
}
