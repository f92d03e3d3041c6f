//! The plane of a fit when its points come as longitude and latitude.

use nalgebra::Point2;

use super::ControlPoint;
use pilotage_base::frames::{Geodetic, LocalFrame, ReferenceSystem, wrap_pi};

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

/// Metres of the ground that a unit of the plane of `system` is around the middle of some points, the mean of both axes;
/// `None` if there is no point or one lies where the system does not reach.
///
/// ```
/// use nalgebra::Point2;
/// use pilotage_maps::frames::ReferenceSystem;
/// use pilotage_maps::georeferencer::{ControlPoint, metres_per_unit};
///
/// // At 60° north a metre of Web Mercator is half of one, and 0.17 % more on the ellipsoid.
/// let place = Point2::new(1_200_000.0, 8_399_737.89);
/// let point = ControlPoint { pixel: Point2::origin(), place, enabled: true };
/// let unit = metres_per_unit(&[point], ReferenceSystem::WebMercator).ok_or("no place")?;
/// assert!((unit - 0.50083).abs() < 1e-4);
/// # Ok::<(), &str>(())
/// ```
pub fn metres_per_unit(points: &[ControlPoint], system: ReferenceSystem) -> Option<f64> {
    /// Units to each side over which it is measured.
    const STEP: f64 = 10.0;
    let middle = middle_of(points, system)?;
    let frame = LocalFrame::new(middle);
    let (x, y) = system.coordinates(&middle)?;
    let ground = |x: f64, y: f64| {
        Some(
            frame
                .ground_from_geodetic(&system.geodetic(x, y)?)
                .to_vector(),
        )
    };
    let along_x = ground(x + STEP, y)? - ground(x - STEP, y)?;
    let along_y = ground(x, y + STEP)? - ground(x, y - STEP)?;
    Some(along_x.perp(&along_y).abs().sqrt() / (2.0 * STEP))
}

/// Place in the middle of some points; `None` if there is none, or one lies where their system does not reach. Over the date
/// line it is there.
fn middle_of(points: &[ControlPoint], system: ReferenceSystem) -> Option<Geodetic> {
    let places = points.iter().map(|p| system.geodetic(p.place.x, p.place.y));
    let places: Vec<Geodetic> = places.collect::<Option<_>>()?;
    let first = places.first()?.longitude;
    let count = places.len() as f64;
    let mean = |of: &dyn Fn(&Geodetic) -> f64| places.iter().map(of).sum::<f64>() / count;
    Some(Geodetic {
        latitude: mean(&|place| place.latitude),
        longitude: wrap_pi(first + mean(&|place| wrap_pi(place.longitude - first))),
        height: 0.0,
    })
}

/// Points of `system`, at least one, in the UTM zone of WGS 84 around their middle. `None` if a point lies where
/// its system or the zone does not reach.
pub fn in_utm_zone(
    points: &[ControlPoint],
    system: ReferenceSystem,
) -> Option<(Vec<ControlPoint>, ReferenceSystem)> {
    let middle = middle_of(points, system)?;
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
