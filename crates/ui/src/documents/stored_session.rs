//! The document in the storage.

use super::Session;

impl Session {
    /// As bytes for the storage: version 2, JSON behind a byte with the number.
    pub fn encode(&self) -> Vec<u8> {
        let mut bytes = vec![2];
        bytes.extend(serde_json::to_vec(self).unwrap_or_default());
        bytes
    }

    /// From the storage; `None` if it was written by a later version or is damaged.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        match bytes.split_first()? {
            (2, body) => serde_json::from_slice(body).ok(),
            _ => None,
        }
    }
}
