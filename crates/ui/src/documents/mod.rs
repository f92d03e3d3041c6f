//! What is open: the mission, the flight, the run, its ghost, the pictures.

mod edit;
mod files;
mod history;
mod session;
mod store;

pub use files::{RunFileError, decode_run, encode_run};
pub use history::History;
pub use session::{SESSION_KEY, Session, VIEW_KEY, ViewState};
pub use store::{Documents, Staged};
