//! The way back when a belief locks out what is right.
//!
//! A wrong correction that passed its gate, a shake of the camera far out in its tail, leaves a belief
//! that is surer than it may be: the right places of the next landmarks then lie outside their gates,
//! for good. So a refused place founds a recovery: the same filter with its covariance faded as
//! much as that place makes likeliest ([`fading_factor`]). It is moved along, eats nothing but what the
//! first refuses, and takes over when, in another frame, it believes another landmark's place that the
//! first refuses too. Once the first believes a landmark again, the recovery is dropped.
//!
//! One wrong place can be wrong again, in the same way, of the same landmark, and two landmarks in one
//! frame share its shake: neither convinces.

use super::CandidateReport;
use super::aids::take;
use super::engine::{Engine, PredictedStep};
use super::observation::Observation;
use super::observed_at::ObservedAt;
use super::see::{Agreed, Associator, FoundPlace, observation};
use pilotage_estimation::filter::{FilterError, Gate, fading_factor};
use pilotage_estimation::vehicle::ControlInput;

/// Another belief about the same flight.
pub struct Recovery {
    engine: Box<dyn Engine>,
    /// Landmarks that it believes and the first refused.
    landmarks: Vec<u32>,
    /// Factor on the covariance of the first when it was founded.
    fading: f64,
    /// Its last prediction.
    step: Option<PredictedStep>,
}

/// Verdict of the recovery on a frame in which the first believes nothing.
pub enum RecoveryVerdict<'l> {
    /// Nothing that convinces.
    Unsure(Option<Recovery>),
    /// The recovery is right: its filter, before this frame, and what it believes of the frame.
    TakesOver {
        /// The filter that goes on.
        engine: Box<dyn Engine>,
        /// Factor on the covariance of the first when the recovery was founded.
        fading: f64,
        /// The prediction that brought it here.
        step: Option<PredictedStep>,
        /// Measurements that correct the filter.
        agreed: Agreed<'l>,
    },
}

impl Recovery {
    /// Moves it along as the first; `None` if it cannot be.
    pub fn moved(mut self, input: &ControlInput, dt: f64) -> Option<Self> {
        self.step = Some(self.engine.predict(input, dt).ok()?);
        Some(self)
    }

    /// Shows it what an aid observed; it assumes that pictures come `lag` seconds late.
    pub fn take(
        &mut self,
        observation: &Observation<'_>,
        (at, lag, gate): (&ObservedAt<'_>, f64, Gate),
    ) -> Result<(), FilterError> {
        at.turn(self.engine.as_mut(), lag);
        take(self.engine.as_mut(), observation, gate)?;
        Ok(())
    }

    /// See [`Engine::look_back`].
    pub fn look_back(&mut self, past: Vec<(ControlInput, f64)>) {
        self.engine.look_back(past);
    }
}

/// Shows a frame's `refused` places to the recovery, if there is one, or founds one.
///
/// `associator` looks with the first filter; `reports` change only when the recovery takes over. A recovery
/// whose filter cannot go on is dropped.
pub fn reconsider<'l>(
    recovery: Option<Recovery>,
    associator: &Associator<'_>,
    refused: &[FoundPlace<'l>],
    reports: &mut Vec<CandidateReport>,
) -> RecoveryVerdict<'l> {
    weigh(recovery, associator, refused, reports).unwrap_or(RecoveryVerdict::Unsure(None))
}

fn weigh<'l>(
    recovery: Option<Recovery>,
    associator: &Associator<'_>,
    refused: &[FoundPlace<'l>],
    reports: &mut Vec<CandidateReport>,
) -> Result<RecoveryVerdict<'l>, FilterError> {
    if refused.is_empty() {
        return Ok(RecoveryVerdict::Unsure(recovery));
    }
    let Some(mut recovery) = recovery else {
        return founded(associator, refused, reports).map(RecoveryVerdict::Unsure);
    };
    let mut judged = reports.clone();
    let agreed = believed(
        &associator.judged_by(recovery.engine.as_ref()),
        refused,
        &mut judged,
    )?;
    let another = |id: u32| recovery.landmarks.iter().any(|known| *known != id);
    if agreed.0.iter().any(|m| another(m.landmark.id)) {
        *reports = judged;
        return Ok(RecoveryVerdict::TakesOver {
            engine: recovery.engine,
            fading: recovery.fading,
            step: recovery.step,
            agreed,
        });
    }
    if agreed.0.is_empty() {
        return founded(associator, refused, reports).map(RecoveryVerdict::Unsure);
    }
    let seen = observation(
        associator.settings,
        &agreed.0,
        &associator.model,
        &associator.pose,
    );
    seen.correct(recovery.engine.as_mut())?;
    Ok(RecoveryVerdict::Unsure(Some(recovery)))
}

/// A recovery that believes the least surprising of the refused places, and those that agree.
fn founded(
    associator: &Associator<'_>,
    refused: &[FoundPlace<'_>],
    reports: &[CandidateReport],
) -> Result<Option<Recovery>, FilterError> {
    let nis = |place: &&FoundPlace<'_>| reports[place.1].nis.unwrap_or(f64::INFINITY);
    let least = refused.iter().min_by(|a, b| nis(a).total_cmp(&nis(b)));
    let Some(measurement) = least.and_then(|(l, i, place)| associator.measurement(l, *i, *place))
    else {
        return Ok(None);
    };
    let innovation = associator.innovation(&[measurement])?;
    let Some(fading) = fading_factor(
        &innovation.innovation,
        &innovation.covariance,
        &innovation.noise,
    ) else {
        return Ok(None);
    };
    let mut engine = associator.engine.faded(fading)?;
    let judge = associator.judged_by(engine.as_ref());
    let (agreed, _, _) = believed(&judge, refused, &mut reports.to_vec())?;
    if agreed.is_empty() {
        return Ok(None);
    }
    let seen = observation(
        associator.settings,
        &agreed,
        &associator.model,
        &associator.pose,
    );
    seen.correct(engine.as_mut())?;
    Ok(Some(Recovery {
        engine,
        landmarks: agreed.iter().map(|m| m.landmark.id).collect(),
        fading,
        step: None,
    }))
}

/// Measurements of the places that `judge` believes.
pub fn believed<'l>(
    judge: &Associator<'_>,
    found: &[FoundPlace<'l>],
    reports: &mut [CandidateReport],
) -> Result<Agreed<'l>, FilterError> {
    let mut measurements = Vec::new();
    for (landmark, index, place) in found {
        measurements.extend(judge.judge(landmark, &mut reports[*index], *index, *place));
    }
    judge.agree(measurements, reports)
}
