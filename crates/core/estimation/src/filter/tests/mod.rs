//! The filter against mathematics it must reproduce.

mod estimators;
mod honesty;
mod invariants;
mod linear;
mod robustness;
mod table_3;
