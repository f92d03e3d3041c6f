//! Roads in pictures, laid on the roads of a map.

use nalgebra::{DMatrix, DVector, MatrixXx4, Vector3};

use super::super::engine::MeasurementModel;
use super::super::observation::{Observation, PicturePart};
use super::super::sighting::SightingReport;
use super::super::tilt::ByTilt;
use super::aid::{Aid, AidInfo, AidLook, AidMoment, AidNumber, BeginAid};
use super::error::AidError;
use super::reading::Spacing;
use super::road_sighting;
use pilotage_mission::settings::ROAD_MAP;
use pilotage_raster::imagery::Window;
use pilotage_roads::{RoadFix, RoadFixSettings, RoadJoining, RoadMap, RoadSighting, fix_on_roads};
use pilotage_vision::road::{COARSEST_SEEN, NorthUpPicture, RoadDetection, RoadPoint};

/// Metres a pixel at which roads are looked for.
const GSD: f64 = 0.5;
/// Ground that is looked at, as far as so many heights from below the camera.
const FARTHEST_HEIGHTS: f64 = 2.0;
/// And as far as this, metres: 16 million pixels at most.
const FARTHEST: f64 = 1000.0;
/// Least probability of a point that counts.
const LEAST_PROBABILITY: f64 = 0.5;
/// Least distance between points, metres: nearer ones err alike.
const SPACING: f64 = 4.0;
/// Standard deviations of the belief within which roads are looked for, beside the least reach.
const BELIEVED: f64 = 3.0;
/// Least and greatest reach, metres.
const REACH: (f64, f64) = (15.0, 60.0);

/// Change of an angle by which its effect is found, radians.
const SMALL_ANGLE: f64 = 1e-3;

/// Description for people.
pub const INFO: AidInfo = AidInfo {
    key: ROAD_MAP.aid,
    label: "Roads",
    description: "Roads seen in the picture, laid on the roads of the mission. They tell the place across a road and the \
                  heading, and along it only where it bends or another one meets it; what they do not tell is left to \
                  dead reckoning. No number of looks is surer than the map of the roads, except where the height and \
                  the biases of airspeed and heading are estimated as well: there the map's error is taken to be another in \
                  every look. Pictures of which a pixel shows \
                  more than 1.2 m are not looked at.",
    channels: &[],
    components: &[("best known", "m"), ("second", "m"), ("third", "m")],
    tells_place: true,
    passes_over: |camera, pose, ground_down| {
        let height = (ground_down - pose.position_in_world.z).max(1.0);
        let is_looked_at = farthest(height, camera.focal).is_some();
        (!is_looked_at).then_some("a pixel of theirs shows more than 1.2 m of ground")
    },
    numbers: &[
        AidNumber {
            key: ROAD_MAP.number,
            label: "Error of the road map per axis",
            unit: "m",
            usual: ROAD_MAP.usual,
        },
        AidNumber {
            key: "middle",
            label: "Error of a road's middle in a look",
            unit: "m",
            usual: 0.5,
        },
        AidNumber {
            key: "apart",
            label: "Time between looks",
            unit: "s",
            usual: 0.5,
        },
    ],
};

/// Makes the aid.
pub const BEGIN: BeginAid = |numbers, ground| {
    let lines = ground.map_or(&[][..], |ground| &ground.roads);
    if lines.is_empty() {
        return Err(AidError::UnknownGround {
            key: ROAD_MAP.aid.to_owned(),
            what: "road".to_owned(),
            remedy: "add roads to the mission, or switch it off".to_owned(),
        });
    }
    Ok(Box::new(Roads {
        map: RoadMap::new(lines.to_vec(), RoadJoining::SHARED_POINTS),
        of_map: numbers[0],
        of_middle: numbers[1],
        spacing: Spacing::of(numbers[2]),
        sighting: None,
    }))
};

/// The aid over a road map.
struct Roads {
    map: RoadMap,
    /// Standard deviations of the map and of a road's middle in one look, metres.
    of_map: f64,
    of_middle: f64,
    spacing: Spacing,
    /// Report of what it saw last, until that is told.
    sighting: Option<SightingReport>,
}

impl Aid for Roads {
    fn info(&self) -> &'static AidInfo {
        &INFO
    }

    fn observe(&mut self, moment: &AidMoment<'_>) -> Vec<Observation<'static>> {
        let Some(look) = self.spacing.look(moment) else {
            return Vec::new();
        };
        let points = road_points(look);
        let sightings: Vec<RoadSighting> = points.iter().map(|(sighting, _)| *sighting).collect();
        let fix = self.fix(look, &sightings);
        let settings = self.fix_settings(look);
        let fixed = fix.as_ref();
        self.sighting = Some(road_sighting::report(
            look, &points, fixed, &self.map, &settings,
        ));
        fix.and_then(|fix| self.observation(look, &sightings, &fix))
            .into_iter()
            .collect()
    }

    fn sighting(&mut self) -> Option<SightingReport> {
        self.sighting.take()
    }
}

impl Roads {
    /// Correction of the look's pose by what was sighted.
    fn fix(&self, look: &AidLook<'_>, sightings: &[RoadSighting]) -> Option<RoadFix> {
        fix_on_roads(&self.map, sightings, look.below(), &self.fix_settings(look))
    }

    fn fix_settings(&self, look: &AidLook<'_>) -> RoadFixSettings {
        RoadFixSettings {
            reach: (REACH.0 + BELIEVED * look.deviation()).min(REACH.1),
            shared: (self.of_middle.powi(2) + look.beyond_state(self.of_map)).sqrt(),
            scale: look.noise.height / look.height(),
            ..RoadFixSettings::default()
        }
    }

    /// Measurement of each component of a fix, with the errors of the camera's attitude; `None` where a little of them
    /// would undo it.
    fn observation(
        &self,
        look: &AidLook<'_>,
        sightings: &[RoadSighting],
        fix: &RoadFix,
    ) -> Option<Observation<'static>> {
        let weights: Vec<Vector3<f64>> = fix.components.iter().map(|c| c.weights).collect();
        let size = weights.len();
        let mut by_pose = MatrixXx4::zeros(size);
        for axis in 0..3 {
            let moved = assumed_otherwise(look, sightings, axis)?;
            let change = (self.fix(look, &moved)?.correction - fix.correction) / SMALL_ANGLE;
            for (row, weights) in weights.iter().enumerate() {
                by_pose[(row, axis)] = weights.dot(&change);
            }
        }
        let own = fix.components.iter().map(|component| component.variance);
        let own = DMatrix::from_diagonal(&DVector::from_iterator(size, own));
        let noise = &own + &by_pose * look.noise.pose_covariance() * by_pose.transpose();
        let measured = fix.components.iter().map(|component| component.value);
        let by_tilt = ByTilt::of(&by_pose);
        // North, east and heading that were believed; a bias that is larger is a heading that is smaller.
        let believed = look.belief.mean;
        Some(Observation {
            measured: DVector::from_iterator(size, measured),
            noise,
            model: MeasurementModel::of_pose(move |seen| {
                let bias = seen.heading_bias.unwrap_or(0.0);
                let change = Vector3::new(
                    seen.on_map.north - believed.x,
                    seen.on_map.east - believed.y,
                    believed.z - bias,
                );
                let values = weights.iter().map(|weights| weights.dot(&change));
                let mut expected = DVector::from_iterator(size, values);
                by_tilt.add(&mut expected, seen);
                Some(expected)
            }),
            weakened: None,
            degrees: size,
            in_picture: Some(PicturePart { by_pose, own }),
        })
    }
}

/// The sightings where they would lie if the roll, pitch or yaw (0, 1, 2) were assumed a little smaller than it is.
fn assumed_otherwise(
    look: &AidLook<'_>,
    sightings: &[RoadSighting],
    axis: usize,
) -> Option<Vec<RoadSighting>> {
    let (camera, ground_down) = (look.model.camera, look.model.ground_down);
    let mut moved = look.pose;
    let attitude = &mut moved.attitude;
    let mut turned = 0.0;
    match axis {
        0 => attitude.roll -= SMALL_ANGLE,
        1 => attitude.pitch -= SMALL_ANGLE,
        _ => {
            attitude.yaw -= SMALL_ANGLE;
            turned = SMALL_ANGLE;
        }
    }
    let otherwise = |sighting: &RoadSighting| {
        let pixel = look.pixel_of(sighting.place)?;
        Some(RoadSighting {
            place: camera.ground_at(&moved, &pixel, ground_down)?,
            direction: sighting.direction - turned,
        })
    };
    sightings.iter().map(otherwise).collect()
}

/// Points on roads in the look's picture, on the ground under its pose, with the width of the road, metres.
fn road_points(look: &AidLook<'_>) -> Vec<(RoadSighting, f64)> {
    let model = &look.model;
    let Some(farthest) = farthest(look.height(), model.camera.focal) else {
        return Vec::new();
    };
    let ground = NorthUpPicture::of(
        model.camera,
        &look.pose,
        model.ground_down,
        look.picture,
        GSD,
        farthest,
    );
    let Some(NorthUpPicture { window, pixels }) = ground else {
        return Vec::new();
    };
    let seen = RoadDetection::Network.roads_seen(&pixels, GSD);
    let mut kept: Vec<(RoadSighting, f64)> = Vec::new();
    for point in &seen.points {
        let new = sighting(&window, point);
        let is_apart = |other: &(RoadSighting, f64)| other.0.place.distance(&new.place) >= SPACING;
        if point.probability >= LEAST_PROBABILITY && kept.iter().all(is_apart) {
            kept.push((new, GSD * point.width));
        }
    }
    kept
}

/// Distance from below the camera to which roads are looked for from that height, metres. `None` where every pixel shows too
/// much for a road.
fn farthest(height: f64, focal: f64) -> Option<f64> {
    let is_seen = height <= COARSEST_SEEN * focal;
    is_seen.then(|| FARTHEST.min(FARTHEST_HEIGHTS * height))
}

fn sighting(window: &Window, point: &RoadPoint) -> RoadSighting {
    let [x, y] = point.pixel;
    RoadSighting {
        place: window.ground_at(x, y),
        direction: point.direction,
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::super::super::engine::engine;
    use super::super::super::{KnownGround, NavigatorError};
    use super::super::look_for_tests::TestLooks;
    use super::super::take;
    use super::*;
    use nalgebra::Vector2;
    use pilotage_base::frames::{Attitude, GroundPoint};
    use pilotage_estimation::filter::Gate;
    use pilotage_mission::settings::{ChosenAid, NavigatorSettings, SensorNoise};
    use pilotage_raster::camera::CameraModel;
    use pilotage_raster::imagery::Blank;
    use pilotage_roads::RoadLine;

    /// A road to the north-east through the origin.
    fn road() -> RoadLine {
        RoadLine {
            width: 7.0,
            course: vec![
                GroundPoint::new(-500.0, -500.0),
                GroundPoint::new(500.0, 500.0),
            ],
            ..RoadLine::default()
        }
    }

    fn aid(of_map: f64) -> Roads {
        Roads {
            map: RoadMap::new(vec![road()], RoadJoining::SHARED_POINTS),
            of_map,
            of_middle: 0.3,
            spacing: Spacing::of(0.5),
            sighting: None,
        }
    }

    fn settings(of_map: f64) -> NavigatorSettings {
        NavigatorSettings {
            aids: vec![ChosenAid::usual(INFO.key).with(ROAD_MAP.number, of_map)],
            ..NavigatorSettings::default()
        }
    }

    /// Corrections by `looks` looks at the road from 100 m, from a belief 20 m north of the truth, which is the origin:
    /// variances of the place along and across the road before and after, and the error across after.
    fn corrected(of_map: f64, looks: usize) -> ([f64; 2], [f64; 2], f64) {
        let looks_at_road = TestLooks {
            settings: settings(of_map),
            camera: CameraModel::pinhole(64, 48, 1.0),
            attitude: Attitude::level(0.8),
            height: 100.0,
            ..TestLooks::default()
        };
        let believed = GroundPoint::new(20.0, 0.0);
        let mut engine = engine(&looks_at_road.settings, believed, 15.0).unwrap();
        let (along, across) = (Vector2::new(0.5, 0.5), Vector2::new(-0.5, 0.5));
        let variances = |covariance: nalgebra::Matrix2<f64>| {
            [along, across].map(|axis| 2.0 * axis.dot(&(covariance * axis)))
        };
        let before = variances(engine.state().position_covariance());
        let aid = aid(of_map);
        for _ in 0..looks {
            let mut look = looks_at_road.look(engine.as_ref());
            look.noise = SensorNoise {
                roll: 0.002,
                pitch: 0.002,
                yaw: 0.002,
                height: 0.5,
                ..look.noise
            };
            assert_eq!(look.map_deviation, of_map);
            let mean = look.belief.mean;
            // Points of the road below the true place, as they lie below the believed one.
            let seen = (-15..=15).map(|i| RoadSighting {
                place: GroundPoint::new(mean.x + 4.0 * f64::from(i), mean.y + 4.0 * f64::from(i)),
                direction: std::f64::consts::FRAC_PI_4 + mean.z,
            });
            let seen: Vec<_> = seen.collect();
            let fix = aid.fix(&look, &seen).unwrap();
            check_report(&aid, &look, &seen, &fix);
            let observed = aid.observation(&look, &seen, &fix).unwrap();
            let taken = take(engine.as_mut(), &observed, Gate { confidence: 0.999 });
            assert!(taken.unwrap().unwrap().verdict.accepted);
        }
        let state = engine.state();
        let error = 2.0_f64.sqrt() * across.dot(&state.position().to_vector());
        (before, variances(state.position_covariance()), error)
    }

    /// All points lie on the centre line, and one of a road that crosses it lies on none.
    fn check_report(aid: &Roads, look: &AidLook<'_>, seen: &[RoadSighting], fix: &RoadFix) {
        let crossing = RoadSighting {
            direction: seen[0].direction + std::f64::consts::FRAC_PI_2,
            ..seen[0]
        };
        let points = seen.iter().chain([&crossing]).map(|seen| (*seen, 7.0));
        let points: Vec<_> = points.collect();
        let settings = aid.fix_settings(look);
        let report = road_sighting::report(look, &points, Some(fix), &aid.map, &settings);
        assert_eq!(report.accepted(), seen.len());
        assert!(
            (report.known.iter()).all(|known| (known.place.north - known.place.east).abs() < 1e-6)
        );
        let last = report.seen.last().unwrap();
        assert_eq!((last.pair, last.similar), (None, 0));
    }

    #[test]
    fn a_look_at_a_straight_road_corrects_across_and_leaves_dead_reckoning_along() {
        let (before, after, error) = corrected(0.3, 1);
        assert!(error.abs() < 1.0, "{error}");
        assert!(after[1] < 0.4, "{after:?}");
        assert!(
            (after[0] / before[0] - 1.0).abs() < 1e-6,
            "{before:?} {after:?}"
        );
    }

    #[test]
    fn a_hundred_looks_are_no_surer_than_the_map() {
        let (_, after, _) = corrected(3.0, 100);
        assert!((8.0..9.5).contains(&after[1]), "{after:?}");
    }

    #[test]
    fn roads_are_looked_for_as_far_as_pixels_show_them() {
        // A camera of 60° with 640 pixels across: all of it from 1000 ft, nothing from where a pixel shows 2.7 m.
        let focal = CameraModel::pinhole(640, 480, 60_f64.to_radians()).focal;
        assert_eq!(farthest(305.0, focal), Some(610.0));
        assert_eq!(farthest(550.0, focal), Some(1000.0));
        assert_eq!(farthest(1500.0, focal), None);
        assert_eq!(farthest(f64::NAN, focal), None);
        for height in [100.0, 1000.0, 3000.0, 20e3] {
            let side = 2.0 * farthest(height, 20e3).unwrap() / GSD;
            assert!(side * side <= 16e6, "{height} m: {side} pixels");
        }
    }

    #[test]
    fn a_mission_without_roads_is_told_so() {
        let ground = KnownGround::new(Arc::new(Blank));
        let refused = BEGIN(&[1.0, 1.0, 1.0], Some(&ground)).err().unwrap();
        let words = NavigatorError::from(refused).to_string();
        assert!(words.contains("no road"), "{words}");
    }
}
