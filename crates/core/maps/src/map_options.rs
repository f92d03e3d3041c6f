//! Options of a map: all that is known about it beside its files.

use crate::MapMemory;
use pilotage_base::frames::{Geodetic, LocalFrame, ReferenceSystem};
use pilotage_base::georeference::Georeference;

/// Endings of a `GeoTIFF`.
const GEO_TIFF: [&str; 2] = [".tif", ".tiff"];

/// Options of a map: all that is known about it beside its files.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MapOptions {
    /// The world frame to put it into; its own, around its own middle, if there is none.
    pub frame: Option<LocalFrame>,
    /// World frame to put the map into where there is no `frame`, if the map's middle lies within that many
    /// metres of its origin.
    pub near: Option<(LocalFrame, f64)>,
    /// The reference system of its coordinates, before whatever its files say.
    pub system: Option<ReferenceSystem>,
    /// Place of its pixels, instead of whatever its files say.
    pub place: Option<Georeference>,
    /// Limits of the memory that it may keep.
    pub memory: MapMemory,
}

/// Whether a file is a `GeoTIFF` by its name.
pub(crate) fn is_geo_tiff(name: &str) -> bool {
    let lower = name.to_ascii_lowercase();
    GEO_TIFF.iter().any(|ending| lower.ends_with(ending))
}

/// The world frame of a map whose own origin is `origin`.
pub(crate) fn frame_of(options: &MapOptions, origin: Option<Geodetic>) -> LocalFrame {
    let near = (options.near.zip(origin))
        .filter(|((frame, reach), own)| frame.world_from_geodetic(own).coords.norm() <= *reach)
        .map(|((frame, _), _)| frame);
    (options.frame.or(near))
        .or_else(|| origin.map(LocalFrame::new))
        // A world file in metres needs no place on the globe.
        .unwrap_or_else(|| LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0)))
}
