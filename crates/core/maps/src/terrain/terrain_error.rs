//! Why a file cannot be terrain.

use crate::GeoTiffError;

/// Why a file cannot be terrain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TerrainError {
    /// A `GeoTIFF` that cannot be read.
    #[error(transparent)]
    GeoTiff(#[from] GeoTiffError),
    /// A `GeoTIFF` that is a picture.
    #[error(
        "{file}: a picture with {samples} samples of colour a pixel; the bands of an elevation model have no colours"
    )]
    Picture {
        /// Name of the file.
        file: String,
        /// Samples of a pixel.
        samples: usize,
    },
    /// A `GeoTIFF` whose values are no heights, or in an unknown unit.
    #[error("{file}: {cause}")]
    Unit {
        /// Name of the file.
        file: String,
        /// The meaning of the values.
        cause: String,
    },
    /// A grid of text that cannot be read.
    #[error("{file}: {cause}")]
    Text {
        /// Name of the file.
        file: String,
        /// Error of the file, in words.
        cause: String,
    },
    /// A .hgt file that cannot be read.
    #[error("{file}: {cause}")]
    Hgt {
        /// Name of the file.
        file: String,
        /// Error of the file, in words.
        cause: String,
    },
}
