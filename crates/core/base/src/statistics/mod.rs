//! Distributions behind gates and intervals.

mod chi_square;
mod words;

pub use chi_square::{chi_square_probability, chi_square_quantile, normal_probability};
pub use words::probability_words;
