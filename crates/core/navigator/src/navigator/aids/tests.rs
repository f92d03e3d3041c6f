//! Aids against Kalman updates by hand, and flights without pictures that they keep on course.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector, Matrix2x4, Matrix4, Vector2, Vector4};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::super::engine::engine;
use super::super::{KnownGround, Navigator, NavigatorError, Run};
use super::*;
use pilotage_base::frames::{Attitude, GroundPoint, wrap_pi};
use pilotage_estimation::filter::{Consistency, Gate};
use pilotage_estimation::vehicle::{ControlInput, StateComponent};
use pilotage_flight::{Channel, ChannelName, Flight, NoPictures, StartFix};
use pilotage_mission::settings::{ChosenAid, EstimatorChoice, NavigatorSettings, VehicleChoice};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Blank;
use pilotage_roads::RoadLine;

/// Wind of the flights, m/s north and east, of which no filter is told.
const WIND: Vector2<f64> = Vector2::new(-3.0, 5.0);
/// Airspeed, m/s, and turn rate, rad/s.
const AIRSPEED: f64 = 18.0;
const TURN_RATE: f64 = 0.03;
/// Standard deviation of the compass, radians.
const COMPASS: f64 = 0.05;
/// Random walk of the height, m/√s, and the bank, radians.
const CLIMB: f64 = 1.0;
const ROLL: f64 = 0.1;

/// Two minutes in a wide circle, with satellite navigation once a second from `seed`, of these standard deviations (m,
/// m/s).
fn flight(seed: u64, (position, velocity): (f64, f64)) -> Flight {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let times: Vec<f64> = (0..=1200).map(|i| 0.1 * f64::from(i)).collect();
    let channel = |name, times: Vec<f64>, values| Channel {
        name,
        times,
        values,
    };
    let place = |t: f64| {
        let angle = TURN_RATE * t;
        let radius = AIRSPEED / TURN_RATE;
        Vector2::new(angle.sin(), 1.0 - angle.cos()) * radius + WIND * t
    };
    let over_ground = |t: f64| {
        let angle = TURN_RATE * t;
        Vector2::new(angle.cos(), angle.sin()) * AIRSPEED + WIND
    };
    let heading = times.iter().map(|t| wrap_pi(TURN_RATE * t));
    let mut channels = vec![
        channel(ChannelName::Heading, times.clone(), heading.collect()),
        channel(
            ChannelName::Airspeed,
            times.clone(),
            // Not one number all along, which would be a stuck instrument.
            times.iter().map(|_| AIRSPEED + 1e-3 * normal()).collect(),
        ),
    ];
    let compass = times
        .iter()
        .map(|t| wrap_pi(TURN_RATE * t + COMPASS * normal()));
    channels.push(channel(
        ChannelName::MagneticHeading,
        times.clone(),
        compass.collect(),
    ));
    let (mut height, mut bias) = (120.0, 35.0 + 10.0 * normal());
    let heights = times.iter().map(|t| {
        // A step of the walk every tenth of a second.
        height += CLIMB * 0.1_f64.sqrt() * normal();
        bias += 0.02 * 0.1_f64.sqrt() * normal();
        let tilted = ROLL.cos();
        (
            *t,
            ROLL,
            height + bias + normal(),
            height / tilted + 0.5 * normal(),
        )
    });
    let heights: Vec<(f64, f64, f64, f64)> = heights.collect();
    let of = |value: fn(&(f64, f64, f64, f64)) -> f64| heights.iter().map(value).collect();
    channels.push(channel(ChannelName::Roll, times.clone(), of(|h| h.1)));
    channels.push(channel(
        ChannelName::BarometricHeight,
        times.clone(),
        of(|h| h.2),
    ));
    channels.push(channel(
        ChannelName::GroundRange,
        times.clone(),
        of(|h| h.3),
    ));
    let stamps: Vec<f64> = (1..=120).map(f64::from).collect();
    for (axis, place_name, velocity_name) in [
        (0, ChannelName::GpsNorth, ChannelName::GpsVelocityNorth),
        (1, ChannelName::GpsEast, ChannelName::GpsVelocityEast),
    ] {
        let places = stamps.iter().map(|t| place(*t)[axis] + position * normal());
        channels.push(channel(place_name, stamps.clone(), places.collect()));
        let velocities = stamps
            .iter()
            .map(|t| over_ground(*t)[axis] + velocity * normal());
        channels.push(channel(velocity_name, stamps.clone(), velocities.collect()));
    }
    Flight {
        name: "circle".to_owned(),
        frame_on_globe: None,
        camera: CameraModel::pinhole(64, 48, 1.0),
        ground_down: 0.0,
        channels,
        frames: Vec::new(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::new(3.0 * normal(), 3.0 * normal()),
            standard_deviation: 3.0,
        },
        truth: None,
    }
}

fn settings(aids: Vec<ChosenAid>) -> NavigatorSettings {
    let mut settings = NavigatorSettings {
        aids,
        ..NavigatorSettings::default()
    };
    // A wind that stays as it is, without gusts, and instruments that hardly err.
    settings.process.gust = 0.0;
    settings.process.airspeed_bias = 0.0;
    settings.process.heading_bias = 0.0;
    settings.process.airspeed = 1e-3;
    settings.process.heading = 1e-4;
    settings.process.wind = 1e-4;
    settings
}

fn fly(flight: Flight, settings: &NavigatorSettings) -> Result<Run, NavigatorError> {
    let navigator = Navigator::new(
        Arc::new(flight),
        &KnownGround::new(Arc::new(Blank)),
        settings,
    )?;
    navigator.fly(&mut NoPictures, &|| 0.0)
}

/// Every aid with the noise of the flights.
fn honest(position: f64, velocity: f64) -> [ChosenAid; 2] {
    [
        ChosenAid::usual("gps-position").with("noise", position),
        ChosenAid::usual("gps-velocity").with("noise", velocity),
    ]
}

#[test]
fn a_reading_corrects_as_a_linear_kalman_update_by_hand_does() {
    for (aid, slope) in [
        (0, Matrix2x4::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0)),
        (1, Matrix2x4::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)),
    ] {
        for choice in [EstimatorChoice::Unscented, EstimatorChoice::Extended] {
            let mut settings = settings(Vec::new());
            settings.estimator.choice = choice;
            let mut engine = engine(&settings, GroundPoint::new(5.0, -2.0), 3.0).unwrap();
            let input = ControlInput::new(AIRSPEED, Attitude::level(0.4));
            engine.predict(&input, 2.0).unwrap();
            engine.look_now(&input);
            let prior = engine.state();
            let mean = Vector4::from_column_slice(prior.mean.as_slice());
            let covariance = Matrix4::from_column_slice(prior.covariance.as_slice());
            let flight = flight(7, (2.0, 0.3));
            let moment = AidMoment {
                flight: &flight,
                from: 1.5,
                until: 2.0,
                air: AssumedAir::default(),
                look: None,
            };
            let mut aid = chosen(&honest(2.0, 0.3)[aid..=aid], &flight, None)
                .unwrap()
                .remove(0);
            let observation = aid.observe(&moment).remove(0);
            let of_air = if slope[(0, 0)] == 0.0 {
                Vector2::new(0.4_f64.cos(), 0.4_f64.sin()) * AIRSPEED
            } else {
                Vector2::zeros()
            };
            let measured = Vector2::new(observation.measured[0], observation.measured[1]);
            let sigma = observation.noise[(0, 0)].sqrt();
            let spread = slope * covariance * slope.transpose()
                + nalgebra::Matrix2::identity() * sigma.powi(2);
            let gain = covariance * slope.transpose() * spread.try_inverse().unwrap();
            let innovation = measured - of_air - slope * mean;
            let nis = innovation.dot(&(spread.try_inverse().unwrap() * innovation));
            let open = Gate { confidence: 1.0 };
            let taken = take(engine.as_mut(), &observation, open).unwrap().unwrap();
            assert!(
                (taken.verdict.nis - nis).abs() < 1e-9 * nis.max(1.0),
                "{choice:?}"
            );
            let after = engine.state();
            let expected = mean + gain * innovation;
            assert!((after.mean - DVector::from_column_slice(expected.as_slice())).norm() < 1e-9);
            let left = (Matrix4::identity() - gain * slope) * covariance;
            let off = after.covariance - DMatrix::from_column_slice(4, 4, left.as_slice());
            assert!(off.norm() < 1e-9, "{choice:?}: {off}");
        }
    }
}

#[test]
fn innovations_of_every_aid_are_as_large_as_they_are_said_to_be() {
    let mut of_aids = [Consistency::default(); 2];
    for seed in 0..20 {
        let mut settings = settings(honest(2.0, 0.3).to_vec());
        settings.gate_confidence = 1.0;
        let run = fly(flight(seed, (2.0, 0.3)), &settings).unwrap();
        for update in run.steps.iter().flat_map(|step| &step.updates) {
            let aid = usize::from(update.aid == "gps-velocity");
            of_aids[aid].push(update.nis, update.degrees_of_freedom);
        }
    }
    for nis in of_aids {
        let summary = nis.summary().unwrap();
        println!("{summary:?}");
        assert_eq!((summary.count, summary.dof), (20 * 120, 2.0));
        assert!(summary.is_consistent(), "{summary:?}");
    }
}

#[test]
fn a_compass_tells_the_bias_of_the_heading_as_a_kalman_update_of_one_number_does() {
    const BIAS: f64 = 0.02;
    let mut settings = settings(vec![
        ChosenAid::usual("magnetic-heading").with("apart", 1.0),
    ]);
    settings.vehicle = VehicleChoice::AirplaneFull;
    settings.process.heading_bias = 0.03;
    settings.gate_confidence = 1.0;
    let mut nis = Consistency::default();
    for seed in 0..20 {
        let mut flight = flight(seed, (2.0, 0.3));
        let heading = flight
            .channels
            .iter_mut()
            .find(|c| c.name == ChannelName::Heading);
        for value in &mut heading.unwrap().values {
            *value = wrap_pi(*value + BIAS);
        }
        let compass = flight
            .channel(ChannelName::MagneticHeading)
            .unwrap()
            .clone();
        let run = fly(flight, &settings).unwrap();
        let index = run.state_index(StateComponent::HeadingBias).unwrap();
        let (mut mean, mut variance) = (0.0, 0.03_f64.powi(2));
        for step in run.steps.iter().filter(|step| !step.updates.is_empty()) {
            let read = compass.interpolated(step.time).unwrap();
            let innovation = wrap_pi(TURN_RATE * step.time + BIAS - read) - mean;
            let spread = variance + COMPASS.powi(2);
            nis.push(step.updates[0].nis, 1);
            assert!((step.updates[0].nis - innovation.powi(2) / spread).abs() < 1e-6);
            mean += variance / spread * innovation;
            variance *= 1.0 - variance / spread;
            assert!(
                (step.after.mean[index] - mean).abs() < 1e-9,
                "{} {mean}",
                step.time
            );
            assert!((step.after.covariance[(index, index)] / variance - 1.0).abs() < 1e-6);
        }
    }
    let summary = nis.summary().unwrap();
    println!("{summary:?}");
    assert_eq!(summary.count, 20 * 120);
    assert!(summary.is_consistent(), "{summary:?}");
}

#[test]
fn barometer_and_range_tell_height_and_bias_as_honestly_as_they_say() {
    let aids = [
        ChosenAid::usual("barometric-height").with("noise", 1.0),
        ChosenAid::usual("ground-range").with("noise", 0.5),
    ];
    let mut settings = settings(aids.to_vec());
    (settings.estimates_height, settings.gate_confidence) = (true, 1.0);
    let mut of_aids = [Consistency::default(); 2];
    for seed in 0..20 {
        let run = fly(flight(seed, (2.0, 0.3)), &settings).unwrap();
        for update in run.steps.iter().flat_map(|step| &step.updates) {
            let aid = usize::from(update.aid == "ground-range");
            of_aids[aid].push(update.nis, update.degrees_of_freedom);
        }
        let bias = run.state_index(StateComponent::BarometerBias).unwrap();
        let last = &run.steps.last().unwrap().after;
        assert!((last.mean[bias] - 35.0).abs() < 40.0, "{}", last.mean);
        assert!(last.covariance[(bias, bias)].sqrt() < 0.5);
    }
    for nis in of_aids {
        let summary = nis.summary().unwrap();
        println!("{summary:?}");
        assert!(
            summary.count >= 20 * 120 && summary.is_consistent(),
            "{summary:?}"
        );
    }
}

/// Updates by an aid while the heading is silent for half a minute, times in seconds with the squares per degree.
fn updates_in_silence(vehicle: VehicleChoice, aid: ChosenAid) -> Vec<(f64, f64)> {
    let mut flight = flight(3, (2.0, 0.3));
    let heading = flight
        .channels
        .iter_mut()
        .find(|channel| channel.name == ChannelName::Heading)
        .unwrap();
    let of_gap = |time: f64| (60.0..90.0).contains(&time);
    let told = heading.times.iter().copied().zip(heading.values.clone());
    let told: Vec<(f64, f64)> = told.filter(|it| !of_gap(it.0)).collect();
    (heading.times, heading.values) = told.into_iter().unzip();
    let mut settings = settings(vec![aid]);
    (settings.vehicle, settings.gate_confidence) = (vehicle, 1.0);
    let run = fly(flight, &settings).unwrap();
    let updates = run.steps.iter().flat_map(|step| {
        let of_step = step.updates.iter();
        of_step.map(|it| (step.time, it.nis / it.degrees_of_freedom as f64))
    });
    updates.collect()
}

#[test]
fn a_velocity_over_ground_is_no_contradiction_while_the_heading_is_held() {
    let [_, velocity] = honest(2.0, 0.3);
    let updates = updates_in_silence(VehicleChoice::AirplaneWind, velocity);
    let held: Vec<f64> = updates
        .iter()
        .filter(|it| (62.0..89.5).contains(&it.0))
        .map(|it| it.1)
        .collect();
    // The aircraft turns by 0.8 rad, and 13 m/s of its velocity with it: 43 standard deviations of a reading.
    assert_eq!(held.len(), 28);
    let most = held.iter().copied().fold(0.0, f64::max);
    assert!(most < 9.0, "{held:?}");
}

#[test]
fn a_compass_tells_nothing_of_a_heading_that_is_held() {
    let compass = ChosenAid::usual("magnetic-heading").with("apart", 1.0);
    let updates = updates_in_silence(VehicleChoice::AirplaneFull, compass);
    let is_held = |it: &&(f64, f64)| (62.0..89.5).contains(&it.0);
    assert_eq!(updates.iter().filter(is_held).count(), 0);
    assert!(updates.iter().filter(|it| it.0 > 92.0).count() > 20);
}

#[test]
fn aids_keep_an_airplane_on_course_in_a_wind_that_nobody_told() {
    let off = |aids: Vec<ChosenAid>| {
        let run = fly(flight(3, (2.0, 0.3)), &settings(aids)).unwrap();
        let last = run.steps.last().unwrap().after.clone();
        let truth = Vector2::new((TURN_RATE * 120.0).sin(), 1.0 - (TURN_RATE * 120.0).cos())
            * (AIRSPEED / TURN_RATE)
            + WIND * 120.0;
        (last.position().to_vector() - truth).norm()
    };
    let [position, velocity] = honest(2.0, 0.3);
    assert!(off(Vec::new()) > 500.0, "the wind carries it off");
    assert!(off(vec![position]) < 4.0);
    // A velocity leaves the error of the start.
    assert!(off(vec![velocity]) < 25.0);
}

#[test]
fn a_reading_far_off_is_refused_and_reported() {
    let mut flight = flight(5, (2.0, 0.3));
    let north = flight
        .channels
        .iter_mut()
        .find(|c| c.name == ChannelName::GpsNorth);
    north.unwrap().values[60] += 200.0;
    let run = fly(flight, &settings(honest(2.0, 0.3)[..1].to_vec())).unwrap();
    let updates = run
        .steps
        .iter()
        .flat_map(|step| step.updates.iter().map(|u| (step.time, u)));
    let refused: Vec<_> = updates
        .filter(|(_, update)| !update.is_accepted())
        .collect();
    let (time, update) = refused
        .iter()
        .max_by(|a, b| a.1.nis.total_cmp(&b.1.nis))
        .unwrap();
    assert!((time - 61.0).abs() < 1e-6 && update.nis > update.threshold);
    assert!((update.innovation[0] - 200.0).abs() < 20.0);
}

#[test]
fn readings_nearer_than_their_errors_last_are_left_out() {
    let aid = honest(2.0, 0.3)[0].clone().with("apart", 10.0);
    let run = fly(flight(1, (2.0, 0.3)), &settings(vec![aid])).unwrap();
    assert_eq!(
        run.steps
            .iter()
            .map(|step| step.updates.len())
            .sum::<usize>(),
        12
    );
}

#[test]
fn a_vehicle_that_knows_neither_velocity_nor_heading_bias_is_not_asked_for_them() {
    let [_, velocity] = honest(2.0, 0.3);
    let mut settings = settings(vec![velocity, ChosenAid::usual("magnetic-heading")]);
    settings.vehicle = VehicleChoice::RandomWalk;
    let run = fly(flight(1, (2.0, 0.3)), &settings).unwrap();
    assert!(run.steps.iter().all(|step| step.updates.is_empty()));
}

#[test]
fn an_aid_that_looks_at_pictures_asks_for_a_height() {
    let road = RoadLine {
        course: vec![GroundPoint::default(), GroundPoint::new(900.0, 0.0)],
        ..RoadLine::default()
    };
    let mut ground = KnownGround::new(Arc::new(Blank));
    ground.roads = vec![road];
    let begun = |flight: Flight| {
        let settings = settings(vec![ChosenAid::usual("roads")]);
        Navigator::new(Arc::new(flight), &ground, &settings).map(|_| ())
    };
    let mut flight = flight(1, (2.0, 0.3));
    let refused = begun(flight.clone()).err().map(|error| error.to_string());
    let refused = refused.unwrap_or_default();
    assert!(
        refused.contains("no readings of channel height"),
        "{refused}"
    );
    flight.channels.push(Channel {
        name: ChannelName::HeightAboveGround,
        times: vec![0.0, 120.0],
        values: vec![120.0, 121.0],
    });
    assert_eq!(begun(flight), Ok(()));
}

#[test]
fn every_aid_is_described_and_what_cannot_be_switched_on_says_why() {
    for info in AidInfo::ALL {
        assert_eq!(AidInfo::named(info.key).unwrap().label, info.label);
        assert!(info.description.ends_with('.'));
        let usual = info.values(&ChosenAid::usual(info.key)).unwrap();
        assert_eq!(usual.len(), info.numbers.len());
        let mut bare = flight(1, (2.0, 0.3));
        bare.channels
            .retain(|channel| !info.channels.contains(&channel.name));
        let refused = chosen(&[ChosenAid::usual(info.key)], &bare, None).err();
        assert!(
            matches!(
                refused,
                Some(AidError::NoChannel { .. } | AidError::UnknownGround { .. })
            ),
            "{}",
            info.key
        );
    }
    let refused = |choice: ChosenAid| {
        let error = chosen(&[choice], &flight(1, (2.0, 0.3)), None)
            .err()
            .unwrap();
        error.to_string()
    };
    assert!(refused(ChosenAid::usual("sextant")).contains("gps-position"));
    assert!(refused(ChosenAid::usual("gps-position").with("colour", 1.0)).contains("colour"));
    assert!(refused(ChosenAid::usual("gps-position").with("noise", 0.0)).contains("above zero"));
}
