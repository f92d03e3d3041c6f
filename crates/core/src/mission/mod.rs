//! What people author: landmarks, camera, aircraft, filter settings. A value; edits make a new one.

mod record;

pub use record::{MapReference, Mission};
