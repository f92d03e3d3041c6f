//! Descriptions of messages.

/// Description of the messages of a channel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Schema {
    pub name: String,
    pub encoding: String,
    pub data: Vec<u8>,
}
