//! Bytes at an offset: what a large map is read from, piece by piece.

use std::sync::Arc;

/// A file of which any range can be read: a part of a file on disk, of a file that was dropped on
/// the page, or of a URL.
///
/// Reading waits for the bytes. In a browser that is possible in a worker, where files and requests
/// have waiting forms.
pub trait ByteSource: Send + Sync {
    /// Name for messages, usually that of the file.
    fn name(&self) -> &str;

    /// Number of bytes.
    fn length(&self) -> u64;

    /// Exactly `length` bytes from `offset` on; the error says in words what went wrong.
    ///
    /// Callers stay within [`length`](Self::length), so that no more memory is asked for than the
    /// file has bytes.
    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String>;
}

/// A file that lies in memory.
#[derive(Clone, Debug)]
pub struct MemoryBytes {
    name: String,
    bytes: Arc<[u8]>,
}

impl MemoryBytes {
    /// The file `name` with the given contents.
    ///
    /// ```
    /// use pilotage_base::bytes::{ByteSource, MemoryBytes};
    ///
    /// let file = MemoryBytes::new("letters.txt", &b"abcdef"[..]);
    /// assert_eq!((file.name(), file.length()), ("letters.txt", 6));
    /// assert_eq!(file.read(2, 3)?, b"cde");
    /// assert!(file.read(4, 3).is_err());
    /// # Ok::<(), String>(())
    /// ```
    pub fn new(name: impl Into<String>, bytes: impl Into<Arc<[u8]>>) -> Self {
        Self {
            name: name.into(),
            bytes: bytes.into(),
        }
    }
}

impl ByteSource for MemoryBytes {
    fn name(&self) -> &str {
        &self.name
    }

    fn length(&self) -> u64 {
        self.bytes.len() as u64
    }

    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        usize::try_from(offset)
            .ok()
            .and_then(|start| self.bytes.get(start..start.checked_add(length)?))
            .map(<[u8]>::to_vec)
            .ok_or_else(|| "the file ends before".to_owned())
    }
}
