//! Studies: the same flights navigated in several ways, judged in one table.

mod compare;
mod contender;
mod row;
mod tally;

pub use compare::EstimatorComparison;
pub use contender::Contender;
pub use row::ComparisonRow;
pub use tally::ContenderTally;
