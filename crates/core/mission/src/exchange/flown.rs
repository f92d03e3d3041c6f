//! Flown tracks in the files of other programs.

use super::flown_track::FlownTrack;
use super::{ExchangeError, Format, WrittenFile};

/// The track as a file of a format; angles are written to ten decimals of a degree, heights and values with all digits.
///
/// # Errors
/// A track without places, or a format that has none for tracks.
pub fn write_flown(format: Format, track: &FlownTrack) -> Result<WrittenFile, ExchangeError> {
    let cannot_hold = |what: &str, advice| ExchangeError::CannotHold {
        format: format.name(),
        what: what.to_owned(),
        advice,
    };
    if track.points.is_empty() {
        return Err(cannot_hold(
            "a track without places",
            "choose another track",
        ));
    }
    let form = format.work().track.as_ref();
    let form =
        form.ok_or_else(|| cannot_hold("a flown track", "write it as KML, GPX, GeoJSON or CSV"))?;
    let undated = form.undated.filter(|_| track.utc_at_zero.is_none());
    Ok(WrittenFile {
        bytes: (form.write)(track)?,
        notes: undated.map(str::to_owned).into_iter().collect(),
    })
}
