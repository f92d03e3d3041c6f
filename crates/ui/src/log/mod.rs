//! A flight log beside the run: what it holds, what looks wrong, and its fields over time.

mod command;
mod fields;
mod open;
mod overview;
mod panel;
mod plots;
mod words;

pub use command::LogCommand;
pub use fields::FieldList;
pub use open::{OpenLog, PlottedSeries};
pub use overview::overview_panel;
pub use plots::LogPlots;
pub use words::series_name;
