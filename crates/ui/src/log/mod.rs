//! A flight log beside the run: what it holds, what looks wrong, and its fields over time.

mod against;
mod against_menu;
mod answers;
mod arrangement;
mod catalog;
mod cloud;
mod coloured_track;
mod column;
mod command;
mod completion_list;
mod execute;
mod expression_field;
mod feature;
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
mod reading;
mod recorded;
mod report;
mod scene;
mod series;
mod statistics;
mod svg;
mod words;
mod work;

pub use command::ID;
pub use work::LogFeature;

use arrangement::{PanelContent, Preset};
use command::{LogCommand, LogTab};
use fields::FieldList;
use figures::SpanFigures;
use open::{OpenLog, PlottedSeries};
use plots::LogPlots;
use presets::{OwnPresets, PRESETS_KEY, PresetCommand};
use words::series_name;
