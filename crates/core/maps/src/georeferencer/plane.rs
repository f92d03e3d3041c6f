//! The plane of a fit when its points come as longitude and latitude.

use nalgebra::Point2;

use super::ControlPoint;
use pilotage_base::frames::ReferenceSystem;

/// Points of `system` in a plane of metres: those in degrees are taken into the UTM zone around their
/// middle, others stay. `None` if a point lies where its system does not reach.
pub fn in_metres(
    points: &[ControlPoint],
    system: ReferenceSystem,
) -> Option<(Vec<ControlPoint>, ReferenceSystem)> {
    if !system.is_geographic() || points.is_empty() {
        return Some((points.to_vec(), system));
    }
    in_utm_zone(points, system)
}

/// Points of `system`, at least one, in the UTM zone of WGS 84 around their middle. `None` if a point lies where
/// its system or the zone does not reach.
pub fn in_utm_zone(
    points: &[ControlPoint],
    system: ReferenceSystem,
) -> Option<(Vec<ControlPoint>, ReferenceSystem)> {
    let sum = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.place.x, y + p.place.y));
    let count = points.len() as f64;
    let middle = system.geodetic(sum.0 / count, sum.1 / count)?;
    let plane = ReferenceSystem::utm_around(&middle);
    let moved = points.iter().map(|point| {
        let place = system.geodetic(point.place.x, point.place.y)?;
        let (x, y) = plane.coordinates(&place)?;
        Some(ControlPoint {
            place: Point2::new(x, y),
            ..point.clone()
        })
    });
    Some((moved.collect::<Option<_>>()?, plane))
}
