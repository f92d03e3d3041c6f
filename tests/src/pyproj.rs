//! Places that pyproj gives coordinates of a reference system.

use serde::Serialize;

use crate::oracle::ask;

/// Coordinates of one reference system.
#[derive(Serialize)]
pub struct Coordinates {
    /// EPSG code of the system.
    pub epsg: u32,
    /// Each point in the order x, y and in the unit of the system; degrees of longitude and latitude.
    pub coordinates: Vec<[f64; 2]>,
    /// Latitude and longitude in degrees and height in metres at which a horizontal plane touches the globe.
    pub origin: [f64; 3],
}

/// Latitude and longitude in degrees of each point of each case, and metres to the north and the east on the plane through
/// the case's origin, straight above or below the place. `None` (after saying so) without an interpreter.
///
/// # Panics
/// If pyproj does not answer: that is a failed test.
pub fn places(cases: &[Coordinates]) -> Option<Vec<Vec<[f64; 4]>>> {
    #[derive(Serialize)]
    struct Question<'a> {
        cases: &'a [Coordinates],
    }
    ask("pyproj_points.py", &Question { cases })
}
