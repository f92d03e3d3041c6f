//! How a job ends.

/// What a job may end with: an error that names the place and what to do.
pub type Outcome = Result<(), Box<dyn std::error::Error>>;
