//! Errors of a cascade's file.

use thiserror::Error;

/// Why a cascade cannot be read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum CascadeError {
    /// The text is not XML.
    #[error("{file}: byte {offset}: {cause}")]
    Xml {
        /// Name of the file.
        file: String,
        /// Byte of the file at which the error lies.
        offset: u64,
        /// Message of the parser.
        cause: String,
    },
    /// The XML is not that of a cascade, or says things that cannot be.
    #[error("{file}: {place}: {cause}")]
    Content {
        /// Name of the file.
        file: String,
        /// Element with the error, by the names of those around it.
        place: String,
        /// Description of the error.
        cause: String,
    },
    /// Parts that make no cascade.
    #[error("{place}: {cause}")]
    Parts {
        /// Part with the error.
        place: String,
        /// Description of the error.
        cause: String,
    },
    /// Bytes that are no cascade in the compact form.
    #[error("byte {offset}: {cause}")]
    Bytes {
        /// Number of bytes that could be read.
        offset: usize,
        /// Description of the error.
        cause: String,
    },
}
