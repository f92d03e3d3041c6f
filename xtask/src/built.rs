//! Places of what is built.

use std::{path::PathBuf, sync::OnceLock};

use crate::{metadata, places::root};

/// Cargo's folder for everything that is built, which people may have put elsewhere: in a variable or in cargo's own
/// settings.
pub fn target() -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let named = std::env::var_os("CARGO_TARGET_DIR").map(|folder| root().join(folder));
    let asked = || metadata::target().unwrap_or_else(|| root().join("target"));
    named.unwrap_or_else(|| FOLDER.get_or_init(asked).clone())
}

/// Folder in which the browser's journeys find the page.
pub fn page_under_test() -> PathBuf {
    target().join("page")
}
