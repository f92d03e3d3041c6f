//! Ground points of a mission as longitude and latitude.

use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};

/// Longitude and latitude in degrees of a point on the plane through the origin.
pub(crate) fn lon_lat(frame: &LocalFrame, p: &GroundPoint) -> (f64, f64) {
    let position = frame.geodetic_from_ground(p);
    (
        position.longitude.to_degrees(),
        position.latitude.to_degrees(),
    )
}

/// The point of the plane through the origin at a longitude and latitude in degrees.
pub(crate) fn ground(frame: &LocalFrame, longitude: f64, latitude: f64) -> GroundPoint {
    frame.ground_from_geodetic(&Geodetic::from_degrees(latitude, longitude, 0.0))
}

/// Corners of a box, counter-clockwise from the south-west and back to it, as GeoJSON asks.
pub(crate) fn ring(rect: &GroundRect) -> [GroundPoint; 5] {
    [
        GroundPoint::new(rect.south, rect.west),
        GroundPoint::new(rect.south, rect.east),
        GroundPoint::new(rect.north, rect.east),
        GroundPoint::new(rect.north, rect.west),
        GroundPoint::new(rect.south, rect.west),
    ]
}

/// The corners of a polygon without the first one again at the end.
pub(crate) fn open(corners: &[GroundPoint]) -> &[GroundPoint] {
    match corners {
        [first, .., last] if corners.len() > 3 && first.distance(last) < 1e-3 => {
            &corners[..corners.len() - 1]
        }
        all => all,
    }
}

/// Whether corners are those of a box with its sides to the north and to the east, to a millimetre.
pub(crate) fn is_box(corners: &[GroundPoint]) -> bool {
    let open = open(corners);
    let Some(around) = GroundRect::around(open.iter().copied()) else {
        return true;
    };
    let at_corner = |p: &GroundPoint| {
        let north = (p.north - around.north)
            .abs()
            .min((p.north - around.south).abs());
        let east = (p.east - around.east)
            .abs()
            .min((p.east - around.west).abs());
        north < 1e-3 && east < 1e-3
    };
    open.len() == 4 && open.iter().all(at_corner)
}

/// The box around the corners of a polygon.
///
/// Of a box as it is saved, opposite corners are averaged: their coordinates are rounded, and the
/// mean rounds back to the same digits, where the outermost would creep outward with every saving.
pub(crate) fn bounds(corners: &[GroundPoint]) -> Option<GroundRect> {
    let open = match corners {
        [first, .., last] if corners.len() == 5 && first.distance(last) < 1e-3 => &corners[..4],
        all => all,
    };
    let around = GroundRect::around(open.iter().copied())?;
    if open.len() != 4 {
        return Some(around);
    }
    let mut norths: Vec<f64> = open.iter().map(|p| p.north).collect();
    let mut easts: Vec<f64> = open.iter().map(|p| p.east).collect();
    norths.sort_by(f64::total_cmp);
    easts.sort_by(f64::total_cmp);
    let mean = GroundRect {
        south: 0.5 * (norths[0] + norths[1]),
        north: 0.5 * (norths[2] + norths[3]),
        west: 0.5 * (easts[0] + easts[1]),
        east: 0.5 * (easts[2] + easts[3]),
    };
    let is_box = [
        around.south - mean.south,
        around.north - mean.north,
        around.west - mean.west,
        around.east - mean.east,
    ]
    .into_iter()
    .all(|difference| difference.abs() < 1e-3);
    Some(if is_box { mean } else { around })
}
