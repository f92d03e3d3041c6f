//! Routes and places over the generated scenery that nobody tuned anything on.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_simulate::simulate::Scenario;
use pilotage_vision::landmark::Landmark;

/// Way-points of a random route.
const WAY_POINTS: usize = 5;
/// Shortest and longest leg, metres.
const LEG: (f64, f64) = (250.0, 500.0);
/// Greatest turn from leg to leg, degrees.
const TURN: f64 = 100.0;
/// Half the side of the square, around the origin, that holds the route, metres.
const WITHIN: f64 = 800.0;

/// Side of random places, metres.
const SIDE: f64 = 34.0;
/// Largest distance of a random place beside the middle of a distinct one, metres.
const BESIDE: f64 = 22.0;

/// Boxes of every quality, drawn by `seed`: half on or beside the distinct places of the scenery, half
/// anywhere within 800 m of the origin on either axis.
pub fn random_places(count: usize, seed: u64) -> Vec<Landmark> {
    let features = Scenario::map().distinct_features();
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x000c_a11b);
    let number = (0..count).zip(1..);
    let place = |(i, id): (usize, u32)| {
        let [north, east] = [(); 2].map(|()| 2.0 * random.random::<f64>() - 1.0);
        let middle = match features.get(i / 2 % features.len().max(1)) {
            Some(feature) if i % 2 == 0 => {
                let center = feature.landmark_box.center();
                GroundPoint::new(center.north + BESIDE * north, center.east + BESIDE * east)
            }
            _ => GroundPoint::new(WITHIN * north, WITHIN * east),
        };
        let bounds = GroundRect::centered(middle, SIDE, SIDE);
        Landmark::new(id, format!("place {id}"), bounds)
    };
    number.map(place).collect()
}

/// A route drawn by `seed` over the generated scenery: four legs of 250 to 500 m that turn by up to
/// 100° and stay within 800 m of the origin on either axis.
pub fn random_route(seed: u64) -> Vec<GroundPoint> {
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0x0ff_5e7);
    let mut between = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
    loop {
        let begin = between(-0.8 * WITHIN, 0.8 * WITHIN);
        let mut points = vec![GroundPoint::new(
            begin,
            between(-0.8 * WITHIN, 0.8 * WITHIN),
        )];
        let mut course = between(-180.0, 180.0);
        while points.len() < WAY_POINTS {
            let last = points[points.len() - 1];
            let (sin, cos) = f64::to_radians(course).sin_cos();
            let leg = between(LEG.0, LEG.1);
            points.push(GroundPoint::new(
                last.north + leg * cos,
                last.east + leg * sin,
            ));
            course += between(-TURN, TURN);
        }
        let inside = |p: &GroundPoint| p.north.abs() <= WITHIN && p.east.abs() <= WITHIN;
        if points.iter().all(inside) {
            return points;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_random_route_stays_over_the_scenery_and_another_seed_gives_another() {
        let route = random_route(4);
        assert_eq!(route, random_route(4));
        assert_ne!(route, random_route(5));
        for leg in route.windows(2) {
            let length = leg[0].distance(&leg[1]);
            assert!((LEG.0..=LEG.1).contains(&length), "{length}");
            assert!(
                leg.iter()
                    .all(|p| p.north.abs() <= WITHIN && p.east.abs() <= WITHIN)
            );
        }
    }
}
