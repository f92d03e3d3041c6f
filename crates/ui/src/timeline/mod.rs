//! Time: the cursor, how it moves, and the strip that shows it.

mod bins;
mod playback;
mod selected;
mod strip;

pub use playback::Playback;
pub use selected::Span;
pub(crate) use selected::{SpanPointer, TimeOnScreen, paint_span};
pub use strip::{Timeline, TimelineExtra};
