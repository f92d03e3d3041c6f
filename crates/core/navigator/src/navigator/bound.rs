//! The posterior Cramér-Rao bound of a run: the same geometry, the same detections, the true noise.

use nalgebra::{Const, Dyn, Matrix4, OMatrix, OVector, Rotation2, SVector, Vector2};

use super::engine::{frame_noise, visit_model};
use super::expected::{Anchor, AppearanceModel, appearances};
use super::inputs::Inputs;
use super::tilt::ByTilt;
use super::{Run, StepReport};
use pilotage_base::frames::{Attitude, GroundPoint};
use pilotage_estimation::filter::{CramerRao, FilterError, numerical_jacobian};
use pilotage_estimation::vehicle::{ControlInput, StateComponent, VehicleModel, VehicleVisitor};
use pilotage_flight::{Flight, Truth};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_vision::geometry::joint_noise;

/// Root mean square over the run of the bound on the position error, metres: no estimator that gets
/// the same detections can do better.
///
/// `true_noise` describes the real process and sensors; the noise of the detections is what the
/// detector reported, and that of aids what they stated. `None` where the truth is not known, and where aids corrected
/// a filter whose state is not that of `true_noise` with those aids.
pub fn position_bound(
    flight: &Flight,
    run: &Run,
    true_noise: &NavigatorSettings,
) -> Option<Result<f64, FilterError>> {
    flight.truth.as_ref().filter(|t| !t.states.is_empty())?;
    let bound = Bound {
        flight,
        run,
        true_noise,
    };
    if run.settings.aids.is_empty() {
        return Some(visit_model(true_noise, bound));
    }
    let with_aids = NavigatorSettings {
        aids: run.settings.aids.clone(),
        ..true_noise.clone()
    };
    let is_same = visit_model(&with_aids, Components) == run.state_names;
    is_same.then(|| visit_model(&with_aids, bound))
}

/// Names and units of the components of a vehicle's state.
struct Components;

impl VehicleVisitor for Components {
    type Output = Vec<(String, String)>;

    fn visit<const N: usize, V: VehicleModel<N>>(self, model: V) -> Self::Output {
        let layout = model.layout().into_iter();
        layout
            .map(|component| (component.key().to_owned(), component.unit().to_owned()))
            .collect()
    }
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
            let input = inputs.between(self.flight, step.time - step.dt, step.time);
            let Some(truth) = self.flight.truth.as_ref() else {
                continue;
            };
            let Some(state) = true_state(&model, truth, (step.time, step.dt), &input) else {
                continue;
            };
            let transition = numerical_jacobian(
                |x: &SVector<f64, N>| Some(model.propagate(x, &input, step.dt)),
                &state,
            )
            .ok_or(FilterError::NotFinite {
                place: "process model at the truth",
            })?;
            bound.predict(&transition, &model.process_noise(&state, &input, step.dt))?;
            self.update(&mut bound, &model, step, &state)?;
            update_by_aids(&mut bound, step)?;
            sum += bound.position_covariance()?.trace();
            count += 1;
        }
        Ok((sum / count.max(1) as f64).sqrt())
    }
}

/// State of the vehicle at `time`, the end of a step of `dt` seconds: true position, wind, and velocity over the step; zero
/// is what the truth does not tell. `None` where it tells no position.
fn true_state<const N: usize, V: VehicleModel<N>>(
    model: &V,
    truth: &Truth,
    (time, dt): (f64, f64),
    input: &ControlInput,
) -> Option<SVector<f64, N>> {
    let position = truth.position(time)?.xy();
    let mut state = SVector::<f64, N>::zeros();
    let mut enter = |first: Option<usize>, pair: Vector2<f64>| {
        if let Some(i) = first {
            (state[i], state[i + 1]) = (pair.x, pair.y);
        }
    };
    enter(Some(0), position.coords);
    let wind = truth.wind(time);
    if let Some(wind) = wind {
        enter(model.wind_index(), wind);
    }
    let before = truth.position(time - dt);
    if let Some(before) = before.filter(|_| dt > 0.0) {
        let velocity = (position - before.xy()) / dt;
        enter(model.index_of(StateComponent::VelocityNorth), velocity);
        let through_air = velocity - wind.unwrap_or_else(Vector2::zeros);
        let in_body = Rotation2::new(input.heading()).inverse() * through_air;
        enter(model.index_of(StateComponent::VelocityForward), in_body);
    }
    Some(state)
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
        let map_error = model.index_of(StateComponent::MapErrorNorth);
        let tilt_bias = model.index_of(StateComponent::RollBias);
        let by_tilt = ByTilt::of_landmarks(&jacobians);
        let slope = numerical_jacobian::<N, Dyn>(
            |x| -> Option<OVector<f64, Dyn>> {
                let [north, east] = map_error.map_or([0.0; 2], |i| [x[i], x[i + 1]]);
                let position = GroundPoint::new(x[0] + north, x[1] + east);
                let bias = bias.map_or(0.0, |i| x[i]);
                let attitude = &appearance.attitude;
                let mut expected = appearances(attitude, &places, &pose, position, bias);
                by_tilt.add_biases(&mut expected, tilt_bias.map(|i| [x[i], x[i + 1]]));
                Some(expected)
            },
            state,
        );
        let Some(slope) = slope else { return Ok(()) };
        let noise = joint_noise(
            &own,
            &jacobians,
            &frame_noise(self.true_noise).pose_covariance(),
            1.0,
        );
        bound.update(&slope, &noise)
    }
}

/// Adds the information of what aids observed and the filter took in.
///
/// The slope of an observation is that which the filter gained by: with the covariance P before it, its gain K and the
/// innovation's covariance S, H = S Kᵀ P⁻¹, and its noise is what H P Hᵀ leaves of S.
fn update_by_aids<const N: usize>(
    bound: &mut CramerRao<N>,
    step: &StepReport,
) -> Result<(), FilterError> {
    if step.updates.is_empty() {
        return Ok(());
    }
    let mut before = step.predicted.covariance.clone();
    let joint = step.frame.as_ref().and_then(|frame| frame.joint.as_ref());
    if let Some(joint) = joint {
        before -= &joint.gain * &joint.innovation_covariance * joint.gain.transpose();
    }
    for update in &step.updates {
        let Some(gain) = &update.gain else { continue };
        let of_innovation = &update.innovation_covariance;
        let together = gain * of_innovation;
        let root = before.clone().cholesky().ok_or(FilterError::NotFinite {
            place: "covariance before an aid",
        })?;
        let slope = root.solve(&together).transpose();
        let noise = of_innovation - &slope * &together;
        let slope = OMatrix::<f64, Dyn, Const<N>>::from_fn(slope.nrows(), |i, j| slope[(i, j)]);
        bound.update(&slope, &noise)?;
        before -= &together * gain.transpose();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::Point3;

    use super::super::{KnownGround, Navigator};
    use super::*;
    use pilotage_estimation::vehicle::{ConstantVelocity, Multirotor};
    use pilotage_flight::{Channel, ChannelName, NoPictures, StartFix, TruthState};
    use pilotage_mission::settings::{ChosenAid, VehicleChoice};
    use pilotage_raster::camera::CameraModel;
    use pilotage_raster::imagery::Blank;

    /// Twenty seconds to the east, with satellite navigation each second.
    fn flight() -> Flight {
        let at = |time: f64| TruthState {
            time,
            position: Point3::new(0.0, 20.0 * time, -100.0),
            attitude: None,
            wind: None,
        };
        let channel = |name, count: u32, of: fn(f64) -> f64| Channel {
            name,
            times: (1..=count)
                .map(|i| 20.0 * f64::from(i) / f64::from(count))
                .collect(),
            values: (1..=count).map(|i| of(f64::from(i))).collect(),
        };
        Flight {
            name: "eastward".to_owned(),
            frame_on_globe: None,
            camera: CameraModel::pinhole(64, 48, 1.0),
            ground_down: 0.0,
            channels: vec![
                channel(ChannelName::Heading, 100, |i| 1.57 + 0.001 * i.sin()),
                channel(ChannelName::Airspeed, 100, |i| 20.0 + 0.1 * i.sin()),
                channel(ChannelName::GpsNorth, 20, f64::sin),
                channel(ChannelName::GpsEast, 20, |i| 20.0 * i + i.cos()),
            ],
            frames: Vec::new(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::new(1.0, -1.0),
                standard_deviation: 3.0,
            },
            truth: Some(Truth {
                states: (0..=20).map(|i| at(f64::from(i))).collect(),
                frames: Vec::new(),
            }),
        }
    }

    #[test]
    fn where_all_is_linear_the_bound_with_an_aid_is_the_covariance_of_the_filter() {
        let mut settings = NavigatorSettings {
            vehicle: VehicleChoice::ConstantVelocity,
            aids: vec![ChosenAid::usual("gps-position")],
            ..NavigatorSettings::default()
        };
        settings.start.wind = 30.0;
        let flight = Arc::new(flight());
        let ground = KnownGround::new(Arc::new(Blank));
        let navigator = Navigator::new(Arc::clone(&flight), &ground, &settings).unwrap();
        let run = navigator.fly(&mut NoPictures, &|| 0.0).unwrap();
        let updates = run.steps.iter().flat_map(|step| &step.updates);
        let accepted = updates.filter(|update| update.is_accepted()).count();
        assert!(accepted >= 19, "{accepted}");
        let bound = position_bound(&flight, &run, &settings).unwrap().unwrap();
        let traces = run
            .steps
            .iter()
            .map(|step| step.after.position_covariance().trace());
        let stated = (traces.sum::<f64>() / run.steps.len() as f64).sqrt();
        assert!((bound / stated - 1.0).abs() < 0.01, "{bound} {stated}");
        let other = NavigatorSettings {
            vehicle: VehicleChoice::RandomWalk,
            ..settings
        };
        assert!(position_bound(&flight, &run, &other).is_none());
    }

    /// The way that it flies over the map follows from it, and how much of the map's error is another one.
    #[test]
    fn the_state_at_the_truth_flies_as_the_vehicle_did() {
        let mut truth = flight().truth.unwrap();
        for state in &mut truth.states {
            state.wind = Some(Vector2::new(3.0, 5.0));
        }
        // Heads south while the ground goes by to the east at 20 m/s in a wind from the south-west.
        let input = ControlInput::without_airspeed(Attitude::level(std::f64::consts::PI));
        let at = (12.5, 0.5);
        let over_ground = true_state(&ConstantVelocity::default(), &truth, at, &input).unwrap();
        let expected = [0.0, 250.0, 0.0, 20.0];
        assert!((over_ground - SVector::from(expected)).norm() < 1e-9);
        let through_air = true_state(&Multirotor::default(), &truth, at, &input).unwrap();
        // Through the air 3 m/s south, which is ahead, and 15 m/s east, which is to the left.
        let expected = [0.0, 250.0, 3.0, 5.0, 3.0, -15.0];
        assert!(
            (through_air - SVector::from(expected)).norm() < 1e-9,
            "{through_air}"
        );
        let after = true_state(&ConstantVelocity::default(), &truth, (30.0, 0.5), &input);
        assert_eq!(after, None);
    }
}
