//! Distributions behind gates and intervals.

mod chi_square;
mod circle;
mod words;

pub use chi_square::{chi_square_probability, chi_square_quantile, normal_probability};
pub use circle::circle_radius;
pub use words::probability_words;
