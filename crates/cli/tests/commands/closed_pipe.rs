//! `pilotage … | head`: who reads no further ends the program, quietly.

use std::process::{Command, Stdio};

#[test]
fn a_reader_that_goes_away_is_no_reason_to_panic() {
    let mut program = Command::new(env!("CARGO_BIN_EXE_pilotage"))
        .arg("scenarios")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(program.stdout.take());
    let output = program.wait_with_output().expect("the program ends");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.is_empty(), "{said}");
}
