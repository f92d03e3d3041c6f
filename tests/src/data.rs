//! Recorded flights and test vectors beside the repository.

use std::path::{Path, PathBuf};

/// Root of the repository.
pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Folder or file `name` of the shared data, or `None` (after saying so) where it is absent.
///
/// The data lie in `shared/data` beside the repository; a checkout without them still passes its
/// tests, and prints which of them had nothing to work on.
pub fn shared(name: &str) -> Option<PathBuf> {
    let place = repository().join("../shared/data").join(name);
    if place.exists() {
        return Some(place);
    }
    println!("skipped: no shared data ({name})");
    None
}
