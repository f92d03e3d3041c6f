//! The checks that cargo itself runs.
//!
//! All of them choose the same packages, so that the libraries are built once for all: cargo
//! settles the features of a library by the packages that are asked for. This program itself and the
//! rules of the house are left out of the tests and have their own lines: their libraries are built
//! already, in this program's profile.

use super::{
    Reach, documented, extension, linted,
    linted::native_cargo,
    program::CheckProgram,
    programs::{self, Manner, Outcomes},
};
use std::fs;
use std::path::{Path, PathBuf};

use crate::{
    compiler::ensure_component,
    failure::Failure,
    page::{PROGRAMS, Profile, TARGET, without_flags},
    places::root,
    process::{CARGO_ADVICE, capture, cargo, is_automatic, run, succeed},
};

/// The packages that are tested natively.
pub const PACKAGES: [&str; 6] = [
    "--locked",
    "--workspace",
    "--exclude",
    "xtask",
    "--exclude",
    "pilotage-house",
];

/// The packages that have their own lines, in the profile of this program.
const OWN_LINE: [&str; 7] = [
    "--locked",
    "--profile",
    "tool",
    "-p",
    "xtask",
    "-p",
    "pilotage-house",
];

/// The packages of one run.
#[derive(Debug)]
pub struct Packages {
    /// Those that a change reaches, or `None` for all.
    reached: Option<Vec<String>>,
    /// Whether this program or the rules of the house are reached, which have their own lines.
    tools: bool,
}

impl Packages {
    /// All, or those that a change reaches and that are tested natively.
    pub fn of(reach: Option<&Reach>) -> Self {
        let own_line = |name: &String| ["xtask", "pilotage-house"].contains(&name.as_str());
        let reached = reach.map(|reach| {
            let names = reach.packages.iter();
            names.filter(|name| !own_line(name)).cloned().collect()
        });
        let tools = reach.is_none_or(|reach| reach.packages.iter().any(own_line));
        Self { reached, tools }
    }

    /// Whether there is nothing for the lints to look at.
    pub fn are_not_linted(&self) -> bool {
        self.are_none() && !self.tools
    }

    /// Whether there is nothing to check.
    pub fn are_none(&self) -> bool {
        self.reached.as_ref().is_some_and(Vec::is_empty)
    }

    /// Whether the package `name` is among them.
    pub fn hold(&self, name: &str) -> bool {
        let reached = self.reached.as_ref();
        reached.is_none_or(|reached| reached.iter().any(|other| other == name))
    }

    /// Arguments for cargo, and `all` where nothing is left out.
    fn arguments<'a>(&'a self, all: &'a [&'a str]) -> Vec<&'a str> {
        let Some(reached) = &self.reached else {
            return all.to_vec();
        };
        let names = reached.iter().flat_map(|name| ["-p", name.as_str()]);
        std::iter::once("--locked").chain(names).collect()
    }
}

/// Folders of which a macro declares modules, so that `cargo fmt` does not find them.
const DECLARED_BY_MACROS: [&str; 9] = [
    "crates/core/estimation/src/estimator",
    "crates/core/mission/src/exchange",
    "crates/core/navigator/src/navigator/aids",
    "crates/core/readers/src/log",
    "crates/core/simulate/src/simulate",
    "crates/jobs/src",
    "crates/lessons/src/lessons",
    "crates/ui/src",
    "crates/ui/src/learn/lessons",
];

/// Files of those folders, and the own files of folders in them, that no line `mod name;` declares.
fn declared_by_macros() -> Result<Vec<PathBuf>, Failure> {
    let mut paths = Vec::new();
    for folder in DECLARED_BY_MACROS {
        let folder = root().join(folder);
        let own = ["mod.rs", "lib.rs"].map(|own| folder.join(own));
        let declared: String = own
            .iter()
            .filter_map(|own| fs::read_to_string(own).ok())
            .collect();
        let entries = fs::read_dir(&folder).map_err(Failure::file(&folder))?;
        let modules = entries.flatten().filter_map(|entry| {
            let path = entry.path();
            let name = path.file_stem()?.to_str()?;
            let is_declared = declared.contains(&format!("mod {name};")) || own.contains(&path);
            let file = if path.is_dir() {
                path.join("mod.rs")
            } else {
                path
            };
            let is_rust = file.extension().is_some_and(|ending| ending == "rs");
            (!is_declared && is_rust && file.exists()).then_some(file)
        });
        paths.extend(modules);
    }
    Ok(paths)
}

/// `cargo fmt` would change nothing, nor where macros declare the files.
pub fn format() -> Result<(), Failure> {
    run_rustfmt(&["--check"])
}

/// Formats every Rust file.
pub fn format_all() -> Result<(), Failure> {
    run_rustfmt(&[])
}

fn run_rustfmt(options: &[&str]) -> Result<(), Failure> {
    ensure_component("rustfmt", "fmt")?;
    let mut format = cargo(&["fmt", "--all", "--"]);
    let formatted = run(
        format.args(options).args(declared_by_macros()?),
        CARGO_ADVICE,
    );
    formatted.map_err(|failure| match failure {
        // The command names more than a hundred files.
        Failure::Command { status, .. } => Failure::Command {
            command: "cargo fmt --all -- FILES OF TABLES".to_owned(),
            status,
        },
        other => other,
    })
}

/// No lint has anything to say about anything built natively. Where nobody sits at the terminal, what the tests are
/// built of is linted as it is built.
pub fn lints(packages: &Packages) -> Result<(), Failure> {
    ensure_component("clippy", "clippy")?;
    let of_tools = match packages.tools {
        true if is_automatic() => linted::check(&OWN_LINE),
        true => clippy(&OWN_LINE),
        false => Ok(()),
    };
    let of_programs = match packages.are_none() {
        true => Ok(()),
        false if is_automatic() => linted::check(&packages.arguments(&PACKAGES)),
        false => clippy(&packages.arguments(&PACKAGES)),
    };
    of_programs.and(of_tools)
}

fn clippy(packages: &[&str]) -> Result<(), Failure> {
    let mut clippy = cargo(&["clippy", "--all-targets"]);
    run(
        clippy.args(packages).args(["--", "-D", "warnings"]),
        CARGO_ADVICE,
    )
}

/// No lint has anything to say about what only the page is built from. All of it is told when the check is over: at a
/// terminal it runs beside the native lints.
pub fn page_lints() -> Result<(), Failure> {
    ensure_component("clippy", "clippy")?;
    crate::page::ensure_target()?;
    if is_automatic() {
        return linted::check_page();
    }
    let mut clippy = cargo(&["clippy", "--locked", "--target", TARGET]);
    clippy.args(["-p", "pilotage-worker"]);
    clippy.args(PROGRAMS.iter().flat_map(|name| ["-p", name]));
    clippy.args(["--profile", Profile::Quick.name(), "--", "-D", "warnings"]);
    without_flags(&mut clippy);
    let output = capture(&mut clippy, CARGO_ADVICE)?;
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    succeed(&clippy, output.status)
}

/// The rules of the house (tests/house), in the profile of this program: both need little, and much of it is
/// built already.
pub fn house_rules() -> Result<(), Failure> {
    let arguments = [
        "test",
        "--locked",
        "--profile",
        "tool",
        "-p",
        "pilotage-house",
    ];
    run(&mut native_cargo(&arguments)?, CARGO_ADVICE)
}

/// Extent of the native tests.
pub struct Extent<'a> {
    /// All seeds of studies (`tests/src/studies.rs`).
    pub studies: bool,
    /// Without what takes long and what has not changed since it passed.
    pub quick: bool,
    /// Interpreter with other people's programs, for the tests that ask them.
    pub python: Option<&'a str>,
    /// Programs that run among the tests, by what cargo said of what it built.
    pub beside: &'a dyn Fn(&str) -> Vec<CheckProgram>,
}

/// Every test program.
pub fn tests(packages: &Packages, extent: &Extent<'_>) -> Result<Outcomes, Failure> {
    let packages = packages.arguments(&PACKAGES);
    let mut manner = Manner::default();
    if extent.studies {
        manner = manner.over_all_seeds();
    }
    if let Some(python) = extent.python {
        manner = manner.asking(python);
    }
    programs::test(&packages, &manner, extent.quick, extent.beside)
}

/// Every example in the documentation.
pub fn examples(packages: &Packages) -> Result<(), Failure> {
    let mut examples = native_cargo(&["test", "--no-fail-fast", "--doc"])?;
    examples.args(packages.arguments(&PACKAGES));
    run(&mut examples, CARGO_ADVICE)
}

/// Stores anew what the page shows first, as the program of the page in `dist` computes it, by the test that
/// compares it with what this machine computes.
pub fn store_first_seconds(dist: &Path) -> Result<(), Failure> {
    let mut test = cargo(&["test", "--locked", "-p", "pilotage-jobs", "--lib"]);
    test.args(["--", "--exact"]);
    test.arg("prelude::tests::the_stored_first_seconds_are_what_the_program_computes");
    run(test.env("PILOTAGE_FIRST_SECONDS_OF", dist), CARGO_ADVICE)
}

/// The tests of this program.
pub fn build_program() -> Result<(), Failure> {
    run(
        &mut native_cargo(&["test", "--locked", "--profile", "tool", "-p", "xtask"])?,
        CARGO_ADVICE,
    )
}

/// The documentation builds without a broken link. Where nobody sits at the terminal, it was made with what it is of.
pub fn documentation(packages: &Packages) -> Result<(), Failure> {
    if is_automatic() {
        linted::check(&packages.arguments(&PACKAGES))?;
        if packages.hold(extension::PACKAGE) {
            extension::build()?;
        }
        return documented::check(|name| !OWN_LINE.contains(&name) && packages.hold(name));
    }
    let arguments = ["doc", "--no-deps"];
    run(
        cargo(&arguments)
            .args(packages.arguments(&PACKAGES))
            .env("RUSTDOCFLAGS", "-D warnings"),
        CARGO_ADVICE,
    )
}
