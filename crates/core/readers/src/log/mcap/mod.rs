//! MCAP, the container of Foxglove and ROS (<https://mcap.dev/spec>).
//!
//! The crate `mcap` of the format's authors needs C for packed chunks and gives up a file at the first record
//! that makes no sense, so that this reader is our own. Chunks may be packed with LZ4 or Zstandard.
//! Messages are JSON, Protocol Buffers, or those of ROS 1 and ROS 2; of any other, times and sizes are kept.
//!
//! Times are those at which messages were logged (of topics that were logged in bursts those that they carry), counted from the first message of the file, so that
//! nothing of their nanoseconds is lost; [`Log::utc_at_zero`](super::Log::utc_at_zero) tells its date.

mod attachment;
mod bytes;
mod chunk;
mod contents;
mod decode;
mod inside;
mod magic;
mod message_topic;
mod order;
mod reader;
mod record;
mod ros;
mod schema;
mod search;
mod stamps;
#[cfg(test)]
mod tests;
mod units;
mod words;
mod zstandard;

use magic::MAGIC;

pub(super) use ros::MEANING;

use super::stepping::Stepping;
use super::{LogFormat, LogFormatInfo};

/// The format.
pub(super) const INFO: LogFormatInfo = LogFormatInfo {
    format: LogFormat::Mcap,
    begins: |head| head.starts_with(&MAGIC),
    reader: || Box::new(Stepping::<reader::Mcap>::default()),
};
