//! The format of a file, by its content first and its name where that leaves it open: every format of the table is asked.

use super::Format;
use super::file_look::{Claim, FileLook};

impl Format {
    /// The format of a file, by its content first and its name where that leaves it open.
    pub fn of(name: &str, bytes: &[u8]) -> Option<Self> {
        Self::claimed(name, bytes).1
    }

    /// Whether a file is to be read as one of a format: by its content, or by a name that files of anything do not have.
    ///
    /// ```
    /// use pilotage_mission::exchange::Format;
    ///
    /// assert!(Format::is_expected_in("a.txt", b"QGC WPL 110"));
    /// assert!(!Format::is_expected_in("a.txt", b"Dear Sir, the map"));
    /// assert!(Format::is_expected_in("a.gpx", b""));
    /// ```
    pub fn is_expected_in(name: &str, bytes: &[u8]) -> bool {
        Self::claimed(name, bytes).0 >= Claim::Likely || Self::is_extension_of_formats_alone(name)
    }

    /// The greatest claim to a file, and whose it is.
    fn claimed(name: &str, bytes: &[u8]) -> (Claim, Option<Self>) {
        let head = FileLook::head(bytes);
        let look = FileLook::new(name, bytes, &head);
        let mut found = (Claim::None, None);
        for format in Self::all() {
            let claim = (format.work().claims)(&look);
            if claim > found.0 {
                found = (claim, Some(format));
            }
        }
        found
    }
}
