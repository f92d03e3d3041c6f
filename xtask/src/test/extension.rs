//! The extension that Python loads, which `cargo test` does not build: it has no test program.

use std::path::PathBuf;

use serde_json::Value;

use super::linted;
use crate::failure::Failure;

/// The package of the extension.
pub const PACKAGE: &str = "pilotage-python";
/// Name of its library.
const LIBRARY: &str = "pilotage_python";

/// Builds the extension in the profile of the native tests, by the linter where that compiles. The library's file.
pub fn build() -> Result<PathBuf, Failure> {
    let messages = linted::compile(&["build", "--locked", "-p", PACKAGE])?;
    messages.lines().find_map(of_message).ok_or_else(|| {
        Failure::Check(format!(
            "cargo names no file of {PACKAGE} that Python loads"
        ))
    })
}

/// The extension that a message of cargo tells of.
fn of_message(line: &str) -> Option<PathBuf> {
    let message: Value = serde_json::from_str(line).ok()?;
    let target = &message["target"];
    let is_it = target["name"] == LIBRARY && target["kind"][0] == "cdylib";
    let file = message["filenames"][0].as_str().filter(|_| is_it)?;
    Some(PathBuf::from(file))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn the_extension_is_learnt_from_what_cargo_says() {
        let line = r#"{"reason":"compiler-artifact","target":{"kind":["cdylib"],"name":"pilotage_python"},"filenames":["/r/target/debug/libpilotage_python.so"],"executable":null}"#;
        let file = of_message(line);
        assert_eq!(
            file.as_deref(),
            Some(Path::new("/r/target/debug/libpilotage_python.so"))
        );
        for other in [
            line.replace("\"pilotage_python\"", "\"pilotage_core\""),
            line.replace("cdylib", "lib"),
            String::new(),
        ] {
            assert_eq!(of_message(&other), None, "{other}");
        }
    }
}
