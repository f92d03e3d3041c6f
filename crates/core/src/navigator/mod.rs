//! The pipeline: predict → choose landmarks → see → associate → gate → update → report.

mod report;
mod run;
mod settings;

pub use report::{
    CandidateReport, Control, Estimate, FrameReport, JointReport, Outcome, Refusal, SigmaSets,
    StepReport, StepTiming,
};
pub use run::Run;
pub use settings::{NavigatorSettings, ProcessNoise, SensorNoise, StartError, VehicleChoice};
