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
