//! Dryden turbulence at low altitude (MIL-F-8785C), discretised exactly.

use nalgebra::{Matrix2, Vector2, Vector3};
use rand::Rng;
use rand_distr::{Distribution, StandardNormal};

use pilotage_base::frames::units::{METRES_PER_FOOT, feet};

/// Exponent of the power-law wind profile in stable air.
const PROFILE_EXPONENT: f64 = 0.3;
/// Height at which MIL-F-8785C takes the wind that drives the turbulence, metres (20 ft).
const REFERENCE_HEIGHT: f64 = 20.0 * METRES_PER_FOOT;
/// Vertical gust intensity of calm air, m/s.
const CALM_INTENSITY: f64 = 0.1;

/// Strength and scale of the gusts: along, across and vertical to the flight direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turbulence {
    /// Standard deviations of the gust (along, across, down), m/s.
    pub intensity: Vector3<f64>,
    /// Scale lengths (along, across, down), metres.
    pub scale: Vector3<f64>,
}

impl Turbulence {
    /// Turbulence at `height` metres above ground where the mean wind there is `wind_speed` m/s.
    ///
    /// MIL-F-8785C, 3.7.3.4, with h in feet and u₂₀ the wind at 20 ft; u along, v across, w down:
    ///
    /// ```text
    /// σ_w = 0.1 u₂₀      σ_u = σ_v = σ_w / (0.177 + 0.000823 h)^0.4
    /// L_w = h            L_u = L_v = h / (0.177 + 0.000823 h)^1.2
    /// ```
    ///
    /// u₂₀ follows from the wind at flight height by a power law with the exponent 0.3 of stable
    /// air. Calm air keeps a vertical intensity of 0.1 m/s.
    ///
    /// ```
    /// use pilotage_simulate::simulate::Turbulence;
    ///
    /// // At 1000 ft 0.177 + 0.000823 h is 1: gusts are as strong and as long in all directions.
    /// let turbulence = Turbulence::low_altitude(304.8, 10.0);
    /// assert!((turbulence.intensity.x - turbulence.intensity.z).abs() < 1e-9);
    /// assert!((turbulence.scale.x - 304.8).abs() < 1e-6);
    /// // u₂₀ = 10 (20 / 1000)^0.3 m/s, a tenth of which is σ_w.
    /// assert!((turbulence.intensity.z - 0.02_f64.powf(0.3)).abs() < 1e-9);
    /// ```
    pub fn low_altitude(height: f64, wind_speed: f64) -> Self {
        let height_ft = (height / METRES_PER_FOOT).clamp(10.0, 1000.0);
        let wind_at_20_ft =
            wind_speed * (REFERENCE_HEIGHT / feet(height_ft)).powf(PROFILE_EXPONENT);
        let vertical = (0.1 * wind_at_20_ft).max(CALM_INTENSITY);
        let shape = 0.177 + 0.000_823 * height_ft;
        let horizontal = vertical / shape.powf(0.4);
        let horizontal_scale = feet(height_ft) / shape.powf(1.2);
        Self {
            intensity: Vector3::new(horizontal, horizontal, vertical),
            scale: Vector3::new(horizontal_scale, horizontal_scale, feet(height_ft)),
        }
    }

    /// Standard deviation of the horizontal gust, m/s, per m/s of the mean wind at `height` metres above
    /// ground, where the wind is more than calm.
    pub fn per_wind(height: f64) -> f64 {
        /// Any wind that is not calm at any height, m/s.
        const WIND: f64 = 100.0;
        Self::low_altitude(height, WIND).intensity.x / WIND
    }

    /// Correlation time of the horizontal gust for an aircraft at `airspeed` m/s, seconds.
    pub fn correlation_time(&self, airspeed: f64) -> f64 {
        self.scale.x / airspeed
    }
}

/// The gust along the flight: a first-order process.
#[derive(Clone, Copy, Debug)]
struct FirstOrder {
    value: f64,
    decay: f64,
    drive: f64,
}

/// The gust across the flight: a second-order process with the Dryden numerator.
#[derive(Clone, Copy, Debug)]
struct SecondOrder {
    state: Vector2<f64>,
    transition: Matrix2<f64>,
    drive: Matrix2<f64>,
}

/// Gusts met by an aircraft at constant airspeed, step by step.
///
/// Each step is the exact discretisation of the continuous process, so that the variance and the
/// spectrum do not depend on the step.
#[derive(Clone, Debug)]
pub struct DrydenGust {
    along: FirstOrder,
    across: SecondOrder,
    down: SecondOrder,
}

fn standard_normal(random: &mut impl Rng) -> f64 {
    StandardNormal.sample(random)
}

impl FirstOrder {
    /// H(s) = σ √(2τ) / (1 + τ s), begun in its stationary state.
    fn new(intensity: f64, time: f64, step: f64, random: &mut impl Rng) -> Self {
        let decay = (-step / time).exp();
        Self {
            value: intensity * standard_normal(random),
            decay,
            drive: intensity * (1.0 - decay * decay).sqrt(),
        }
    }

    fn step(&mut self, random: &mut impl Rng) -> f64 {
        self.value = self.decay * self.value + self.drive * standard_normal(random);
        self.value
    }
}

impl SecondOrder {
    /// H(s) = σ √τ (1 + √3 τ s) / (1 + τ s)², begun in its stationary state.
    ///
    /// In time units of τ: x'' + 2x' + x = w with intensity σ², output x + √3 x'. Then
    /// Φ(r) = e^-r [[1 + r, r], [-r, 1 - r]], and the stationary covariance is P = (σ²/4) I, so that
    /// the output has variance σ²/4 + 3σ²/4 and the step's noise covariance is P - Φ P Φᵀ.
    fn new(intensity: f64, time: f64, step: f64, random: &mut impl Rng) -> Self {
        let r = step / time;
        let transition = (-r).exp() * Matrix2::new(1.0 + r, r, -r, 1.0 - r);
        let variance = 0.25 * intensity * intensity;
        let noise = variance * (Matrix2::identity() - transition * transition.transpose());
        // Upper triangular factor written out: the matrix may be singular to rounding for tiny steps.
        let a = noise[(1, 1)].max(0.0).sqrt();
        let b = if a > 0.0 { noise[(0, 1)] / a } else { 0.0 };
        let c = (noise[(0, 0)] - b * b).max(0.0).sqrt();
        Self {
            state: Vector2::new(standard_normal(random), standard_normal(random)) * variance.sqrt(),
            transition,
            drive: Matrix2::new(c, b, 0.0, a),
        }
    }

    fn step(&mut self, random: &mut impl Rng) -> f64 {
        let noise = Vector2::new(standard_normal(random), standard_normal(random));
        self.state = self.transition * self.state + self.drive * noise;
        self.state.x + 3.0_f64.sqrt() * self.state.y
    }
}

impl DrydenGust {
    /// Gusts for an aircraft at `airspeed` m/s, in steps of `step` seconds.
    pub fn new(turbulence: &Turbulence, airspeed: f64, step: f64, random: &mut impl Rng) -> Self {
        let time = turbulence.scale / airspeed;
        let sigma = turbulence.intensity;
        Self {
            along: FirstOrder::new(sigma.x, time.x, step, random),
            across: SecondOrder::new(sigma.y, time.y, step, random),
            down: SecondOrder::new(sigma.z, time.z, step, random),
        }
    }

    /// The gust (along, across to the right, down) one step later, m/s: velocity of the air.
    ///
    /// ```
    /// use rand::SeedableRng;
    /// use pilotage_simulate::simulate::{DrydenGust, Turbulence};
    ///
    /// let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
    /// let turbulence = Turbulence::low_altitude(100.0, 10.0);
    /// let mut gusts = DrydenGust::new(&turbulence, 20.0, 5.0, &mut random);
    /// // Over 20 000 gusts the mean square is that of the turbulence, to 5 %.
    /// let squares = (0..20_000).map(|_| gusts.step(&mut random).x.powi(2));
    /// let deviation = (squares.sum::<f64>() / 20_000.0).sqrt();
    /// assert!((deviation / turbulence.intensity.x - 1.0).abs() < 0.05);
    /// ```
    pub fn step(&mut self, random: &mut impl Rng) -> Vector3<f64> {
        Vector3::new(
            self.along.step(random),
            self.across.step(random),
            self.down.step(random),
        )
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use pilotage_base::frames::units::knots;

    /// Variance per axis over `seconds`, and the correlation of the first axis over one second.
    fn measured(step: f64, seconds: f64) -> (Vector3<f64>, f64) {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let turbulence = Turbulence {
            intensity: Vector3::new(1.0, 2.0, 0.5),
            scale: Vector3::new(30.0, 40.0, 20.0),
        };
        let mut gust = DrydenGust::new(&turbulence, 20.0, step, &mut random);
        let samples: Vec<Vector3<f64>> = (0..(seconds / step) as usize)
            .map(|_| gust.step(&mut random))
            .collect();
        let lag = (1.0 / step).round() as usize;
        let n = samples.len() as f64;
        let variance = samples
            .iter()
            .map(|g| g.component_mul(g))
            .sum::<Vector3<f64>>()
            / n;
        let lagged = samples
            .windows(lag + 1)
            .map(|w| w[0].x * w[lag].x)
            .sum::<f64>()
            / n;
        (variance, lagged / variance.x)
    }

    #[test]
    fn the_variance_of_the_gust_is_the_stated_one_whatever_the_step() {
        for step in [0.01, 0.1, 0.5] {
            let (variance, _) = measured(step, 60_000.0);
            assert!((variance.x - 1.0).abs() < 0.05, "step {step}: {variance}");
            assert!((variance.y - 4.0).abs() < 0.2, "step {step}: {variance}");
            assert!(
                (variance.z - 0.25).abs() < 0.0125,
                "step {step}: {variance}"
            );
        }
    }

    #[test]
    fn the_gust_along_the_flight_fades_with_the_scale_length() {
        let (_, correlation) = measured(0.05, 60_000.0);
        // One second is 20 m of a scale length of 30 m.
        assert!((correlation - (-20.0_f64 / 30.0).exp()).abs() < 0.03);
    }

    #[test]
    fn ten_knots_at_400_feet_make_light_turbulence() {
        let t = Turbulence::low_altitude(feet(400.0), knots(10.0));
        // u20 = 10 kt * (20/400)^0.3 = 4.07 kt; sigma_w a tenth of that.
        assert!((t.intensity.z - knots(0.407)).abs() < 1e-3, "{t:?}");
        assert!(
            (t.intensity.x / t.intensity.z - 1.313).abs() < 2e-3,
            "{t:?}"
        );
        assert!((t.scale.x - feet(905.0)).abs() < 2.0, "{t:?}");
        assert!((t.scale.z - feet(400.0)).abs() < 1e-9);
    }

    #[test]
    fn calm_air_is_not_quite_still() {
        let t = Turbulence::low_altitude(feet(400.0), 0.0);
        assert_eq!(t.intensity.z, 0.1);
    }
}
