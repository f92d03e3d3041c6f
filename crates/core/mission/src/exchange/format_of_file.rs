//! The format of a file, by its content first and its name where that leaves it open: every format of the table is asked.

use super::Format;
use super::file_look::{Claim, FileLook};

impl Format {
    /// The format of a file, by its content first and its name where that leaves it open.
    pub fn of(name: &str, bytes: &[u8]) -> Option<Self> {
        let head = FileLook::head(bytes);
        let look = FileLook::new(name, bytes, &head);
        let mut found = (Claim::None, None);
        for format in Self::all() {
            let claim = (format.work().claims)(&look);
            if claim > found.0 {
                found = (claim, Some(format));
            }
        }
        found.1
    }
}
