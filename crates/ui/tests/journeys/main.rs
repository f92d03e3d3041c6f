//! What people do, one action per file, driven by role and label on a scripted host.

mod support;

mod add_landmark;
mod autosave;
mod bookmarks;
mod broken_file;
mod camera_log;
mod column_map;
mod compare;
mod cut;
mod detector;
mod first_screen;
mod fly_again;
mod georeference;
mod keyboard_landmark;
mod labels;
mod link;
mod log;
mod log_against;
mod log_presets;
mod log_statistics;
mod lost_worker;
mod names;
mod open_map;
mod palette;
mod pictures;
mod plan;
mod reload;
mod reopen;
mod save;
mod scrub;
mod select_span;
mod settings;
mod simulate;
mod typing;
mod undo;
