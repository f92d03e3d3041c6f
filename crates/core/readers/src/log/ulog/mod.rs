//! PX4's `ULog` files.
//!
//! The crate `px4-ulog` reads pieces, too, but ends at the first message that makes no sense, tells no
//! place in the file and has no way on; so this reader is our own.
//!
//! Rows are stored as the file has them, without their number. Times are seconds since the autopilot
//! started; of appended data (what a crash left behind) as well.

mod belief;
mod definition;
mod header;
mod message;
mod reader;
mod rows;
mod search;
#[cfg(test)]
mod tests;
mod value;

use header::MAGIC;

pub(super) use super::px4_roles::MEANING;

use super::stepping::Stepping;
use super::{LogFormat, LogFormatInfo};

/// The format.
pub(super) const INFO: LogFormatInfo = LogFormatInfo {
    format: LogFormat::Ulog,
    begins: |head| head.starts_with(&MAGIC),
    reader: || Box::new(Stepping::<reader::Ulog>::default()),
};
