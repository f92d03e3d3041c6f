//! An observation taken in by a filter, or refused.

use super::super::engine::{CorrectedStep, Engine};
use super::super::observation::{GaussianInnovation, Observation};
use pilotage_estimation::filter::{FilterError, Gate, Verdict};

/// Effect of an observation on a filter.
pub struct Taken {
    pub verdict: Verdict,
    pub innovation: GaussianInnovation,
    /// Logarithm of its likelihood, as if it lay on the border of the gate where it lies outside.
    pub log_likelihood: f64,
    /// The correction, if the gate accepted it.
    pub step: Option<CorrectedStep>,
}

/// Shows an observation to `engine`, which is corrected by it if `gate` lets it pass; `None` where the vehicle model
/// knows nothing of what was measured.
pub fn take(
    engine: &mut dyn Engine,
    observation: &Observation<'_>,
    gate: Gate,
) -> Result<Option<Taken>, FilterError> {
    let innovation = match observation.innovation(engine) {
        Err(FilterError::NoMeasurement { .. }) => return Ok(None),
        innovation => innovation?,
    };
    let verdict = observation.verdict(&innovation, gate)?;
    let log_likelihood = innovation.log_likelihood(verdict.threshold)?;
    let step = if verdict.accepted {
        Some(observation.correct(engine)?)
    } else {
        None
    };
    Ok(Some(Taken {
        verdict,
        innovation,
        log_likelihood,
        step,
    }))
}
