//! The checks that cargo itself runs.
//!
//! All of them choose the same packages, so that the libraries are built once for all: cargo
//! settles the features of a library by the packages that are asked for. This program itself is
//! left out of the tests and has its own line: its libraries are built already, in its profile.

use crate::{
    failure::Failure,
    page::{Profile, TARGET, without_flags},
    process::{cargo, program, run, succeeds},
};

const ADVICE: &str = "cargo came with rustup";

/// Has rustup bring `component`, without which cargo lacks `command`.
fn ensure_component(component: &str, command: &str) -> Result<(), Failure> {
    if succeeds(&mut cargo(&[command, "--version"])) {
        return Ok(());
    }
    let mut rustup = program("rustup");
    rustup.args(["component", "add", component]);
    run(&mut rustup, "install Rust with rustup (https://rustup.rs)")
}

/// The packages that are tested natively.
pub const PACKAGES: [&str; 4] = ["--locked", "--workspace", "--exclude", "xtask"];

/// `cargo fmt` would change nothing.
pub fn format() -> Result<(), Failure> {
    ensure_component("rustfmt", "fmt")?;
    run(&mut cargo(&["fmt", "--all", "--check"]), ADVICE)
}

/// No lint has anything to say about anything built natively.
pub fn lints() -> Result<(), Failure> {
    ensure_component("clippy", "clippy")?;
    let arguments = [
        "clippy",
        "--locked",
        "--workspace",
        "--all-targets",
        "--",
        "-D",
        "warnings",
    ];
    run(&mut cargo(&arguments), ADVICE)
}

/// The same for what only the page is built from.
pub fn page_lints() -> Result<(), Failure> {
    ensure_component("clippy", "clippy")?;
    crate::page::ensure_target()?;
    let mut clippy = cargo(&[
        "clippy",
        "--locked",
        "-p",
        "pilotage-web",
        "-p",
        "pilotage-worker",
        "--target",
        TARGET,
    ]);
    clippy.args(["--profile", Profile::Quick.name(), "--", "-D", "warnings"]);
    without_flags(&mut clippy);
    run(&mut clippy, ADVICE)
}

/// The rules of the house (tests/tests/house.rs).
pub fn house_rules() -> Result<(), Failure> {
    run(
        cargo(&["test"]).args(PACKAGES).args(["--test", "house"]),
        ADVICE,
    )
}

/// Every test that needs no other program.
pub fn tests() -> Result<(), Failure> {
    run(cargo(&["test", "--no-fail-fast"]).args(PACKAGES), ADVICE)
}

/// The tests of this program.
pub fn build_program() -> Result<(), Failure> {
    run(
        &mut cargo(&["test", "--locked", "--profile", "tool", "-p", "xtask"]),
        ADVICE,
    )
}

/// The documentation builds without a broken link.
pub fn documentation() -> Result<(), Failure> {
    let arguments = ["doc", "--no-deps"];
    run(
        cargo(&arguments)
            .args(PACKAGES)
            .env("RUSTDOCFLAGS", "-D warnings"),
        ADVICE,
    )
}
