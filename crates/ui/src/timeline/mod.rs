//! Time: the cursor, how it moves, and the strip that shows it.

mod bins;
mod playback;
mod strip;

pub use playback::Playback;
pub use strip::{Timeline, TimelineExtra, clock_text};
