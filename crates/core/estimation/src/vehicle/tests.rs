//! Every vehicle model, and what each promises.

use std::f64::consts::{FRAC_PI_2, TAU};

use approx::assert_relative_eq;
use nalgebra::{Const, Matrix2, SMatrix, SVector, Vector2, Vector4};
use proptest::prelude::*;

use super::*;
use crate::filter::{Gaussian, Ukf, UnscentedSettings, numerical_jacobian};
use pilotage_base::frames::units::{feet, knots};
use pilotage_base::frames::{Attitude, GroundPoint};

fn eastward(airspeed: f64) -> ControlInput {
    ControlInput::new(airspeed, Attitude::level(FRAC_PI_2))
}

#[test]
fn an_airplane_heading_east_in_a_north_west_wind_drifts_south_east() {
    // DeAngelo 2016, first flight with wind: from 307° at 10 kt, +7.986 kt east, 6.018 kt south.
    let wind = Vector2::new(-knots(6.018), knots(7.986));
    let state = Vector4::new(10.0, 20.0, wind.x, wind.y);
    let model = AirplaneWind::default();
    let next = model.propagate(&state, &eastward(19.0), 2.0);
    assert_relative_eq!(next[0], 10.0 - 2.0 * 3.096, epsilon = 3e-3);
    assert_relative_eq!(next[1], 20.0 + 2.0 * (19.0 + 4.109), epsilon = 3e-3);
    assert_eq!(model.wind(&next), Some(wind));
    assert_eq!(model.position(&state), GroundPoint::new(10.0, 20.0));
}

#[test]
fn doubtful_airspeed_spreads_the_position_along_the_heading() {
    let air_data = AirData {
        airspeed_noise_density: 2.0,
        heading_noise_density: 0.01,
        position_noise_density: 0.0,
        ..AirData::default()
    };
    let model = AirplaneWind {
        air_data,
        wind_noise_density: 0.0,
        ..AirplaneWind::default()
    };
    let noise = model.process_noise(&Vector4::zeros(), &eastward(20.0), 0.5);
    assert_relative_eq!(noise[(1, 1)], 2.0 * 2.0 * 0.5, max_relative = 1e-12);
    assert_relative_eq!(
        noise[(0, 0)],
        (20.0_f64 * 0.01).powi(2) * 0.5,
        max_relative = 1e-12
    );
    assert!(noise[(0, 1)].abs() < 1e-12);
}

#[test]
fn the_thesis_noise_is_that_of_table_4_whatever_the_step() {
    let model = AirplaneWind::with_thesis_noise(ThesisNoise::DistinctLandmarks);
    for dt in [0.1, 0.5, 2.0] {
        let noise = model.process_noise(&Vector4::zeros(), &eastward(20.0), dt);
        assert_relative_eq!(noise[(0, 0)].sqrt(), feet(3.0), max_relative = 1e-12);
        assert_relative_eq!(noise[(3, 3)], 0.2 * feet(1.0).powi(2), max_relative = 1e-12);
    }
    assert_relative_eq!(
        ThesisNoise::GenericLandmarks.position_variance().sqrt(),
        feet(20.0)
    );
    assert_relative_eq!(
        ThesisNoise::RoadLocalization.wind_variance().sqrt(),
        feet(2.0)
    );
    assert_relative_eq!(
        ThesisNoise::WindFromGps.wind_variance(),
        0.4 * feet(1.0).powi(2)
    );
}

#[test]
fn without_a_measured_airspeed_the_airplane_cruises_and_doubts_it() {
    let model = AirplaneWind::default();
    let unknown = ControlInput::without_airspeed(Attitude::level(FRAC_PI_2));
    let next = model.propagate(&Vector4::zeros(), &unknown, 1.0);
    assert_relative_eq!(
        next[1],
        model.air_data.cruise_airspeed,
        max_relative = 1e-12
    );
    let known = model.process_noise(&next, &eastward(18.0), 1.0);
    assert!(model.process_noise(&next, &unknown, 1.0)[(1, 1)] > 10.0 * known[(1, 1)]);
}

#[test]
fn a_biased_airplane_flies_where_it_truly_heads() {
    let model = AirplaneWindBias::default();
    let bias = 0.05;
    let state = SVector::from([0.0, 0.0, 0.0, 0.0, 1.5, bias]);
    let reading = ControlInput::new(20.0, Attitude::level(bias));
    let next = model.propagate(&state, &reading, 1.0);
    assert_relative_eq!(next[0], 18.5, epsilon = 1e-12);
    assert_relative_eq!(next[1], 0.0, epsilon = 1e-12);
    for turns in [-3.0, 1.0] {
        let wrapped = ControlInput::new(20.0, Attitude::level(bias + turns * TAU));
        assert_relative_eq!(model.propagate(&state, &wrapped, 1.0), next, epsilon = 1e-9);
        let noise = model.process_noise(&state, &wrapped, 1.0);
        assert_relative_eq!(
            noise,
            model.process_noise(&state, &reading, 1.0),
            epsilon = 1e-9
        );
    }
}

#[test]
fn a_gust_fades_and_carries_the_airplane_by_its_time_constant() {
    let model = AirplaneWindGust {
        gusts: Gusts {
            deviation: 1.0,
            per_wind: 0.0,
            correlation_time: 4.0,
        },
        ..AirplaneWindGust::default()
    };
    let state = SVector::from([0.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
    let still = ControlInput::new(0.0, Attitude::level(0.0));
    let later = model.propagate(&state, &still, 400.0);
    assert_relative_eq!(later[0], 2.0 * 4.0, epsilon = 1e-9);
    assert!(later[4].abs() < 1e-9);
    let noise = model.process_noise(&state, &still, 400.0);
    assert_relative_eq!(noise[(4, 4)], 1.0, epsilon = 1e-9);
}

#[test]
fn gusts_are_as_strong_as_the_wind_that_is_believed_in() {
    let model = AirplaneFull {
        gusts: Gusts {
            deviation: 0.1,
            per_wind: 0.05,
            correlation_time: 4.0,
        },
        ..AirplaneFull::default()
    };
    let input = eastward(20.0);
    let state = |north, east| SVector::from([0.0, 0.0, north, east, 0.0, 0.0, 0.0, 0.0]);
    let gust = |noise: SMatrix<f64, 8, 8>| noise[(4, 4)].sqrt();
    let long = 400.0;
    let in_calm = gust(model.process_noise(&state(1.0, 1.0), &input, long));
    assert_relative_eq!(in_calm, 0.1, epsilon = 1e-9);
    let in_wind = gust(model.process_noise(&state(-6.0, 8.0), &input, long));
    assert_relative_eq!(in_wind, 0.5, epsilon = 1e-9);
    // Of a wind that nobody knows: the mean over the winds that it may be.
    let mut belief = Gaussian::new(state(9.0, -8.0), SMatrix::identity());
    belief.covariance[(2, 2)] = 16.0;
    belief.covariance[(3, 3)] = 9.0;
    let mean = (0..4).map(|corner| {
        let north = if corner % 2 == 0 { 4.0 } else { -4.0 };
        let east = if corner / 2 == 0 { 3.0 } else { -3.0 };
        model.process_noise(&state(9.0 + north, -8.0 + east), &input, 0.5)
    });
    let mean = mean.sum::<SMatrix<f64, 8, 8>>() / 4.0;
    assert_relative_eq!(
        model.noise_of_belief(&belief, &input, 0.5),
        mean,
        max_relative = 1e-9
    );
    let nobody_knows = model.prior(GroundPoint::new(0.0, 0.0), 1.0);
    let expected = 0.05 * 32.0_f64.sqrt();
    assert_relative_eq!(
        nobody_knows.covariance[(4, 4)].sqrt(),
        expected,
        epsilon = 1e-9
    );
}

/// Checks the slope that a model gives against differences of what it does.
struct Slopes {
    input: ControlInput,
    dt: f64,
    offset: f64,
}

impl VehicleVisitor for Slopes {
    type Output = ();

    fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) {
        let prior = model.prior(GroundPoint::new(5.0, -7.0), 3.0);
        let state = prior.mean + prior.standard_deviations() * self.offset;
        let step = |x: &SVector<f64, N>| Some(model.propagate(x, &self.input, self.dt));
        let differences = numerical_jacobian::<N, Const<N>>(step, &state).unwrap();
        let slope = model.transition(&state, &self.input, self.dt);
        assert_relative_eq!(slope, differences, epsilon = 1e-7, max_relative = 1e-7);
    }
}

proptest! {
    #[test]
    fn the_slope_of_every_model_is_that_of_what_it_does(
        heading in -7.0..7.0, airspeed in prop::option::of(0.0..40.0), offset in -2.0..2.0,
        dt in 0.001..3.0,
    ) {
        let attitude = Attitude { roll: 0.2, pitch: -0.1, yaw: heading };
        let input = ControlInput { airspeed, attitude, ..ControlInput::default() };
        for vehicle in all_vehicles() {
            vehicle.visit(Slopes { input, dt, offset });
        }
    }
}

/// Checks what every model promises about its noise at a state.
struct Promises {
    input: ControlInput,
    dt: f64,
    bias: f64,
}

impl VehicleVisitor for Promises {
    type Output = ();

    fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) {
        let mut state = model.prior(GroundPoint::new(5.0, -7.0), 3.0).mean;
        if let Some(i) = model.index_of(StateComponent::HeadingBias) {
            state[i] = self.bias;
        }
        let (input, dt) = (&self.input, self.dt);
        let transition = |x: &SVector<f64, N>, dt: f64| -> SMatrix<f64, N, N> {
            let step = |x: &SVector<f64, N>| Some(model.propagate(x, input, dt));
            numerical_jacobian::<N, Const<N>>(step, x).unwrap()
        };
        let whole = model.process_noise(&state, input, dt);
        assert_relative_eq!(whole, whole.transpose());
        assert!(Ukf::new(Gaussian::new(state, whole), UnscentedSettings::default()).is_ok());
        // Two half steps add what one whole step adds.
        let between = model.propagate(&state, input, 0.5 * dt);
        let first = model.process_noise(&state, input, 0.5 * dt);
        let second = model.process_noise(&between, input, 0.5 * dt);
        let moved = transition(&between, 0.5 * dt);
        let halves = moved * first * moved.transpose() + second;
        let scale = whole.norm();
        assert_relative_eq!(halves, whole, epsilon = 1e-6 * scale, max_relative = 1e-6);
        let end = model.propagate(&between, input, 0.5 * dt);
        assert_relative_eq!(
            end,
            model.propagate(&state, input, dt),
            epsilon = 1e-9 * (1.0 + dt * 50.0)
        );
    }
}

proptest! {
    #[test]
    fn noise_is_a_covariance_and_two_half_steps_make_a_whole_one(
        heading in -7.0..7.0, airspeed in prop::option::of(0.0..40.0), bias in -0.3..0.3,
        log_dt in -3.0_f64..1.0,
    ) {
        let attitude = Attitude { roll: 0.2, pitch: -0.1, yaw: heading };
        let input = ControlInput { airspeed, attitude, ..ControlInput::default() };
        for vehicle in all_vehicles() {
            vehicle.visit(Promises { input, dt: 10.0_f64.powf(log_dt), bias });
        }
    }
}

#[test]
fn settings_survive_the_file_and_may_be_left_out() {
    let mut keys = Vec::new();
    for vehicle in all_vehicles() {
        let text = serde_json::to_string(&vehicle).unwrap();
        assert_eq!(
            serde_json::from_str::<VehicleSettings>(&text).unwrap(),
            vehicle
        );
        let short = format!("{{\"model\": \"{}\"}}", vehicle.key());
        assert_eq!(
            serde_json::from_str::<VehicleSettings>(&short).unwrap(),
            vehicle
        );
        assert_eq!(VehicleSettings::from_key(vehicle.key()), Some(vehicle));
        assert!(!vehicle.label().is_empty() && vehicle.description().ends_with('.'));
        let components = vehicle.state_components();
        assert_eq!(&components[..2], &[("north", "m"), ("east", "m")]);
        keys.push(vehicle.key());
    }
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), all_vehicles().len());
    assert_eq!(VehicleSettings::from_key("balloon"), None);
}

#[test]
fn flying_a_circle_tells_the_wind_from_the_biases() {
    let model = AirplaneFull {
        gusts: Gusts {
            deviation: 0.1,
            per_wind: 0.0,
            correlation_time: 5.0,
        },
        ..AirplaneFull::default()
    };
    let (wind, airspeed_bias, heading_bias) = (Vector2::new(2.0, -3.0), 0.8, 0.04);
    let prior = model.prior(GroundPoint::new(0.0, 0.0), 2.0);
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
    let mut position = Vector2::zeros();
    let dt = 0.5;
    for k in 0..600 {
        let heading = 0.1 * f64::from(k) * dt;
        let airspeed = 20.0;
        position += (Vector2::new(heading.cos(), heading.sin()) * airspeed + wind) * dt;
        let input = ControlInput::new(
            airspeed + airspeed_bias,
            Attitude::level(pilotage_base::frames::wrap_pi(heading + heading_bias)),
        );
        let noise = model.process_noise(filter.mean(), &input, dt);
        filter
            .predict(|x| model.propagate(x, &input, dt), &noise)
            .unwrap();
        let predicted = filter
            .predict_measurement(|x| Some(Vector2::new(x[0], x[1])), &Matrix2::identity())
            .unwrap();
        filter.correct(&predicted, &position).unwrap();
    }
    let state = filter.state();
    assert_relative_eq!(model.wind(&state.mean).unwrap(), wind, epsilon = 0.1);
    assert_relative_eq!(state.mean[6], airspeed_bias, epsilon = 0.1);
    assert_relative_eq!(state.mean[7], heading_bias, epsilon = 0.005);
}
