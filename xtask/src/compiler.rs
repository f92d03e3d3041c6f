//! The program that cargo runs in the place of the compiler where nobody sits at the terminal, so that each crate is compiled, linted
//! and documented in one go: passes of their own would each ask for all dependencies in another form, which takes longer
//! than they themselves.
//!
//! Natively it is the linter that compiles, and rustdoc runs after it. The page is compiled by the compiler, since the
//! linter's code is another one, and may not say a word; the linter looks after it at what the page has in another
//! form than the native programs (`page_form.rs`). What cargo builds in this way it keeps apart from what it builds
//! else: who edits and tests a crate by hand shall find that built by the compiler already.

use std::{
    ffi::OsString,
    fs,
    io::ErrorKind,
    path::{Path, PathBuf},
    process::{Command, ExitCode},
};

use crate::{
    built,
    failure::Failure,
    page_form::has_own_form,
    process::{CARGO_ADVICE, capture, cargo, is_automatic, program, run, succeed, succeeds},
};

/// Names the linter; where it is set, this program is the compiler.
pub const LINTER: &str = "PILOTAGE_LINTER";

/// A pass over a crate after it was compiled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CompilerPass {
    /// Documentation of what is built natively.
    Documentation,
    /// Lints of what the page is built from.
    PageLints,
}

impl CompilerPass {
    /// Folder of the texts that it says of each crate.
    fn folder(self) -> PathBuf {
        built::target().join(match self {
            Self::Documentation => "documented",
            Self::PageLints => "linted-page",
        })
    }

    /// Text that it said of a crate when that was compiled last; `None` of one that was not.
    pub fn said(self, name: &str) -> Option<String> {
        fs::read_to_string(self.folder().join(format!("{name}.txt"))).ok()
    }

    /// Forgets what it said of a crate that it has nothing to say about any more.
    fn forget(self, name: &str) -> Result<(), Failure> {
        let file = self.folder().join(format!("{name}.txt"));
        match fs::remove_file(&file) {
            Err(error) if error.kind() != ErrorKind::NotFound => Err(Failure::file(&file)(error)),
            _ => Ok(()),
        }
    }

    /// Texts that it said of all crates that were compiled.
    pub fn all_said(self) -> Result<Vec<String>, Failure> {
        let folder = self.folder();
        let files = fs::read_dir(&folder).map_err(Failure::file(&folder))?;
        let names = files.filter_map(|file| file.ok()?.file_name().into_string().ok());
        let names = names.filter_map(|name| Some(name.strip_suffix(".txt")?.to_owned()));
        Ok(names.filter_map(|name| self.said(&name)).collect())
    }
}

/// Has rustup bring `component`, without which cargo lacks `command`.
pub fn ensure_component(component: &str, command: &str) -> Result<(), Failure> {
    if succeeds(&mut cargo(&[command, "--version"])) {
        return Ok(());
    }
    let mut rustup = program("rustup");
    rustup.args(["component", "add", component]);
    run(&mut rustup, "install Rust with rustup (https://rustup.rs)")
}

/// Has `cargo` compile by this program where nobody sits at the terminal.
pub fn take_place(cargo: &mut Command) -> Result<(), Failure> {
    if is_automatic() {
        let own = std::env::current_exe().map_err(Failure::file("this program"))?;
        cargo.env("RUSTC_WORKSPACE_WRAPPER", own);
        // Asking cargo where that is takes longer than some crates.
        cargo.env("CARGO_TARGET_DIR", built::target());
        cargo.env(LINTER, linter()?);
    }
    Ok(())
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

/// Compiles as `arguments` say, of which the first is the compiler, and looks at the crate in the other ways.
pub fn compile(linter: &OsString, arguments: &[OsString]) -> ExitCode {
    let is_page = arguments.iter().any(|argument| argument == "--target");
    let compiled = match arguments.split_first() {
        Some((compiler, others)) if is_page => {
            let mut compiler = Command::new(compiler);
            compiler.args(others).args(["-D", "warnings"]).status()
        }
        _ => Command::new(linter).args(arguments).status(),
    };
    if !compiled.is_ok_and(|status| status.success()) {
        return ExitCode::FAILURE;
    }
    let texts: Vec<String> = arguments
        .iter()
        .map(|argument| argument.to_string_lossy().into_owned())
        .collect();
    let passed = of_compiler(&texts).map(|(name, options)| {
        if !is_page {
            return document(&name, &options);
        }
        if has_own_form(&options)? {
            lint_page(linter, &name, &options)?;
        } else {
            CompilerPass::PageLints.forget(&name)?;
        }
        // Programs of the page are compiled for it only.
        if is_of_type(&options, "cdylib") {
            return document(&name, &options);
        }
        Ok(())
    });
    match passed {
        Some(Err(failure)) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Name of the crate and arguments but for where and how to write, where the compiler is told to make something that other
/// passes look at: no test, example or build script.
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
            // Of paths that the page would tell, which a pass over it does not write: rustdoc calls it unstable.
            "--remap-path-prefix=",
        ];
        if !ours.iter().any(|start| argument.starts_with(start)) {
            options.push(argument.clone());
        }
    }
    Some((name, options))
}

fn is_of_type(options: &[String], kind: &str) -> bool {
    options
        .windows(2)
        .any(|pair| pair == ["--crate-type", kind])
}

fn document(name: &str, options: &[String]) -> Result<(), Failure> {
    let mut rustdoc = Command::new("rustdoc");
    rustdoc.args(options).args(["-D", "warnings", "--out-dir"]);
    rustdoc.arg(CompilerPass::Documentation.folder().join("pages"));
    if options
        .windows(2)
        .any(|pair| pair == ["--crate-type", "bin"])
    {
        rustdoc.arg("--document-private-items");
    }
    keep(CompilerPass::Documentation, name, &mut rustdoc)
}

fn lint_page(linter: &OsString, name: &str, options: &[String]) -> Result<(), Failure> {
    let mut lint = Command::new(linter);
    lint.arg("rustc").args(options);
    lint.args(["--emit=metadata", "--out-dir"]);
    lint.arg(CompilerPass::PageLints.folder().join("metadata"));
    keep(CompilerPass::PageLints, name, &mut lint)
}

/// Runs a pass and keeps what it says.
fn keep(pass: CompilerPass, name: &str, command: &mut Command) -> Result<(), Failure> {
    let folder = pass.folder();
    fs::create_dir_all(&folder).map_err(Failure::file(&folder))?;
    let output = capture(command, "it came with rustup")?;
    let mut said = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() && said.is_empty() {
        said = format!("{name}: the pass failed ({})\n", output.status);
    }
    let file = folder.join(format!("{name}.txt"));
    fs::write(&file, said).map_err(Failure::file(&file))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(line: &str) -> Vec<String> {
        line.split(' ').map(str::to_owned).collect()
    }

    #[test]
    fn passes_are_told_what_the_compiler_is_told_but_where_and_how_to_write() {
        let line = "rustc --crate-name pilotage --edition=2024 crates/cli/src/main.rs --error-format=json --crate-type bin --emit=dep-info,link -C opt-level=1 --out-dir target/deps --extern a=liba.rlib --remap-path-prefix=/index=";
        let (name, options) = of_compiler(&words(line)).unwrap();
        assert_eq!(name, "pilotage");
        assert_eq!(
            options.join(" "),
            "--crate-name pilotage --edition=2024 crates/cli/src/main.rs --crate-type bin -C opt-level=1 --extern a=liba.rlib"
        );
    }

    #[test]
    fn tests_examples_scripts_and_questions_are_not_looked_at() {
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
