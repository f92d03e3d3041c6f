//! Small simulations behind lessons: what several of them share.

mod bell;

pub use bell::bell;
