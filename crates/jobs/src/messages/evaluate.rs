//! A detector to be judged, and what came of it.

use pilotage_core::training::evaluation::Plot;
use serde::{Deserialize, Serialize};

use super::{AssessmentOrder, FlightSource};

/// Detector to be judged, and the real frames to judge it by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationOrder {
    /// The landmark with its detector, and the flights for which it is judged.
    pub about: AssessmentOrder,
    /// A recorded flight; its frames are looked at if the truth of it is known.
    pub flight: Option<FlightSource>,
    /// Photos to take.
    pub photos: usize,
    /// Days on which they are taken.
    pub days: usize,
}

/// Result of an evaluation, ready to be shown and saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationReport {
    /// The landmark.
    pub landmark: u32,
    /// Its name.
    pub name: String,
    /// The figures that matter most.
    pub figures: Vec<String>,
    /// Basis of the figures: numbers of pictures and days, and the meaning of bands and brackets.
    pub basis: String,
    /// The plots, each with itself as SVG.
    pub plots: Vec<(Plot, String)>,
    /// Every figure as one table.
    pub csv: String,
    /// Whether there is more to be looked at.
    pub is_partial: bool,
}
