//! Motion of a vehicle as measurement models see it.

use nalgebra::{SVector, Vector2};

use super::{ControlInput, StateComponent, VehicleModel};
use pilotage_base::frames::{Attitude, GroundPoint};

/// Motion of a vehicle in one state, as far as its model knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// Position, metres north and east of the world's origin.
    pub position: GroundPoint,
    /// Place at which the map shows what is at the position: beside it where the map's error is known.
    pub on_map: GroundPoint,
    /// Velocity over ground, m/s north and east; `None` where nobody asked for it or the model knows none.
    pub velocity: Option<Vector2<f64>>,
    /// Attitude as the camera has it: the biases of heading, roll and pitch, which are those of its pictures, taken out.
    pub attitude: Attitude,
    /// Heading, reading minus truth, radians; `None` where the model takes the reading for the truth.
    pub heading_bias: Option<f64>,
    /// Roll and pitch, reading minus truth, radians; `None` where the model takes the readings for the truth.
    pub tilt_bias: Option<[f64; 2]>,
    /// Height above the ground plane, metres; `None` where the model has none.
    pub height: Option<f64>,
    /// Height by air pressure, reading minus truth, metres; `None` where the model has none.
    pub barometer_bias: Option<f64>,
}

/// Part of the kinematics at which a measurement model looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KinematicsPart {
    /// Position and heading.
    Pose,
    /// Velocity, too.
    Motion,
}

/// Places in the state of what kinematics are read from, looked up once for all states of a model.
#[derive(Clone, Copy, Debug)]
pub struct KinematicsReader {
    position: [usize; 2],
    heading_bias: Option<usize>,
    /// The first of the two components of the tilt's bias.
    tilt_bias: Option<usize>,
    height: Option<usize>,
    barometer_bias: Option<usize>,
    /// The first of the map's two components.
    map_error: Option<usize>,
}

impl KinematicsReader {
    /// Reader of states of this layout; a layout without a position has it first.
    pub fn of(layout: &[StateComponent]) -> Self {
        let north = StateComponent::PositionNorth.index_in(layout).unwrap_or(0);
        Self {
            position: [north, north + 1],
            heading_bias: StateComponent::HeadingBias.index_in(layout),
            tilt_bias: StateComponent::RollBias.index_in(layout),
            height: StateComponent::Height.index_in(layout),
            barometer_bias: StateComponent::BarometerBias.index_in(layout),
            map_error: StateComponent::MapErrorNorth.index_in(layout),
        }
    }

    /// Components on which position, place on the map, attitude and height depend.
    pub fn pose_components(&self) -> impl Iterator<Item = usize> {
        let of_map = self.map_error.into_iter().flat_map(|i| [i, i + 1]);
        let of_height = self.height.into_iter().chain(self.barometer_bias);
        let of_tilt = self.tilt_bias.into_iter().flat_map(|i| [i, i + 1]);
        let own = self.position.into_iter().chain(self.heading_bias);
        own.chain(of_tilt).chain(of_map).chain(of_height)
    }

    /// Bias of the heading in `state`, radians.
    pub fn heading_bias<const N: usize>(&self, state: &SVector<f64, N>) -> Option<f64> {
        self.heading_bias.map(|i| state[i])
    }

    /// Kinematics of a vehicle in `state` with these readings; its position is that in the state `then`, which may be
    /// an earlier one.
    #[inline]
    pub fn read<const N: usize>(
        &self,
        model: &impl VehicleModel<N>,
        part: KinematicsPart,
        (state, then): (&SVector<f64, N>, &SVector<f64, N>),
        input: &ControlInput,
    ) -> Kinematics {
        let [north, east] = self.position;
        let position = GroundPoint::new(then[north], then[east]);
        let heading_bias = self.heading_bias(state);
        let tilt_bias = self.tilt_bias.map(|i| [state[i], state[i + 1]]);
        let [roll_bias, pitch_bias] = tilt_bias.unwrap_or_default();
        Kinematics {
            position,
            on_map: match self.map_error {
                None => position,
                Some(i) => {
                    GroundPoint::new(position.north + state[i], position.east + state[i + 1])
                }
            },
            velocity: match part {
                KinematicsPart::Pose => None,
                KinematicsPart::Motion => model.ground_velocity(state, input),
            },
            attitude: Attitude {
                roll: input.attitude.roll - roll_bias,
                pitch: input.attitude.pitch - pitch_bias,
                yaw: input.attitude.yaw - heading_bias.unwrap_or(0.0),
            },
            heading_bias,
            tilt_bias,
            height: self.height.map(|i| state[i]),
            barometer_bias: self.barometer_bias.map(|i| state[i]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vehicle::{VehicleVisitor, all_vehicles};

    /// Velocity over ground of a model with its prior mean and a wind, and that which its process model flies.
    struct Velocities(ControlInput);

    impl VehicleVisitor for Velocities {
        type Output = Option<(Vector2<f64>, Vector2<f64>)>;

        fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) -> Self::Output {
            const INSTANT: f64 = 1e-6;
            let mut state = model.prior(GroundPoint::new(5.0, -7.0), 3.0).mean;
            for i in 2..N {
                state[i] += 0.1 * i as f64;
            }
            let reader = KinematicsReader::of(&model.layout());
            let read = reader.read(&model, KinematicsPart::Motion, (&state, &state), &self.0);
            assert_eq!(read.position, GroundPoint::new(5.0, -7.0));
            let next = model.propagate(&state, &self.0, INSTANT);
            let flown = Vector2::new(next[0] - state[0], next[1] - state[1]) / INSTANT;
            Some((read.velocity?, flown))
        }
    }

    #[test]
    fn the_velocity_over_ground_of_every_model_is_that_with_which_its_position_moves() {
        let attitude = Attitude {
            roll: 0.2,
            pitch: -0.1,
            yaw: 0.7,
        };
        let measured = Some(Vector2::new(3.0, -1.0));
        for airspeed in [Some(17.0), None] {
            let input = ControlInput {
                airspeed,
                attitude,
                ground_velocity: measured,
                ..ControlInput::default()
            };
            let mut told = 0;
            for vehicle in all_vehicles() {
                if let Some((read, flown)) = vehicle.visit(Velocities(input)) {
                    assert!(
                        (read - flown).norm() < 1e-4,
                        "{}: {read} {flown}",
                        vehicle.key()
                    );
                    told += 1;
                }
            }
            assert_eq!(told, all_vehicles().len() - 1, "all but the random walk");
        }
    }
}
