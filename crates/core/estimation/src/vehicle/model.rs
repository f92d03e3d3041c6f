//! Interface of a vehicle to the filter.

use std::sync::Arc;

use nalgebra::{DVector, SMatrix, SVector, Vector2};
use serde::{Deserialize, Serialize};

use super::StateComponent;
use crate::filter::{Gaussian, partial_jacobian};
use pilotage_base::frames::{Attitude, GroundPoint};

/// Readings of the vehicle's own instruments at a moment; DeAngelo 2016, eqs 26 and 50, and the attitude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ControlInput {
    /// True airspeed, m/s, where it is measured.
    pub airspeed: Option<f64>,
    /// Attitude; its yaw is the heading, radians clockwise from north.
    pub attitude: Attitude,
    /// Rate of the heading, rad/s clockwise, even over the step.
    pub turn_rate: f64,
    /// Velocity over ground, m/s north and east, where something other than satellites measures it:
    /// motion capture, optical flow.
    pub ground_velocity: Option<Vector2<f64>>,
    /// Standard deviation of the heading while it is not read but held from earlier, radians; 0 where it is
    /// read.
    pub heading_deviation: f64,
    /// Time since a heading was read, seconds, while it is held.
    pub heading_held: f64,
    /// Standard deviation of roll and pitch, each, while they are not read but taken to be what they are usually,
    /// radians; 0 where they are read.
    pub tilt_deviation: f64,
}

impl ControlInput {
    /// Airspeed in m/s and attitude.
    ///
    /// ```
    /// use nalgebra::Vector4;
    /// use pilotage_base::frames::Attitude;
    /// use pilotage_estimation::vehicle::{AirplaneWind, ControlInput, VehicleModel};
    ///
    /// // 20 m/s towards the east in air that moves north by 5 m/s, for ten seconds.
    /// let input = ControlInput::new(20.0, Attitude::level(90_f64.to_radians()));
    /// let state = Vector4::new(0.0, 0.0, 5.0, 0.0);
    /// let later = AirplaneWind::default().propagate(&state, &input, 10.0);
    /// assert!((later - Vector4::new(50.0, 200.0, 5.0, 0.0)).norm() < 1e-9);
    /// ```
    pub fn new(airspeed: f64, attitude: Attitude) -> Self {
        Self {
            airspeed: Some(airspeed),
            attitude,
            ..Self::default()
        }
    }

    /// Attitude of a vehicle whose airspeed nobody measures.
    pub fn without_airspeed(attitude: Attitude) -> Self {
        Self {
            attitude,
            ..Self::default()
        }
    }

    /// Heading, radians clockwise from north.
    pub fn heading(&self) -> f64 {
        self.attitude.yaw
    }
}

/// A vehicle model of any kind with `N` states: a filter of it is compiled once for every size, not for every model.
pub type AnyVehicle<const N: usize> = Arc<dyn VehicleModel<N> + Send + Sync>;

/// Motion of a vehicle: a process model over `N` state components.
///
/// Every layout begins with the position, north and east, so that the marginal of a belief over its first two
/// components is that of the position.
pub trait VehicleModel<const N: usize> {
    /// The state `dt` seconds later if nothing unexpected happens.
    fn propagate(&self, state: &SVector<f64, N>, input: &ControlInput, dt: f64) -> SVector<f64, N>;

    /// Slope of [`Self::propagate`] with the state, N × N: for filters that need one.
    ///
    /// By differences where a model has no formula of its own, exact to about 1e-11 of the entries.
    fn transition(
        &self,
        state: &SVector<f64, N>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, N, N> {
        let moved = |x: &SVector<f64, N>| {
            let moved = self.propagate(x, input, dt);
            Some(DVector::from_column_slice(moved.as_slice()))
        };
        let all: [usize; N] = std::array::from_fn(|i| i);
        partial_jacobian(moved, state, &all)
            .map_or_else(SMatrix::zeros, |j| SMatrix::from_fn(|i, k| j[(i, k)]))
    }

    /// Covariance of what unexpected things add to the state in `dt` seconds.
    fn process_noise(
        &self,
        state: &SVector<f64, N>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, N, N>;

    /// The same for a state that is only believed: the mean over all states of `belief`.
    ///
    /// Where the noise depends on the square of a component, that of a component nobody knows is not
    /// the one at its mean.
    fn noise_of_belief(
        &self,
        belief: &Gaussian<N>,
        input: &ControlInput,
        dt: f64,
    ) -> SMatrix<f64, N, N> {
        self.process_noise(&belief.mean, input, dt)
    }

    /// Components of the state, in their order.
    fn layout(&self) -> [StateComponent; N];

    /// Belief at the start: the position as given, with standard deviation `position_deviation`
    /// (metres) on each axis, and everything else as the model's settings say.
    fn prior(&self, position: GroundPoint, position_deviation: f64) -> Gaussian<N>;

    /// Index of a component in the state; `None` where the model has none.
    fn index_of(&self, component: StateComponent) -> Option<usize> {
        component.index_in(&self.layout())
    }

    /// Index of the wind's north component, its east component follows; `None` without wind.
    fn wind_index(&self) -> Option<usize> {
        self.index_of(StateComponent::WindNorth)
    }

    /// The same vehicle in gusts of `deviation` m/s per axis that fade over `correlation_time` seconds; `None` where the
    /// model knows no gusts.
    #[must_use]
    fn in_gusts(&self, deviation: f64, correlation_time: f64) -> Option<AnyVehicle<N>> {
        let _ = (deviation, correlation_time);
        None
    }

    /// The steady wind of a state: velocity of the air, m/s north and east.
    fn wind(&self, state: &SVector<f64, N>) -> Option<Vector2<f64>> {
        self.wind_index()
            .map(|i| Vector2::new(state[i], state[i + 1]))
    }

    /// Velocity over ground in a state with these readings, m/s north and east: that with which
    /// [`Self::propagate`] begins to move the position; `None` where the model knows none.
    fn ground_velocity(
        &self,
        state: &SVector<f64, N>,
        input: &ControlInput,
    ) -> Option<Vector2<f64>> {
        let _ = (state, input);
        None
    }

    /// The position of a state.
    fn position(&self, state: &SVector<f64, N>) -> GroundPoint {
        GroundPoint::new(state[0], state[1])
    }
}
