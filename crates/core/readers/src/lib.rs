//! What was measured in a flight: channels, frames, and the truth where it is known.

pub mod beside_log;
mod camera_file;
mod channel;
pub mod columns;
pub mod expression;
pub mod files;
mod finding;
mod folder;
mod frame;
pub mod interpret;
pub mod log;
pub mod overview;
pub mod photo;
mod record;
pub mod role;
mod span_statistics;
mod span_table;
pub mod stretches;
pub mod trajectory;
mod truth;
pub mod video;

pub use camera_file::{CameraFile, MountFile, OriginFile};
pub use channel::{Channel, ChannelName, Quantity};
pub use finding::{Finding, Severity};
pub use folder::{
    FLIGHT_FILE, FlightFolder, FolderError, FolderFrames, WriteError, read_flight, write_flight,
};
pub use frame::{Frame, FrameError, FrameSource};
pub use record::{Flight, StartFix};
pub use span_statistics::SpanStatistics;
pub use span_table::SpanTable;
pub use truth::{FrameTruth, Truth, TruthState};
