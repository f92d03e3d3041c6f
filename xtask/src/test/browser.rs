//! The journeys through the page in a real browser (`tests/browser/`).

use std::{
    fs,
    path::{Path, PathBuf},
    process::Stdio,
};

use super::{install, linted::native_cargo};
use crate::{
    built,
    failure::Failure,
    places,
    process::{capture, on_path, program, run},
};

/// Oldest Node that runs the journeys.
const NODE: u32 = 20;
/// Scenario that the page flies by itself.
const DEMO: &str = "distinct-400ft-wind";
/// Names under which Chromium goes.
const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome-stable",
    "google-chrome",
];

/// Walks the journeys through the page in `dist`: all, or those with one of `tags`. The demo is flown before, unless it
/// `is_flown`.
pub fn check(dist: &Path, tags: Option<&[String]>, is_flown: bool) -> Result<(), Failure> {
    let browser = prepare()?;
    let server = std::env::current_exe().map_err(Failure::file("xtask"))?;
    let demo = demo();
    if !is_flown {
        fly_demo()?;
    }
    run(
        program(on_path(&["node"]).unwrap_or_else(|| "node".into()))
            .arg("tests/browser/run.mjs")
            .env("PILOTAGE_CHROMIUM", browser)
            .env("PILOTAGE_SERVER", server)
            .env("PILOTAGE_PAGE", dist)
            .env("PILOTAGE_RUN", demo)
            .env("PILOTAGE_TAGS", tags.unwrap_or_default().join(","))
            .env("PILOTAGE_SCREENSHOTS", built::target().join("screenshots")),
        "node was found a moment ago",
    )
}

/// Brings what the journeys need beside the page, and says which browser they take.
pub fn prepare() -> Result<PathBuf, Failure> {
    node()?;
    let browser = chromium()?;
    packages()?;
    Ok(browser)
}

/// File of the demo as it was flown once, for all journeys that do not judge how it is flown.
fn demo() -> PathBuf {
    built::target().join("demo.run")
}

/// Words for the program of the terminal that make it.
pub fn words_for_demo() -> Vec<String> {
    let file = demo().to_string_lossy().into_owned();
    ["replay", "--scenario", DEMO, "--out", &file]
        .map(ToOwned::to_owned)
        .into()
}

fn fly_demo() -> Result<(), Failure> {
    let arguments = ["run", "--locked", "--quiet", "-p", "pilotage-cli", "--"];
    let mut replay = native_cargo(&arguments)?;
    replay.args(words_for_demo());
    run(replay.stdout(Stdio::null()), "cargo was found before")
}

/// Makes sure that a Node of the right age is there.
fn node() -> Result<(), Failure> {
    let missing = || Failure::Missing {
        program: "Node",
        advice: format!(
            "the journeys need node and npm, version {NODE} or newer (https://nodejs.org)"
        ),
    };
    if on_path(&["node"]).is_none() || on_path(&["npm"]).is_none() {
        return Err(missing());
    }
    let output = capture(
        program("node").arg("--version"),
        "it was found a moment ago",
    )?;
    match major(&String::from_utf8_lossy(&output.stdout)) {
        Some(version) if version >= NODE => Ok(()),
        _ => Err(missing()),
    }
}

/// `20` of `v20.1.2`.
fn major(version: &str) -> Option<u32> {
    version
        .trim()
        .strip_prefix('v')?
        .split('.')
        .next()?
        .parse()
        .ok()
}

/// The browser: `PILOTAGE_CHROMIUM` if set, else one on the path, else Debian's, installed.
fn chromium() -> Result<PathBuf, Failure> {
    if let Some(named) = std::env::var_os("PILOTAGE_CHROMIUM") {
        return Ok(PathBuf::from(named));
    }
    if let Some(found) = on_path(&NAMES) {
        return Ok(found);
    }
    install::debian_packages(&["chromium"]);
    on_path(&NAMES).ok_or_else(|| Failure::Missing {
        program: "Chromium",
        advice: "install it (Debian: `apt-get install chromium`) or name it in PILOTAGE_CHROMIUM"
            .to_owned(),
    })
}

/// Installs what `tests/browser/package-lock.json` lists, unless that is there already.
fn packages() -> Result<(), Failure> {
    let folder = places::root().join("tests/browser");
    let lock_file = folder.join("package-lock.json");
    let lock = fs::read(&lock_file).map_err(Failure::file(&lock_file))?;
    let installed_file = folder.join("node_modules/.installed-lock.json");
    if fs::read(&installed_file).is_ok_and(|installed| installed == lock) {
        return Ok(());
    }
    let mut npm = program(on_path(&["npm"]).unwrap_or_else(|| "npm".into()));
    npm.args(["ci", "--no-audit", "--no-fund", "--ignore-scripts"])
        .current_dir(&folder);
    run(&mut npm, "npm was found a moment ago")?;
    fs::write(&installed_file, lock).map_err(Failure::file(&installed_file))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_age_of_node_is_read_from_what_it_prints() {
        assert_eq!(major("v20.20.2\n"), Some(20));
        assert_eq!(major("20"), None);
    }
}
