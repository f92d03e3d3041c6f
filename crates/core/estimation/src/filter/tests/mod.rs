//! The filter against mathematics it must reproduce.

mod consistency;
mod estimators;
mod invariants;
mod linear;
mod robustness;
mod table_3;
