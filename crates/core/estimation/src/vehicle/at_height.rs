//! A vehicle whose height is estimated as well.

use super::StateComponent;
use super::extended::{Extended, PairChange, StatePair};

/// Height of a vehicle and the barometer that it has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightModel {
    /// Standard deviation of the height at the start, of which nothing is known, metres.
    pub start_deviation: f64,
    /// Random walk of the height, m/√s: climbs and sinks that nobody foresees.
    pub climb_noise_density: f64,
    /// Standard deviation of the barometer's bias at the start, metres.
    pub start_bias_deviation: f64,
    /// Random walk of that bias, m/√s: weather and temperature.
    pub bias_noise_density: f64,
}

impl Default for HeightModel {
    fn default() -> Self {
        Self {
            start_deviation: 2000.0,
            climb_noise_density: 1.0,
            start_bias_deviation: 500.0,
            bias_noise_density: 0.02,
        }
    }
}

/// A vehicle of `M` states whose height is estimated. State: that of the vehicle, then its height above the ground plane
/// and the bias of its barometer, metres: random walks both.
///
/// A barometer tells the sum of the two, so that it takes something that measures the height itself, such as the range to
/// the ground, to tell them apart; from then on the barometer holds the height.
pub type AtHeight<const M: usize> = Extended<M, HeightModel>;

impl StatePair for HeightModel {
    const COMPONENTS: [StateComponent; 2] = [StateComponent::Height, StateComponent::BarometerBias];

    fn change(&self, _way: impl FnOnce() -> Option<f64>, dt: f64) -> PairChange {
        PairChange {
            left: 1.0,
            added: [
                self.climb_noise_density.powi(2) * dt,
                self.bias_noise_density.powi(2) * dt,
            ],
        }
    }

    fn prior_variances(&self) -> [f64; 2] {
        [self.start_deviation, self.start_bias_deviation].map(|deviation| deviation.powi(2))
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::{SVector, Vector1};
    use pilotage_base::frames::GroundPoint;

    use super::*;
    use crate::filter::{Ukf, UnscentedSettings};
    use crate::vehicle::{ConstantVelocity, ControlInput, VehicleModel as _};

    #[test]
    fn a_range_to_the_ground_tells_the_bias_of_a_barometer_which_then_holds_the_height() {
        let model = AtHeight::<4>::new(
            Arc::new(ConstantVelocity::default()),
            HeightModel::default(),
        );
        let prior = model.prior(GroundPoint::new(0.0, 0.0), 3.0);
        let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
        let (noise, input) = (nalgebra::Matrix1::new(0.25), ControlInput::default());
        for second in 0..60 {
            let of_motion = model.process_noise(&filter.state().mean, &input, 1.0);
            filter
                .predict(|x| model.propagate(x, &input, 1.0), &of_motion)
                .unwrap();
            let barometer = |x: &SVector<f64, 6>| Some(Vector1::new(x[4] + x[5]));
            let expected = filter.predict_measurement(barometer, &noise).unwrap();
            filter.correct(&expected, &Vector1::new(430.0)).unwrap();
            let deviation = filter.state().covariance[(4, 4)].sqrt();
            assert!(
                second > 0 || deviation > 400.0,
                "a sum tells neither: {deviation}"
            );
            if second == 0 {
                let range = |x: &SVector<f64, 6>| Some(Vector1::new(x[4]));
                let expected = filter.predict_measurement(range, &noise).unwrap();
                filter.correct(&expected, &Vector1::new(120.0)).unwrap();
            }
        }
        let state = filter.state();
        assert!((state.mean[4] - 120.0).abs() < 0.5, "{}", state.mean);
        assert!((state.mean[5] - 310.0).abs() < 0.5, "{}", state.mean);
        assert!(state.covariance[(4, 4)].sqrt() < 1.0);
    }
}
