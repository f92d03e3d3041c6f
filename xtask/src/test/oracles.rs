//! The tests that ask other people's programs (`tests/tests/oracles/` and the like).

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::{Mutex, PoisonError},
};

use super::{
    install,
    native::PACKAGES,
    program::CheckProgram,
    programs::{self, Manner},
};
use crate::{
    built,
    failure::Failure,
    places,
    process::{on_path, program, run, succeeds},
};

/// Oldest Python that has the pinned versions.
const IS_USABLE: &str = "import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 11))";

/// Prepares the interpreter and runs the tests; a test that skips is a failure here.
pub fn check() -> Result<(), Failure> {
    let python = interpreter()?;
    let python = python.to_string_lossy();
    let arguments = [&PACKAGES[..], &["--test", "oracle*"]].concat();
    let manner = Manner::default().asking(&python);
    programs::test(&arguments, &manner, false, &|_| Vec::new())?.judge(CheckProgram::asks_oracles)
}

/// Times that it is tried to make the interpreter: a network may fail for a while, and each try takes minutes where
/// there is none.
const TRIES: usize = 2;

/// The Python of `target/oracles`, with everything in `tests/oracles/requirements.txt`; made if it is not there.
pub fn interpreter() -> Result<PathBuf, Failure> {
    static FAILED: Mutex<Vec<String>> = Mutex::new(Vec::new());
    let mut failed = FAILED.lock().unwrap_or_else(PoisonError::into_inner);
    if failed.len() >= TRIES {
        return Err(Failure::Check(failed.join("; ")));
    }
    let made = made_interpreter();
    if let Err(failure) = &made {
        failed.push(failure.to_string());
    }
    made
}

fn made_interpreter() -> Result<PathBuf, Failure> {
    let home = built::target().join("oracles");
    let python = home.join(if cfg!(windows) {
        "Scripts/python.exe"
    } else {
        "bin/python"
    });
    let wanted_file = places::root().join("tests/oracles/requirements.txt");
    let wanted = fs::read(&wanted_file).map_err(Failure::file(&wanted_file))?;
    let installed_file = home.join("installed.txt");
    let is_ready = fs::read(&installed_file).is_ok_and(|installed| installed == wanted)
        && succeeds(program(&python).args(["-c", "import sys"]));
    if is_ready {
        return Ok(python);
    }
    println!("installing the oracles into {} …", home.display());
    let advice = "Python 3.11 or newer with venv";
    run(
        program(system_python()?)
            .args(["-m", "venv", "--clear"])
            .arg(&home),
        advice,
    )?;
    // The list is complete: what a program merely could use beside is not needed here.
    run(
        pip(&python).args(["--no-deps", "-r"]).arg(&wanted_file),
        advice,
    )?;
    fs::write(&installed_file, wanted).map_err(Failure::file(&installed_file))?;
    Ok(python)
}

fn pip(python: &Path) -> Command {
    let mut pip = program(python);
    pip.args([
        "-m",
        "pip",
        "install",
        "--disable-pip-version-check",
        "--quiet",
        "--no-input",
    ]);
    pip
}

/// A Python of the system that can make environments; installs Debian's if it may.
fn system_python() -> Result<PathBuf, Failure> {
    let find = || {
        [
            "python3",
            "python3.13",
            "python3.12",
            "python3.11",
            "python",
        ]
        .iter()
        .filter_map(|name| on_path(&[name]))
        .find(|python| succeeds(program(python).args(["-c", IS_USABLE])))
    };
    if let Some(python) = find() {
        return Ok(python);
    }
    install::debian_packages(&["python3", "python3-venv"]);
    find().ok_or_else(|| Failure::Missing {
        program: "Python 3.11 or newer with venv",
        advice: "install it (Debian and Ubuntu: `apt-get install python3 python3-venv`)".to_owned(),
    })
}
