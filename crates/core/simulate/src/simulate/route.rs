//! The routes of the built-in scenarios over the generated scenery.

use pilotage_base::frames::GroundPoint;

fn route<const N: usize>(points: [(f64, f64); N]) -> Vec<GroundPoint> {
    points
        .into_iter()
        .map(|(north, east)| GroundPoint::new(north, east))
        .collect()
}

/// Nine buildings, a right turn, a road, and a pool near the end.
///
/// The turn is flown before the corner, so that it ends on the second leg.
pub(super) fn two_legs() -> Vec<GroundPoint> {
    route([(-400.0, 420.0), (145.0, -125.0), (540.0, 270.0)])
}

/// The second of the two legs alone, between the buildings and the pool: along a road.
pub(super) fn road_leg() -> Vec<GroundPoint> {
    route([(145.0, -125.0), (540.0, 270.0)])
}

/// Several crossings of the same places with S-turns in different directions, with gaps between.
pub(super) fn extended() -> Vec<GroundPoint> {
    route([
        // S-turns along the buildings, north-west.
        (-400.0, 420.0),
        (-330.0, 300.0),
        (-190.0, 210.0),
        (-110.0, 70.0),
        (30.0, -10.0),
        // Right turn, S-turns along the road to the pool.
        (145.0, -125.0),
        (290.0, -50.0),
        (370.0, 140.0),
        (520.0, 230.0),
        // Right-hand loop and back south-west: nothing known below.
        (600.0, 320.0),
        (540.0, 430.0),
        (420.0, 410.0),
        (240.0, 230.0),
        (140.0, 60.0),
        (10.0, -50.0),
        // S-turns along the buildings, south-east.
        (-40.0, 90.0),
        (-170.0, 150.0),
        (-240.0, 290.0),
        (-380.0, 350.0),
        // Right-hand loop, and once more along the buildings, north-west.
        (-480.0, 330.0),
        (-500.0, 210.0),
        (-400.0, 120.0),
        (-270.0, 150.0),
        (-170.0, 40.0),
        (-40.0, 60.0),
        (60.0, -80.0),
        (150.0, -130.0),
    ])
}

/// From the east along the main road, turns in the west, and back east north of it, away from the road.
pub(super) fn winter() -> Vec<GroundPoint> {
    route([
        // Along the road.
        (-590.0, 700.0),
        (-650.0, 340.0),
        (-640.0, 0.0),
        (-470.0, -340.0),
        (-430.0, -560.0),
        // Turns in the west.
        (-230.0, -680.0),
        (-30.0, -560.0),
        (-160.0, -360.0),
        (-360.0, -300.0),
        (-340.0, -100.0),
        (-120.0, -80.0),
        // Back east, without the road.
        (60.0, 160.0),
        (-20.0, 640.0),
    ])
}

/// Right-hand circuits as around an airfield: over the village on the heading of its runway, out to each corner of the
/// country, and back.
pub(super) fn spring() -> Vec<GroundPoint> {
    route([
        (-350.0, -500.0),
        (100.0, 100.0),
        (440.0, 520.0),
        (-120.0, 600.0),
        (-560.0, 420.0),
        (-480.0, -420.0),
        (-40.0, -620.0),
        (500.0, -480.0),
        (560.0, 60.0),
        (300.0, 460.0),
        (-160.0, 240.0),
        (-420.0, -300.0),
    ])
}
