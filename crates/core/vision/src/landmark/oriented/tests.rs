//! Landmarks of a village looked for on another day, when every roof, the ground and the shadows have changed.

use std::sync::Arc;

use nalgebra::{Matrix2, Point2, Point3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::landmark::{
    Detector, FrameView, Landmark, Refusal, SearchRequest, Sighting, TemplateDetector,
    TemplateFeatures, TemplateSettings,
};
use pilotage_base::frames::{Attitude, GroundPoint, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Gray, Pyramid, Raster, Rgba};

/// A house: its middle, its half sides in metres, and a number that its roof has from it every day.
type House = (GroundPoint, [f64; 2], u64);

struct Village {
    houses: Vec<House>,
    day: u64,
}

impl Village {
    /// Seventy houses about the origin.
    fn new() -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(4);
        let mut number = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
        let houses = (0..70).map(|roof| {
            let middle = GroundPoint::new(number(-100.0, 100.0), number(-100.0, 100.0));
            (middle, [number(2.0, 7.0), number(2.0, 7.0)], roof)
        });
        Self {
            houses: houses.collect(),
            day: 1,
        }
    }

    fn on_day(self, day: u64) -> Self {
        Self { day, ..self }
    }

    /// Without what stands within `radius` of a place.
    fn razed(mut self, place: GroundPoint, radius: f64) -> Self {
        self.houses.retain(|(at, ..)| at.distance(&place) > radius);
        self
    }

    /// With what stands within `radius` of a place standing `offset` from it, too, alone there.
    fn copied(mut self, place: GroundPoint, radius: f64, offset: [f64; 2]) -> Self {
        let moved = GroundPoint::new(place.north + offset[0], place.east + offset[1]);
        let near = |at: &GroundPoint, to: GroundPoint| at.distance(&to) < radius;
        let mut copies = self.houses.clone();
        copies.retain(|(at, ..)| near(at, place));
        self.houses.retain(|(at, ..)| !near(at, moved));
        for (at, half, roof) in copies {
            let at = GroundPoint::new(at.north + offset[0], at.east + offset[1]);
            self.houses.push((at, half, roof));
        }
        self
    }

    fn grey(&self, p: &GroundPoint) -> u8 {
        let mut random = ChaCha8Rng::seed_from_u64(self.day);
        let ground = random.random_range(70..130);
        let (sun, cos) = (std::f64::consts::TAU * random.random::<f64>()).sin_cos();
        let mut grey = ground;
        for (middle, half, number) in &self.houses {
            let on = |north: f64, east: f64| {
                (north - middle.north).abs() < half[0] && (east - middle.east).abs() < half[1]
            };
            if on(p.north - 1.5 * cos, p.east - 1.5 * sun) {
                grey = ground / 2;
            }
            if on(p.north, p.east) {
                let mut roof = ChaCha8Rng::seed_from_u64(self.day + 1000 * number);
                return roof.random_range(30..230);
            }
        }
        grey
    }
}

impl Imagery for Village {
    fn name(&self) -> &'static str {
        "village"
    }
    fn bounds(&self) -> GroundRect {
        GroundRect::centered(GroundPoint::default(), 400.0, 400.0)
    }
    fn native_gsd(&self) -> f64 {
        0.4
    }
    fn window(&self, window: &Window) -> Raster<Rgba> {
        Raster::from_fn(window.width, window.height, |x, y| {
            let grey = self.grey(&window.ground_at(x as f64 + 0.5, y as f64 + 0.5));
            [grey, grey, grey, 255]
        })
    }
}

/// A landmark of 30 m about a place.
fn landmark(place: GroundPoint) -> Landmark {
    Landmark::new(1, "Corner", GroundRect::centered(place, 30.0, 30.0))
}

/// Answer of the detector on a landmark of `map` in a picture of `seen` by a camera 100 m over `above`, to
/// somebody who thinks it `off` metres (north, east) and `turn` radians beside that and as much higher as the
/// logarithm `log_height` says, and knows that to `deviation` metres.
fn sighting(
    map: Village,
    seen: &Village,
    landmark: &Landmark,
    above: GroundPoint,
    (off, turn, log_height, deviation): ([f64; 2], f64, f64, f64),
) -> Sighting {
    let camera = CameraModel::pinhole(320, 240, 60_f64.to_radians());
    let pose = |off: [f64; 2], height: f64, yaw: f64| Pose {
        position_in_world: Point3::new(above.north + off[0], above.east + off[1], -height),
        attitude: Attitude::level(yaw),
    };
    let truth = pose([0.0, 0.0], 100.0, 0.3);
    let pixels = Gray::from_fn(320, 240, |x, y| {
        let pixel = Point2::new(x as f64 + 0.5, y as f64 + 0.5);
        let ground = camera.ground_at(&truth, &pixel, 0.0);
        f32::from(ground.map_or(0, |p| seen.grey(&p)))
    });
    let luminance = Pyramid::new(pixels, 3);
    let view = FrameView {
        camera: &camera,
        pose: pose(off, 100.0 * f64::exp(log_height), 0.3 + turn),
        ground_down: 0.0,
        luminance: &luminance,
    };
    let request = SearchRequest {
        landmark,
        displacement_covariance: Matrix2::identity() * deviation * deviation,
        turn_deviation: 0.07,
        log_scale_deviation: 0.04,
    };
    let settings = TemplateSettings {
        features: TemplateFeatures::Orientation,
        ..TemplateSettings::default()
    };
    TemplateDetector::new(Arc::new(map), settings).detect(&view, &request)
}

#[test]
fn a_corner_of_a_village_is_found_on_another_day_with_its_turn_and_size() {
    let at = GroundPoint::new(12.0, -8.0);
    let above = GroundPoint::new(5.0, 0.0);
    let seen = Village::new().on_day(2);
    let assumed = ([4.0, -3.0], 0.08, 0.05, 5.0);
    let said = sighting(Village::new(), &seen, &landmark(at), above, assumed);
    let Sighting::Found(found) = said else {
        panic!("{said:?}");
    };
    // Under the assumed pose the ground is turned and enlarged about the place below the camera.
    let arm = at.to_vector() - above.to_vector();
    let (sin, cos) = 0.08_f64.sin_cos();
    let turned = nalgebra::Vector2::new(cos * arm.x - sin * arm.y, sin * arm.x + cos * arm.y);
    let expected = above.to_vector() + nalgebra::Vector2::new(4.0, -3.0) + 0.05_f64.exp() * turned;
    let off = (found.ground.to_vector() - expected).norm();
    assert!(off < 1.0, "{off} m: {found:?}");
    assert!((found.rotation - 0.08).abs() < 0.05, "{found:?}");
    assert!((found.scale.ln() - 0.05).abs() < 0.05, "{found:?}");
    let probability = found.probability.unwrap();
    assert!((0.99..=1.0).contains(&probability), "{probability}");
}

#[test]
fn what_was_razed_is_not_found() {
    let at = GroundPoint::new(12.0, -8.0);
    let seen = Village::new().on_day(2).razed(at, 45.0);
    let above = GroundPoint::new(5.0, 0.0);
    let assumed = ([4.0, -3.0], 0.08, 0.05, 5.0);
    let said = sighting(Village::new(), &seen, &landmark(at), above, assumed);
    assert!(matches!(said, Sighting::Refused(..)), "{said:?}");
}

#[test]
fn of_two_places_that_look_alike_neither_is_believed() {
    let at = GroundPoint::new(12.0, -8.0);
    let twins = || Village::new().copied(at, 26.0, [0.0, 36.0]);
    let seen = twins().on_day(2);
    let above = GroundPoint::new(12.0, 10.0);
    // As far from one as from the other.
    let assumed = ([0.0, -18.0], 0.0, 0.0, 14.0);
    let said = sighting(twins(), &seen, &landmark(at), above, assumed);
    let Sighting::Refused(Refusal::Ambiguous, Some(best)) = said else {
        panic!("{said:?}");
    };
    assert!(best.probability.unwrap() < 0.99, "{best:?}");
}

#[test]
fn a_landmark_beyond_the_edge_of_the_picture_is_not_found_in_it() {
    let at = GroundPoint::new(12.0, -8.0);
    let seen = Village::new().on_day(2);
    // The picture ends some 58 m east of the place below the camera.
    for above in [GroundPoint::new(12.0, 75.0), GroundPoint::new(90.0, -8.0)] {
        let assumed = ([0.0, 0.0], 0.0, 0.0, 25.0);
        let said = sighting(Village::new(), &seen, &landmark(at), above, assumed);
        assert!(matches!(said, Sighting::Refused(..)), "{said:?}");
    }
}
