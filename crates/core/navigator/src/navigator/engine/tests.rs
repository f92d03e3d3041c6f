//! Every estimator on every vehicle model behind the same door.

use nalgebra::{DMatrix, DVector, Vector2, dvector};

use super::*;
use crate::navigator::Estimate;
use crate::navigator::place_on_map::PlaceOnMap;
use pilotage_base::frames::Attitude;
use pilotage_base::statistics::chi_square_quantile;
use pilotage_estimation::filter::{Consistency, ConsistencySummary};
use pilotage_estimation::vehicle::ControlInput;
use pilotage_mission::settings::{
    ChosenAid, EstimatorChoice, EstimatorSettings, SensorNoise, VehicleChoice,
};
use pilotage_vision::registration::FollowSettings;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

fn settings(choice: EstimatorChoice, vehicle: VehicleChoice) -> NavigatorSettings {
    let mut settings = NavigatorSettings {
        vehicle,
        estimator: EstimatorSettings {
            choice,
            ..EstimatorSettings::default()
        },
        ..NavigatorSettings::default()
    };
    if vehicle == VehicleChoice::RandomWalk {
        // A slow one.
        settings.process.position = 3.0;
    }
    settings
}

fn begun(choice: EstimatorChoice, vehicle: VehicleChoice) -> Box<dyn Engine> {
    engine(
        &settings(choice, vehicle),
        GroundPoint::new(10.0, -20.0),
        3.0,
    )
    .unwrap()
}

#[expect(
    clippy::unnecessary_wraps,
    reason = "a measurement model may see nothing"
)]
/// Distance and direction of a mast, and the direction of another seen from a turned vehicle.
fn seen_from(position: GroundPoint, bias: f64) -> Option<DVector<f64>> {
    let (north, east) = (120.0 - position.north, 80.0 - position.east);
    let other = (-60.0 - position.east).atan2(300.0 - position.north) - bias;
    Some(dvector![
        north.hypot(east),
        100.0 * east.atan2(north),
        100.0 * other
    ])
}

/// The same as a measurement model.
fn seen() -> MeasurementModel<'static> {
    MeasurementModel::of_pose(|k| seen_from(k.on_map, k.heading_bias.unwrap_or(0.0)))
}

fn noise() -> DMatrix<f64> {
    DMatrix::from_diagonal(&dvector![1.0, 0.5, 0.5])
}

/// Flies a bent way in a wind and sees the masts every second; the end.
fn flown(choice: EstimatorChoice, vehicle: VehicleChoice) -> Estimate {
    let mut engine = begun(choice, vehicle);
    let mut truth = GroundPoint::new(8.0, -19.0);
    for k in 0..60_i32 {
        let attitude = Attitude::level(0.02 * f64::from(k));
        let north = 3.0 * attitude.yaw.cos() + 1.0;
        let east = 3.0 * attitude.yaw.sin() - 0.5;
        let input = ControlInput {
            // What nobody measures, particles forget by chance.
            ground_velocity: Some(Vector2::new(north, east)),
            ..ControlInput::new(3.0, attitude)
        };
        engine.predict(&input, 0.5).unwrap();
        truth.north += 0.5 * north;
        truth.east += 0.5 * east;
        if k % 2 == 0 {
            let off = 0.5 * f64::from(k).sin();
            let z = seen_from(truth, 0.0).unwrap() + dvector![off, -off, off];
            let expected = engine.expect(&seen(), &noise()).unwrap();
            let step = engine.correct(&seen(), &noise(), &z).unwrap();
            assert_eq!(step.innovation_covariance, expected.covariance);
            assert!((&step.innovation - (z - expected.mean)).norm() < 1e-9);
            let n = step.after.mean.len();
            assert_eq!(step.gain.shape(), (n, 3));
            assert_eq!(step.sigma_after.shape(), (n, 2 * n + 1));
            assert_eq!(step.after, engine.state());
        }
    }
    engine.state()
}

#[test]
fn all_estimators_come_to_the_same_end_on_every_vehicle_model() {
    for vehicle in VehicleChoice::ALL {
        let unscented = flown(EstimatorChoice::Unscented, vehicle);
        for choice in EstimatorChoice::ALL {
            let is_random = choice == EstimatorChoice::Particles;
            let allowed = if is_random { 0.5 } else { 0.1 };
            let other = flown(choice, vehicle);
            for i in 0..unscented.mean.len() {
                let deviation = unscented.covariance[(i, i)].sqrt();
                let off = (unscented.mean[i] - other.mean[i]).abs() / deviation;
                assert!(
                    off < allowed,
                    "{vehicle:?} {choice:?}, component {i}: {off}"
                );
                let ratio = other.covariance[(i, i)].sqrt() / deviation;
                assert!(
                    (0.75..1.35).contains(&ratio),
                    "{vehicle:?} {choice:?}, component {i}: deviation × {ratio}"
                );
            }
        }
    }
}

#[test]
fn a_faded_engine_has_the_factor_of_the_covariance_and_the_same_mean() {
    for choice in EstimatorChoice::ALL {
        let engine = begun(choice, VehicleChoice::AirplaneFull);
        let (before, after) = (engine.state(), engine.faded(4.0).unwrap().state());
        assert!((&after.mean - &before.mean).norm() < 1e-9, "{choice:?}");
        let off = (&after.covariance - before.covariance.clone() * 4.0).norm();
        assert!(off < 1e-9 * before.covariance.norm(), "{choice:?}: {off}");
    }
}

#[test]
fn every_estimator_shows_sigma_points_from_which_the_step_can_be_told() {
    for choice in EstimatorChoice::ALL {
        let mut engine = begun(choice, VehicleChoice::AirplaneFull);
        let step = engine
            .predict(&ControlInput::new(20.0, Attitude::level(0.4)), 0.5)
            .unwrap();
        let n = step.before.mean.len();
        for (points, mean) in [
            (&step.sigma_before, &step.before.mean),
            (&step.sigma_after, &step.after.mean),
        ] {
            assert_eq!(points.shape(), (n, 2 * n + 1));
            assert!((points.column(0) - mean).norm() < 0.05, "{choice:?}");
        }
        // Pairs about the mean before, √n deviations away: their squares are the covariance.
        let pairs = (step.sigma_before.columns(1, n) - step.sigma_before.columns(n + 1, n))
            / (2.0 * (n as f64).sqrt());
        let off = (&pairs * pairs.transpose() - &step.before.covariance).norm();
        assert!(off < 1e-9 * step.before.covariance.norm(), "{choice:?}");
    }
}

#[test]
fn estimators_have_names_and_old_settings_mean_the_unscented_one() {
    let mut keys: Vec<_> = EstimatorChoice::ALL.map(EstimatorChoice::key).to_vec();
    for choice in EstimatorChoice::ALL {
        assert_eq!(EstimatorChoice::from_key(choice.key()), Some(choice));
        assert!(!choice.label().is_empty() && choice.description().ends_with('.'));
    }
    keys.dedup();
    assert_eq!(keys.len(), EstimatorChoice::ALL.len());
    assert_eq!(EstimatorChoice::from_key("oracle"), None);
    let mut stored = serde_json::to_value(NavigatorSettings::default()).unwrap();
    stored.as_object_mut().unwrap().remove("estimator");
    let read: NavigatorSettings = serde_json::from_value(stored).unwrap();
    assert_eq!(read.estimator.choice, EstimatorChoice::Unscented);
    assert_eq!(read, NavigatorSettings::default());
}

#[test]
fn an_engine_that_looks_back_sees_from_where_it_was() {
    for vehicle in [VehicleChoice::AirplaneWind, VehicleChoice::AirplaneFull] {
        let mut engine = begun(EstimatorChoice::Unscented, vehicle);
        let was = engine.state().position();
        let input = |k: i32| ControlInput::new(18.0, Attitude::level(0.1 * f64::from(k)));
        for k in 0..10 {
            engine.predict(&input(k), 0.1).unwrap();
        }
        let here = engine.state().position();
        assert_eq!(engine.seen_from(), here);
        engine.look_back((0..10).rev().map(|k| (input(k), 0.1)).collect());
        assert!(was.distance(&here) > 15.0);
        // Sigma points on a bent way lie a little off the way of their middle.
        assert!(engine.seen_from().distance(&was) < 0.01, "{vehicle:?}");
        let model = MeasurementModel::of_pose(|k| Some(dvector![k.on_map.north, k.on_map.east]));
        let expected = engine.expect(&model, &DMatrix::identity(2, 2)).unwrap();
        let of_then = GroundPoint::new(expected.mean[0], expected.mean[1]);
        assert!(of_then.distance(&was) < 0.1, "{vehicle:?}");
    }
}

#[test]
fn a_random_walk_whose_noise_nobody_stated_is_not_believed_to_stand_still() {
    let settings = NavigatorSettings {
        vehicle: VehicleChoice::RandomWalk,
        ..NavigatorSettings::default()
    };
    let mut walk = engine(&settings, GroundPoint::new(0.0, 0.0), 0.0).unwrap();
    let spread = |walk: &dyn Engine| walk.state().position_covariance().trace();
    let before = spread(walk.as_ref());
    let input = ControlInput::new(0.0, Attitude::level(0.0));
    for _ in 0..4 {
        walk.predict(&input, 0.5).unwrap();
    }
    // 6 m/√s for two seconds, on both axes.
    let grown = spread(walk.as_ref()) - before;
    assert!((grown - 2.0 * 36.0 * 2.0).abs() < 1e-6, "{grown}");
}

/// Flights of a minute over a map of which nobody knows how it is off, by a place on it every second and, where the height
/// is a state, a range to the ground: the NEES of the position at their ends.
fn over_a_map(settings: &NavigatorSettings, of_map: f64, seeds: u64) -> ConsistencySummary {
    let dt = 0.5_f64;
    let mut nees = Consistency::default();
    for seed in 0..seeds {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let mut engine = engine(settings, GroundPoint::default(), 3.0).unwrap();
        let mut place = [3.0 * normal(), 3.0 * normal()];
        let wind_deviation = settings.start.wind;
        let mut wind = [wind_deviation * normal(), wind_deviation * normal()];
        let mut map = [of_map * normal(), of_map * normal()];
        let mut height = 120.0 + normal();
        for k in 0..120_i32 {
            let heading = 0.05 * f64::from(k);
            let input = ControlInput::new(18.0, Attitude::level(heading));
            engine.predict(&input, dt).unwrap();
            let airspeed = 18.0 + settings.process.airspeed * normal() / dt.sqrt();
            let across = 18.0 * settings.process.heading * normal() / dt.sqrt();
            let (sin, cos) = heading.sin_cos();
            let moved = [
                (airspeed * cos - across * sin + wind[0]) * dt,
                (airspeed * sin + across * cos + wind[1]) * dt,
            ];
            let left = (-moved[0].hypot(moved[1]) / 2000.0).exp();
            for axis in 0..2 {
                place[axis] += moved[axis];
                wind[axis] += settings.process.wind * dt.sqrt() * normal();
                map[axis] = left * map[axis] + of_map * (1.0 - left * left).sqrt() * normal();
            }
            height += dt.sqrt() * normal();
            if k % 2 == 0 {
                continue;
            }
            if settings.estimates_height {
                let model = MeasurementModel::of_pose(|k| Some(dvector![k.height?]));
                let noise = DMatrix::from_element(1, 1, 0.25);
                let range = dvector![height + 0.5 * normal()];
                engine.correct(&model, &noise, &range).unwrap();
            }
            let model =
                MeasurementModel::of_pose(|k| Some(dvector![k.on_map.north, k.on_map.east]));
            let of_frame = 1.0 + PlaceOnMap::of(settings, of_map).beyond_state();
            let noise = DMatrix::from_diagonal_element(2, 2, of_frame);
            let seen = dvector![place[0] + map[0] + normal(), place[1] + map[1] + normal()];
            engine.correct(&model, &noise, &seen).unwrap();
        }
        let state = engine.state();
        let off = state.position().to_vector() - nalgebra::Vector2::from(place);
        let root = state.position_covariance().cholesky().unwrap();
        nees.push(root.solve(&off).dot(&off), 2);
    }
    nees.summary().unwrap()
}

#[test]
fn no_number_of_places_on_a_map_is_surer_than_the_map_whoever_tells_how_far_it_is_off() {
    const FLIGHTS: u64 = 800;
    const STUDIES: f64 = 12.0;
    // The sum over all flights has a chi-square distribution with two degrees of freedom each. All studies are to hold at once
    // in 95 of 100 tests.
    let end =
        |probability: f64| chi_square_quantile(probability, 2.0 * FLIGHTS as f64) / FLIGHTS as f64;
    let honest = end(0.025 / STUDIES)..end(1.0 - 0.025 / STUDIES);
    let mut usual = settings(EstimatorChoice::Unscented, VehicleChoice::AirplaneWind);
    usual.process.airspeed = 0.5;
    // Air without gusts, and readings without biases.
    usual.process.gust = 0.0;
    usual.process.gust_per_wind = 0.0;
    usual.process.airspeed_bias = 0.0;
    usual.process.heading_bias = 0.0;
    usual.sensors = SensorNoise {
        tilt_bias: 0.0,
        ..usual.sensors
    };
    let mut by_frames = usual.clone();
    by_frames.whole_frames = Some(FollowSettings {
        map_deviation: 3.0,
        ..FollowSettings::default()
    });
    let mut by_landmarks = usual.clone();
    by_landmarks.detector.map_deviation = 3.0;
    let mut by_roads = usual.clone();
    by_roads.aids = vec![ChosenAid::usual("roads").with("map", 3.0)];
    for (who, told) in [
        ("frames", by_frames),
        ("landmarks", by_landmarks),
        ("roads", by_roads),
    ] {
        for at_height in [false, true] {
            for choice in [EstimatorChoice::Unscented, EstimatorChoice::Extended] {
                let mut settings = told.clone();
                settings.estimates_height = at_height;
                settings.estimator.choice = choice;
                let mean = over_a_map(&settings, 3.0, FLIGHTS).mean;
                println!("{who}, height {at_height}, {choice:?}: {mean}");
                assert!(
                    honest.contains(&mean),
                    "{who}, height {at_height}, {choice:?}: {mean}, not within {honest:?}"
                );
            }
        }
    }
}
