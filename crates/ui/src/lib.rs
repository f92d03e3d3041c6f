//! The views and commands of Pilotage, without a window system, so that tests drive them natively.

pub mod app;
pub mod camera_log;
pub mod command;
pub mod compare;
pub mod context;
pub mod dialogs;
pub mod documents;
pub mod feature;
pub mod feature_command;
pub mod features;
pub mod georeference;
pub mod host;
pub mod kept_mesh;
pub mod labelling;
pub mod log;
pub mod map;
pub mod outage;
pub mod photos;
pub mod plan;
pub mod shell;
pub mod short_map;
mod state_json;
pub mod still;
pub mod timeline;
pub mod tokens;
pub mod units;
pub mod views;
