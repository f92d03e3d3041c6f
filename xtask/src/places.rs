//! Places of files and folders.

use std::path::{Path, PathBuf};

/// Root of the repository.
pub fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own)
}

/// Cargo's folder for everything that is built.
pub fn target() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => root().join(folder),
        None => root().join("target"),
    }
}

/// Folder in which the page is put together unless another one is named.
pub fn dist() -> PathBuf {
    root().join("dist")
}

/// Folder in which the browser's journeys find the page.
pub fn page_under_test() -> PathBuf {
    target().join("page")
}
