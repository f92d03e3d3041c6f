//! A vehicle with two states more, that neither move it nor are moved by it.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector, Vector2};

use super::{AnyVehicle, ControlInput, StateComponent, VehicleModel};
use crate::filter::Gaussian;
use pilotage_base::frames::GroundPoint;

/// Change of two states over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairChange {
    /// Share of their values that is left.
    pub left: f64,
    /// Variances that are added.
    pub added: [f64; 2],
}

/// Two states that go with a vehicle, and what is known of them.
pub trait StatePair: Clone + Send + Sync + 'static {
    /// Names of the two.
    const COMPONENTS: [StateComponent; 2];

    /// Their change over `dt` seconds, in which the vehicle flies so far over ground as `way` says, metres; `None` where its
    /// model knows no velocity.
    fn change(&self, way: impl FnOnce() -> Option<f64>, dt: f64) -> PairChange;

    /// Their variances at the start.
    fn prior_variances(&self) -> [f64; 2];
}

/// A vehicle of `M` states with a pair of others. State: that of the vehicle, then the pair.
#[derive(Clone)]
pub struct Extended<const M: usize, P> {
    vehicle: AnyVehicle<M>,
    pair: P,
}

impl<const M: usize, P: StatePair> Extended<M, P> {
    /// `vehicle` with the states of `pair`.
    pub fn new(vehicle: AnyVehicle<M>, pair: P) -> Self {
        Self { vehicle, pair }
    }

    /// State of the vehicle alone.
    fn own<const N: usize>(state: &SVector<f64, N>) -> SVector<f64, M> {
        SVector::from_fn(|i, _| state[i])
    }

    /// Variances that are added to the pair over a step from `own`.
    fn added(&self, own: &SVector<f64, M>, input: &ControlInput, dt: f64) -> [f64; 2] {
        self.change(own, input, || self.vehicle.propagate(own, input, dt), dt)
            .added
    }

    /// Change of the pair while the vehicle moves from `from` to what `to` says.
    fn change(
        &self,
        from: &SVector<f64, M>,
        input: &ControlInput,
        to: impl FnOnce() -> SVector<f64, M>,
        dt: f64,
    ) -> PairChange {
        let way = || {
            self.vehicle.ground_velocity(from, input)?;
            let to = to();
            Some(Vector2::new(to[0] - from[0], to[1] - from[1]).norm())
        };
        self.pair.change(way, dt)
    }
}

/// Covariance of a vehicle with that of a pair that has nothing in common with it; `N` is `M` + 2.
fn beside<const M: usize, const N: usize>(
    vehicle: &SMatrix<f64, M, M>,
    [first, second]: [f64; 2],
) -> SMatrix<f64, N, N> {
    let mut all = SMatrix::<f64, N, N>::zeros();
    all.fixed_view_mut::<M, M>(0, 0).copy_from(vehicle);
    all[(M, M)] = first;
    all[(M + 1, M + 1)] = second;
    all
}

/// The model of `$n` states over a vehicle of `$m`, two fewer: sums of sizes cannot be written as types.
macro_rules! extended {
    ($($m:literal + 2 = $n:literal),+) => {
        $(impl<P: StatePair> VehicleModel<$n> for Extended<$m, P> {
            fn propagate(
                &self,
                state: &SVector<f64, $n>,
                input: &ControlInput,
                dt: f64,
            ) -> SVector<f64, $n> {
                let own = Self::own(state);
                let moved = self.vehicle.propagate(&own, input, dt);
                let left = self.change(&own, input, || moved, dt).left;
                SVector::from_fn(|i, _| if i < $m { moved[i] } else { left * state[i] })
            }

            fn process_noise(
                &self,
                state: &SVector<f64, $n>,
                input: &ControlInput,
                dt: f64,
            ) -> SMatrix<f64, $n, $n> {
                let own = Self::own(state);
                let noise = self.vehicle.process_noise(&own, input, dt);
                beside(&noise, self.added(&own, input, dt))
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
                let noise = self.vehicle.noise_of_belief(&own, input, dt);
                beside(&noise, self.added(&own.mean, input, dt))
            }

            fn in_gusts(&self, deviation: f64, correlation_time: f64) -> Option<AnyVehicle<$n>> {
                let vehicle = self.vehicle.in_gusts(deviation, correlation_time)?;
                Some(Arc::new(Self::new(vehicle, self.pair.clone())))
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
                std::array::from_fn(|i| if i < $m { own[i] } else { P::COMPONENTS[i - $m] })
            }

            fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<$n> {
                let own = self.vehicle.prior(position, position_deviation);
                let mut mean = SVector::<f64, $n>::zeros();
                mean.fixed_rows_mut::<$m>(0).copy_from(&own.mean);
                Gaussian::new(mean, beside(&own.covariance, self.pair.prior_variances()))
            }
        })+
    };
}

extended!(2 + 2 = 4, 4 + 2 = 6, 6 + 2 = 8, 8 + 2 = 10);
