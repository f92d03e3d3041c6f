//! Time that the cores of this machine have spent: it says whether a check computes or waits.

use std::fs;

/// Time since the machine started, all cores together, in the system's ticks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cores {
    idle: u64,
    all: u64,
}

impl Cores {
    /// Time that they have spent until now; `None` where the system does not say (`/proc/stat` is Linux').
    pub fn now() -> Option<Self> {
        Self::of(&fs::read_to_string("/proc/stat").ok()?)
    }

    /// The first line: user, nice, system, idle, waiting for disks, interrupts (two), stolen by other machines, …
    fn of(stat: &str) -> Option<Self> {
        let line = stat.lines().next()?.strip_prefix("cpu ")?;
        let ticks: Result<Vec<u64>, _> = line.split_whitespace().take(8).map(str::parse).collect();
        let ticks = ticks.ok().filter(|ticks| ticks.len() == 8)?;
        Some(Self {
            idle: ticks[3] + ticks[4],
            all: ticks.iter().sum(),
        })
    }

    /// Share of the time until `later` in which the cores were busy; `None` if none went by.
    pub fn busy_until(self, later: Self) -> Option<f64> {
        let all = later.all.checked_sub(self.all).filter(|all| *all > 0)?;
        let idle = later.idle.saturating_sub(self.idle).min(all);
        // Ticks of a run are far from 2^52.
        #[allow(clippy::cast_precision_loss)]
        Some((all - idle) as f64 / all as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_share_is_that_of_the_time_in_between() {
        let before = Cores::of("cpu  100 0 50 800 50 0 0 0 0 0\ncpu0 1 2 3\n").unwrap();
        let after = Cores::of("cpu  160 5 60 825 50 0 0 0 0 0\n").unwrap();
        assert_eq!((before.all, after.all), (1000, 1100));
        assert_eq!(before.busy_until(after), Some(0.75));
        assert_eq!(after.busy_until(after), None);
        assert_eq!(Cores::of("intr 1"), None);
    }
}
