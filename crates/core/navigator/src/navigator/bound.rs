//! The posterior Cramér-Rao bound of a run: the same geometry, the same detections, the true noise.

use nalgebra::{Dyn, Matrix4, OVector, SVector};

use super::engine::vehicle;
use super::expected::{Anchor, AppearanceModel, appearances};
use super::inputs::Inputs;
use super::{Run, StepReport};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{CramerRao, FilterError, numerical_jacobian};
use pilotage_estimation::vehicle::{StateComponent, VehicleModel, VehicleVisitor};
use pilotage_flight::Flight;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_vision::geometry::joint_noise;

/// Root mean square over the run of the bound on the position error, metres: no estimator that gets
/// the same detections can do better.
///
/// `true_noise` describes the real process and sensors; the noise of the detections is what the
/// detector reported. `None` where the truth is not known, and where aids beside landmarks corrected the run, which are
/// not in it.
pub fn position_bound(
    flight: &Flight,
    run: &Run,
    true_noise: &NavigatorSettings,
) -> Option<Result<f64, FilterError>> {
    flight.truth.as_ref().filter(|t| !t.states.is_empty())?;
    run.settings.aids.is_empty().then_some(())?;
    Some(vehicle(true_noise).visit(Bound {
        flight,
        run,
        true_noise,
    }))
}

struct Bound<'a> {
    flight: &'a Flight,
    run: &'a Run,
    true_noise: &'a NavigatorSettings,
}

impl VehicleVisitor for Bound<'_> {
    type Output = Result<f64, FilterError>;

    fn visit<const N: usize, V>(self, model: V) -> Self::Output
    where
        V: VehicleModel<N> + Clone + Send + Sync + 'static,
    {
        let start = self.flight.start;
        let deviation = start.standard_deviation;
        let prior = model.prior(start.position, deviation);
        let mut bound = CramerRao::from_prior(&prior.covariance)?;
        let inputs = Inputs::of(self.flight);
        let (mut sum, mut count) = (0.0, 0_usize);
        for step in &self.run.steps {
            let Some(truth) = self
                .flight
                .truth
                .as_ref()
                .and_then(|t| t.position(step.time))
            else {
                continue;
            };
            let mut state = SVector::<f64, N>::zeros();
            state[0] = truth.x;
            state[1] = truth.y;
            let wind = self.flight.truth.as_ref().and_then(|t| t.wind(step.time));
            if let Some((i, wind)) = model.wind_index().zip(wind) {
                state[i] = wind.x;
                state[i + 1] = wind.y;
            }
            let input = inputs.between(self.flight, step.time - step.dt, step.time);
            let transition = numerical_jacobian(
                |x: &SVector<f64, N>| Some(model.propagate(x, &input, step.dt)),
                &state,
            )
            .ok_or(FilterError::NotFinite {
                place: "process model at the truth",
            })?;
            bound.predict(&transition, &model.process_noise(&state, &input, step.dt))?;
            self.update(&mut bound, &model, step, &state)?;
            sum += bound.position_covariance()?.trace();
            count += 1;
        }
        Ok((sum / count.max(1) as f64).sqrt())
    }
}

impl Bound<'_> {
    /// Adds the information of the landmarks that the run accepted in this step.
    fn update<const N: usize, V: VehicleModel<N>>(
        &self,
        bound: &mut CramerRao<N>,
        model: &V,
        step: &StepReport,
        state: &SVector<f64, N>,
    ) -> Result<(), FilterError> {
        let Some(frame) = &step.frame else {
            return Ok(());
        };
        let camera = self.flight.camera_of_frame(frame.index);
        let appearance = AppearanceModel {
            camera: &camera,
            attitude: Attitude {
                roll: step.control.roll,
                pitch: step.control.pitch,
                yaw: step.control.heading,
            },
            camera_down: self.flight.ground_down - step.control.height,
            ground_down: self.flight.ground_down,
        };
        let pose = appearance.pose(GroundPoint::new(state[0], state[1]), 0.0);
        let mut places: Vec<(GroundPoint, Anchor)> = Vec::new();
        let (mut own, mut jacobians): (Vec<Matrix4<f64>>, Vec<Matrix4<f64>>) = (vec![], vec![]);
        for candidate in frame.accepted() {
            let Some(landmark) = self
                .run
                .landmarks
                .iter()
                .find(|l| l.id == candidate.landmark)
            else {
                continue;
            };
            let point = landmark.reference_in_world(self.flight.ground_down);
            let seen = camera.project(&pose, &point);
            let anchor = seen.and_then(|at| Anchor::at(&camera, &pose, &at, point.z));
            let seen = anchor.and_then(|a| Some((a, a.pose_jacobian(&camera, &pose, &point)?)));
            if let Some(((anchor, jacobian), covariance)) =
                seen.zip(candidate.measurement_covariance)
            {
                places.push((landmark.reference, anchor));
                jacobians.push(jacobian);
                own.push(covariance);
            }
        }
        if places.is_empty() {
            return Ok(());
        }
        let bias = model.index_of(StateComponent::HeadingBias);
        let slope = numerical_jacobian::<N, Dyn>(
            |x| -> Option<OVector<f64, Dyn>> {
                let position = GroundPoint::new(x[0], x[1]);
                let bias = bias.map_or(0.0, |i| x[i]);
                Some(appearances(
                    &appearance.attitude,
                    &places,
                    &pose,
                    position,
                    bias,
                ))
            },
            state,
        );
        let Some(slope) = slope else { return Ok(()) };
        let noise = joint_noise(
            &own,
            &jacobians,
            &self.true_noise.sensors.pose_covariance(),
            1.0,
        );
        bound.update(&slope, &noise)
    }
}
