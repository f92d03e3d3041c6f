//! Results of this program beside those of other people's programs: one file for each thing that is compared.
//!
//! One test program, since each links all of the crates.

mod cascades;
mod dataflash;
mod estimators;
mod evaluation;
mod evo;
mod exchange;
mod filterpy;
mod georeferencer;
mod globe;
mod labels;
mod maps;
mod mcap;
mod opencv;
mod photos;
mod places;
mod pmtiles;
mod roads;
mod systems;
mod terrain;
mod tlog;
mod ulog;
mod versions;
mod words;
