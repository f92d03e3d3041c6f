//! The filter's covariance along a planned flight, in many worlds at once.

use nalgebra::{DMatrix, Matrix2, Matrix4, SMatrix, SVector, Vector3};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::prediction::{PredictionError, PredictionRequest};
use super::view::{Look, PlannedFrame};
use crate::filter::numerical_jacobian;
use crate::flight::TruthState;
use crate::frames::{GroundPoint, Pose};
use crate::navigator::geometry::{COMPONENTS, joint_noise, pose_covariance};
use crate::simulate::TrueFlight;
use crate::vehicle::{ControlInput, VehicleModel, VehicleVisitor};

/// Longest step of the covariance, seconds.
const LONGEST_STEP: f64 = 0.5;

/// What the worlds have come to at one frame of the plan.
pub(super) struct Moment {
    /// Index of the state of the flight.
    pub state: usize,
    /// Position covariance of each world after the frame.
    pub covariances: Vec<Matrix2<f64>>,
    /// For each landmark the share of the worlds in which it was found in this frame.
    pub found: Vec<f64>,
    /// Share of the worlds in which any was found.
    pub any: f64,
}

/// Propagates every world along the planned flight.
pub(super) struct Propagation<'a> {
    pub request: &'a PredictionRequest<'a>,
    pub flight: &'a TrueFlight,
}

impl VehicleVisitor for Propagation<'_> {
    type Output = Result<Vec<Moment>, PredictionError>;

    fn visit<const N: usize, V>(self, model: V) -> Self::Output
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static,
    {
        let request = self.request;
        let plan = request.plan;
        let states = &self.flight.states;
        let first = states.first().ok_or(PredictionError::NoRoute)?;
        let start = GroundPoint::new(first.position.x, first.position.y);
        let prior = model
            .prior(start, request.settings.start.position)
            .covariance;
        let bias = model
            .state_names()
            .iter()
            .position(|n| *n == "heading bias");
        let mut random = ChaCha8Rng::seed_from_u64(request.seed);
        let mut worlds: Vec<World<N>> = (0..request.worlds.max(1))
            .map(|_| World {
                covariance: prior,
                recognised: request.landmarks.iter().map(|_| random.random()).collect(),
            })
            .collect();
        let pose_noise = pose_covariance(&request.settings.sensors);
        let period = 1.0 / plan.sensors.frame_rate;
        let mut next_frame = first.time;
        let mut time = first.time;
        let mut moments = Vec::new();
        for (index, state) in states.iter().enumerate() {
            let is_frame = state.time >= next_frame - 1e-6;
            let dt = state.time - time;
            let last = index + 1 == states.len();
            if !(is_frame || last || dt >= LONGEST_STEP) {
                continue;
            }
            if dt > 0.0 {
                let (transition, noise) = step(&model, state, self.flight.airspeeds[index], dt)?;
                for world in &mut worlds {
                    world.covariance =
                        transition * world.covariance * transition.transpose() + noise;
                }
                time = state.time;
            }
            if !is_frame {
                continue;
            }
            next_frame += period;
            let frame = PlannedFrame {
                camera: &plan.camera,
                pose: Pose {
                    position_in_world: state.position,
                    attitude: state.attitude.unwrap_or_default(),
                },
                ground_down: plan.ground_down,
            };
            let looks: Vec<Look> = request
                .landmarks
                .iter()
                .enumerate()
                .filter_map(|(i, l)| frame.look(i, l, &request.settings.sensors))
                .collect();
            let mut found = vec![0.0; request.landmarks.len()];
            let mut any = 0.0;
            let share = 1.0 / worlds.len() as f64;
            for world in worlds.iter_mut().filter(|_| !looks.is_empty()) {
                let shake = self.shake(&mut random);
                let seen: Vec<&Look> = looks
                    .iter()
                    .filter(|look| {
                        let chance: f64 = random.random();
                        world.recognised[look.landmark] < look.recognised
                            && chance < look.per_frame
                            && frame.holds(&request.landmarks[look.landmark], &shake)
                    })
                    .collect();
                for look in &seen {
                    found[look.landmark] += share;
                }
                if !seen.is_empty() {
                    any += share;
                    world.correct(&seen, bias, &pose_noise)?;
                }
            }
            moments.push(Moment {
                state: index,
                covariances: worlds.iter().map(World::position).collect(),
                found,
                any,
            });
        }
        Ok(moments)
    }
}

impl Propagation<'_> {
    /// Error of the camera's attitude in one frame of one world (roll, pitch, yaw), radians.
    fn shake(&self, random: &mut impl Rng) -> Vector3<f64> {
        let sensors = &self.request.settings.sensors;
        Vector3::new(sensors.roll, sensors.pitch, sensors.yaw).map(|deviation| {
            let z: f64 = StandardNormal.sample(random);
            deviation * z
        })
    }
}

/// Transition and process noise over a step of the plan that ends in `state`.
fn step<const N: usize, V: VehicleModel<N>>(
    model: &V,
    state: &TruthState,
    airspeed: f64,
    dt: f64,
) -> Result<(SMatrix<f64, N, N>, SMatrix<f64, N, N>), PredictionError> {
    let input = ControlInput::new(airspeed, state.attitude.unwrap_or_default());
    let mut place = SVector::<f64, N>::zeros();
    place[0] = state.position.x;
    place[1] = state.position.y;
    if let Some((i, wind)) = model.wind_index().zip(state.wind) {
        place[i] = wind.x;
        place[i + 1] = wind.y;
    }
    let transition = numerical_jacobian(
        |x: &SVector<f64, N>| Some(model.propagate(x, &input, dt)),
        &place,
    )
    .ok_or(PredictionError::NotFinite { time: state.time })?;
    Ok((transition, model.process_noise(&place, &input, dt)))
}

/// One way in which the flight may turn out.
struct World<const N: usize> {
    covariance: SMatrix<f64, N, N>,
    /// For each landmark a number from 0 to 1: it can be recognised where that is more probable.
    recognised: Vec<f64>,
}

impl<const N: usize> World<N> {
    fn position(&self) -> Matrix2<f64> {
        Matrix2::from_fn(|i, j| self.covariance[(i, j)])
    }

    /// Corrects with the landmarks that were seen, in Joseph's form, which stays positive.
    fn correct(
        &mut self,
        seen: &[&Look],
        bias: Option<usize>,
        pose_noise: &Matrix4<f64>,
    ) -> Result<(), PredictionError> {
        let rows = COMPONENTS * seen.len();
        let mut slope = DMatrix::zeros(rows, N);
        for (i, look) in seen.iter().enumerate() {
            for row in 0..COMPONENTS {
                let to = COMPONENTS * i + row;
                slope[(to, 0)] = look.slope[(row, 0)];
                slope[(to, 1)] = look.slope[(row, 1)];
                if let Some(bias) = bias {
                    slope[(to, bias)] = look.slope[(row, 2)];
                }
            }
        }
        let own: Vec<Matrix4<f64>> = seen.iter().map(|l| l.covariance).collect();
        let jacobians: Vec<Matrix4<f64>> = seen.iter().map(|l| l.pose_jacobian).collect();
        let noise = joint_noise(&own, &jacobians, pose_noise, 1.0);
        let before = DMatrix::from_fn(N, N, |i, j| self.covariance[(i, j)]);
        let cross = &before * slope.transpose();
        let innovation = &slope * &cross + &noise;
        let root = innovation
            .cholesky()
            .ok_or(PredictionError::NotFinite { time: f64::NAN })?;
        let gain = root.solve(&cross.transpose()).transpose();
        let kept = DMatrix::identity(N, N) - &gain * slope;
        let after = &kept * before * kept.transpose() + &gain * noise * gain.transpose();
        self.covariance = SMatrix::from_fn(|i, j| 0.5 * (after[(i, j)] + after[(j, i)]));
        Ok(())
    }
}
