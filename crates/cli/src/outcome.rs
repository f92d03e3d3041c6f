//! The end of a job.

/// Success, or an error that names the place and what to do.
pub type CommandResult = Result<(), Box<dyn std::error::Error>>;

/// Failure of a command that went on without some: `done` of `all` `things` were `treated`, and of the others it was told
/// why.
pub fn all_done(done: usize, all: usize, things: &str, treated: &str) -> CommandResult {
    if done == all {
        return Ok(());
    }
    Err(format!("{} of {all} {things} could not be {treated}", all - done).into())
}

/// Flights of several seeds: those that cannot be flown are told, and the others go on.
#[derive(Debug)]
pub struct SeedFlights {
    first: u64,
    count: usize,
    /// Reasons of those that could not be flown.
    failed: Vec<String>,
}

impl SeedFlights {
    /// None flown yet of the seeds from `first` on, `end` left out.
    pub fn of((first, end): (u64, u64)) -> Self {
        Self {
            first,
            count: usize::try_from(end - first).unwrap_or(usize::MAX),
            failed: Vec::new(),
        }
    }

    /// Seed of flight `number`, from 0 on.
    pub fn seed(&self, number: usize) -> u64 {
        self.first + number as u64
    }

    /// Whether they are more than one.
    pub fn are_several(&self) -> bool {
        self.count > 1
    }

    /// Tells and counts that flight `number` could not be flown.
    pub fn fail(&mut self, number: usize, why: &str) {
        if !self.are_several() {
            return self.failed.push(why.to_owned());
        }
        let why = format!("seed {}: {why}", self.seed(number));
        eprintln!("{why}");
        self.failed.push(why);
    }

    /// Refusal where not one could be flown: there is nothing to tell of them.
    pub fn any(&self) -> Result<(), String> {
        let all_failed = self.failed.len() >= self.count;
        match self.failed.first().filter(|_| all_failed) {
            Some(why) => Err(why.clone()),
            None => Ok(()),
        }
    }

    /// Failure of the command where some could not be flown, once all else is told.
    pub fn all_done(&self) -> CommandResult {
        let done = self.count - self.failed.len();
        all_done(done, self.count, "flights", "flown")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_that_cannot_be_flown_is_counted_and_only_if_none_can_there_is_nothing_to_tell() {
        let mut seeds = SeedFlights::of((7, 9));
        assert!(seeds.any().is_ok() && seeds.all_done().is_ok());
        seeds.fail(1, "no wind");
        assert_eq!(seeds.any(), Ok(()));
        let told = seeds.all_done().unwrap_err().to_string();
        assert_eq!(told, "1 of 2 flights could not be flown");
        seeds.fail(0, "no camera");
        assert_eq!(seeds.any(), Err("seed 8: no wind".to_owned()));
    }
}
