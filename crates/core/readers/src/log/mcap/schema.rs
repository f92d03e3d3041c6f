//! How messages are described.

/// What the messages of a channel look like.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Schema {
    pub name: String,
    pub encoding: String,
    pub data: Vec<u8>,
}
