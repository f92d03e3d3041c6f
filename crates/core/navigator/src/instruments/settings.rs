//! Settings of dead reckoning.

use serde::{Deserialize, Serialize};

use super::calibration::CalibrationSettings;
use pilotage_estimation::vehicle::{AirData, AirDataErrors, AirplaneScaled, AirplaneWind, Gusts};

/// Choice of the heading to navigate by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum HeadingChoice {
    /// The one with which the track over ground fits best so far.
    #[default]
    Best,
    /// The logged one.
    Logged,
    /// The gyros' own since take-off.
    Gyros,
}

/// Choice of the filter that navigates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// Eight states, delays, pitch: [`AirplaneScaled`].
    #[default]
    Scaled,
    /// The four states of the thesis, heading and airspeed as logged: [`AirplaneWind`].
    Plain,
}

/// Settings of dead reckoning; numbers are standard deviations in SI.
///
/// The full filter takes the noise of wind and gusts, and its beliefs about airspeed and heading, from the flight up to
/// the outage ([`super::TrackNoise`], [`super::AirFit`]). What stands below is for flights that do not say it yet, and
/// comes from the two flights of the Skywalker X-8 that the tests fly: that of the full filter is rounded from what makes
/// the positions at the ends of outages likeliest ([`super::likeliest`] over [`super::OutageStudy::end_log_likelihood`]);
/// that of the plain one makes the innovations of `TestLog2` likeliest with the
/// 5 ft of DeAngelo 2016, Table 4, as the doubt of a position, among winds that hardly change: a wind that follows
/// whatever the positions do (4.5 m/s/√s) makes them likelier still and outages useless.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ReckonSettings {
    /// Whether the full filter takes its noise from the flight up to the outage, where that shows it; as set below
    /// otherwise.
    pub learns_noise: bool,
    /// Process model of the filter.
    pub airplane: AirplaneScaled,
    /// Standard deviation of a position by satellite navigation per axis, m.
    pub position_deviation: f64,
    /// Standard deviation of a velocity by satellite navigation per axis, m/s.
    pub velocity_deviation: f64,
    /// Process model of the plain filter.
    pub plain: AirplaneWind,
    /// Standard deviation of a position by satellite navigation per axis, m, as the plain filter takes it.
    pub plain_position_deviation: f64,
    /// Delays and fits.
    pub calibration: CalibrationSettings,
    /// Confidence of the gate on every measurement; 1 lets everything pass.
    pub gate_confidence: f64,
    /// Seconds of refusals after which the measurements are believed and the filter is not.
    pub patience: f64,
}

impl Default for ReckonSettings {
    fn default() -> Self {
        let exact = AirData {
            airspeed_noise_density: 0.0,
            heading_noise_density: 0.0,
            position_noise_density: 0.0,
            ..AirData::default()
        };
        Self {
            learns_noise: true,
            airplane: AirplaneScaled {
                air_data: AirData {
                    position_noise_density: 0.05,
                    ..exact
                },
                wind_noise_density: 0.01,
                start_wind_deviation: 5.0,
                gusts: Gusts {
                    deviation: 1.1,
                    per_wind: 0.0,
                    correlation_time: 2.5,
                },
                errors: AirDataErrors {
                    start_scale_deviation: 0.1,
                    scale_noise_density: 0.0005,
                    start_heading_bias_deviation: 0.2,
                    heading_bias_noise_density: 0.0005,
                },
                ..AirplaneScaled::default()
            },
            position_deviation: 3.0,
            velocity_deviation: 1.0,
            plain: AirplaneWind {
                air_data: AirData {
                    position_noise_density: 2.6,
                    ..exact
                },
                wind_noise_density: 0.14,
                start_wind_deviation: 5.0,
                ..AirplaneWind::default()
            },
            plain_position_deviation: 1.524,
            calibration: CalibrationSettings::default(),
            gate_confidence: 0.9999,
            patience: 10.0,
        }
    }
}
