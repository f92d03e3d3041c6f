//! Documentation made while compiling: what cargo runs in the place of the compiler where nobody sits at the terminal.
//!
//! It runs the linter, which compiles, and then rustdoc with the same libraries. `cargo doc` would ask for all
//! dependencies in another form, which takes twice as long as the documentation.

use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
    process::{Command, ExitCode},
};

use crate::{failure::Failure, metadata, places, process::capture};

/// The linter that is run in the place of the compiler; where it is set, this program is the compiler.
pub const LINTER: &str = "PILOTAGE_LINTER";

/// Where what rustdoc says of each crate is kept.
fn told() -> PathBuf {
    places::target().join("documented")
}

/// Compiles and documents as `arguments` say, of which the first is the compiler.
pub fn compile(linter: &OsString, arguments: &[OsString]) -> ExitCode {
    let status = Command::new(linter).args(arguments).status();
    if !status.is_ok_and(|status| status.success()) {
        return ExitCode::FAILURE;
    }
    let texts: Vec<String> = arguments
        .iter()
        .map(|argument| argument.to_string_lossy().into_owned())
        .collect();
    // What cannot be written is missed by the check.
    let documented = of_compiler(&texts).map(|(name, options)| document(&name, &options));
    match documented {
        Some(Err(failure)) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Name of the crate and arguments of rustdoc where the compiler is told to make something that is documented: no
/// test, example or build script.
fn of_compiler(arguments: &[String]) -> Option<(String, Vec<String>)> {
    let value = |name: &str| {
        let place = arguments.iter().position(|argument| argument == name)?;
        arguments.get(place + 1)
    };
    let name = value("--crate-name")?.clone();
    let is_source = |argument: &&String| Path::new(argument).extension().is_some_and(|e| e == "rs");
    let source = arguments.iter().find(is_source)?;
    let is_example = Path::new(source)
        .components()
        .any(|c| c.as_os_str() == "examples");
    if is_example || name == "build_script_build" || arguments.iter().any(|a| a == "--test") {
        return None;
    }
    let mut options = Vec::new();
    let mut left = arguments.iter().skip(1);
    while let Some(argument) = left.next() {
        if argument == "--out-dir" {
            left.next();
            continue;
        }
        let ours = [
            "--emit=",
            "--error-format=",
            "--json=",
            "--diagnostic-width=",
        ];
        if !ours.iter().any(|start| argument.starts_with(start)) {
            options.push(argument.clone());
        }
    }
    if value("--crate-type").is_some_and(|kind| kind == "bin") {
        options.push("--document-private-items".to_owned());
    }
    Some((name, options))
}

fn document(name: &str, options: &[String]) -> Result<(), Failure> {
    let folder = told();
    fs::create_dir_all(&folder).map_err(Failure::file(&folder))?;
    let mut rustdoc = Command::new("rustdoc");
    rustdoc.args(options).args(["-D", "warnings", "--out-dir"]);
    let output = capture(
        rustdoc.arg(folder.join("pages")),
        "rustdoc came with rustup",
    )?;
    let mut said = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() && said.is_empty() {
        said = format!("rustdoc failed ({})\n", output.status);
    }
    let file = folder.join(format!("{name}.txt"));
    fs::write(&file, said).map_err(Failure::file(&file))
}

/// Whether everything that was compiled of the packages that `are_asked_for` is documented without a word.
pub fn check(are_asked_for: impl Fn(&str) -> bool) -> Result<(), Failure> {
    let mut wrong = Vec::new();
    for package in metadata::packages(false)? {
        if !package["name"].as_str().is_some_and(&are_asked_for) {
            continue;
        }
        let targets = package["targets"].as_array().into_iter().flatten();
        for target in targets.filter(|target| is_documented(&target["kind"])) {
            let name = target["name"]
                .as_str()
                .unwrap_or_default()
                .replace('-', "_");
            match fs::read_to_string(told().join(format!("{name}.txt"))) {
                Ok(said) if said.is_empty() => {}
                Ok(said) => {
                    eprintln!("{said}");
                    wrong.push(name);
                }
                Err(_) => wrong.push(format!("{name} (was not compiled)")),
            }
        }
    }
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!(
            "documentation of {}",
            wrong.join(", ")
        )))
    }
}

fn is_documented(kinds: &serde_json::Value) -> bool {
    let kinds = kinds.as_array().into_iter().flatten();
    let documented = ["lib", "rlib", "cdylib", "bin"];
    kinds
        .filter_map(|kind| kind.as_str())
        .any(|kind| documented.contains(&kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn rustdoc_is_told_what_the_compiler_is_told_but_where_and_how_to_write() {
        let line = "rustc --crate-name pilotage --edition=2024 crates/cli/src/main.rs --error-format=json --crate-type bin --emit=dep-info,link -C opt-level=1 --out-dir target/deps --extern a=liba.rlib";
        let (name, options) = of_compiler(&words(line)).unwrap();
        assert_eq!(name, "pilotage");
        assert_eq!(
            options.join(" "),
            "--crate-name pilotage --edition=2024 crates/cli/src/main.rs --crate-type bin -C opt-level=1 --extern a=liba.rlib --document-private-items"
        );
    }

    #[test]
    fn tests_examples_scripts_and_questions_are_not_documented() {
        for line in [
            "rustc --crate-name a src/lib.rs --test",
            "rustc --crate-name topics examples/topics.rs --crate-type bin",
            "rustc --crate-name build_script_build build.rs --crate-type bin",
            "rustc -vV",
            "rustc - --crate-name ___ --print=file-names",
        ] {
            assert_eq!(of_compiler(&words(line)), None, "{line}");
        }
    }
}
