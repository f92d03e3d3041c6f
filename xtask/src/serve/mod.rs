//! A small server for the page, on this machine only.
//!
//! It sends no isolation headers (COOP, COEP): with them the browser would refuse map tiles from
//! other servers.

mod request;

use std::{path::PathBuf, sync::Arc, thread};

use tiny_http::Server;

use crate::{
    arguments::Arguments,
    failure::Failure,
    page::{self, Profile},
    places, progress,
};

/// Requests answered at the same time.
const THREADS: usize = 4;

/// What `cargo xtask serve` was asked for.
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
    if let Some(profile) = options.profile {
        page::build(profile, &options.dist)?;
    }
    let dist = options
        .dist
        .canonicalize()
        .map_err(Failure::file(&options.dist))?;
    let server = Server::http(("127.0.0.1", options.port)).map_err(|error| Failure::Port {
        port: options.port,
        reason: error.to_string(),
    })?;
    let server = Arc::new(server);
    println!("serving http://{}/ (Ctrl+C stops)", server.server_addr());
    progress::flush();
    let workers = (0..THREADS).map(|_| {
        let (server, dist) = (Arc::clone(&server), dist.clone());
        thread::spawn(move || {
            for incoming in server.incoming_requests() {
                // A browser that goes away in the middle of an answer is its own affair.
                let _ = request::answer(incoming, &dist);
            }
        })
    });
    let workers: Vec<_> = workers.collect();
    for worker in workers {
        worker
            .join()
            .map_err(|_| Failure::Check("the server stopped by itself".to_owned()))?;
    }
    Ok(())
}
