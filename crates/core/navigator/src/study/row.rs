//! A line of the table of a study.

use serde::{Deserialize, Serialize};

use super::Contender;
use crate::navigator::ErrorFigures;
use pilotage_estimation::filter::ConsistencySummary;

/// A line of the table: what became of one contender over all flights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ComparisonRow {
    /// Who.
    pub contender: Contender,
    /// Whether these are the estimates after the flight, of the smoother, in place of those in flight.
    pub smoothed: bool,
    /// Flights navigated to their end, and smoothed if these are the estimates after the flight.
    pub flights: usize,
    /// Flights that could not.
    pub failed: usize,
    /// Distance of the position from the true one over all steps whose truth is known, metres.
    pub position_error_m: Option<ErrorFigures>,
    /// Normalized estimation error squared of the position: two degrees of freedom. The bounds of its
    /// mean take every flight for one independent sample, as the errors of its steps are alike.
    pub nees: Option<ConsistencySummary>,
    /// Normalized innovation squared of the corrections by landmarks and whole frames, not of those by aids, with the bounds
    /// of as many independent samples; none for smoothed estimates.
    pub nis: Option<ConsistencySummary>,
    /// Camera frames that corrected the estimate.
    pub frames_with_update: usize,
    /// Landmarks that corrected the estimate.
    pub updates_accepted: usize,
    /// Landmarks that were looked for and not used.
    pub updates_refused: usize,
    /// Mean time of a step's prediction and correction, milliseconds; seeing is not in it. For smoothed
    /// estimates that of the smoother, as far as it was measured.
    pub ms_per_step: f64,
}
