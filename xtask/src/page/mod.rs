//! The page: a folder of plain files made from the wasm crates, `index.html` and `www/`.
//!
//! Layout: `index.html` and the content of `www/` at the root, the programs of the page and of its
//! workers with their glue in `pkg/`,
//! beside each text and module a `.br` and a `.gz`, and `build.json` with what was built.

mod compress;
mod files;
mod offline;
mod sizes;
mod wasm;
mod weights;

use std::path::Path;

pub use sizes::check as check_sizes;
pub use wasm::{TARGET, ensure_target, without_flags};

use crate::{failure::Failure, progress::step};

/// The package of the page itself.
const PAGE: &str = "pilotage-web";

/// The packages that become programs: the page, and what its workers run, the first of them at once.
pub const PROGRAMS: [&str; 3] = [PAGE, "pilotage-worker-flying", "pilotage-worker-whole"];

/// Name of a package's program in `pkg/`, without its endings.
pub fn module_name(package: &str) -> String {
    package.replace('-', "_")
}

/// How a page is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Quick to link, for working on it and for the browser's journeys.
    Quick,
    /// Small and fast, for shipping.
    Shipped,
}

impl Profile {
    /// The profile of that name.
    pub fn named(name: &str) -> Result<Self, Failure> {
        match name {
            "web-quick" => Ok(Self::Quick),
            "web" => Ok(Self::Shipped),
            _ => Err(Failure::Usage(format!(
                "no profile `{name}`; there are web-quick and web"
            ))),
        }
    }

    /// Its name in `Cargo.toml`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "web-quick",
            Self::Shipped => "web",
        }
    }

    /// The profile in `Cargo.toml` that the program of `package` is compiled in: what is shipped of the page itself
    /// has one of its own, small before fast, since its workers do what takes long.
    fn of_program(self, package: &str) -> &'static str {
        match self {
            Self::Shipped if package == PAGE => "web-page",
            Self::Shipped | Self::Quick => self.name(),
        }
    }

    /// Brotli's quality from 0 to 11: the last grades cost many seconds and are for shipping.
    fn brotli_quality(self) -> u32 {
        match self {
            Self::Quick => 5,
            Self::Shipped => 11,
        }
    }
}

/// Builds the page into `dist`, replacing a page that is there.
pub fn build(profile: Profile, dist: &Path) -> Result<(), Failure> {
    wasm::ensure_target()?;
    let modules = step(&format!("compiling the page ({})", profile.name()), || {
        wasm::compile(profile)
    })?;
    step("putting the page together", || {
        files::clear(dist)?;
        for module in &modules {
            wasm::bind(module, dist)?;
        }
        files::copy_shell(dist)?;
        offline::stamp(dist)
    })?;
    step("compressing", || {
        compress::folder(dist, profile.brotli_quality())
    })
}

/// Builds the page for shipping and prints its sizes.
pub fn pack(dist: &Path) -> Result<(), Failure> {
    build(Profile::Shipped, dist)?;
    println!();
    sizes::print(dist)?;
    println!();
    sizes::check(Profile::Shipped, dist)?;
    println!(
        "\n{} can be put under any path of any file server.",
        dist.display()
    );
    Ok(())
}
