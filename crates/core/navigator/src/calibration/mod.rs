//! A camera put in time and place beside a log: when its clock stands against the log's, how it is mounted,
//! and how long its lens is, each with what is known of it.
//!
//! It is told from frames that were laid on the map ([`crate::navigator::RegisteredPlace`]) against satellite
//! navigation, heading and height of the log: the place in the middle of each picture should be the one that
//! the mounted camera sees from where and how the log says that the aircraft was.

mod estimate;
mod evidence;
mod finding;
mod numbers;
mod residual;
mod solve;

pub use estimate::{
    CalibrationError, CameraPrior, CameraSearch, CameraToLog, Estimated, FEWEST_FRAMES,
    camera_to_log,
};
pub use evidence::{CameraEvidence, FrameResidual, ResidualSummary};
pub use finding::camera_findings;
pub use numbers::{CameraNumber, camera_numbers};
