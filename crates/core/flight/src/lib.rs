//! Measurements of a flight: channels, frames, the truth where it is known, and findings that look wrong.
//!
//! The same types whether a flight was recorded or simulated; nothing here reads a file.

mod camera_file;
mod channel;
mod finding;
mod frame;
mod moment;
mod record;
pub mod stretches;
mod truth;

pub use camera_file::{CameraFile, MountFile, OriginFile};
pub use channel::{Channel, ChannelName, Quantity};
pub use finding::{Finding, Severity};
pub use frame::{Frame, FrameError, FrameSource, NoPictures, SharedFrames};
pub use moment::{in_log_time, moment, with_moments};
pub use record::{Flight, StartFix};
pub use truth::{FrameTruth, Truth, TruthState};
