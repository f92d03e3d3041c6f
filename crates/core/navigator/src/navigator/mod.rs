//! The pipeline: predict → choose landmarks → see → associate → gate → update → report.

mod aids;
mod attention;
mod bound;
mod engine;
mod estimate;
mod expected;
mod explain;
mod finding;
mod fixes;
#[cfg(test)]
pub(crate) mod flight_for_tests;
mod flown;
mod found_places;
mod frame_registration;
mod heading_doubt;
mod inputs;
mod known_ground;
mod looks;
mod observation;
mod observed_at;
mod onlooker;
mod passed_over;
mod picture_errors;
mod picture_lag;
mod pipeline;
mod place_on_map;
mod placed;
mod possible_places;
mod recovery;
mod region;
mod registration_refusal;
mod report;
mod run;
mod run_file;
mod run_files_before;
mod see;
mod sighting;
mod smooth;
#[cfg(test)]
pub(crate) mod step_for_tests;
mod summary;
mod ticks;
mod tilt;
mod unused_pictures;

pub use aids::{AidError, AidInfo, AidNumber};
pub use bound::position_bound;
pub use engine::{frame_noise, visit_model};
pub use estimate::Estimate;
pub use explain::{explain, explain_cascade};
pub use fixes::position_fixes;
pub use inputs::{Doubt, Instrument, SensorFault};
pub use known_ground::KnownGround;
pub use looks::{LooksAtLandmarks, lasting_variances, weakened};
pub use passed_over::passed_over;
pub use pilotage_vision::landmark::Refusal;
pub use pipeline::{Navigator, NavigatorError};
pub use place_on_map::PlaceOnMap;
pub use registration_refusal::RegistrationRefusal;
pub use report::{
    CandidateReport, Control, FrameReport, JointReport, Outcome, RegisteredPlace,
    RegistrationReport, SigmaSets, StepReport, StepTiming, UpdateReport,
};
pub use run::Run;
pub use run_file::{RunFileError, decode_run, encode_run};
pub use sighting::{KnownReport, PairReport, SeenReport, SightedKind, SightingReport};
pub use smooth::{RunSmoothing, smooth};
pub use summary::{
    ConsistencyFigures, ErrorFigures, FrameTiming, Summary, is_wrong, place_error, summarize,
};
pub use unused_pictures::unused_pictures;
