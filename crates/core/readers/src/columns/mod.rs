//! Anybody's tables: what their columns mean, guessed from names, units and values, and open to correction.
//!
//! [`guess_table`] makes a [`ColumnMap`] of a table, each column with a confidence and a reason; a [`TablePreview`] shows
//! the first rows beside it; [`guess_tables`] does so for tables that were written together;
//! [`flight_of_tables`] makes a flight of tables by their maps, as corrected.

mod attitude;
mod bodies;
mod body_velocity;
mod build;
#[cfg(test)]
mod conventions;
#[cfg(test)]
mod export_tests;
mod flights;
mod gimbal;
mod groups;
mod guess;
mod header;
#[cfg(test)]
mod logger_tests;
mod long;
#[cfg(test)]
mod maker_tests;
mod makers;
mod map;
mod names;
mod newest_first;
mod part_units;
mod parts;
#[cfg(test)]
mod parts_tests;
mod physics;
mod pictures;
mod preview;
#[cfg(test)]
mod receiver_tests;
#[cfg(test)]
mod recorder_tests;
mod rows;
mod sampling;
mod settle;
mod several;
#[cfg(test)]
mod simulator_tests;
mod strays;
#[cfg(test)]
#[path = "../../../../../tests/src/studies.rs"]
mod studies;
#[cfg(test)]
mod tests;
mod together;
mod two_heights;
mod values;
#[cfg(test)]
mod waiting_tests;

use crate::cells::{ColumnSample, time};

pub use crate::cells::{Separator, TableShape};
pub use build::flight_of_tables;
pub use guess::guess_table;
pub use map::{Alternative, BodyAxis, ColumnMap, ColumnRole, MappedColumn, QuaternionPart};
pub use preview::{TablePreview, preview};
pub use together::{GuessedTable, guess_tables, tables_lack, tables_lack_to_navigate};
