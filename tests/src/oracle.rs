//! Questions to the Python programs that serve as oracles.
//!
//! A question is JSON on a script's standard input, its answer JSON on the standard output. The
//! scripts lie in `tests/oracles`, the versions of what they import in `requirements.txt` there.
//! `cargo xtask test` prepares the interpreter and names it in `PILOTAGE_PYTHON`; without that
//! variable the questions are skipped, with it every failure is a failed test.

use std::{
    io::Write,
    process::{Command, Stdio},
};

use serde::{Serialize, de::DeserializeOwned};

use crate::data::repository;

/// Environment variable with the path of the Python interpreter that has the oracles installed.
pub const INTERPRETER: &str = "PILOTAGE_PYTHON";

/// Line that a test prints when it had no interpreter; the full test run refuses this line.
pub const SKIPPED: &str = "skipped: no oracle interpreter";

/// Answer of `tests/oracles/<script>` to `question`, or `None` (after saying so) when no
/// interpreter is given.
///
/// # Panics
/// If the script fails or answers with something else than `Answer`: that is a failed test.
pub fn ask<Question: Serialize, Answer: DeserializeOwned>(
    script: &str,
    question: &Question,
) -> Option<Answer> {
    let Some(interpreter) = std::env::var_os(INTERPRETER) else {
        println!("{SKIPPED} ({script}; set {INTERPRETER} or run `cargo xtask test`)");
        return None;
    };
    let place = repository().join("tests/oracles").join(script);
    let mut process = Command::new(&interpreter)
        .arg(&place)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap_or_else(|error| panic!("{}: {error}", interpreter.to_string_lossy()));
    let text = serde_json::to_vec(question).expect("a question is plain data");
    let mut input = process.stdin.take().expect("the input was asked for");
    // The question is written beside the reading of the answer: neither pipe can fill and stall.
    let writer = std::thread::spawn(move || input.write_all(&text));
    let output = process.wait_with_output().expect("the script was started");
    let written = writer.join().expect("writing does not panic");
    assert!(
        output.status.success(),
        "{}: {}\n{}",
        place.display(),
        output.status,
        String::from_utf8_lossy(&output.stderr)
    );
    written.unwrap_or_else(|error| panic!("{}: {error}", place.display()));
    Some(
        serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
            let start: String = String::from_utf8_lossy(&output.stdout)
                .chars()
                .take(400)
                .collect();
            panic!("{}: {error} in the answer: {start}", place.display())
        }),
    )
}

/// Bytes as hexadecimal digits, for a script to read.
pub fn hex_of_bytes(bytes: &[u8]) -> String {
    let digits = bytes.iter().flat_map(|byte| [byte >> 4, byte & 15]);
    let letters = digits.filter_map(|digit| char::from_digit(u32::from(digit), 16));
    letters.collect()
}

/// The bytes that a script writes as hexadecimal digits.
///
/// # Panics
/// If there are other letters: that is a failed test.
pub fn bytes_of_hex(hex: &str) -> Vec<u8> {
    let digit = |letter: u8| {
        let digit = char::from(letter).to_digit(16);
        digit.unwrap_or_else(|| panic!("{letter} is no hexadecimal digit")) as u8
    };
    (hex.as_bytes().chunks_exact(2))
        .map(|pair| digit(pair[0]) << 4 | digit(pair[1]))
        .collect()
}
