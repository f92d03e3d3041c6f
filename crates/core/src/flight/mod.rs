//! What was measured in a flight: channels, frames, and the truth where it is known.

mod channel;
pub mod files;
mod folder;
mod frame;
pub mod interpret;
pub mod log;
pub mod overview;
mod record;
pub mod trajectory;
mod truth;

pub use channel::{Channel, ChannelName, Quantity};
pub(crate) use folder::{CameraFile, OriginFile};
pub use folder::{
    FLIGHT_FILE, FlightFolder, FolderError, FolderFrames, WriteError, read_flight, write_flight,
};
pub use frame::{Frame, FrameError, FrameSource};
pub use record::{Flight, StartFix};
pub use truth::{FrameTruth, Truth, TruthState};
