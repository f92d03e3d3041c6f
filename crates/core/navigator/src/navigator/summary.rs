//! A run in figures.

use std::collections::BTreeMap;

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::bound::position_bound;
use super::{CandidateReport, Outcome, RegistrationRefusal, Run, StepReport};
use pilotage_base::statistics::quantile;
use pilotage_estimation::filter::Consistency;
use pilotage_estimation::vehicle::StateComponent;
use pilotage_flight::Flight;
use pilotage_mission::settings::NavigatorSettings;
use pilotage_vision::landmark::Refusal;

/// An accepted place further than this from the truth in the picture is wrong, pixels …
const WRONG_PIXELS: f64 = 5.0;
/// … if it is also further than this on the ground, metres.
const WRONG_METRES: f64 = 2.0;
/// Without the true attitude: an accepted frame whose position is further off than this is wrong.
const WRONG_POSITION: f64 = 5.0;

/// Distribution of an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ErrorFigures {
    /// Root mean square.
    pub rms: f64,
    /// Median.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Largest.
    pub max: f64,
}

impl ErrorFigures {
    /// Figures of a set of errors, `None` if it is empty.
    ///
    /// ```
    /// use pilotage_navigator::navigator::ErrorFigures;
    ///
    /// let figures = ErrorFigures::of(vec![4.0, 0.0, 3.0]).ok_or("no errors")?;
    /// assert_eq!((figures.median, figures.max), (3.0, 4.0));
    /// assert!((figures.rms - (25.0_f64 / 3.0).sqrt()).abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(mut errors: Vec<f64>) -> Option<Self> {
        errors.sort_by(f64::total_cmp);
        let mean_square = errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64;
        Some(Self {
            rms: mean_square.sqrt(),
            median: quantile(&errors, 0.5)?,
            p95: quantile(&errors, 0.95)?,
            max: *errors.last()?,
        })
    }
}

/// Mean of a normalized squared error, what it should be, and how often it was plausible.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ConsistencyFigures {
    /// Mean over the samples.
    pub mean: f64,
    /// Mean degrees of freedom: what the mean should be.
    pub dof: f64,
    /// Share of samples inside their own two-sided 95 % interval.
    pub inside_95: f64,
    /// Number of samples.
    pub count: usize,
}

/// Milliseconds per camera frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameTiming {
    /// Prediction, all steps since the frame before.
    pub predict: f64,
    /// Rectification and matching.
    pub see: f64,
    /// Gating and correction.
    pub update: f64,
    /// All of it.
    pub total: f64,
}

/// The posterior Cramér-Rao bound over a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundFigures {
    /// Root mean square, metres.
    pub rms: f64,
}

/// Kind of the frames that could not be used at all.
const UNUSABLE: &str = "unusable";

/// A run in figures.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the run.
    pub name: String,
    /// Camera frames.
    pub frames: usize,
    /// Frames in which at least one landmark corrected the estimate.
    pub frames_with_update: usize,
    /// Landmarks looked for, over all frames.
    pub searches: usize,
    /// Landmarks that corrected the estimate.
    pub updates_accepted: usize,
    /// Landmarks looked for and not used, by reason.
    pub updates_refused: BTreeMap<String, usize>,
    /// Whole frames laid on the map that corrected the estimate.
    #[serde(default)]
    pub frames_laid: usize,
    /// Whole frames that were looked for on the map and did not correct the estimate, by reason; and, as "unusable",
    /// frames that could not be used at all. Those of which there are none are left out.
    #[serde(default)]
    pub frames_refused: BTreeMap<String, usize>,
    /// Accepted although wrong: over 5 px and over 2 m on the ground from where the landmark truly is
    /// in that picture; where the camera's true attitude is not known, over 5 m of implied position.
    pub updates_wrong: Option<usize>,
    /// Error of the position over all steps whose truth is known, metres.
    pub position_error_m: Option<ErrorFigures>,
    /// The same over steps with a correction only, metres.
    pub corrected_position_error_m: Option<ErrorFigures>,
    /// Error of dead reckoning alone, metres.
    pub dead_reckoning_error_m: Option<ErrorFigures>,
    /// Error of the wind over all steps, m/s.
    pub wind_error_mps: Option<ErrorFigures>,
    /// Error of the wind after the first minute, m/s.
    pub wind_error_after_minute_mps: Option<ErrorFigures>,
    /// Posterior Cramér-Rao bound of the position, where the truth is known, metres.
    pub position_bound_m: Option<BoundFigures>,
    /// Root mean square position error over the bound.
    pub error_over_bound: Option<f64>,
    /// Normalized estimation error squared of the position.
    pub nees: Option<ConsistencyFigures>,
    /// Normalized innovation squared of the corrections by landmarks and whole frames.
    pub nis: Option<ConsistencyFigures>,
    /// The same of every aid beside pictures that had a reading, by its name; refused readings count.
    #[serde(default)]
    pub nis_of_aids: BTreeMap<String, ConsistencyFigures>,
    /// Milliseconds per camera frame, mean.
    pub ms_per_frame: FrameTiming,
}

fn figures(consistency: &Consistency) -> Option<ConsistencyFigures> {
    consistency.summary().map(|s| ConsistencyFigures {
        mean: s.mean,
        dof: s.dof,
        inside_95: s.inside_95,
        count: s.count,
    })
}

/// The run in figures, held against the flight's truth where there is one.
///
/// `true_noise` describes the real process and sensors for the Cramér-Rao bound; none, no bound.
///
/// ```
/// # use std::sync::Arc;
/// # use pilotage_base::frames::GroundPoint;
/// # use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
/// # use pilotage_raster::camera::CameraModel;
/// # use nalgebra::Point3;
/// # use pilotage_flight::{NoPictures, Truth, TruthState};
/// # use pilotage_mission::settings::NavigatorSettings;
/// use pilotage_navigator::navigator::{KnownGround, Navigator, summarize};
/// # use pilotage_raster::imagery::Blank;
/// # let at = |time: f64| TruthState {
/// #     time,
/// #     position: Point3::new(0.0, 22.0 * time, -100.0),
/// #     attitude: None,
/// #     wind: None,
/// # };
/// # let channel = |name, mean: f64, by: f64| Channel {
/// #     name,
/// #     times: (0..=50).map(|i| 0.2 * f64::from(i)).collect(),
/// #     values: (0..=50).map(|i| if i % 2 == 0 { mean + by } else { mean - by }).collect(),
/// # };
/// # let flight = Flight {
/// #     name: "eastward".to_owned(),
/// #     frame_on_globe: None,
/// #     camera: CameraModel::pinhole(640, 480, 1.0),
/// #     ground_down: 0.0,
/// #     channels: vec![
/// #         channel(ChannelName::Airspeed, 20.0, 0.1),
/// #         channel(ChannelName::Heading, 90_f64.to_radians(), 0.001),
/// #     ],
/// #     frames: Vec::new(),
/// #     start: StartFix { time: 0.0, position: GroundPoint::new(0.0, 0.0), standard_deviation: 3.0 },
/// #     truth: Some(Truth { states: vec![at(0.0), at(10.0)], frames: Vec::new() }),
/// # };
/// # let flight = Arc::new(flight);
/// # let settings = NavigatorSettings::default();
/// # let navigator = Navigator::new(Arc::clone(&flight), &KnownGround::new(Arc::new(Blank)), &settings)?;
/// # let run = navigator.fly(&mut NoPictures, &|| 0.0)?;
///
/// // Ten seconds without a picture in a wind of 2 m/s that nobody told.
/// let summary = summarize(&flight, &run, None);
/// let reckoned = summary.dead_reckoning_error_m.ok_or("no truth")?;
/// assert!((reckoned.max - 20.0).abs() < 0.5);
/// assert_eq!(summary.frames, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn summarize(flight: &Flight, run: &Run, true_noise: Option<&NavigatorSettings>) -> Summary {
    let mut summary = Summary {
        name: run.name.clone(),
        ..Summary::default()
    };
    let (mut all, mut corrected, mut unaided) = (vec![], vec![], vec![]);
    let (mut wind, mut wind_later) = (vec![], vec![]);
    let (mut nees, mut nis) = (Consistency::default(), Consistency::default());
    let mut nis_of_aids: BTreeMap<&String, Consistency> = BTreeMap::new();
    let wind_index = run.state_index(StateComponent::WindNorth);
    let begun = run.span().map_or(0.0, |(start, _)| start);
    for step in &run.steps {
        count_frame(&mut summary, step);
        if let Some(joint) = step.frame.as_ref().and_then(|f| f.joint.as_ref()) {
            nis.push(joint.nis, joint.degrees_of_freedom);
        }
        for update in &step.updates {
            let of_aid = nis_of_aids.entry(&update.aid).or_default();
            of_aid.push(update.nis, update.degrees_of_freedom);
        }
        let Some(truth) = flight.truth.as_ref() else {
            continue;
        };
        if let Some(true_position) = position(flight, step) {
            let off = step.after.position().to_vector() - true_position;
            all.push(off.norm());
            if step.corrected() {
                corrected.push(off.norm());
            }
            unaided.push((step.dead_reckoned.to_vector() - true_position).norm());
            let covariance: Matrix2<f64> = step.after.position_covariance();
            if let Some(root) = covariance.cholesky() {
                nees.push(root.solve(&off).dot(&off), 2);
            }
        }
        if let Some((index, truth)) = wind_index.zip(truth.wind(step.time)) {
            let mean = &step.after.mean;
            let error = (Vector2::new(mean[index], mean[index + 1]) - truth).norm();
            wind.push(error);
            if step.time - begun >= 60.0 {
                wind_later.push(error);
            }
        }
    }
    let frames = summary.frames.max(1) as f64;
    let timing = &mut summary.ms_per_frame;
    timing.predict /= frames;
    timing.see /= frames;
    timing.update /= frames;
    timing.total = timing.predict + timing.see + timing.update;
    summary.updates_wrong = wrong_updates(flight, run);
    summary.position_error_m = ErrorFigures::of(all);
    summary.corrected_position_error_m = ErrorFigures::of(corrected);
    summary.dead_reckoning_error_m = ErrorFigures::of(unaided);
    summary.wind_error_mps = ErrorFigures::of(wind);
    summary.wind_error_after_minute_mps = ErrorFigures::of(wind_later);
    summary.nees = figures(&nees);
    summary.nis = figures(&nis);
    let of_aids = nis_of_aids.into_iter();
    let of_aids = of_aids.filter_map(|(aid, nis)| Some((aid.clone(), figures(&nis)?)));
    summary.nis_of_aids = of_aids.collect();
    summary.position_bound_m = true_noise
        .and_then(|noise| position_bound(flight, run, noise)?.ok())
        .map(|rms| BoundFigures { rms });
    summary.error_over_bound = summary
        .position_error_m
        .zip(summary.position_bound_m)
        .map(|(error, bound)| error.rms / bound.rms);
    summary
}

/// True position (north, east) at a step: of the frame where the step has one, else of the path.
fn position(flight: &Flight, step: &StepReport) -> Option<Vector2<f64>> {
    let truth = flight.truth.as_ref()?;
    let of_frame = step
        .frame
        .as_ref()
        .and_then(|f| truth.frames.get(f.index))
        .map(|f| f.position);
    let position = of_frame.or_else(|| truth.position(step.time))?;
    Some(Vector2::new(position.x, position.y))
}

fn count_frame(summary: &mut Summary, step: &StepReport) {
    summary.ms_per_frame.predict += step.timing.predict;
    summary.ms_per_frame.see += step.timing.see;
    summary.ms_per_frame.update += step.timing.update;
    let Some(frame) = &step.frame else { return };
    summary.frames += 1;
    summary.frames_with_update += usize::from(frame.joint.is_some());
    summary.searches += frame.candidates.len();
    let kind = match &frame.laid {
        _ if frame.trouble.is_some() => Some(UNUSABLE),
        Some(laid) if laid.is_believed() => {
            summary.frames_laid += 1;
            None
        }
        Some(laid) => Some(laid.refused_as.map_or(UNUSABLE, RegistrationRefusal::key)),
        None => None,
    };
    if let Some(kind) = kind {
        *summary.frames_refused.entry(kind.to_owned()).or_default() += 1;
    }
    for candidate in &frame.candidates {
        match candidate.outcome {
            Outcome::Accepted => summary.updates_accepted += 1,
            Outcome::Refused(refusal) => {
                *summary
                    .updates_refused
                    .entry(refusal.key().to_owned())
                    .or_default() += 1;
            }
        }
    }
    for refusal in Refusal::ALL {
        summary
            .updates_refused
            .entry(refusal.key().to_owned())
            .or_default();
    }
}

/// Accepted landmarks that were wrong; `None` without a truth.
fn wrong_updates(flight: &Flight, run: &Run) -> Option<usize> {
    let truth = flight.truth.as_ref()?;
    let mut wrong = 0;
    for step in run.steps.iter().filter(|s| s.corrected()) {
        let Some(frame) = &step.frame else { continue };
        let Some(true_frame) = truth.frames.get(frame.index) else {
            continue;
        };
        if true_frame.camera_attitude.is_some() {
            wrong += frame
                .accepted()
                .filter(|c| is_wrong(flight, run, frame.index, c))
                .count();
        } else {
            let position = step.after.position();
            let off = (position.north - true_frame.position.x)
                .hypot(position.east - true_frame.position.y);
            wrong += if off > WRONG_POSITION {
                frame.accepted().count()
            } else {
                0
            };
        }
    }
    Some(wrong)
}

/// Distance between the place found and the landmark's true place in that picture: pixels, and metres on the
/// ground. `None` where the truth is not known or nothing was found.
pub fn place_error(
    flight: &Flight,
    run: &Run,
    frame: usize,
    candidate: &CandidateReport,
) -> Option<(f64, f64)> {
    let pose = flight.truth.as_ref()?.frames.get(frame)?.pose()?;
    let landmark = run.landmarks.iter().find(|l| l.id == candidate.landmark)?;
    let camera = flight.camera_of_frame(frame);
    let point = landmark.reference_in_world(flight.ground_down);
    let true_pixel = camera.project(&pose, &point)?;
    let found = candidate.measured_pixel?;
    let ground = camera.ground_at(&pose, &found, flight.ground_down)?;
    let metres = ground.distance(&landmark.reference);
    Some(((found - true_pixel).norm(), metres))
}

/// Whether an accepted place is not where the landmark truly is in the picture.
pub fn is_wrong(flight: &Flight, run: &Run, frame: usize, candidate: &CandidateReport) -> bool {
    place_error(flight, run, frame, candidate)
        .is_none_or(|(pixels, metres)| pixels > WRONG_PIXELS && metres > WRONG_METRES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_lie_between_the_errors() {
        let figures = ErrorFigures::of(vec![4.0, 1.0, 2.0, 3.0, 5.0]).unwrap();
        assert_eq!(figures.median, 3.0);
        assert_eq!(figures.max, 5.0);
        assert!((figures.p95 - 4.8).abs() < 1e-12);
        assert!((figures.rms - 11.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(ErrorFigures::of(Vec::new()), None);
    }
}
