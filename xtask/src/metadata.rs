//! The packages, as `cargo metadata` lists them.

use std::path::PathBuf;

use serde_json::Value;

use crate::{
    failure::Failure,
    places,
    process::{capture, cargo, succeed},
};

/// The packages of the dependency graph, or those of this repository alone, as cargo describes each.
pub fn packages(with_dependencies: bool) -> Result<Vec<Value>, Failure> {
    match workspace(with_dependencies)?["packages"].as_array() {
        Some(packages) => Ok(packages.clone()),
        None => Err(unreadable("cargo lists no packages")),
    }
}

/// Folder into which cargo builds, if it tells.
pub fn target() -> Option<PathBuf> {
    let told = workspace(false).ok()?;
    Some(PathBuf::from(told["target_directory"].as_str()?))
}

/// All that cargo tells of the repository.
fn workspace(with_dependencies: bool) -> Result<Value, Failure> {
    let mut metadata = cargo(&["metadata", "--locked", "--format-version", "1"]);
    if !with_dependencies {
        metadata.arg("--no-deps");
    }
    metadata.stderr(std::process::Stdio::inherit());
    let output = capture(&mut metadata, "cargo came with rustup")?;
    succeed(&metadata, output.status)?;
    serde_json::from_slice(&output.stdout).map_err(|error| unreadable(error.to_string()))
}

fn unreadable(reason: impl Into<String>) -> Failure {
    Failure::Content {
        path: places::root().join("Cargo.lock"),
        reason: reason.into(),
    }
}
