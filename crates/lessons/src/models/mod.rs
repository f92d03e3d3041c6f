//! Small simulations behind lessons: what several of them share.

mod bell;
mod normal_numbers;

pub use bell::bell;
pub use normal_numbers::normal_numbers;
