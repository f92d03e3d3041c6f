//! Expressions over the series of a log: `hypot(GPS.VelN, GPS.VelE) - {Ground speed}`.
//!
//! Names are those of the log (`ATT.Roll`, `vehicle_attitude.q[0]`, `GPS[1].Spd`) or of what it means
//! (`{Ground speed}`); any name may stand in braces, a closing brace in it twice. A name stands for the
//! values as they are plotted: angles that the log has in degrees stay in degrees.
//!
//! From loose to tight: comparisons (`< <= > >= == !=`, 1 or 0), `+ -`, `* / %`, the sign, `^`. `a % b` has the
//! sign of `b`, so that `x % 360` lies in a full turn; `a ^ b ^ c` is `a ^ (b ^ c)`.
//!
//! The first series named gives the times of the result; others are interpolated there, linearly, angles the
//! shorter way round, and are missing (NaN) before their first and after their last sample.

mod complete;
mod error;
mod evaluate;
mod function;
mod grid;
mod log_series;
mod nearest;
mod over_time;
mod parse;
mod samples;
mod syntax;
mod token;
mod tree;

pub use complete::{Completion, NameCandidate, complete};
pub use error::{ExpressionError, Trouble};
pub use function::{FUNCTIONS, Function, FunctionInfo};
pub use samples::{SeriesSource, TimedSamples};
pub use syntax::Expression;
pub use token::written;

#[cfg(test)]
mod tests;
