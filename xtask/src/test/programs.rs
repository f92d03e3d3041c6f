//! The test programs that cargo builds, run several at a time: one ends with a single long test while another
//! still has many.

use std::{
    io::Write as _,
    process::{Command, Stdio},
    sync::{Mutex, PoisonError},
    time::Instant,
};

use super::{
    linted::native_cargo,
    passed::Passed,
    program::{LONG, Program, SURFACES, of_message},
};
use crate::{
    failure::Failure,
    process::{CARGO_ADVICE, capture, program, succeed},
};

/// Builds the tests of the packages that `arguments` choose and runs them; `environment` is what they are told.
/// `quick` leaves out what takes long and what has not changed since it passed.
pub fn test(arguments: &[&str], environment: &[(&str, &str)], quick: bool) -> Result<(), Failure> {
    let mut programs = in_order(build(arguments)?);
    let all = programs.len();
    let mut passed = Passed::read();
    if quick {
        let mut left_out = |keep: &dyn Fn(&Program) -> bool| {
            let before = programs.len();
            programs.retain(keep);
            before - programs.len()
        };
        let long = left_out(&|one| !one.takes_long());
        let below = left_out(&|one| !passed.has_sources(one));
        let same = left_out(&|one| !passed.has(one));
        println!(
            "{} of {all} test programs; left out: {long} that take long ({}), {below} of {} \
            whose own sources passed, {same} that passed as they are",
            programs.len(),
            LONG.join(", "),
            SURFACES.join(" and "),
        );
    }
    let manner = Manner {
        environment,
        ..Manner::default()
    };
    let outcomes = run_all(programs, &manner, &print);
    for (one, has_passed) in &outcomes {
        passed.note(one, *has_passed);
    }
    passed.write()?;
    judge(&outcomes)
}

/// Builds the test programs that `arguments` choose and runs them; `environment` is what they are told. What they say
/// is printed, and one that says `skipped` has failed.
pub fn test_aloud(
    arguments: &[&str],
    environment: &[(&str, &str)],
    skipped: &str,
) -> Result<(), Failure> {
    let manner = Manner {
        environment,
        aloud: Some(skipped),
    };
    judge(&run_all(in_order(build(arguments)?), &manner, &print))
}

/// The programs in the order in which they begin.
fn in_order(mut programs: Vec<Program>) -> Vec<Program> {
    programs.sort_by_key(|one| (one.rank(), one.name.clone()));
    programs
}

/// Manner in which programs are run.
#[derive(Debug, Default)]
struct Manner<'a> {
    /// Variables that they find.
    environment: &'a [(&'a str, &'a str)],
    /// All that they say is printed; and what makes one fail that says it.
    aloud: Option<&'a str>,
}

fn print(told: &str) {
    // A closed pipe is no reason to stop.
    let _ = writeln!(std::io::stdout(), "{told}");
}

/// Fails with the names of the programs that did.
fn judge(outcomes: &[(Program, bool)]) -> Result<(), Failure> {
    let failed: Vec<&str> = outcomes
        .iter()
        .filter(|(_, has_passed)| !has_passed)
        .map(|(one, _)| one.name.as_str())
        .collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::Check(format!("{} failed", failed.join(", "))))
    }
}

/// Has cargo build the test programs.
fn build(arguments: &[&str]) -> Result<Vec<Program>, Failure> {
    let mut cargo = native_cargo(&["test", "--no-run"])?;
    cargo.args(arguments);
    cargo.arg("--message-format=json-render-diagnostics");
    cargo.stderr(Stdio::inherit());
    let output = capture(&mut cargo, CARGO_ADVICE)?;
    succeed(&cargo, output.status)?;
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.lines().filter_map(of_message).collect())
}

/// Runs the programs, as many at a time as there are cores, each on one; whether each passed. How each went is told
/// when it is over.
fn run_all(
    programs: Vec<Program>,
    manner: &Manner<'_>,
    tell: &(dyn Fn(&str) + Sync),
) -> Vec<(Program, bool)> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let queue = Mutex::new(programs.into_iter());
    let outcomes = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                loop {
                    let next = queue.lock().unwrap_or_else(PoisonError::into_inner).next();
                    let Some(next) = next else { return };
                    let (has_passed, told) = run_one(&next, manner);
                    tell(&told);
                    let mut outcomes = outcomes.lock().unwrap_or_else(PoisonError::into_inner);
                    outcomes.push((next, has_passed));
                }
            });
        }
    });
    outcomes
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner)
}

/// Runs a program: whether it passed, and how it went in words, with all that it said if it failed.
fn run_one(one: &Program, manner: &Manner<'_>) -> (bool, String) {
    let mut command: Command = program(&one.executable);
    command.current_dir(&one.folder);
    command.env("CARGO_MANIFEST_DIR", &one.folder);
    command.env("RUST_TEST_THREADS", "1");
    command.envs(manner.environment.iter().copied());
    if manner.aloud.is_some() {
        command.arg("--nocapture");
    }
    let begun = Instant::now();
    let output = command.output();
    let seconds = begun.elapsed().as_secs_f64();
    let (has_passed, said) = match &output {
        Ok(output) => {
            let said = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
            let said = String::from_utf8_lossy(&said).into_owned();
            let skipped = manner.aloud.is_some_and(|word| said.contains(word));
            (output.status.success() && !skipped, said)
        }
        Err(error) => (false, error.to_string()),
    };
    let result = said.lines().rfind(|line| line.starts_with("test result"));
    let result = result
        .unwrap_or("ended without an error")
        .trim_start_matches("test result: ");
    let told = if has_passed {
        let head = format!("{seconds:>7.1} s  {}: {result}", one.name);
        match manner.aloud {
            Some(_) => format!("{said}{head}"),
            None => head,
        }
    } else {
        format!("FAILED {seconds:.1} s  {}\n{said}", one.name)
    };
    (has_passed, told)
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::*;

    #[test]
    fn a_program_that_cannot_be_run_fails() {
        let missing = Program {
            name: "a/b".to_owned(),
            executable: PathBuf::from("/nowhere/b"),
            folder: std::env::temp_dir(),
        };
        let said = Mutex::new(Vec::new());
        let tell = |told: &str| said.lock().unwrap().push(told.to_owned());
        let outcomes = run_all(vec![missing.clone()], &Manner::default(), &tell);
        assert_eq!(outcomes, [(missing, false)]);
        let said = said.into_inner().unwrap();
        assert!(
            said[0].starts_with("FAILED") && said[0].contains("a/b"),
            "{said:?}"
        );
    }
}
