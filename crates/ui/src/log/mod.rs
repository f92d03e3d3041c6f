//! A flight log beside the run: what it holds, what looks wrong, and its fields over time.

mod against;
mod against_menu;
mod arrangement;
mod catalog;
mod cloud;
mod command;
mod completion_list;
mod expression_field;
mod fields;
mod figures;
mod names;
mod open;
mod overview;
mod pairs;
mod panel;
mod picture;
mod plots;
mod preset_menu;
mod presets;
mod scene;
mod statistics;
mod svg;
mod words;

pub use arrangement::{PanelContent, Preset};
pub use catalog::commands;
pub use command::{LogCommand, LogTab};
pub use fields::FieldList;
pub use figures::SpanFigures;
pub use open::{OpenLog, PlottedSeries};
pub use overview::overview_panel;
pub use plots::LogPlots;
pub use presets::{OwnPreset, OwnPresets, PRESETS_KEY, PresetCommand};
pub(crate) use scene::colour as field_colour;
pub use statistics::statistics_panel;
pub use words::series_name;
