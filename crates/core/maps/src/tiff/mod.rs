//! TIFF files read by pieces: directories first, then only the tiles or strips that are wanted.
//!
//! After the TIFF 6.0 specification, its supplements and `BigTIFF`. What is known: strips and tiles,
//! interleaved or by plane, 8 to 64 bits a sample, uncompressed, deflate, LZW, `PackBits`, JPEG, Zstandard,
//! `WebP` and LERC, both predictors, masks. Nothing in a damaged file makes it panic, loop, or ask for more memory
//! than the file's own size or [`LARGEST_CHUNK`].

mod compression;
mod decompress;
mod directory;
mod error;
mod file;
mod layout;
mod lerc;
mod samples;
mod tags;
#[cfg(test)]
pub(super) mod tests;

pub use compression::{Compression, LercWrap};
pub(super) use directory::Directory;
pub use error::TiffError;
pub use file::TiffFile;
pub use layout::{FillOrder, Photometric, SampleKind, TiffLayout};
pub use samples::{Chunk, TileSamples};
pub(super) use tags::Tag;

/// Most bytes of one decoded tile or strip.
pub const LARGEST_CHUNK: u64 = 64 << 20;
/// Most pixels of one tile or strip.
pub const MOST_CHUNK_PIXELS: usize = 16 << 20;
