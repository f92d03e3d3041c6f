//! Why a file of roads cannot be read.

use std::fmt;

/// Why a file of roads cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RoadFileError {
    /// It is neither of OpenStreetMap nor GeoJSON.
    Unknown,
    /// Something in it is broken.
    Broken {
        /// Byte at which that was noticed.
        place: usize,
        /// Cause.
        cause: String,
    },
    /// It needs something that is not read.
    Unread(String),
}

impl RoadFileError {
    pub(super) fn broken(place: usize, cause: impl fmt::Display) -> Self {
        Self::Broken {
            place,
            cause: cause.to_string(),
        }
    }
}

impl fmt::Display for RoadFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => write!(
                f,
                "no roads are known in files of this kind; give OpenStreetMap's XML or PBF, or GeoJSON"
            ),
            Self::Broken { place, cause } => write!(
                f,
                "the file is broken at byte {place} ({cause}); fetch or export it again"
            ),
            Self::Unread(what) => write!(f, "the file has {what}; export it without"),
        }
    }
}

impl std::error::Error for RoadFileError {}
