//! The linter in the place of the compiler: it compiles as the compiler does, and lints on the way, for a tenth of the
//! time that a pass of its own takes. Documentation is made on the way, too.
//!
//! What the two build, cargo keeps apart. So this is done where nobody sits at the terminal: who edits and tests a
//! crate by hand shall find it built by the compiler already.

use std::{
    collections::BTreeSet,
    path::PathBuf,
    process::{Command, Stdio},
};

use serde_json::Value;

use super::{documented::LINTER, install::ensure_component};
use crate::{
    failure::Failure,
    process::{CARGO_ADVICE, capture, cargo, is_automatic, program, succeed},
};

/// Cargo with `arguments` for what is built natively: by the linter where nobody sits at the terminal.
pub fn native_cargo(arguments: &[&str]) -> Result<Command, Failure> {
    let mut command = cargo(arguments);
    if is_automatic() {
        let own = std::env::current_exe().map_err(Failure::file("this program"))?;
        command.env("RUSTC_WORKSPACE_WRAPPER", own);
        command.env(LINTER, linter()?);
    }
    Ok(command)
}

/// The linter of the compiler that is in use.
fn linter() -> Result<PathBuf, Failure> {
    ensure_component("clippy", "clippy")?;
    let mut ask = program("rustc");
    let output = capture(ask.args(["--print", "sysroot"]), CARGO_ADVICE)?;
    succeed(&ask, output.status)?;
    let sysroot = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
    let name = format!("clippy-driver{}", std::env::consts::EXE_SUFFIX);
    Ok(sysroot.join("bin").join(name))
}

/// Builds the test programs and examples of what `arguments` choose by the linter, which must have nothing to say.
pub fn check(arguments: &[&str]) -> Result<(), Failure> {
    let mut build = native_cargo(&["test", "--no-run", "--message-format=json"])?;
    build.args(arguments).stderr(Stdio::inherit());
    let output = capture(&mut build, CARGO_ADVICE)?;
    let told = diagnostics(&String::from_utf8_lossy(&output.stdout));
    for diagnostic in &told {
        eprintln!("{diagnostic}");
    }
    succeed(&build, output.status)?;
    match told.len() {
        0 => Ok(()),
        count => Err(Failure::Check(format!("lints: {count}"))),
    }
}

/// What the compiler and the linter say in cargo's messages, each once: a library is built for others and for its own
/// tests.
fn diagnostics(messages: &str) -> BTreeSet<String> {
    let rendered = |line: &str| {
        let message: Value = serde_json::from_str(line).ok()?;
        let told = message["reason"] == "compiler-message";
        // The last one only counts the others.
        let is_placed = message["message"]["spans"]
            .as_array()
            .is_some_and(|spans| !spans.is_empty());
        let text = message["message"]["rendered"].as_str();
        text.filter(|_| told && is_placed).map(str::to_owned)
    };
    messages.lines().filter_map(rendered).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_lint_is_told_once_and_the_count_of_them_is_none() {
        let lint = r#"{"reason":"compiler-message","message":{"level":"warning","spans":[{"line_start":3}],"rendered":"warning: unused `x`"}}"#;
        let count = r#"{"reason":"compiler-message","message":{"level":"warning","spans":[],"rendered":"warning: 1 warning emitted"}}"#;
        let built = r#"{"reason":"compiler-artifact","profile":{"test":true}}"#;
        let messages = [lint, built, count, lint].join("\n");
        let told: Vec<_> = diagnostics(&messages).into_iter().collect();
        assert_eq!(told, ["warning: unused `x`"]);
        assert!(diagnostics(built).is_empty());
    }
}
