//! The sign of the format.

/// Bytes that a file begins and ends with.
pub(super) const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
