//! Content of a file on its way from the page to its workers.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::whole_bytes;

/// Content of a file, or the place where a worker reads it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum FileContent {
    /// Its bytes.
    Bytes(#[serde(with = "whole_bytes")] Arc<[u8]>),
    /// A file that stays where it is, on the user's disk, and is read by pieces.
    Lent {
        /// Number under which the shell lends it.
        number: u32,
        /// Its length, bytes.
        length: u64,
    },
    /// A file of the web, read by pieces at its address.
    Address(String),
}

impl FileContent {
    /// Its length, bytes.
    pub fn length(&self) -> u64 {
        match self {
            Self::Bytes(bytes) => bytes.len() as u64,
            Self::Lent { length, .. } => *length,
            Self::Address(_) => 0,
        }
    }

    /// Its bytes, if they are here.
    pub fn bytes(&self) -> Option<&Arc<[u8]>> {
        match self {
            Self::Bytes(bytes) => Some(bytes),
            Self::Lent { .. } | Self::Address(_) => None,
        }
    }
}

impl From<Vec<u8>> for FileContent {
    fn from(bytes: Vec<u8>) -> Self {
        Self::Bytes(bytes.into())
    }
}
