//! Map projections of an ellipsoid.
//!
//! Longitudes count from that of the origin, in (-π, π]; coordinates are metres without false easting and
//! northing.

mod azimuthal;
mod conic;
mod cylindrical;
mod krovak;
mod latitudes;

use pilotage_base::frames::{ProjectionMethod, SystemNumbers, TransverseMercator};

/// Farthest from its central meridian that a transverse Mercator projection is used, radians.
const WIDEST: f64 = 0.7;

/// Coordinates of a place; `None` where the projection does not reach.
pub(super) fn project(
    numbers: &SystemNumbers,
    latitude: f64,
    longitude: f64,
) -> Option<(f64, f64)> {
    let (x, y) = match numbers.method {
        ProjectionMethod::Geographic => (longitude, latitude),
        ProjectionMethod::TransverseMercator => {
            if longitude.abs() > WIDEST {
                return None;
            }
            let projection = TransverseMercator::new(numbers.datum.ellipsoid, numbers.scale);
            let (x, y) = projection.project(latitude, longitude);
            (x, y - projection.project(numbers.latitude_0, 0.0).1)
        }
        ProjectionMethod::Mercator => cylindrical::mercator(numbers, latitude, longitude),
        ProjectionMethod::SwissOblique => cylindrical::swiss(numbers, latitude, longitude),
        ProjectionMethod::Krovak => {
            krovak::Krovak::new(numbers).project(numbers, latitude, longitude)
        }
        ProjectionMethod::LambertConformal => {
            conic::LambertConformal::new(numbers).project(latitude, longitude)
        }
        ProjectionMethod::Albers => conic::Albers::new(numbers).project(latitude, longitude)?,
        ProjectionMethod::LambertAzimuthal => {
            azimuthal::LambertAzimuthal::new(numbers).project(latitude, longitude)?
        }
        ProjectionMethod::PolarStereographic => azimuthal::polar(numbers, latitude, longitude),
        ProjectionMethod::ObliqueStereographic => {
            azimuthal::Oblique::new(numbers).project(latitude, longitude)?
        }
    };
    (x.is_finite() && y.is_finite()).then_some((x, y))
}

/// Latitude, and longitude from the origin, of coordinates; `None` where they name no place.
pub(super) fn unproject(numbers: &SystemNumbers, x: f64, y: f64) -> Option<(f64, f64)> {
    let (latitude, longitude) = match numbers.method {
        ProjectionMethod::Geographic => (y, x),
        ProjectionMethod::TransverseMercator => {
            let a = numbers.datum.ellipsoid.semi_major;
            let projection = TransverseMercator::new(numbers.datum.ellipsoid, numbers.scale);
            let north = y + projection.project(numbers.latitude_0, 0.0).1;
            if !(x.abs() < 0.8 * a && north.abs() < 1.6 * a) {
                return None;
            }
            projection.unproject(x, north)
        }
        ProjectionMethod::Mercator => cylindrical::from_mercator(numbers, x, y),
        ProjectionMethod::SwissOblique => cylindrical::from_swiss(numbers, x, y)?,
        ProjectionMethod::Krovak => krovak::Krovak::new(numbers).unproject(numbers, x, y),
        ProjectionMethod::LambertConformal => {
            conic::LambertConformal::new(numbers).unproject(x, y)?
        }
        ProjectionMethod::Albers => conic::Albers::new(numbers).unproject(x, y)?,
        ProjectionMethod::LambertAzimuthal => {
            azimuthal::LambertAzimuthal::new(numbers).unproject(x, y)?
        }
        ProjectionMethod::PolarStereographic => azimuthal::from_polar(numbers, x, y),
        ProjectionMethod::ObliqueStereographic => {
            azimuthal::Oblique::new(numbers).unproject(x, y)?
        }
    };
    (latitude.is_finite() && longitude.is_finite()).then_some((latitude, longitude))
}

/// Name for people.
pub(super) fn name(method: ProjectionMethod) -> &'static str {
    match method {
        ProjectionMethod::Geographic => "longitude and latitude",
        ProjectionMethod::TransverseMercator => "transverse Mercator",
        ProjectionMethod::Mercator => "Mercator",
        ProjectionMethod::LambertConformal => "Lambert conformal conic",
        ProjectionMethod::Albers => "Albers equal-area conic",
        ProjectionMethod::LambertAzimuthal => "Lambert azimuthal equal-area",
        ProjectionMethod::PolarStereographic => "polar stereographic",
        ProjectionMethod::ObliqueStereographic => "oblique stereographic",
        ProjectionMethod::SwissOblique => "Swiss oblique Mercator",
        ProjectionMethod::Krovak => "Křovák's cone",
    }
}

/// Scale of a projection whose scale is true along a parallel: at the pole, or along the equator.
pub(super) fn scale_for(numbers: &SystemNumbers, parallel: f64) -> f64 {
    let ellipsoid = &numbers.datum.ellipsoid;
    match numbers.method {
        ProjectionMethod::PolarStereographic => azimuthal::scale_at_pole(ellipsoid, parallel),
        _ => latitudes::parallel_radius(ellipsoid, parallel),
    }
}
