//! Small simulations behind lessons: what several of them share.

mod bell;
mod normal_numbers;
mod route_belief;

pub use bell::bell;
pub use normal_numbers::normal_numbers;
pub use route_belief::{RouteBelief, SPEED};
