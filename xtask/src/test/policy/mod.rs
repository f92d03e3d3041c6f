//! Policy on the project's dependencies: licences, banned crates, sources, as `deny.toml` states them.
//!
//! `cargo deny` reads the same file and is used where it is installed. Building it takes longer
//! than all our own code, so elsewhere the same three questions are answered here, from
//! `cargo metadata`.

mod packages;
mod rules;

use std::fs;

use crate::{
    failure::Failure,
    places,
    process::{cargo, on_path, run},
};
use rules::Rules;

/// Every dependency keeps to `deny.toml`.
pub fn check() -> Result<(), Failure> {
    if on_path(&["cargo-deny"]).is_some() {
        let arguments = ["deny", "--locked", "check", "licenses", "bans", "sources"];
        return run(&mut cargo(&arguments), "cargo-deny was found a moment ago");
    }
    let file = places::root().join("deny.toml");
    let text = fs::read_to_string(&file).map_err(Failure::file(&file))?;
    let rules = Rules::read(&text).map_err(|reason| Failure::Content {
        path: file.clone(),
        reason,
    })?;
    let packages = packages::all()?;
    let complaints: Vec<_> = packages
        .iter()
        .flat_map(|package| rules.complaints(package))
        .collect();
    let doubles = packages::in_several_versions(&packages);
    println!(
        "{} packages; in several versions: {}",
        packages.len(),
        doubles.join(", ")
    );
    if complaints.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(complaints.join("\n")))
    }
}
