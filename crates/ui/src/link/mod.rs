//! Links to the view of a built-in flight, copied and followed.

mod content;
mod feature;

pub use content::{BEFORE_LINK_KEY, Link};
pub use feature::LinkFeature;

pub use crate::host::LINK_KEY;
