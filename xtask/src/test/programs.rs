//! The test programs that cargo builds, run several at a time: one ends with a single long test while another
//! still has many.

use std::{
    collections::BTreeMap,
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    sync::{Mutex, PoisonError},
    time::Instant,
};

use super::{
    linted::native_cargo,
    passed::{Passed, Print, Sources},
    program::{CheckProgram, LONG, SURFACES, of_message},
};
use crate::{
    failure::Failure,
    metadata,
    process::{CARGO_ADVICE, capture, program, succeed},
};

/// Line that an oracle test prints when it had no interpreter (`tests/src/oracle.rs`).
const SKIPPED: &str = "skipped: no oracle interpreter";
/// The variable that names the interpreter.
const INTERPRETER: &str = "PILOTAGE_PYTHON";
/// The variable that has studies asked over all seeds (`tests/src/studies.rs`).
const STUDIES: &str = "PILOTAGE_STUDIES";

/// Programs that were run, and whether each passed.
#[derive(Debug, PartialEq, Eq)]
pub struct Outcomes(Vec<(CheckProgram, bool)>);

impl Outcomes {
    /// Whether one of `these` was run, and passed.
    pub fn has_passed(&self, these: impl Fn(&CheckProgram) -> bool) -> bool {
        let mut outcomes = self.0.iter();
        outcomes.any(|(one, has_passed)| *has_passed && these(one))
    }

    /// Judges `these`, or `None` where none of them was run.
    pub fn judged(&self, these: impl Fn(&CheckProgram) -> bool) -> Option<Result<(), Failure>> {
        let were_run = self.0.iter().any(|(one, _)| these(one));
        were_run.then(|| self.judge(these))
    }

    /// Fails with the names of those among `these` that did.
    pub fn judge(&self, these: impl Fn(&CheckProgram) -> bool) -> Result<(), Failure> {
        let outcomes = self.0.iter();
        let failed: Vec<&str> = outcomes
            .filter(|(one, has_passed)| !has_passed && these(one))
            .map(|(one, _)| one.name.as_str())
            .collect();
        if failed.is_empty() {
            Ok(())
        } else {
            Err(Failure::Check(format!("{} failed", failed.join(", "))))
        }
    }
}

/// Builds the tests of the packages that `arguments` choose and runs them in this manner. `quick` leaves out what takes
/// long and what has not changed since it passed; `beside` tells by what cargo said of what it built which programs run
/// among the tests that cargo does not know as such.
pub fn test(
    arguments: &[&str],
    manner: &Manner<'_>,
    quick: bool,
    beside: &dyn Fn(&str) -> Vec<CheckProgram>,
) -> Result<Outcomes, Failure> {
    let sources = Sources::of(folders_of_surfaces()?);
    let told = build(arguments)?;
    let mut programs = in_order(told.lines().filter_map(of_message).collect());
    let all = programs.len();
    let mut passed = Passed::read();
    let prints: BTreeMap<String, Print> = programs
        .iter()
        .map(|one| (one.name.clone(), sources.print(one)))
        .collect();
    if quick {
        let mut left_out = |keep: &dyn Fn(&CheckProgram) -> bool| {
            let before = programs.len();
            programs.retain(keep);
            before - programs.len()
        };
        let long = left_out(&|one| !one.takes_long());
        let is_known = |one: &CheckProgram| {
            prints
                .get(&one.name)
                .filter(|_| !manner.asks_over_all_seeds())
        };
        let below = left_out(&|one| {
            !is_known(one).is_some_and(|print| passed.has_sources(&one.name, print))
        });
        let same =
            left_out(&|one| !is_known(one).is_some_and(|print| passed.has(&one.name, print)));
        println!(
            "{} of {all} test programs; left out: {long} that take long ({}), {below} of {} \
            whose own sources passed, {same} that passed as they are",
            programs.len(),
            LONG.join(", "),
            SURFACES.join(" and "),
        );
    }
    // After the longest: whoever needs what they make comes after all of them.
    let place = programs.len().min(LONG.len());
    programs.splice(place..place, beside(&told));
    let outcomes = run_all(programs, manner, &print);
    for (one, has_passed) in outcomes
        .0
        .iter()
        .filter(|(one, _)| one.arguments.is_empty())
    {
        let print = prints.get(&one.name).cloned().unwrap_or_default();
        passed.note(&one.name, print, *has_passed);
    }
    passed.write()?;
    Ok(outcomes)
}

/// Folders of the packages that link all others.
fn folders_of_surfaces() -> Result<Vec<PathBuf>, Failure> {
    let packages = metadata::packages(false)?;
    let of_surface = packages.iter().filter(|package| {
        let name = package["name"].as_str();
        name.is_some_and(|name| SURFACES.contains(&name))
    });
    let manifests = of_surface.filter_map(|package| package["manifest_path"].as_str());
    let folders = manifests.filter_map(|manifest| Path::new(manifest).parent());
    Ok(folders.map(Path::to_owned).collect())
}

/// The programs in the order in which they begin.
fn in_order(mut programs: Vec<CheckProgram>) -> Vec<CheckProgram> {
    programs.sort_by_key(|one| (one.rank(), one.name.clone()));
    programs
}

/// Manner in which programs are run.
#[derive(Debug, Default)]
pub struct Manner<'a> {
    /// Variables that they find.
    pub environment: Vec<(&'a str, &'a str)>,
    /// Text that makes those that ask other people's programs fail where they say it; all that they say is printed.
    pub skipped: Option<&'a str>,
}

impl<'a> Manner<'a> {
    /// The same, in which studies are asked over all seeds.
    pub fn over_all_seeds(mut self) -> Self {
        self.environment.push((STUDIES, "1"));
        self
    }

    /// Whether studies are asked over all seeds: what passed over a few may not have passed so.
    fn asks_over_all_seeds(&self) -> bool {
        self.environment.iter().any(|(name, _)| *name == STUDIES)
    }

    /// The same, in which the tests that ask other people's programs ask `python`, and fail where they do not.
    pub fn asking(mut self, python: &'a str) -> Self {
        self.environment.push((INTERPRETER, python));
        self.skipped = Some(SKIPPED);
        self
    }
}

/// Runs one program, which must pass.
pub fn run(one: CheckProgram) -> Result<(), Failure> {
    run_all(vec![one], &Manner::default(), &print).judge(|_| true)
}

fn print(told: &str) {
    // A closed pipe is no reason to stop.
    let _ = writeln!(std::io::stdout(), "{told}");
}

/// Has cargo build the test programs; its messages.
fn build(arguments: &[&str]) -> Result<String, Failure> {
    let mut cargo = native_cargo(&["test", "--no-run"])?;
    cargo.args(arguments);
    cargo.arg("--message-format=json-render-diagnostics");
    cargo.stderr(Stdio::inherit());
    let output = capture(&mut cargo, CARGO_ADVICE)?;
    succeed(&cargo, output.status)?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Runs the programs, as many at a time as there are cores, each on one; whether each passed. How each went is told
/// when it is over.
fn run_all(
    programs: Vec<CheckProgram>,
    manner: &Manner<'_>,
    tell: &(dyn Fn(&str) + Sync),
) -> Outcomes {
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
    let outcomes = outcomes.into_inner();
    Outcomes(outcomes.unwrap_or_else(PoisonError::into_inner))
}

/// Runs a program: whether it passed, and how it went in words, with all that it said if it failed.
fn run_one(one: &CheckProgram, manner: &Manner<'_>) -> (bool, String) {
    let mut command: Command = program(&one.executable);
    command.current_dir(&one.folder);
    command.env("CARGO_MANIFEST_DIR", &one.folder);
    command.env("RUST_TEST_THREADS", "1");
    command.envs(manner.environment.iter().copied());
    command.envs(one.environment.iter().map(|(name, value)| (name, value)));
    command.args(&one.arguments);
    let skipped = manner.skipped.filter(|_| one.asks_oracles());
    if skipped.is_some() {
        command.arg("--nocapture");
    }
    let begun = Instant::now();
    let output = command.output();
    let seconds = begun.elapsed().as_secs_f64();
    let (has_passed, said) = match &output {
        Ok(output) => {
            let said = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
            let said = String::from_utf8_lossy(&said).into_owned();
            let has_skipped = skipped.is_some_and(|word| said.contains(word));
            (output.status.success() && !has_skipped, said)
        }
        Err(error) => (false, error.to_string()),
    };
    let result = said
        .lines()
        .rfind(|line| line.starts_with("test result") || line.contains(" passed"));
    let result = result
        .unwrap_or("ended without an error")
        .trim_start_matches("test result: ");
    let told = if has_passed {
        let head = format!("{seconds:>7.1} s  {}: {result}", one.name);
        match skipped {
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
    use super::*;

    #[test]
    fn a_program_that_cannot_be_run_fails() {
        let missing = CheckProgram {
            name: "a/b".to_owned(),
            executable: PathBuf::from("/nowhere/b"),
            folder: std::env::temp_dir(),
            arguments: Vec::new(),
            environment: Vec::new(),
        };
        let said = Mutex::new(Vec::new());
        let tell = |told: &str| said.lock().unwrap().push(told.to_owned());
        let outcomes = run_all(vec![missing.clone()], &Manner::default(), &tell);
        assert_eq!(outcomes, Outcomes(vec![(missing, false)]));
        assert!(
            !outcomes.has_passed(|_| true)
                && outcomes.judge(|_| true).is_err()
                && outcomes.judge(CheckProgram::asks_oracles).is_ok()
                && outcomes.judged(CheckProgram::asks_oracles).is_none()
                && outcomes
                    .judged(|_| true)
                    .is_some_and(|judged| judged.is_err())
        );
        let said = said.into_inner().unwrap();
        assert!(
            said[0].starts_with("FAILED") && said[0].contains("a/b"),
            "{said:?}"
        );
    }
}
