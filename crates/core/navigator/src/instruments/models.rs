//! Requirements of dead reckoning on a process model beyond what every vehicle promises.

use super::fit::AirFit;
use super::outlook::Outlook;
use pilotage_base::frames::GroundPoint;
use pilotage_estimation::filter::Gaussian;
use pilotage_estimation::vehicle::{
    AIRSPEED_MEMORY, AirplaneScaled, AirplaneWind, Gusts, VehicleModel,
};

/// An airplane whose airspeed may be missing.
pub trait Airplane<const N: usize>: VehicleModel<N> + Clone {
    /// The same airplane, assumed to fly at `speed` with standard deviation `deviation` (m/s) wherever no
    /// airspeed is measured.
    #[must_use]
    fn cruising(&self, speed: f64, deviation: f64) -> Self;

    /// The same airplane in the noise that its flight shows.
    #[must_use]
    fn in_noise_of(&self, fit: &AirFit) -> Self;

    /// Belief at the beginning, at `place` with standard deviation `deviation` (m) per axis.
    fn start(&self, fit: Option<&AirFit>, place: GroundPoint, deviation: f64) -> Gaussian<N> {
        let _ = fit;
        self.prior(place, deviation)
    }

    /// The same during an outage that follows the fit.
    #[must_use]
    fn in_outage_after(&self, fit: &AirFit) -> Self {
        self.in_noise_of(fit)
    }

    /// Has a belief at the beginning of an outage say what the outlook does of everything but the place.
    fn begin_outage(&self, belief: &mut Gaussian<N>, outlook: &Outlook) {
        let _ = (belief, outlook);
    }

    /// A belief with the doubts of the fit about what it has told.
    #[must_use]
    fn with_doubts_of(&self, fit: &AirFit, belief: Gaussian<N>) -> Gaussian<N> {
        let _ = fit;
        belief
    }

    /// Components of the state that the fit has told and the filter leaves as they are.
    fn told(&self) -> &'static [usize] {
        &[]
    }
}

/// Indices of wind, gust, the airspeed's scale and the heading's bias in the state of [`AirplaneScaled`].
const WIND: usize = 2;
const GUST: usize = 4;
const SCALE: usize = 6;
const HEADING_BIAS: usize = 7;
/// Standard deviation of what counts as known.
const EXACT: f64 = 1e-6;
/// Time over which a drift of the heading that is not known counts as its random walk, seconds: that of an outage.
pub(super) const OUTAGE: f64 = 60.0;

impl Airplane<8> for AirplaneScaled {
    fn cruising(&self, speed: f64, deviation: f64) -> Self {
        let mut model = *self;
        model.air_data.cruise_airspeed = speed;
        model.air_data.cruise_airspeed_noise_density = self.air_data.airspeed_noise_density;
        model.gusts_without_airspeed = Gusts {
            deviation: deviation.hypot(self.gusts.deviation),
            per_wind: 0.0,
            correlation_time: AIRSPEED_MEMORY,
        };
        model
    }

    fn in_noise_of(&self, fit: &AirFit) -> Self {
        let mut model = *self;
        model.wind_noise_density = fit.noise.walk;
        model.gusts = Gusts {
            deviation: fit.noise.gust,
            per_wind: 0.0,
            correlation_time: fit.noise.memory,
        };
        let errors = &mut model.errors;
        // A filter that allows for their doubt weighs a velocity the less the farther its airspeed as read is from nothing:
        // noise of the airspeed then decides what the wind is made of, which is learning the scale in another way. In
        // winds that hardly change, with an airspeed noise of 2 m/s, that made winds 5 m/s off.
        errors.start_scale_deviation = EXACT;
        errors.start_heading_bias_deviation = EXACT;
        // The fit is about the end of what it rests on.
        (
            errors.scale_noise_density,
            errors.heading_bias_noise_density,
        ) = (0.0, 0.0);
        model
    }

    fn in_outage_after(&self, fit: &AirFit) -> Self {
        let mut model = self.in_noise_of(fit);
        model.wind_noise_density = fit.expected_noise.walk;
        model.gusts.deviation = fit.expected_noise.gust;
        model.gusts.correlation_time = fit.expected_noise.memory;
        let errors = &mut model.errors;
        errors.scale_noise_density = self.errors.scale_noise_density;
        let drift = fit.drift_deviation * OUTAGE.sqrt();
        errors.heading_bias_noise_density = self.errors.heading_bias_noise_density.hypot(drift);
        model
    }

    fn start(&self, fit: Option<&AirFit>, place: GroundPoint, deviation: f64) -> Gaussian<8> {
        let mut start = self.prior(place, deviation);
        if let Some(fit) = fit {
            start.mean[SCALE] = fit.scale;
        }
        start
    }

    /// The errors of the place have nothing in common with the others but by way of the flight so far, which satellite
    /// navigation has held to metres.
    fn begin_outage(&self, belief: &mut Gaussian<8>, outlook: &Outlook) {
        for row in WIND..8 {
            belief.covariance.row_mut(row).fill(0.0);
            belief.covariance.column_mut(row).fill(0.0);
        }
        let places = [WIND, WIND + 1, SCALE, HEADING_BIAS];
        for (i, row) in places.into_iter().enumerate() {
            for (j, column) in places.into_iter().enumerate() {
                belief.covariance[(row, column)] = outlook.covariance[(i, j)];
            }
        }
        for gust in [GUST, GUST + 1] {
            belief.covariance[(gust, gust)] = outlook.gust_variance;
        }
    }

    fn with_doubts_of(&self, fit: &AirFit, mut belief: Gaussian<8>) -> Gaussian<8> {
        let least = fit.still_wind_deviation.powi(2);
        for (index, least) in [
            (WIND, least),
            (WIND + 1, least),
            (SCALE, fit.scale_deviation.powi(2)),
            (HEADING_BIAS, fit.offset_deviation.powi(2)),
        ] {
            let variance = &mut belief.covariance[(index, index)];
            *variance = variance.max(least);
        }
        belief
    }

    /// Scale and heading. A filter that learns them by itself compares the airspeed with the velocity from moment to
    /// moment, where both have noise of their own, and finds too small a scale; and it would learn the same velocities
    /// a second time.
    fn told(&self) -> &'static [usize] {
        &[SCALE, HEADING_BIAS]
    }
}

impl Airplane<4> for AirplaneWind {
    /// Without a state that remembers it, the deviation becomes the white noise that moves the airplane as far
    /// in the long run: σ √(2τ).
    fn cruising(&self, speed: f64, deviation: f64) -> Self {
        let mut model = *self;
        model.air_data = model.air_data.cruising(speed, deviation);
        model
    }

    /// As it is: it is told its noise.
    fn in_noise_of(&self, _fit: &AirFit) -> Self {
        *self
    }
}
