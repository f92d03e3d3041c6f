//! The pipeline: predict → choose landmarks → see → associate → gate → update → report.

mod engine;
mod geometry;
mod pipeline;
mod region;
mod report;
mod run;
mod see;
mod settings;

pub use crate::landmark::Refusal;
pub use pipeline::{Navigator, NavigatorError, explain};
pub use report::{
    CandidateReport, Control, Estimate, FrameReport, JointReport, Outcome, SigmaSets, StepReport,
    StepTiming,
};
pub use run::Run;
pub use settings::{NavigatorSettings, ProcessNoise, SensorNoise, StartError, VehicleChoice};
