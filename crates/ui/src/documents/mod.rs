//! Documents that are open: the mission, the flight, the run, its ghost, the pictures.

mod add;
mod brought;
mod edit;
mod empty_mission;
mod findings;
mod frame_pictures;
mod ground;
mod history;
pub mod kept;
pub mod landmarks;
mod laps;
mod log_file;
mod map_under;
mod noticed;
mod panel_layout;
mod planned_ground;
mod session;
mod store;
mod stored_session;
mod view_panels;

pub use add::Added;
pub use brought::Brought;
pub use frame_pictures::FramePictures;
pub use ground::{OpenedTerrain, TERRAIN_KEY};
pub use history::History;
pub use log_file::LogFile;
pub use map_under::with_origin;
pub use noticed::Noticed;
pub use pilotage_core::navigator::{RunFileError, decode_run, encode_run};
pub use planned_ground::planned_ground;
pub use session::{SESSION_KEY, Session, UNREAD_KEY, VIEW_KEY, ViewState};
pub use store::{Documents, Staged};
