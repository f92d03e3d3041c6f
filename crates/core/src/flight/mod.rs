//! What was measured in a flight: channels, frames, and the truth where it is known.

mod channel;
mod frame;
mod record;
mod truth;

pub use channel::{Channel, ChannelName};
pub use frame::{Frame, FrameError, FrameSource};
pub use record::{Flight, StartFix};
pub use truth::{FrameTruth, Truth, TruthState};
