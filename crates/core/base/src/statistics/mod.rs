//! Distributions behind gates and intervals, and quantiles of samples.

mod chi_square;
mod circle;
mod quantile;
mod ranks;
mod words;

pub use chi_square::{chi_square_probability, chi_square_quantile, normal_probability};
pub use circle::circle_radius;
pub use quantile::{nearest_sample, quantile};
pub use ranks::quantile_ranks;
pub use words::probability_words;
