//! The end of a job.

/// Success, or an error that names the place and what to do.
pub type CommandResult = Result<(), Box<dyn std::error::Error>>;
