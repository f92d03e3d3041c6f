//! Places of files and folders.

use std::path::{Path, PathBuf};

/// Root of the repository.
pub fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own)
}

/// Folder beside the repository with recorded flights and test vectors, on which many tests work.
pub fn recorded_data() -> PathBuf {
    root().join("../shared/data")
}

/// Folder in which the page is put together unless another one is named.
pub fn dist() -> PathBuf {
    root().join("dist")
}
