//! Places of files and folders.

use std::{
    path::{Path, PathBuf},
    sync::OnceLock,
};

use crate::metadata;

/// Root of the repository.
pub fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own)
}

/// Folder beside the repository with recorded flights and test vectors, on which many tests work.
pub fn recorded_data() -> PathBuf {
    root().join("../shared/data")
}

/// Cargo's folder for everything that is built, which people may have put elsewhere: in a variable or in cargo's own
/// settings.
pub fn target() -> PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let named = std::env::var_os("CARGO_TARGET_DIR").map(|folder| root().join(folder));
    let asked = || metadata::target().unwrap_or_else(|| root().join("target"));
    named.unwrap_or_else(|| FOLDER.get_or_init(asked).clone())
}

/// Folder in which the page is put together unless another one is named.
pub fn dist() -> PathBuf {
    root().join("dist")
}

/// Folder in which the browser's journeys find the page.
pub fn page_under_test() -> PathBuf {
    target().join("page")
}
