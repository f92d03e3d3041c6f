//! Reader and writers of a format.

use super::file_look::{Claim, FileLook};
use super::flown_track::FlownTrack;
use super::found::GeodeticContent;
use super::written::WrittenFile;
use super::{ExchangeError, Places};
use pilotage_base::frames::LocalFrame;

/// Reader and writers of a format.
pub(super) struct FormatWork {
    /// Tells whether a file is of the format.
    pub claims: fn(&FileLook<'_>) -> Claim,
    /// Reader of its files.
    pub read: Read,
    /// Writes places that the format holds: of a mission, its one route.
    pub write: fn(&Places<'_>, &LocalFrame) -> Result<WrittenFile, ExchangeError>,
    /// Writer of a flown track, if it has a form for one.
    pub track: Option<TrackWork>,
}

/// Reader of a format, which gets the name of the file for its errors.
pub(super) enum Read {
    /// Of text.
    Text(fn(&str, &str) -> Result<GeodeticContent, ExchangeError>),
    /// Of bytes.
    Bytes(fn(&str, &[u8]) -> Result<GeodeticContent, ExchangeError>),
}

/// Writer of a flown track.
pub(super) struct TrackWork {
    /// Writes it.
    pub write: fn(&FlownTrack) -> Result<Vec<u8>, ExchangeError>,
    /// Note where the date of the track is not known.
    pub undated: Option<&'static str>,
}
