//! `MAVLink` messages as ground stations write them down: each behind the time at which it came, eight
//! bytes with the highest first, microseconds since 1970 (UTC).
//!
//! A topic is a kind of message from one system, which is its instance; where several components of a
//! system send the same kind, those after the first, and all but the autopilot's, have a thousand times the system plus the
//! component.
//! Rows are the messages' payload. What they mean is in a table (`dialect.txt`), made from pymavlink's
//! definitions by `tests/oracles/mavlink_dialect.py`; the crate `mavlink` would be a type and some
//! functions for each of its messages. Values come in plain units: centimetres as metres.

mod airspeed;
mod checksum;
mod clock;
mod dialect;
mod frame;
mod meaning;
mod parameters;
mod reader;
mod receiver;
mod roles;
mod row;
mod units;
mod vehicle;
mod words;

#[cfg(test)]
mod tests;

pub(super) use roles::MEANING;

use super::stepping::Stepping;
use super::{LogFormat, LogFormatInfo};

/// The format.
pub(super) const INFO: LogFormatInfo = LogFormatInfo {
    format: LogFormat::Tlog,
    begins: frame::begins,
    reader: || Box::new(Stepping::<reader::Tlog>::default()),
};
