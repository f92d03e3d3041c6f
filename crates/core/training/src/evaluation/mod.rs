//! Evaluation of a detector on pictures it was not trained on, with what is not known about it.

mod breakdown;
mod calibration;
mod covariance;
mod curve;
mod draws;
mod error;
mod events;
mod held_out_frames;
mod isotonic;
mod judge;
mod look;
mod operating;
mod plot;
mod rate;
mod real_frames;
mod robust;
#[cfg(test)]
mod sample;
mod summary;
mod svg;
mod table;

pub use breakdown::{By, CircumstanceBin, DetectionBreakdown};
pub use calibration::{JudgedMark, Probability, ScoreBin, ScoreCalibration, brier_score, log_loss};
pub use covariance::MarkCovariance;
pub use curve::{Curve, CurveKind, CurvePoint, average_precision, trace};
pub use error::EvaluationError;
pub use held_out_frames::HeldOutFrames;
pub use isotonic::Isotonic;
pub(super) use judge::look;
pub use judge::{DetectorJudge, JudgingPlan};
pub use look::{EvaluatedLook, EvaluatedMark};
pub use operating::{AtThreshold, OperatingPoint};
pub use plot::{Plot, PlotAxis, PlotPoint, PlotSeries, SeriesStyle};
pub use rate::{IntervalEstimate, Rate, correlation_within, wilson};
pub use real_frames::FrameJudge;
pub use robust::RobustFit;
pub use summary::{Evaluation, EvaluationSettings};
