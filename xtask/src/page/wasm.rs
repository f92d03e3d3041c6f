//! The programs: compiled for WebAssembly, then given their glue for the browser.

use std::{
    fs,
    path::{Path, PathBuf},
};

use wasm_bindgen_cli_support::Bindgen;

use super::{
    machine_paths, never_called,
    profile::{PROGRAMS, Profile, TARGET, module_name},
    side_by_side::side_by_side,
};
use crate::{built, compiler, failure::Failure, places, process, progress::step};

/// Has rustup bring the target's standard library if this compiler lacks it.
pub fn ensure_target() -> Result<(), Failure> {
    let advice = "install Rust with rustup (https://rustup.rs)";
    let asked = process::capture(
        process::program("rustc").args(["--print", "target-libdir", "--target", TARGET]),
        advice,
    )?;
    let folder = PathBuf::from(String::from_utf8_lossy(&asked.stdout).trim());
    if asked.status.success() && folder.is_dir() {
        return Ok(());
    }
    step(&format!("adding the target {TARGET}"), || {
        process::run(
            process::program("rustup").args(["target", "add", TARGET]),
            advice,
        )
    })
}

/// Compiles the crates of the page and of its workers, what is of another profile at the same time: each program ends
/// with one core at work on all of it, while the other has nothing left to do.
pub fn compile(profile: Profile) -> Result<(), Failure> {
    let groups: Vec<Vec<&str>> = PROGRAMS
        .chunk_by(|one, other| profile.of_program(one) == profile.of_program(other))
        .map(<[&str]>::to_vec)
        .collect();
    // Several lines of progress would write over each other: that of what takes longest is shown.
    let longest = groups.iter().map(Vec::len).max();
    side_by_side(&groups, |group| {
        let name = profile.of_program(group[0]);
        let mut cargo = process::cargo(&["build", "--locked", "--lib"]);
        if Some(group.len()) != longest {
            cargo.arg("--quiet");
        }
        cargo.args(group.iter().flat_map(|package| ["-p", package]));
        cargo.args(["--target", TARGET, "--profile", name]);
        cargo.args(machine_paths::left_out()?);
        without_flags(&mut cargo);
        compiler::take_place(&mut cargo)?;
        process::run(&mut cargo, "cargo came with rustup")
    })
}

/// The program of a package as the compiler leaves it, with its names.
pub fn module(profile: Profile, package: &str) -> PathBuf {
    let name = module_name(package);
    let folder = built::target()
        .join(TARGET)
        .join(profile.of_program(package));
    folder.join(format!("{name}.wasm"))
}

/// Takes away compiler flags from the environment: they would replace those of
/// `.cargo/config.toml`, and with them the vector instructions of the kernels.
pub fn without_flags(cargo: &mut std::process::Command) {
    cargo
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS");
}

/// Writes the glue and the finished module of a package, `pkg/NAME.js` and `pkg/NAME_bg.wasm`, into `dist`: what the
/// compiler made, without what is never called.
pub fn bind(profile: Profile, package: &str, dist: &Path) -> Result<(), Failure> {
    let module = module(profile, package);
    let made = fs::read(&module).map_err(Failure::file(&module))?;
    let list = places::root().join("xtask/never_called.toml");
    let text = fs::read_to_string(&list).map_err(Failure::file(&list))?;
    let is_shipped = profile == Profile::Shipped;
    let called = never_called::without(&made, &text, package, is_shipped)
        .map_err(|reason| Failure::Content { path: list, reason })?;
    let mut bindgen = Bindgen::new();
    bindgen.input_bytes(&module_name(package), called);
    let made = bindgen.web(true).and_then(|bindgen| {
        bindgen
            .typescript(false)
            .remove_name_section(true)
            .remove_producers_section(true)
            .generate(dist.join("pkg"))
    });
    made.map_err(|error| Failure::Bindings {
        module,
        reason: format!("{error:#}"),
    })
}
