//! What can be wrong with a cascade's file.

use thiserror::Error;

/// Why a cascade cannot be read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum CascadeError {
    /// The text is not XML.
    #[error("{file}: byte {offset}: {cause}")]
    Xml {
        /// Name of the file.
        file: String,
        /// Where in the file.
        offset: u64,
        /// What the parser says.
        cause: String,
    },
    /// The XML is not that of a cascade, or says things that cannot be.
    #[error("{file}: {place}: {cause}")]
    Content {
        /// Name of the file.
        file: String,
        /// Which element, by the names of those around it.
        place: String,
        /// What is wrong.
        cause: String,
    },
    /// Parts that make no cascade.
    #[error("{place}: {cause}")]
    Parts {
        /// Which part.
        place: String,
        /// What is wrong.
        cause: String,
    },
    /// Bytes that are no cascade in the compact form.
    #[error("byte {offset}: {cause}")]
    Bytes {
        /// How far it could be read.
        offset: usize,
        /// What is wrong.
        cause: String,
    },
}
