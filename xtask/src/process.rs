//! Running other programs.

use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
    process::{Command, ExitStatus, Output, Stdio},
};

use crate::{failure::Failure, places};

/// `program`, to be run at the root of the repository, without anything to type.
pub fn program(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new(program);
    command.current_dir(places::root()).stdin(Stdio::null());
    command
}

/// Advice where there is no cargo.
pub const CARGO_ADVICE: &str = "cargo came with rustup";

/// Cargo with `arguments`, as if it had been typed at a terminal.
///
/// What the cargo that runs this program has set for it is taken away again: with it, build
/// scripts would see another environment than under a plain `cargo build` and run once more.
pub fn cargo(arguments: &[&str]) -> Command {
    let mut command = program(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let set_for_us = |name: &str| {
        name.starts_with("CARGO_PKG_")
            || name.starts_with("CARGO_MANIFEST_")
            || matches!(
                name,
                "CARGO_BIN_NAME" | "CARGO_CRATE_NAME" | "CARGO_PRIMARY_PACKAGE"
            )
    };
    for (name, _) in std::env::vars_os() {
        if name.to_str().is_some_and(set_for_us) {
            command.env_remove(name);
        }
    }
    if is_automatic() {
        // Nothing is built twice there, and nobody looks into a debugger; what both take would only cost time.
        command.env("CARGO_INCREMENTAL", "0");
        command.env("CARGO_PROFILE_DEV_DEBUG", "false");
        // Several pieces of a crate cost a tenth more work: there are always other crates to be compiled beside it.
        command.env("CARGO_PROFILE_DEV_CODEGEN_UNITS", "1");
    }
    command.args(arguments);
    command
}

/// Whether nobody sits at the terminal.
pub fn is_automatic() -> bool {
    std::env::var_os("CI").is_some_and(|value| !value.is_empty() && value != "false")
}

/// Runs `command` with its output on the terminal; `advice` says what to do if it cannot start.
pub fn run(command: &mut Command, advice: &str) -> Result<(), Failure> {
    let status = command
        .status()
        .map_err(|source| cannot_start(command, source, advice))?;
    succeed(command, status)
}

/// Runs `command` and keeps its output.
pub fn capture(command: &mut Command, advice: &str) -> Result<Output, Failure> {
    command
        .output()
        .map_err(|source| cannot_start(command, source, advice))
}

/// Whether `command` starts and succeeds; its output is dropped.
pub fn succeeds(command: &mut Command) -> bool {
    let silent = command.stdout(Stdio::null()).stderr(Stdio::null());
    silent.status().is_ok_and(|status| status.success())
}

/// Turns a bad end of `command` into a failure.
pub fn succeed(command: &Command, status: ExitStatus) -> Result<(), Failure> {
    if status.success() {
        Ok(())
    } else {
        Err(Failure::Command {
            command: line(command),
            status,
        })
    }
}

/// Ends that the name of a program has in its file.
const PROGRAM_ENDINGS: &[&str] = if cfg!(windows) {
    &[".exe", ".cmd", ".bat"]
} else {
    &[""]
};

/// First of `names` that is a file in a folder of `PATH`.
pub fn on_path(names: &[&str]) -> Option<PathBuf> {
    let folders: Vec<_> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    let file_in = |name: &str| {
        folders
            .iter()
            .flat_map(|folder| {
                PROGRAM_ENDINGS
                    .iter()
                    .map(move |end| folder.join(format!("{name}{end}")))
            })
            .find(|it| it.is_file())
    };
    names.iter().find_map(|name| file_in(name))
}

fn cannot_start(command: &Command, source: std::io::Error, advice: &str) -> Failure {
    Failure::Start {
        command: line(command),
        source,
        advice: advice.to_owned(),
    }
}

/// The command as one would type it, with the program's name alone.
fn line(command: &Command) -> String {
    let name = Path::new(command.get_program())
        .file_name()
        .unwrap_or(command.get_program());
    let words = std::iter::once(name).chain(command.get_args());
    words
        .map(OsStr::to_string_lossy)
        .collect::<Vec<_>>()
        .join(" ")
}
