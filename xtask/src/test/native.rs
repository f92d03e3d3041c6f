//! The checks that cargo itself runs.
//!
//! All of them choose the same packages, so that the libraries are built once for all: cargo
//! settles the features of a library by the packages that are asked for. This program itself and the
//! rules of the house are left out of the tests and have their own lines: their libraries are built
//! already, in this program's profile.

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
pub const PACKAGES: [&str; 6] = [
    "--locked",
    "--workspace",
    "--exclude",
    "xtask",
    "--exclude",
    "pilotage-house",
];

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
    run(&mut cargo(&arguments), ADVICE)
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
