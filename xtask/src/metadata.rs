//! The packages, as `cargo metadata` lists them.

use serde_json::Value;

use crate::{
    failure::Failure,
    places,
    process::{capture, cargo, succeed},
};

/// The packages of the dependency graph, or those of this repository alone, as cargo describes each.
pub fn packages(with_dependencies: bool) -> Result<Vec<Value>, Failure> {
    let mut metadata = cargo(&["metadata", "--locked", "--format-version", "1"]);
    if !with_dependencies {
        metadata.arg("--no-deps");
    }
    metadata.stderr(std::process::Stdio::inherit());
    let output = capture(&mut metadata, "cargo came with rustup")?;
    succeed(&metadata, output.status)?;
    let unreadable = |reason: String| Failure::Content {
        path: places::root().join("Cargo.lock"),
        reason,
    };
    let graph: Value =
        serde_json::from_slice(&output.stdout).map_err(|error| unreadable(error.to_string()))?;
    match graph["packages"].as_array() {
        Some(packages) => Ok(packages.clone()),
        None => Err(unreadable("cargo lists no packages".to_owned())),
    }
}
