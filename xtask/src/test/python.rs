//! The package for Python: its extension built as the native tests are, and its own tests over it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use super::{
    extension, linted,
    native::PACKAGES,
    oracles,
    program::{CheckProgram, terminal},
    programs,
};
use crate::{built, failure::Failure, places};

/// Name of the package's tests among other programs.
const TESTS: &str = "pilotage-python/pytest";

/// Name of the extension within the package, whichever Python loads it.
const EXTENSION: &str = if cfg!(windows) {
    "_native.pyd"
} else {
    "_native.abi3.so"
};

/// Runs the package's tests.
pub fn check() -> Result<(), Failure> {
    let tests = tests(&built_terminal()?, &oracles::interpreter()?)?;
    programs::run(tests)
}

/// Whether `one` are the package's tests.
pub fn are_tests(one: &CheckProgram) -> bool {
    one.name == TESTS
}

/// Builds the package, puts it together under cargo's folder and tells how its tests are run, which ask other people's
/// programs too: by the interpreter `python` that has them, beside `terminal`.
pub fn tests(terminal: &Path, python: &Path) -> Result<CheckProgram, Failure> {
    let library = extension::build()?;
    let package = built::target().join("python");
    put_together(
        &sources().join("python/pilotage"),
        &package.join("pilotage"),
        &library,
    )?;
    Ok(tests_over(&package, terminal, python))
}

/// The tests over the package that is put together in `package`.
fn tests_over(package: &Path, terminal: &Path, python: &Path) -> CheckProgram {
    let words = ["-m", "pytest", "-q", "-p", "no:cacheprovider"];
    CheckProgram {
        name: TESTS.to_owned(),
        executable: python.to_owned(),
        folder: sources(),
        arguments: words.map(ToOwned::to_owned).into(),
        environment: vec![
            ("PYTHONPATH", package.into()),
            ("PYTHONDONTWRITEBYTECODE", "1".into()),
            ("PILOTAGE_PROGRAM", terminal.into()),
        ],
    }
}

/// The folder of the package.
fn sources() -> PathBuf {
    places::root().join("python/pilotage")
}

/// The program of the terminal, beside which the tests hold the package, as the native tests have it.
fn built_terminal() -> Result<PathBuf, Failure> {
    let arguments = [
        &["test", "--no-run"],
        &PACKAGES[..],
        &["--test", "commands"],
    ]
    .concat();
    let messages = linted::compile(&arguments)?;
    let program = terminal(&messages).map(|program| program.executable);
    program.ok_or_else(|| Failure::Check("cargo names no program `pilotage`".to_owned()))
}

/// Copies the files of Python from `sources` to `package`, and the extension beside them.
fn put_together(sources: &Path, package: &Path, extension: &Path) -> Result<(), Failure> {
    if package.exists() {
        fs::remove_dir_all(package).map_err(Failure::file(package))?;
    }
    fs::create_dir_all(package).map_err(Failure::file(package))?;
    let files = fs::read_dir(sources).map_err(Failure::file(sources))?;
    for file in files.flatten().map(|file| file.path()) {
        let Some(name) = file.file_name().filter(|_| file.is_file()) else {
            continue;
        };
        // Built in place by maturin: of another build than this one.
        let is_extension = name.to_string_lossy().starts_with("_native.") && !is_text(&file);
        if !is_extension {
            fs::copy(&file, package.join(name)).map_err(Failure::file(&file))?;
        }
    }
    let place = package.join(EXTENSION);
    fs::copy(extension, &place).map_err(Failure::file(extension))?;
    Ok(())
}

fn is_text(file: &Path) -> bool {
    file.extension().is_some_and(|ending| ending == "pyi")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_package_is_tested_beside_the_terminal_that_was_built() {
        let tests = tests_over(
            Path::new("/p/package"),
            Path::new("/p/pilotage"),
            Path::new("/p/python"),
        );
        assert!(are_tests(&tests) && !tests.asks_oracles());
        assert_eq!(tests.executable, Path::new("/p/python"));
        let found = |name: &str| {
            let mut variables = tests.environment.iter();
            variables
                .find(|(other, _)| *other == name)
                .map(|(_, value)| value.as_os_str())
        };
        assert_eq!(found("PYTHONPATH"), Some("/p/package".as_ref()));
        assert_eq!(found("PILOTAGE_PROGRAM"), Some("/p/pilotage".as_ref()));
    }

    #[test]
    fn the_package_has_its_files_and_the_extension_of_this_build_only() {
        let folder = std::env::temp_dir().join(format!("pilotage-package-{}", std::process::id()));
        let sources = folder.join("sources");
        fs::create_dir_all(&sources).unwrap();
        for name in ["__init__.py", "_native.pyi", "_native.abi3.so"] {
            fs::write(sources.join(name), "old").unwrap();
        }
        let extension = folder.join("libpilotage_python.so");
        fs::write(&extension, "new").unwrap();
        let package = folder.join("package");
        for _ in 0..2 {
            put_together(&sources, &package, &extension).unwrap();
        }
        let text = |name: &str| fs::read_to_string(package.join(name)).unwrap();
        assert_eq!(text("__init__.py") + &text("_native.pyi"), "oldold");
        assert_eq!(text(EXTENSION), "new");
        assert_eq!(fs::read_dir(&package).unwrap().count(), 3);
        fs::remove_dir_all(&folder).unwrap();
    }
}
