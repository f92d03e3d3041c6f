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
        // Threads that wait for products of matrices keep a core busy: test programs have one each.
        .env("OPENBLAS_NUM_THREADS", "1")
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
    const DIGITS: [char; 16] = [
        '0', '1', '2', '3', '4', '5', '6', '7', '8', '9', 'a', 'b', 'c', 'd', 'e', 'f',
    ];
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        text.push(DIGITS[usize::from(*byte >> 4)]);
        text.push(DIGITS[usize::from(*byte & 15)]);
    }
    text
}

/// The bytes that a script writes as hexadecimal digits.
///
/// # Panics
/// If there are other letters: that is a failed test.
pub fn bytes_of_hex(hex: &str) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(hex.len() / 2);
    let mut above = None;
    for letter in hex.bytes() {
        let digit = match letter {
            b'0'..=b'9' => letter - b'0',
            b'a'..=b'f' => letter - b'a' + 10,
            b'A'..=b'F' => letter - b'A' + 10,
            _ => panic!("{} is no hexadecimal digit", char::from(letter)),
        };
        match above.take() {
            Some(above) => bytes.push(above << 4 | digit),
            None => above = Some(digit),
        }
    }
    bytes
}
