//! Studies: one question over many seeds, for the figures in docs/results.md. The everyday run asks it over a
//! few of them and notices when an answer goes.
//!
//! The method's crates, which must not depend on this one, take this file into their tests by its path.

/// The variable by which `cargo xtask test --studies` asks for studies in full.
const VARIABLE: &str = "PILOTAGE_STUDIES";

/// `full` in a study, `quick` in the everyday run.
pub fn either<T>(quick: T, full: T) -> T {
    if std::env::var_os(VARIABLE).is_some() {
        full
    } else {
        quick
    }
}
