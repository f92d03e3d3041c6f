//! Packages that become programs of the page, and their profiles.

use crate::failure::Failure;

/// The target of the page.
pub const TARGET: &str = "wasm32-unknown-unknown";

/// The package of the page itself.
const PAGE: &str = "pilotage-web";

/// The packages that become programs: the page, what its workers run, the first of them at once, and the page of lessons.
pub const PROGRAMS: [&str; 4] = [
    PAGE,
    "pilotage-worker-flying",
    "pilotage-worker-whole",
    "pilotage-lesson-page",
];

/// Name of a package's program in `pkg/`, without its endings.
pub fn module_name(package: &str) -> String {
    package.replace('-', "_")
}

/// Profile that a page is built with.
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
    pub(super) fn of_program(self, package: &str) -> &'static str {
        match self {
            Self::Shipped if package == PAGE => "web-page",
            Self::Shipped | Self::Quick => self.name(),
        }
    }

    /// Brotli's quality from 0 to 11: the last grades cost many seconds and are for shipping.
    pub(super) fn brotli_quality(self) -> u32 {
        match self {
            Self::Quick => 5,
            Self::Shipped => 11,
        }
    }
}
