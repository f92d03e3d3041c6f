//! Studies: the same flights navigated in several ways, judged in one table.

mod compare;
mod tally;

pub use compare::{Comparison, ComparisonRow, Contender};
pub use tally::Tally;
