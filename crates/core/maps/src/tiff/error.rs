//! Errors of a TIFF file.

/// Why a TIFF file, or a part of it, cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TiffError {
    /// The first bytes are not those of a TIFF file.
    #[error("{file}: not a TIFF file; its first bytes are not II or MM with 42 or 43")]
    NotTiff {
        /// Name of the file.
        file: String,
    },
    /// The bytes could not be had.
    #[error("{file}, {place}: {cause}")]
    Read {
        /// Name of the file.
        file: String,
        /// Part that was being read.
        place: String,
        /// Error in words.
        cause: String,
    },
    /// The file contradicts itself or ends too early.
    #[error("{file}, {place}: {cause}; the file is damaged or cut off, fetch or export it again")]
    Damaged {
        /// Name of the file.
        file: String,
        /// Tag, tile or byte.
        place: String,
        /// Error at that place, in words.
        cause: String,
    },
    /// The file is sound, but of a kind that is not read.
    #[error("{file}, {place}: {cause}")]
    Unsupported {
        /// Name of the file.
        file: String,
        /// Tag, tile or byte.
        place: String,
        /// Kind of the file, and kinds that would be read instead.
        cause: String,
    },
}

/// Makes errors that name one file and one place in it.
#[derive(Clone, Copy)]
pub(crate) struct Blame<'a> {
    /// Name of the file.
    pub file: &'a str,
    /// Tag, tile or byte.
    pub place: &'a str,
}

impl Blame<'_> {
    /// The bytes could not be had.
    pub fn read(self, cause: impl Into<String>) -> TiffError {
        TiffError::Read {
            file: self.file.to_owned(),
            place: self.place.to_owned(),
            cause: cause.into(),
        }
    }

    /// The file contradicts itself.
    pub fn damaged(self, cause: impl Into<String>) -> TiffError {
        TiffError::Damaged {
            file: self.file.to_owned(),
            place: self.place.to_owned(),
            cause: cause.into(),
        }
    }

    /// The file is of a kind that is not read.
    pub fn unsupported(self, cause: impl Into<String>) -> TiffError {
        TiffError::Unsupported {
            file: self.file.to_owned(),
            place: self.place.to_owned(),
            cause: cause.into(),
        }
    }
}
