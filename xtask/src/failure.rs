//! Failures while building, serving and testing.

use std::{io, path::PathBuf};

/// A failure, worded for the person at the terminal.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The command line asks for something unknown.
    #[error("{0}")]
    Usage(String),
    /// A file or folder could not be read or written.
    #[error("{}: {source}", path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// A folder that was to be emptied holds something else than a built page.
    #[error("{}: holds files but no page built earlier; empty it or name another folder", .0.display())]
    ForeignFolder(PathBuf),
    /// A program could not be started.
    #[error("`{command}` could not be started: {source}; {advice}")]
    Start {
        /// The command line.
        command: String,
        /// Error of the system.
        source: io::Error,
        /// Advice to people.
        advice: String,
    },
    /// A program ended with a failure; its own words are above.
    #[error("`{command}` failed ({status})")]
    Command {
        /// The command line.
        command: String,
        /// Status with which it ended.
        status: std::process::ExitStatus,
    },
    /// The module could not be given its glue for the browser.
    #[error("{}: wasm-bindgen: {reason}", module.display())]
    Bindings {
        /// The module as the compiler wrote it.
        module: PathBuf,
        /// Reason that wasm-bindgen gives.
        reason: String,
    },
    /// The server could not take its port.
    #[error("port {port}: {reason}; `--port 0` takes a free one")]
    Port {
        /// The port asked for.
        port: u16,
        /// Reason that the system gives.
        reason: String,
    },
    /// A program needed for a check is missing.
    #[error("{program} is missing: {advice}")]
    Missing {
        /// Name of the missing program.
        program: &'static str,
        /// Advice on how to get it.
        advice: String,
    },
    /// A file of the repository does not hold what it should.
    #[error("{}: {reason}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// Reason in words.
        reason: String,
    },
    /// A check found something.
    #[error("{0}")]
    Check(String),
}

impl Failure {
    /// Turns what the system says about `path` into a failure.
    pub fn file(path: impl Into<PathBuf>) -> impl FnOnce(io::Error) -> Self {
        let path = path.into();
        move |source| Self::File { path, source }
    }
}
