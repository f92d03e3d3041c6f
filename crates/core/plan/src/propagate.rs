//! The filter's covariance along a planned flight, in many worlds at once.

use std::sync::Arc;

use nalgebra::{Matrix2, Matrix5, SMatrix, SVector, Vector2, Vector3};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

use super::corridor::WorldError;
use super::draws::PredictionDraws;
use super::request::{PredictionError, PredictionRequest};
use super::view::{Information, PlannedFrame, PlannedLook, seen};
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_estimation::filter::{Gaussian, numerical_jacobian};
use pilotage_estimation::vehicle::{
    AnyVehicle, ControlInput, StateComponent, VehicleModel, VehicleVisitor,
};
use pilotage_flight::TruthState;
use pilotage_mission::settings::SensorNoise;
use pilotage_navigator::navigator::{LooksAtLandmarks, PlaceOnMap, frame_noise};
use pilotage_simulate::simulate::{TrueFlight, Turbulence};

/// Longest step of the covariance, seconds.
const LONGEST_STEP: f64 = 0.5;

/// State of the worlds of one wind at one frame.
#[derive(Clone, Debug)]
pub(super) struct WorldsMoment {
    /// Index of the state of the flight in that wind.
    pub state: usize,
    /// Place of the aircraft at that frame.
    pub place: GroundPoint,
    /// Error of the position in each world after the frame: truth minus estimate.
    pub beliefs: Vec<WorldError>,
    /// For each landmark the share of the worlds in which it was found in this frame.
    pub found: Vec<f64>,
    /// Share of the worlds in which any was found.
    pub any: f64,
}

/// Propagates worlds along the flight in one wind.
pub(super) struct Propagation<'a> {
    pub request: &'a PredictionRequest<'a>,
    /// The flight as it goes in this wind.
    pub flight: &'a TrueFlight,
    /// The worlds: in each, for every landmark, a number from 0 to 1. It can be recognised where that is
    /// more probable.
    pub worlds: &'a [Vec<f64>],
    /// Seed of shakes and misses.
    pub seed: u64,
    /// Part of the wind that the filter is not told; its prior is of no wind at all.
    pub unknown_wind: Option<UnknownWind>,
}

/// A wind that nobody knows.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnknownWind {
    /// Its mean (north, east), m/s.
    pub mean: Vector2<f64>,
    /// Its covariance, m²/s²: one wind stands for those near it.
    pub covariance: Matrix2<f64>,
}

impl VehicleVisitor for Propagation<'_> {
    type Output = Result<Vec<WorldsMoment>, PredictionError>;

    fn visit<const N: usize, V>(self, model: V) -> Self::Output
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static,
    {
        let model: AnyVehicle<N> = Arc::new(model);
        self.propagate(&model)
    }
}

impl Propagation<'_> {
    /// Moments of the worlds along the flight of `model`; compiled once for every size, not for every model.
    fn propagate<const N: usize>(
        self,
        model: &AnyVehicle<N>,
    ) -> Result<Vec<WorldsMoment>, PredictionError> {
        let request = self.request;
        let plan = request.plan;
        let states = &self.flight.states;
        let first = states.first().ok_or(PredictionError::NoRoute)?;
        let seen = seen(&model.layout());
        let gusty = self.gusts_of(model);
        let vehicle = gusty.as_ref().unwrap_or(model);
        let mut draws = PredictionDraws::new(self.seed);
        let prior = self.prior((model, vehicle), first);
        let worlds = self.worlds.iter().map(|recognised| FlightWorld {
            recognised: recognised.clone(),
            ..prior.clone()
        });
        let mut worlds: Vec<FlightWorld<N>> = worlds.collect();
        let noise = frame_noise(request.settings);
        let period = 1.0 / plan.sensors.frame_rate;
        let mut next_frame = first.time;
        let (mut time, mut from) = (first.time, first.position);
        let mut moments = Vec::new();
        for (index, state) in states.iter().enumerate() {
            let is_frame = state.time >= next_frame - 1e-6;
            let dt = state.time - time;
            let last = index + 1 == states.len();
            if !(is_frame || last || dt >= LONGEST_STEP) {
                continue;
            }
            if dt > 0.0 {
                let airspeed = self.flight.airspeeds[index];
                let velocity = (state.position - from).xy() / dt;
                let step = step((model, vehicle), state, (airspeed, velocity), dt)?;
                for world in &mut worlds {
                    let believed = world.believed_noise(model, &step, dt);
                    world.predict(&step, &believed);
                }
                (time, from) = (state.time, state.position);
            }
            if !is_frame {
                continue;
            }
            next_frame += period;
            let frame = (moments.len(), &mut draws);
            let (found, any) = self.look(state, &mut worlds, &seen, &noise, frame)?;
            moments.push(WorldsMoment {
                state: index,
                place: GroundPoint::new(state.position.x, state.position.y),
                beliefs: worlds.iter().map(FlightWorld::position).collect(),
                found,
                any,
            });
        }
        Ok(moments)
    }

    /// The vehicle in the gusts that go with a wind that is not known (MIL-F-8785C), whatever the filter is told of them.
    fn gusts_of<const N: usize>(&self, model: &AnyVehicle<N>) -> Option<AnyVehicle<N>> {
        let wind = self.unknown_wind?;
        let speed = (wind.mean.norm_squared() + wind.covariance.trace()).sqrt();
        let gusts = Turbulence::low_altitude(self.request.plan.height, speed);
        model.in_gusts(gusts.intensity.x, self.request.settings.process.gust_time)
    }

    /// Belief of the filter at the start, and its error: of a wind that is known here, the error is known,
    /// too.
    fn prior<const N: usize>(
        &self,
        (model, vehicle): (&AnyVehicle<N>, &AnyVehicle<N>),
        first: &TruthState,
    ) -> FlightWorld<N> {
        let start = GroundPoint::new(first.position.x, first.position.y);
        let deviation = self.request.settings.start.position;
        let covariance = model.prior(start, deviation).covariance;
        let mut scatter = vehicle.prior(start, deviation).covariance;
        let mut error = SVector::zeros();
        if let Some((i, wind)) = model.wind_index().zip(self.unknown_wind) {
            for axis in 0..2 {
                error[i + axis] = wind.mean[axis];
                scatter.row_mut(i + axis).fill(0.0);
                scatter.column_mut(i + axis).fill(0.0);
            }
            let mut of_wind = scatter.fixed_view_mut::<2, 2>(i, i);
            of_wind.copy_from(&wind.covariance);
        }
        FlightWorld {
            covariance,
            error,
            scatter,
            recognised: Vec::new(),
            looks: LooksAtLandmarks::default(),
        }
    }

    /// Lets every world look from `state`; the share of the worlds in which each landmark is found, and
    /// of those in which any is.
    fn look<const N: usize>(
        &self,
        state: &TruthState,
        worlds: &mut [FlightWorld<N>],
        on_state: &SMatrix<f64, N, 5>,
        noise: &SensorNoise,
        (number, draws): (usize, &mut PredictionDraws),
    ) -> Result<(Vec<f64>, f64), PredictionError> {
        let request = self.request;
        let of_map = request.settings.detector.map_deviation;
        let frame = PlannedFrame {
            camera: &request.plan.camera,
            pose: Pose {
                position_in_world: state.position,
                attitude: state.attitude.unwrap_or_default(),
            },
            ground_down: request.plan.ground_down,
            noise,
            map_deviation: PlaceOnMap::of(request.settings, of_map)
                .beyond_state()
                .sqrt(),
        };
        let looks: Vec<PlannedLook> = request
            .landmarks
            .iter()
            .enumerate()
            .filter_map(|(i, l)| frame.look(i, l))
            .collect();
        let mut found = vec![0.0; request.landmarks.len()];
        let mut any = 0.0;
        let share = 1.0 / worlds.len() as f64;
        if looks.is_empty() {
            return Ok((found, any));
        }
        let pose_noise = noise.pose_covariance();
        let scale = request.settings.measurement_scale;
        for (index, world) in worlds.iter_mut().enumerate() {
            world.looks.forget(state.time);
            let mut seen: Vec<&PlannedLook> = looks
                .iter()
                .filter(|look| {
                    let id = request.landmarks[look.landmark].landmark.id;
                    world.recognised[look.landmark] < look.recognised
                        && draws.of_landmark(index, id, number).random::<f64>() < look.per_frame
                })
                .collect();
            if seen.is_empty() {
                continue;
            }
            let shake = self.shake(draws.of_all(index, number));
            seen.retain(|look| frame.holds(&request.landmarks[look.landmark], &shake));
            for look in &seen {
                found[look.landmark] += share;
            }
            if !seen.is_empty() {
                any += share;
                let id = |look: &PlannedLook| request.landmarks[look.landmark].landmark.id;
                let mut said = Information::default();
                for look in &seen {
                    let look = look.information(world.looks.next(id(look)), &pose_noise);
                    said.add(&look.ok_or(PredictionError::NotFinite { time: state.time })?);
                }
                world
                    .looks
                    .note(seen.iter().map(|look| id(look)), state.time);
                said.about_state(&pose_noise)
                    .and_then(|said| world.correct(&said, on_state, scale))
                    .ok_or(PredictionError::NotFinite { time: state.time })?;
            }
        }
        Ok((found, any))
    }

    /// Error of the camera's attitude in one frame of one world (roll, pitch, yaw), radians.
    fn shake(&self, random: &mut impl Rng) -> Vector3<f64> {
        let sensors = &self.request.settings.sensors;
        Vector3::new(sensors.roll, sensors.pitch, sensors.yaw).map(|deviation| {
            let z: f64 = StandardNormal.sample(random);
            deviation * z
        })
    }
}

/// A step of the plan: from where, how errors move, and what is truly added to them.
struct PlanStep<const N: usize> {
    state: SVector<f64, N>,
    input: ControlInput,
    transition: SMatrix<f64, N, N>,
    true_noise: SMatrix<f64, N, N>,
}

/// The step of `dt` seconds that ends in `state`, for the filter's model and the vehicle as it is, at a true airspeed, m/s,
/// and a velocity over ground, m/s north and east.
fn step<const N: usize>(
    (model, vehicle): (&AnyVehicle<N>, &AnyVehicle<N>),
    state: &TruthState,
    (airspeed, velocity): (f64, Vector2<f64>),
    dt: f64,
) -> Result<PlanStep<N>, PredictionError> {
    let input = ControlInput::new(airspeed, state.attitude.unwrap_or_default());
    let wind = state.wind.unwrap_or_default();
    let (sin, cos) = input.heading().sin_cos();
    let through_air = velocity - wind;
    let known = [
        (StateComponent::PositionNorth, state.position.x),
        (StateComponent::PositionEast, state.position.y),
        (StateComponent::VelocityNorth, velocity.x),
        (StateComponent::VelocityEast, velocity.y),
        (
            StateComponent::VelocityForward,
            cos * through_air.x + sin * through_air.y,
        ),
        (
            StateComponent::VelocityRight,
            cos * through_air.y - sin * through_air.x,
        ),
        (StateComponent::WindNorth, wind.x),
        (StateComponent::WindEast, wind.y),
    ];
    let mut place = SVector::<f64, N>::zeros();
    for (component, value) in known {
        if let Some(index) = model.index_of(component) {
            place[index] = value;
        }
    }
    let transition = numerical_jacobian(
        |x: &SVector<f64, N>| Some(model.propagate(x, &input, dt)),
        &place,
    )
    .ok_or(PredictionError::NotFinite { time: state.time })?;
    Ok(PlanStep {
        true_noise: vehicle.process_noise(&place, &input, dt),
        state: place,
        input,
        transition,
    })
}

/// World: one way in which the flight may turn out.
///
/// The filter weighs by what it is told; what it is told is not quite so. Both are carried along: the
/// covariance that the filter computes, from which its gain follows, and the mean and covariance of its
/// true error under that gain (Jazwinski 1970, 7.8; Gelb 1974, 7.2).
#[derive(Clone)]
struct FlightWorld<const N: usize> {
    /// The filter's own covariance.
    covariance: SMatrix<f64, N, N>,
    /// Mean of truth minus estimate.
    error: SVector<f64, N>,
    /// Covariance of truth minus estimate.
    scatter: SMatrix<f64, N, N>,
    /// For each landmark a number from 0 to 1: it can be recognised where that is more probable.
    recognised: Vec<f64>,
    /// Looks at landmarks so far.
    looks: LooksAtLandmarks,
}

impl<const N: usize> FlightWorld<N> {
    fn position(&self) -> WorldError {
        WorldError {
            weight: 1.0,
            mean: Vector2::new(self.error[0], self.error[1]),
            covariance: Matrix2::from_fn(|i, j| self.scatter[(i, j)]),
        }
    }

    /// Noise that the filter believes is added in the `dt` seconds of a step, on average over what it may
    /// have come to believe of the state.
    fn believed_noise(
        &self,
        model: &AnyVehicle<N>,
        step: &PlanStep<N>,
        dt: f64,
    ) -> SMatrix<f64, N, N> {
        let belief = Gaussian::new(step.state - self.error, self.covariance + self.scatter);
        model.noise_of_belief(&belief, &step.input, dt)
    }

    fn predict(&mut self, step: &PlanStep<N>, believed: &SMatrix<f64, N, N>) {
        let f = &step.transition;
        self.covariance = f * self.covariance * f.transpose() + believed;
        self.scatter = f * self.scatter * f.transpose() + step.true_noise;
        self.error = f * self.error;
    }

    /// Corrects with what was seen, in Joseph's form, which stays positive and holds for any gain.
    ///
    /// With the information `Λ = HᵀR⁻¹H` about what is `seen` of the state, `Eᵀx`, the gain is `P⁺E HᵀR⁻¹`: what is left of
    /// an error is `I - P E Λ (I + EᵀP E Λ)⁻¹ Eᵀ`, and `K R Kᵀ = P⁺E Λ EᵀP⁺`. Five rows are all that has to be inverted,
    /// however many landmarks there are. The filter takes the noise for `scale` times as much as it is.
    fn correct(
        &mut self,
        said: &Matrix5<f64>,
        seen: &SMatrix<f64, N, 5>,
        scale: f64,
    ) -> Option<()> {
        let said = said / scale;
        let before = self.covariance * seen;
        let own = seen.transpose() * before;
        let gain = before * said * (Matrix5::identity() + own * said).try_inverse()?;
        let kept = SMatrix::<f64, N, N>::identity() - gain * seen.transpose();
        let after = kept * before;
        let added = after * said * after.transpose();
        let joseph = |before: &SMatrix<f64, N, N>, added: SMatrix<f64, N, N>| {
            let after = kept * before * kept.transpose() + added;
            (after + after.transpose()) * 0.5
        };
        self.covariance = joseph(&self.covariance, added);
        self.scatter = joseph(&self.scatter, added / scale);
        self.error = kept * self.error;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix4, Matrix4x5};

    use super::*;

    const LAYOUT: [StateComponent; 6] = [
        StateComponent::PositionNorth,
        StateComponent::PositionEast,
        StateComponent::AirspeedBias,
        StateComponent::HeadingBias,
        StateComponent::RollBias,
        StateComponent::PitchBias,
    ];

    fn world() -> FlightWorld<6> {
        let root = SMatrix::<f64, 6, 6>::from_fn(|i, j| {
            let size = [5.0, 4.0, 0.5, 0.03, 0.01, 0.01][i];
            let off = 0.3 * (1.0 + 7.0 * i as f64 + 3.0 * j as f64).sin();
            size * if i == j { 1.0 } else { off }
        });
        FlightWorld {
            covariance: root * root.transpose(),
            scatter: 1.7 * root * root.transpose() + SMatrix::identity() * 1e-4,
            error: SVector::from([3.0, -2.0, 0.4, 0.05, 0.01, -0.02]),
            recognised: Vec::new(),
            looks: LooksAtLandmarks::default(),
        }
    }

    #[test]
    fn a_correction_by_information_is_that_by_the_gain() {
        let slope = Matrix4x5::from_fn(|i, j| {
            let size = if j < 2 { 5.0 } else { 40.0 };
            size * (0.4 + 5.0 * i as f64 + 11.0 * j as f64).cos()
        });
        let noise = Matrix4::from_diagonal_element(2.0);
        let scale = 3.0;
        let over_map = LAYOUT.map(|component| match component {
            StateComponent::RollBias => StateComponent::MapErrorNorth,
            StateComponent::PitchBias => StateComponent::MapErrorEast,
            other => other,
        });
        let unbiased = LAYOUT.map(|component| match component {
            StateComponent::HeadingBias => StateComponent::GustNorth,
            other => other,
        });
        for (layout, places) in [
            (LAYOUT, [Some(0), Some(1), None, Some(2), Some(3), Some(4)]),
            (
                over_map,
                [Some(0), Some(1), None, Some(2), Some(0), Some(1)],
            ),
            (unbiased, [Some(0), Some(1), None, None, Some(3), Some(4)]),
        ] {
            let mut found = world();
            let said = slope.transpose() * noise.try_inverse().unwrap() * slope;
            found.correct(&said, &seen(&layout), scale).unwrap();
            let mut h = SMatrix::<f64, 4, 6>::zeros();
            for (to, from) in places.into_iter().enumerate() {
                if let Some(from) = from {
                    h.set_column(to, &slope.column(from));
                }
            }
            let w = world();
            let innovation = h * w.covariance * h.transpose() + noise * scale;
            let gain = w.covariance * h.transpose() * innovation.try_inverse().unwrap();
            let kept = SMatrix::<f64, 6, 6>::identity() - gain * h;
            let added = gain * noise * gain.transpose();
            let covariance = kept * w.covariance * kept.transpose() + added * scale;
            let scatter = kept * w.scatter * kept.transpose() + added;
            assert!((found.covariance - covariance).norm() < 1e-9 * covariance.norm());
            assert!((found.scatter - scatter).norm() < 1e-9 * scatter.norm());
            assert!((found.error - kept * w.error).norm() < 1e-9);
        }
    }
}
