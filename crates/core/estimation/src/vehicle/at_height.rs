//! A vehicle whose height is estimated as well.

use nalgebra::{SMatrix, SVector, Vector2};

use super::{AnyVehicle, ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

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
#[derive(Clone)]
pub struct AtHeight<const M: usize> {
    vehicle: AnyVehicle<M>,
    height: HeightModel,
}

impl<const M: usize> AtHeight<M> {
    /// `vehicle` with a height.
    pub fn new(vehicle: AnyVehicle<M>, height: HeightModel) -> Self {
        Self { vehicle, height }
    }

    /// State of the vehicle alone.
    fn own<const N: usize>(state: &SVector<f64, N>) -> SVector<f64, M> {
        SVector::from_fn(|i, _| state[i])
    }
}

/// The model of `$n` states over a vehicle of `$m`, two fewer: sums of sizes cannot be written as types.
macro_rules! at_height {
    ($($m:literal + 2 = $n:literal),+) => {
        $(impl VehicleModel<$n> for AtHeight<$m> {
            fn propagate(
                &self,
                state: &SVector<f64, $n>,
                input: &ControlInput,
                dt: f64,
            ) -> SVector<f64, $n> {
                let moved = self.vehicle.propagate(&Self::own(state), input, dt);
                SVector::from_fn(|i, _| if i < $m { moved[i] } else { state[i] })
            }

            fn process_noise(
                &self,
                state: &SVector<f64, $n>,
                input: &ControlInput,
                dt: f64,
            ) -> SMatrix<f64, $n, $n> {
                let mut noise = SMatrix::<f64, $n, $n>::zeros();
                noise
                    .fixed_view_mut::<$m, $m>(0, 0)
                    .copy_from(&self.vehicle.process_noise(&Self::own(state), input, dt));
                noise[($m, $m)] = self.height.climb_noise_density.powi(2) * dt;
                noise[($m + 1, $m + 1)] = self.height.bias_noise_density.powi(2) * dt;
                noise
            }

            fn noise_of_belief(
                &self,
                belief: &Gaussian<$n>,
                input: &ControlInput,
                dt: f64,
            ) -> SMatrix<f64, $n, $n> {
                let own = Gaussian::new(
                    Self::own(&belief.mean),
                    belief.covariance.fixed_view::<$m, $m>(0, 0).into_owned(),
                );
                let mut noise = self.process_noise(&belief.mean, input, dt);
                noise
                    .fixed_view_mut::<$m, $m>(0, 0)
                    .copy_from(&self.vehicle.noise_of_belief(&own, input, dt));
                noise
            }

            fn ground_velocity(
                &self,
                state: &SVector<f64, $n>,
                input: &ControlInput,
            ) -> Option<Vector2<f64>> {
                self.vehicle.ground_velocity(&Self::own(state), input)
            }

            fn layout(&self) -> [StateComponent; $n] {
                let own = self.vehicle.layout();
                std::array::from_fn(|i| match i {
                    $m => StateComponent::Height,
                    i if i > $m => StateComponent::BarometerBias,
                    i => own[i],
                })
            }

            fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<$n> {
                let own = self.vehicle.prior(position, position_deviation);
                let mut prior = Gaussian::<$n>::new(SVector::zeros(), SMatrix::zeros());
                prior.mean.fixed_rows_mut::<$m>(0).copy_from(&own.mean);
                prior.covariance.fixed_view_mut::<$m, $m>(0, 0).copy_from(&own.covariance);
                prior.covariance[($m, $m)] = self.height.start_deviation.powi(2);
                prior.covariance[($m + 1, $m + 1)] = self.height.start_bias_deviation.powi(2);
                prior
            }
        })+
    };
}

at_height!(2 + 2 = 4, 4 + 2 = 6, 6 + 2 = 8, 8 + 2 = 10);

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::Vector1;

    use super::*;
    use crate::filter::{Ukf, UnscentedSettings};
    use crate::vehicle::ConstantVelocity;

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
