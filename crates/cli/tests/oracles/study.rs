//! Studies on other people's engine: the tests of the Python package `pilotage_study`, with this program.

use std::path::Path;
use std::process::Command;

use pilotage_tests::oracle::{INTERPRETER, SKIPPED};

#[test]
fn studies_on_a_cluster_are_those_of_this_program_whoever_is_killed() {
    let Some(python) = std::env::var_os(INTERPRETER) else {
        println!("{SKIPPED} (set {INTERPRETER} or run `cargo xtask test`)");
        return;
    };
    let package = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../python/pilotage_study");
    let output = Command::new(&python)
        .args(["-m", "unittest", "discover", "-s", "tests"])
        .current_dir(&package)
        .env("PILOTAGE", env!("CARGO_BIN_EXE_pilotage"))
        .env("PYTHONPATH", &package)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    // Whoever finds no tests passes as well.
    assert!(said.contains("Ran 13 tests"), "{said}");
}
