//! Lints told while compiling (`compiler.rs`): a tenth of the time that a pass of their own takes.

use std::{
    collections::BTreeSet,
    process::{Command, Stdio},
};

use serde_json::Value;

use crate::{
    compiler::{self, CompilerPass},
    failure::Failure,
    page::{self, PROGRAMS, Profile},
    process::{CARGO_ADVICE, capture, cargo, succeed},
};

/// Cargo with `arguments` for what is built natively.
pub fn native_cargo(arguments: &[&str]) -> Result<Command, Failure> {
    let mut command = cargo(arguments);
    compiler::take_place(&mut command)?;
    Ok(command)
}

/// Builds the test programs and examples of what `arguments` choose by the linter, which must have nothing to say.
pub fn check(arguments: &[&str]) -> Result<(), Failure> {
    compile(&[&["test", "--no-run"], arguments].concat()).map(drop)
}

/// Has cargo compile as `arguments` say, by the linter where that takes the compiler's place; neither must have anything
/// to say. Its messages.
pub fn compile(arguments: &[&str]) -> Result<String, Failure> {
    let mut build = native_cargo(arguments)?;
    build.arg("--message-format=json").stderr(Stdio::inherit());
    let output = capture(&mut build, CARGO_ADVICE)?;
    let messages = String::from_utf8_lossy(&output.stdout).into_owned();
    let judged = judge(&diagnostics(&messages));
    succeed(&build, output.status)?;
    judged.map(|()| messages)
}

/// Compiles the programs of the page, of which the linter must have nothing to say.
pub fn check_page() -> Result<(), Failure> {
    page::compile(Profile::Quick)?;
    let missing = PROGRAMS.map(|name| name.replace('-', "_"));
    if let Some(name) = missing
        .iter()
        .find(|name| CompilerPass::PageLints.said(name).is_none())
    {
        return Err(Failure::Check(format!("{name} was not linted")));
    }
    let said = CompilerPass::PageLints.all_said()?;
    judge(&said.into_iter().filter(|said| !said.is_empty()).collect())
}

/// Prints what was said, which must be nothing.
fn judge(told: &BTreeSet<String>) -> Result<(), Failure> {
    for diagnostic in told {
        eprintln!("{diagnostic}");
    }
    match told.len() {
        0 => Ok(()),
        count => Err(Failure::Check(format!("lints: {count}"))),
    }
}

/// Texts of the compiler and the linter in cargo's messages, each once: a library is built for others and for its own
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
