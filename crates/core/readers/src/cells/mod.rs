//! The cells of tables: separators, numbers, units, dates and times.

mod date;
mod date_spellings;
mod moment;
mod sample;
mod shape;
mod since_1970;
pub(crate) mod spellings;
pub(crate) mod time;
mod units;

pub(crate) use date::{date_and_time, days_since_1970, has_zone, of_clock_number, readings};
pub(crate) use moment::Moment;
pub use pilotage_base::separator::Separator;
pub(crate) use sample::{ColumnSample, median};
pub use shape::TableShape;
pub(crate) use shape::{is_missing, number, unit_behind};
pub(crate) use since_1970::is_since_1970;
pub(crate) use units::{DEGREES_AND_MINUTES, Dimension, SEMICIRCLES, linear, shortened};
