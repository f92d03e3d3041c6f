//! Progress of a study on the terminal, with the time that is left.

use std::io::{IsTerminal, Write};
use std::time::{Duration, Instant};

/// Shortest time between two lines where they are kept, as in a file.
const APART: Duration = Duration::from_secs(30);

/// Progress on the standard error.
pub struct Progress {
    begun: Instant,
    told: Option<Instant>,
    all: u64,
    done: u64,
    is_quiet: bool,
    /// Things that are counted.
    things: &'static str,
}

impl Progress {
    /// Of so many flights that are left.
    pub fn new(all: u64, is_quiet: bool) -> Self {
        Self::of(all, "flights", is_quiet)
    }

    /// Of so many things that are left.
    pub fn of(all: u64, things: &'static str, is_quiet: bool) -> Self {
        Self {
            things,
            begun: Instant::now(),
            told: None,
            all,
            done: 0,
            is_quiet,
        }
    }

    /// Tells that so many more are done.
    pub fn add(&mut self, more: u64) {
        self.done += more;
        let is_screen = std::io::stderr().is_terminal();
        let is_due = self.told.is_none_or(|told| told.elapsed() >= APART);
        if self.is_quiet || !(is_screen || is_due) {
            return;
        }
        self.told = Some(Instant::now());
        let text = words((self.done, self.all, self.things), self.begun.elapsed());
        // Nobody is there to hear that the terminal is gone.
        if is_screen {
            eprint!("\r{text}\u{1b}[K");
            std::io::stderr().flush().ok();
        } else {
            eprintln!("{text}");
        }
    }

    /// Ends the line.
    pub fn finish(&self) {
        if self.told.is_some() && std::io::stderr().is_terminal() {
            eprintln!();
        }
    }
}

fn words((done, all, things): (u64, u64, &str), elapsed: Duration) -> String {
    let left = elapsed.as_secs_f64() * all.saturating_sub(done) as f64 / done.max(1) as f64;
    let time = match left {
        left if left < 90.0 => format!("{left:.0} s"),
        left if left < 5400.0 => format!("{:.0} min", left / 60.0),
        left => format!("{:.1} h", left / 3600.0),
    };
    let each = 1000.0 * elapsed.as_secs_f64() / done.max(1) as f64;
    format!("{done} of {all} {things}, {each:.1} ms each, {time} left")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_that_of_the_flights_left_at_the_pace_so_far() {
        let of = |done| words((done, 1000, "flights"), Duration::from_mins(1));
        assert_eq!(of(500), "500 of 1000 flights, 120.0 ms each, 60 s left");
        assert_eq!(of(100), "100 of 1000 flights, 600.0 ms each, 9 min left");
        assert_eq!(of(1), "1 of 1000 flights, 60000.0 ms each, 16.6 h left");
    }
}
