//! Wind by the unscented filter from positions by satellite navigation.

use nalgebra::{Matrix2, Vector2, Vector4};
use serde::{Deserialize, Serialize};

use super::calibration::CalibrationSettings;
use super::prepared::{Instruments, ReckonError};
use super::readings::Readings;
use super::series::Series;
use super::settings::HeadingChoice;
use pilotage_base::frames::units::feet;
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{FilterError, Gaussian, Ukf, UnscentedSettings};
use pilotage_estimation::vehicle::{AirplaneWind, ControlInput, ThesisNoise, VehicleModel};
use pilotage_flight::Flight;

/// Longest step of the Euler integration between two positions, seconds.
const INTEGRATION_STEP: f64 = 0.1;
/// Longest pause between positions over which the filter goes on, seconds.
const LONGEST_PAUSE: f64 = 5.0;

/// Settings by which the wind is found from satellite navigation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct GpsWindSettings {
    /// Motion model of the airplane, with its process noise.
    pub vehicle: AirplaneWind,
    /// Standard deviation of a position by satellite navigation per axis, metres.
    pub position_deviation: f64,
    /// Least time between two positions that are taken, seconds. The thesis' Q is one per step, whatever
    /// the step: positions that come ten times a second would have the wind walk as much more.
    pub step: f64,
}

impl Default for GpsWindSettings {
    /// The thesis: DeAngelo 2016, Table 4, "wind from GPS": Q = diag(400, 400) ft² and diag(0.4, 0.4)
    /// (ft/s)² (printed "(ft/2)²") per step, R = diag(25, 25) ft². It does not give the step, nor P₀; its
    /// pictures came twice a second.
    fn default() -> Self {
        Self {
            vehicle: AirplaneWind::with_thesis_noise(ThesisNoise::WindFromGps),
            position_deviation: feet(5.0),
            step: 0.5,
        }
    }
}

impl GpsWindSettings {
    /// Seconds after take-off from which winds are compared: the filter has settled then.
    pub const SETTLED: f64 = 60.0;

    /// With noise that does not depend on the step: what the air data and a slowly changing wind really
    /// add, in place of Table 4.
    pub fn continuous() -> Self {
        Self {
            vehicle: AirplaneWind::default(),
            ..Self::default()
        }
    }
}

/// The wind at a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WindAt {
    /// Seconds in the flight's time base.
    pub time: f64,
    /// Velocity of the air (north, east), m/s.
    pub wind: Vector2<f64>,
    /// Its covariance, (m/s)².
    pub covariance: Matrix2<f64>,
}

/// Wind along the longest stretch in the air of `flight`, from its airspeed, heading and positions by
/// satellite navigation, by the logged readings as they are.
///
/// DeAngelo 2016, end of chapter 4: the process of eqs 25-30 with the position as the measurement,
/// h(x) = (x, y), as a reference for the wind that landmarks give. As there, the airspeed is taken for
/// level (no cosine of the pitch), the heading for the direction through the air, and satellite
/// navigation for late by nothing. Over pauses of the instruments the wind is kept, with the noise of
/// the steps that were missed.
///
/// # Errors
///
/// A flight without positions, without heading, or never in the air; a filter that cannot go on.
///
/// ```
/// # use pilotage_base::frames::{GroundPoint, wrap_pi};
/// # use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
/// use pilotage_navigator::instruments::{GpsWindSettings, gps_wind};
/// # use pilotage_raster::camera::CameraModel;
/// # let rate = 3_f64.to_radians();
/// # let times: Vec<f64> = (0..1200).map(|i| 0.2 * f64::from(i)).collect();
/// # let channel = |name, value: &dyn Fn(f64) -> f64| Channel {
/// #     name,
/// #     times: times.clone(),
/// #     values: times.iter().map(|t| value(*t)).collect(),
/// # };
/// # let flight = Flight {
/// #     name: "circles".to_owned(),
/// #     frame_on_globe: None,
/// #     camera: CameraModel::pinhole(640, 480, 1.0),
/// #     ground_down: 0.0,
/// #     channels: vec![
/// #         channel(ChannelName::Airspeed, &|t| 20.0 + 0.01 * (7.0 * t).sin()),
/// #         channel(ChannelName::Heading, &|t| wrap_pi(rate * t)),
/// #         channel(ChannelName::GpsNorth, &|t| 20.0 / rate * (rate * t).sin() + 3.0 * t),
/// #         channel(ChannelName::GpsEast, &|t| 20.0 / rate * (1.0 - (rate * t).cos()) + 4.0 * t),
/// #     ],
/// #     frames: Vec::new(),
/// #     start: StartFix { time: 0.0, position: GroundPoint::new(0.0, 0.0), standard_deviation: 3.0 },
/// #     truth: None,
/// # };
///
/// // Two circles at 20 m/s that drift by 3 m north and 4 m east a second.
/// let wind = gps_wind(&flight, &GpsWindSettings::continuous())?;
/// let last = wind.last().ok_or("never in the air")?.wind;
/// assert!((last.x - 3.0).abs() < 0.1 && (last.y - 4.0).abs() < 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn gps_wind(flight: &Flight, settings: &GpsWindSettings) -> Result<Vec<WindAt>, ReckonError> {
    along(&Instruments::of(flight, None)?, &flight.name, settings)
}

fn along(
    instruments: &Instruments,
    name: &str,
    settings: &GpsWindSettings,
) -> Result<Vec<WindAt>, ReckonError> {
    let readings = &instruments.readings;
    if readings.heading.is_empty() {
        return Err(ReckonError::NoHeading {
            flight: name.to_owned(),
        });
    }
    Ok(follow(readings, instruments.stretch, settings)?)
}

/// Leads the filter through the positions after the first of a stretch (seconds).
fn follow(
    readings: &Readings,
    (from, to): (f64, f64),
    settings: &GpsWindSettings,
) -> Result<Vec<WindAt>, FilterError> {
    let mut filter: Option<(f64, Ukf<4>)> = None;
    let mut found = Vec::new();
    for (time, place) in readings.positions.between(from, to) {
        let Some((before, ukf)) = filter.as_mut() else {
            filter = Some((time, started(place, settings)?));
            continue;
        };
        let dt = time - *before;
        // A little less, since clocks jitter.
        if dt < 0.99 * settings.step {
            continue;
        }
        match inputs(readings, *before, time).filter(|_| dt <= LONGEST_PAUSE) {
            Some(inputs) => {
                step(ukf, &inputs, dt, place, settings)?;
                let wind = ukf.state().marginal::<2, 2>();
                found.push(WindAt {
                    time,
                    wind: wind.mean,
                    covariance: wind.covariance,
                });
            }
            None => ukf.reset(&after_pause(ukf, dt, place, settings))?,
        }
        *before = time;
    }
    Ok(found)
}

/// A filter at `place` that knows no wind.
fn started(place: Vector2<f64>, settings: &GpsWindSettings) -> Result<Ukf<4>, FilterError> {
    let position = GroundPoint::new(place.x, place.y);
    let prior = settings
        .vehicle
        .prior(position, settings.position_deviation);
    Ukf::new(prior, UnscentedSettings::default())
}

/// Control inputs of the prediction between two times, in equal short steps; `None` over a pause of the
/// instruments.
fn inputs(readings: &Readings, begin: f64, end: f64) -> Option<Vec<ControlInput>> {
    let count = ((end - begin) / INTEGRATION_STEP).ceil().max(1.0);
    let middles = (0..count as usize).map(|i| begin + (i as f64 + 0.5) / count * (end - begin));
    middles
        .map(|time| {
            let airspeed = readings.airspeed.at(time)?;
            let heading = readings.heading.at(time)?;
            Some(ControlInput::new(airspeed, Attitude::level(heading)))
        })
        .collect()
}

/// Predicts over `dt` seconds, Q once, and corrects by the position; DeAngelo 2016, Table 3.
fn step(
    filter: &mut Ukf<4>,
    inputs: &[ControlInput],
    dt: f64,
    place: Vector2<f64>,
    settings: &GpsWindSettings,
) -> Result<(), FilterError> {
    let (model, short) = (&settings.vehicle, dt / inputs.len() as f64);
    let moved = |x: &Vector4<f64>| {
        let each = inputs.iter();
        each.fold(*x, |x, input| model.propagate(&x, input, short))
    };
    let middle = &inputs[inputs.len() / 2];
    let noise = model.process_noise(filter.mean(), middle, dt);
    filter.predict(moved, &noise)?;
    let deviation = settings.position_deviation;
    let noise = Matrix2::identity() * (deviation * deviation);
    let position = |x: &Vector4<f64>| Some(Vector2::new(x[0], x[1]));
    let predicted = filter.predict_measurement(position, &noise)?;
    filter.correct(&predicted, &place)?;
    Ok(())
}

/// The belief after a pause of `pause` seconds: the wind as before, less sure; the place anew.
fn after_pause(
    filter: &Ukf<4>,
    pause: f64,
    place: Vector2<f64>,
    settings: &GpsWindSettings,
) -> Gaussian<4> {
    let wind = filter.state().marginal::<2, 2>();
    let position = GroundPoint::new(place.x, place.y);
    let mut belief = settings
        .vehicle
        .prior(position, settings.position_deviation);
    let steps = (pause / settings.step).max(1.0);
    let input = ControlInput::default();
    let noise = settings
        .vehicle
        .process_noise(&belief.mean, &input, settings.step);
    let noise = noise.fixed_view::<2, 2>(2, 2) * steps;
    belief.mean.fixed_rows_mut::<2>(2).copy_from(&wind.mean);
    let mut block = belief.covariance.fixed_view_mut::<2, 2>(2, 2);
    block.copy_from(&(wind.covariance + noise));
    belief
}

/// Three winds of one flight beside each other, and how far they are apart.
#[derive(Clone, Debug, PartialEq)]
pub struct WindComparison {
    /// By the filter, over time.
    pub by_gps: Vec<WindAt>,
    /// By least squares over all of the stretch in the air (velocity of the air north and east, m/s),
    /// where that can be had.
    pub by_least_squares: Option<Vector2<f64>>,
    /// As the autopilot estimated it, m/s north and east; empty where it did not.
    pub by_autopilot: Series<Vector2<f64>>,
    /// Root mean square of the differences of the filter from the autopilot, m/s.
    pub from_autopilot: Option<f64>,
    /// The same of the filter from least squares, m/s.
    pub from_least_squares: Option<f64>,
    /// The same of the autopilot from least squares, m/s.
    pub autopilot_from_least_squares: Option<f64>,
}

/// Compares the winds of `flight` from `settled` seconds after it took off.
///
/// # Errors
///
/// As [`gps_wind`].
pub fn compare_winds(
    flight: &Flight,
    settings: &GpsWindSettings,
    settled: f64,
) -> Result<WindComparison, ReckonError> {
    let instruments = Instruments::of(flight, None)?;
    WindComparison::of(&instruments, &flight.name, settings, settled)
}

impl WindComparison {
    /// Compares the winds of a flight of this name, of which these are the instruments, from `settled` seconds after
    /// it took off.
    ///
    /// # Errors
    ///
    /// As [`gps_wind`].
    pub fn of(
        instruments: &Instruments,
        name: &str,
        settings: &GpsWindSettings,
        settled: f64,
    ) -> Result<Self, ReckonError> {
        let by_gps = along(instruments, name, settings)?;
        let (begin, end) = instruments.stretch;
        let calibration = CalibrationSettings::default();
        let fit = instruments.calibrate(end, HeadingChoice::Logged, &calibration);
        let fitted = fit.fit.map(|fit| fit.wind);
        let autopilot = &instruments.readings.autopilot_wind;
        let later = || by_gps.iter().filter(|w| w.time >= begin + settled);
        let beside = || later().filter_map(|w| Some((w.wind, autopilot.at(w.time)?)));
        Ok(Self {
            from_autopilot: rms(beside().map(|(own, other)| own - other)),
            from_least_squares: fitted.and_then(|fit| rms(later().map(|w| w.wind - fit))),
            autopilot_from_least_squares: fitted
                .and_then(|fit| rms(beside().map(|(_, other)| other - fit))),
            by_least_squares: fitted,
            by_autopilot: autopilot.clone(),
            by_gps,
        })
    }
}

/// Root mean square of the lengths; `None` of none.
fn rms(differences: impl Iterator<Item = Vector2<f64>>) -> Option<f64> {
    let squares: Vec<f64> = differences.map(|d| d.norm_squared()).collect();
    (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
}
