//! A small server for the page, on this machine only.
//!
//! It sends no isolation headers (COOP, COEP): with them the browser would refuse map tiles from
//! other servers.

mod exchange;
mod files;

use std::{
    net::TcpListener,
    path::{Path, PathBuf},
    sync::Arc,
    thread,
};

use crate::{
    arguments::Arguments,
    failure::Failure,
    page::{self, Profile},
    places, progress,
};

/// Options of `cargo xtask serve`.
#[derive(Debug)]
pub struct Options {
    port: u16,
    /// `None` serves what was built before.
    profile: Option<Profile>,
    dist: PathBuf,
}

impl Options {
    /// Takes the options from the command line.
    pub fn read(arguments: &mut Arguments) -> Result<Self, Failure> {
        let port = match arguments.value("--port")? {
            None => 8080,
            Some(text) => text
                .parse()
                .map_err(|_| Failure::Usage(format!("--port {text}: not a number up to 65535")))?,
        };
        let profile = match arguments.value("--profile")? {
            None => Profile::Quick,
            Some(name) => Profile::named(&name)?,
        };
        let profile = if arguments.flag("--no-build") {
            None
        } else {
            Some(profile)
        };
        let dist = arguments.folder("--dist")?.unwrap_or_else(places::dist);
        Ok(Self {
            port,
            profile,
            dist,
        })
    }
}

/// Builds the page unless told otherwise, and serves it until the program is stopped.
pub fn build_and_serve(options: &Options) -> Result<(), Failure> {
    let taken = |error: std::io::Error| Failure::Port {
        port: options.port,
        reason: error.to_string(),
    };
    // Before the page is built, which takes minutes: that the port is taken is known now.
    let listener = TcpListener::bind(("127.0.0.1", options.port)).map_err(taken)?;
    if let Some(profile) = options.profile {
        page::build(profile, &options.dist)?;
    }
    let dist = options
        .dist
        .canonicalize()
        .map_err(Failure::file(&options.dist))?;
    println!(
        "serving http://{}/ (Ctrl+C stops)",
        listener.local_addr().map_err(taken)?
    );
    progress::flush();
    let dist: Arc<Path> = dist.into();
    // A thread for each connection: a browser opens about six.
    for connection in listener.incoming().flatten() {
        let dist = Arc::clone(&dist);
        thread::spawn(move || {
            // A browser that goes away in the middle of an answer is its own affair.
            let _ = exchange::answer(connection, &dist);
        });
    }
    Ok(())
}
