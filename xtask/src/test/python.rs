//! The package for Python: its extension built as the native tests are, and its own tests over it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use super::{extension, linted, native::PACKAGES, oracles, program::named_in_message};
use crate::{
    built,
    failure::Failure,
    places,
    process::{program, run},
};

/// Name of the extension within the package, whichever Python loads it.
const EXTENSION: &str = if cfg!(windows) {
    "_native.pyd"
} else {
    "_native.abi3.so"
};

/// Builds the package, puts it together under cargo's folder and runs its tests, which ask other people's programs too.
pub fn check() -> Result<(), Failure> {
    let library = extension::build()?;
    let terminal = terminal()?;
    let sources = places::root().join("python/pilotage");
    let package = built::target().join("python");
    put_together(
        &sources.join("python/pilotage"),
        &package.join("pilotage"),
        &library,
    )?;
    let mut pytest = program(oracles::interpreter()?);
    pytest.args(["-m", "pytest", "-q", "-p", "no:cacheprovider"]);
    pytest.arg(&sources);
    pytest.env("PYTHONPATH", &package);
    pytest.env("PYTHONDONTWRITEBYTECODE", "1");
    pytest.env("PILOTAGE_PROGRAM", terminal);
    run(
        &mut pytest,
        "the oracles' Python has what tests/oracles/requirements.txt says",
    )
}

/// The program of the terminal, beside which the tests hold the package, as the native tests have it.
fn terminal() -> Result<PathBuf, Failure> {
    let arguments = [
        &["test", "--no-run"],
        &PACKAGES[..],
        &["--test", "commands"],
    ]
    .concat();
    let messages = linted::compile(&arguments)?;
    let mut programs = messages
        .lines()
        .filter_map(|line| named_in_message("pilotage", line));
    let program = programs.next().map(|program| program.executable);
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
