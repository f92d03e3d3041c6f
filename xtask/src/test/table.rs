//! The checks that ran, how they ended and how long they took.

use std::{process::ExitCode, time::Instant};

use super::cores::Cores;
use crate::{failure::Failure, progress};

/// Table with a line per check.
#[derive(Debug, Default)]
pub struct Table {
    lines: Vec<Line>,
    /// Sentences below the lines.
    notes: Vec<String>,
    /// Only checks with this word in their name are run, if one is given.
    only: Option<String>,
}

#[derive(Debug)]
struct Line {
    name: String,
    seconds: f64,
    /// Share of the cores' time that was computed in, where the system tells.
    busy: Option<f64>,
    /// Why it failed, if it did.
    failure: Option<String>,
}

impl Table {
    /// A table for the checks that have `only` in their name, or for all.
    pub fn new(only: Option<String>) -> Self {
        Self {
            only,
            ..Self::default()
        }
    }

    /// Runs one check under a heading; returns whether it passed. A check that was not asked for
    /// counts as passed and leaves no line.
    pub fn check(&mut self, name: &str, work: impl FnOnce() -> Result<(), Failure>) -> bool {
        !self.asks_for(name) || self.run(name, work)
    }

    /// Whether the check `name` was asked for.
    pub fn asks_for(&self, name: &str) -> bool {
        let word = self.only.as_deref();
        word.is_none_or(|word| name.contains(word))
    }

    /// Runs one check under a heading, asked for or not, such as one that makes what others look at; returns whether it
    /// passed.
    pub fn run(&mut self, name: &str, work: impl FnOnce() -> Result<(), Failure>) -> bool {
        println!("\n━━ {name}");
        progress::flush();
        let start = Instant::now();
        let cores = Cores::now();
        let failure = work().err().map(|failure| failure.to_string());
        let seconds = start.elapsed().as_secs_f64();
        let busy = cores.zip(Cores::now()).and_then(|(a, b)| a.busy_until(b));
        match &failure {
            None => println!("━━ {name}: passed, {seconds:.1} s"),
            Some(reason) => println!("━━ {name}: FAILED, {seconds:.1} s\n{reason}"),
        }
        progress::flush();
        let passed = failure.is_none();
        self.lines.push(Line {
            name: name.to_owned(),
            seconds,
            busy,
            failure,
        });
        passed
    }

    /// Notes a check that could not run because of another one that failed.
    pub fn blocked(&mut self, name: &str, reason: &str) {
        println!("\n━━ {name}: not run, {reason}");
        let failure = Some(format!("not run: {reason}"));
        self.lines.push(Line {
            name: name.to_owned(),
            seconds: 0.0,
            busy: None,
            failure,
        });
    }

    /// Adds a sentence below the table.
    pub fn note(&mut self, sentence: &str) {
        self.notes.push(sentence.to_owned());
    }

    /// Whether no check had the word asked for in its name.
    pub fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// Prints the table; the last line is `N passed, N failed`.
    pub fn finish(&self) -> ExitCode {
        print!("\n{}", self.text());
        progress::flush();
        let all_passed = self.lines.iter().all(|line| line.failure.is_none());
        if all_passed {
            ExitCode::SUCCESS
        } else {
            ExitCode::FAILURE
        }
    }

    fn text(&self) -> String {
        use std::fmt::Write;
        let mut text = String::new();
        for Line {
            name,
            seconds,
            busy,
            failure,
        } in &self.lines
        {
            let verdict = if failure.is_none() {
                "passed"
            } else {
                "FAILED"
            };
            let first = failure.as_deref().and_then(|reason| reason.lines().next());
            let reason = first
                .map(|reason| format!("  {reason}"))
                .unwrap_or_default();
            let busy = match busy {
                Some(share) => format!("{:>4.0} %", 100.0 * share),
                None => String::from("      "),
            };
            // Writing into a text cannot fail.
            let _ = writeln!(text, "{verdict}  {seconds:>7.1} s {busy}  {name}{reason}");
        }
        for note in &self.notes {
            let _ = writeln!(text, "note: {note}");
        }
        let together: f64 = self.lines.iter().map(|line| line.seconds).sum();
        let failed = self
            .lines
            .iter()
            .filter(|line| line.failure.is_some())
            .count();
        let passed = self.lines.len() - failed;
        let _ = writeln!(
            text,
            "        {together:>7.1} s  together (%: share of the cores that was busy)"
        );
        let _ = writeln!(text, "{passed} passed, {failed} failed");
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checks_that_were_not_asked_for_do_not_run() {
        let mut table = Table::new(Some("two".to_owned()));
        assert!(table.check("one", || Err(Failure::Check("ran".to_owned()))));
        assert!(table.is_empty());
        assert!(table.check("number two", || Ok(())));
        assert_eq!(table.text().lines().last(), Some("1 passed, 0 failed"));
    }

    #[test]
    fn a_check_that_others_need_runs_whatever_was_asked_for() {
        let mut table = Table::new(Some("journeys".to_owned()));
        assert!(!table.asks_for("page") && table.asks_for("journeys through the page"));
        assert!(table.run("page", || Ok(())));
        assert!(table.text().contains("page"), "{}", table.text());
    }

    #[test]
    fn the_last_line_counts_the_checks() {
        let mut table = Table::default();
        assert!(table.check("one", || Ok(())));
        assert!(!table.check("two", || Err(Failure::Check(
            "found something\nlong".to_owned()
        ))));
        table.blocked("three", "two failed");
        table.note("there was no data");
        let text = table.text();
        assert!(text.contains("\nnote: there was no data\n"), "{text}");
        assert_eq!(text.lines().last(), Some("1 passed, 2 failed"));
        assert!(text.contains("two  found something\n"), "{text}");
    }
}
