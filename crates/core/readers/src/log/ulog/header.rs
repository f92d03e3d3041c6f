//! The header of a file.

/// Bytes that a file begins with; the version and the time of the start follow.
pub(super) const MAGIC: [u8; 7] = *b"ULog\x01\x12\x35";

/// Bytes of the header: what every file begins with, a version, the time of the start.
pub(super) const HEADER: usize = 16;
