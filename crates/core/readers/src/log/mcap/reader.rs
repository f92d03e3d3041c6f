//! From record to record through a file.

use crc32fast::Hasher;

use super::attachment::{Attachment, attachment};
use super::chunk::{self, Packing};
use super::contents::McapContents;
use super::inside::ChunkRecords;
use super::magic::MAGIC;
use super::order::put_in_order;
use super::record::{
    ATTACHMENT, CHUNK, FRAME, MESSAGE, Record, frame, is_known, parse, whole_length,
};
use super::search::{followed, next_sure};
use super::stamps::count_by_stamps;
use crate::log::stepping::{LogStep, LogSteps};
use crate::log::wrong_times::SecondZero;
use crate::log::{Fact, Log, Topic};

const TOO_EARLY: &str = "the file ends too early";

/// The state of reading.
#[derive(Default)]
pub(super) struct Mcap {
    contents: McapContents,
    /// Why the next record has to be looked for, if it has.
    lost: Option<&'static str>,
    attachment: Option<Attachment>,
    /// Checksum of the section of the file that is being read.
    section: Hasher,
    /// Whether another section begins behind the record at hand.
    is_section_over: bool,
    stage: ReadStage,
}

#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum ReadStage {
    #[default]
    Before,
    Within,
    /// Behind the footer.
    Footed,
    /// Behind the mark that ends a file.
    Closed,
}

impl LogSteps for Mcap {
    fn step(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        let step = match (&mut self.attachment, self.lost) {
            _ if self.stage == ReadStage::Before => self.begin(bytes, over, log),
            (Some(_), _) => self.go_on_attaching(bytes, log),
            (None, Some(cause)) => self.search(bytes, offset, over, cause, log),
            (None, None) => self.next(bytes, offset, over, log),
        };
        if let LogStep::Took(count) = step {
            self.section.update(&bytes[..count.min(bytes.len())]);
            if self.is_section_over {
                self.is_section_over = false;
                self.section = Hasher::new();
            }
        }
        step
    }

    fn end(&mut self, log: &mut Log) {
        if let Some(attachment) = &self.attachment {
            let name = &attachment.name;
            log.report
                .remark(format!("the file ends within what is attached as {name}"));
        }
        if self.stage == ReadStage::Within {
            log.report.remark(
                "the file has no end: it was cut off, or whoever wrote it did not close it",
            );
        }
        self.contents.end(log);
        log.topics.iter_mut().for_each(put_in_order);
        count_by_stamps(log);
        tell_ellipsoid(log);
        log.tell_sets_by_name();
        log.tell_camera_imu();
        log.modes.sort_by(|a, b| a.time.total_cmp(&b.time));
        log.messages.sort_by(|a, b| a.time.total_cmp(&b.time));
        log.leave_out_wrong_times(SecondZero::OfFirstRow, |_| true);
    }
}

impl Mcap {
    fn begin(&mut self, bytes: &[u8], over: bool, log: &mut Log) -> LogStep {
        if bytes.len() < MAGIC.len() && !over {
            return LogStep::Wait;
        }
        self.stage = ReadStage::Within;
        if bytes.starts_with(&MAGIC) {
            log.report.used_bytes += MAGIC.len() as u64;
            return LogStep::Took(MAGIC.len());
        }
        log.report.remark("the file does not begin as MCAP does");
        self.lose(0, "no beginning of MCAP", log)
    }

    fn lose(&mut self, offset: u64, cause: &'static str, log: &mut Log) -> LogStep {
        self.lost = Some(cause);
        log.report.skip(offset, 1, cause);
        LogStep::Took(1)
    }

    /// Takes the record that begins here.
    fn next(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        if bytes.starts_with(&MAGIC) {
            return self.mark(offset, log);
        }
        let wait = |reader: &mut Self, log: &mut Log| {
            if over {
                reader.lose(offset, TOO_EARLY, log)
            } else {
                LogStep::Wait
            }
        };
        if MAGIC.starts_with(bytes) {
            return wait(self, log);
        }
        let Some((kind, length)) = frame(bytes) else {
            return wait(self, log);
        };
        match kind {
            CHUNK => match chunk::head(bytes) {
                None => return wait(self, log),
                Some(Err(cause)) => return self.lose(offset, cause, log),
                Some(Ok(head)) => {
                    if bytes.len() < head.length + head.packed && !over {
                        return LogStep::Wait;
                    }
                    return self.chunk(&head, bytes, offset, log);
                }
            },
            ATTACHMENT => match attachment(bytes) {
                None => return wait(self, log),
                Some(Err(cause)) => return self.lose(offset, cause, log),
                Some(Ok(attachment)) => return self.attach(attachment, log),
            },
            _ => {}
        }
        let Some(length) = whole_length(length) else {
            return self.lose(offset, "a record of impossible length", log);
        };
        let Some(contents) = bytes.get(FRAME..length) else {
            return wait(self, log);
        };
        // What is known by little needs another record behind it.
        if kind == MESSAGE || !is_known(kind) {
            match followed(&bytes[length..], over) {
                None => return LogStep::Wait,
                Some(false) => return self.lose(offset, "no record follows", log),
                Some(true) => {}
            }
        }
        if !is_known(kind) {
            let cause = "a record of a kind that is not known";
            log.report.skip(offset, length as u64, cause);
            return LogStep::Took(length);
        }
        match parse(kind, contents) {
            Ok(record) => self.take(record, bytes, length, offset, log),
            Err(cause) => self.lose(offset, cause, log),
        }
    }

    /// Takes what every file begins and ends with.
    fn mark(&mut self, offset: u64, log: &mut Log) -> LogStep {
        log.report.used_bytes += MAGIC.len() as u64;
        if self.stage == ReadStage::Footed {
            self.stage = ReadStage::Closed;
        } else {
            log.report
                .remark(format!("another file begins at byte {offset}"));
            self.contents.forget(log);
            self.stage = ReadStage::Within;
            self.section = Hasher::new();
        }
        LogStep::Took(MAGIC.len())
    }

    fn take(
        &mut self,
        record: Record,
        bytes: &[u8],
        length: usize,
        offset: u64,
        log: &mut Log,
    ) -> LogStep {
        match record {
            Record::DataEnd { checksum } => {
                let found = self.section.clone().finalize();
                compare(checksum, found, "the checksum of the data", log);
                self.is_section_over = true;
            }
            Record::Footer { checksum, .. } => {
                let mut summary = self.section.clone();
                summary.update(&bytes[..length - 4]);
                compare(
                    checksum,
                    summary.finalize(),
                    "the checksum of the summary",
                    log,
                );
                self.stage = ReadStage::Footed;
            }
            record => {
                if let Err(cause) = self.contents.take(record, log) {
                    log.report.skip(offset, length as u64, cause);
                    return LogStep::Took(length);
                }
            }
        }
        log.report.used_bytes += length as u64;
        LogStep::Took(length)
    }

    /// Takes a chunk, or what there is of it.
    fn chunk(
        &mut self,
        head: &chunk::ChunkHead,
        bytes: &[u8],
        offset: u64,
        log: &mut Log,
    ) -> LogStep {
        let end = head.length + head.packed;
        let is_whole = bytes.len() >= end;
        let length = end.min(bytes.len());
        if let Packing::Unknown(name) = &head.packing {
            log.report
                .remark(format!("chunks packed as {name} cannot be read"));
            let cause = "a chunk is packed in a way that is not known";
            log.report.skip(offset, length as u64, cause);
            return LogStep::Took(length);
        }
        let (records, trouble) = chunk::unpack(head, &bytes[head.length..length]);
        let mut is_sound = false;
        if is_whole && trouble.is_none() && head.checksum != 0 {
            is_sound = crc32fast::hash(&records) == head.checksum;
            if !is_sound {
                log.report.remark(format!(
                    "the checksum of the chunk at byte {offset} does not fit: what was read of it may be \
                     wrong"
                ));
            }
        }
        let is_packed = head.packing != Packing::Not;
        if is_packed {
            log.report.unpacked_bytes += records.len() as u64;
        }
        let inside = ChunkRecords {
            records: &records,
            offset: (!is_packed).then_some(offset + head.length as u64),
            is_sound,
        };
        let before = log.report.messages;
        let nonsense = inside.walk(&mut self.contents, log);
        if !is_packed {
            log.report.used_bytes += head.length as u64;
            return LogStep::Took(length);
        }
        // Packed bytes of what was read, by its share of what is packed: at most all that there are.
        let good = records.len() - nonsense;
        let share = good as f64 / (head.unpacked as f64).max(1.0);
        let packed = (head.packed as f64 * share) as usize;
        let used = (head.length + packed).min(length);
        let (used, cause) = if let Some(cause) = trouble.filter(|_| is_whole) {
            (used.min(length - 1), cause)
        } else if !is_whole {
            let count = log.report.messages - before;
            log.report.remark(format!(
                "the file ends within a packed chunk, of which {count} messages were read"
            ));
            (if count == 0 { 0 } else { used.min(length - 1) }, TOO_EARLY)
        } else if nonsense > 0 {
            let cause = "parts of a packed chunk make no sense";
            (used.min(length - 1), cause)
        } else {
            (length, "")
        };
        log.report.used_bytes += used as u64;
        if used < length {
            let lost = (length - used) as u64;
            log.report.skip(offset + used as u64, lost, cause);
        }
        LogStep::Took(length)
    }

    fn attach(&mut self, attachment: Attachment, log: &mut Log) -> LogStep {
        let head = attachment.head;
        log.report.used_bytes += head as u64;
        log.facts.push(Fact {
            name: format!("attached: {}", attachment.name),
            text: format!("{}, {} bytes", attachment.media, attachment.left - 4),
        });
        self.attachment = Some(attachment);
        LogStep::Took(head)
    }

    fn go_on_attaching(&mut self, bytes: &[u8], log: &mut Log) -> LogStep {
        let Some(attachment) = &mut self.attachment else {
            return LogStep::Wait;
        };
        let count = usize::try_from(attachment.left)
            .unwrap_or(usize::MAX)
            .min(bytes.len());
        let file = usize::try_from(attachment.left - attachment.left.min(4)).unwrap_or(usize::MAX);
        let (file, checksum) = bytes[..count].split_at(file.min(count));
        attachment.checksum.update(file);
        for byte in checksum {
            attachment.last.rotate_left(1);
            attachment.last[3] = *byte;
        }
        attachment.left -= count as u64;
        log.report.used_bytes += count as u64;
        if attachment.left == 0 {
            let found = attachment.checksum.clone().finalize();
            let what = format!("the checksum of what is attached as {}", attachment.name);
            compare(u32::from_le_bytes(attachment.last), found, &what, log);
            self.attachment = None;
        }
        LogStep::Took(count)
    }

    /// Looks for the next record that is surely one.
    fn search(
        &mut self,
        bytes: &[u8],
        offset: u64,
        over: bool,
        cause: &'static str,
        log: &mut Log,
    ) -> LogStep {
        let (count, is_found) = next_sure(&self.contents, bytes, over);
        if is_found {
            self.lost = None;
        }
        if count > 0 {
            log.report.skip(offset, count as u64, cause);
            LogStep::Took(count)
        } else if is_found {
            self.next(bytes, offset, over, log)
        } else {
            LogStep::Wait
        }
    }
}

/// Messages whose `altitude` is above the ellipsoid by their definition.
const ABOVE_ELLIPSOID: [&str; 3] = [
    "sensor_msgs/NavSatFix",
    "foxglove/LocationFix",
    "geographic_msgs/GeoPoseStamped",
];

/// Says of the first topic with heights above the ellipsoid that they are such.
fn tell_ellipsoid(log: &mut Log) {
    let height = |topic: &Topic| {
        let mut names = ["altitude", "pose.position.altitude"].into_iter();
        let is_told = |name: &&str| {
            let values = topic.values(name).unwrap_or_default();
            values.iter().any(|it| it.is_finite() && *it != 0.0)
        };
        let name = names.find(is_told)?;
        Some(format!("{}.{name}", topic.name))
    };
    let mut topics = log.topics.iter();
    let found = topics.find_map(|topic| {
        let is_such = ABOVE_ELLIPSOID.contains(&topic.kind().as_str());
        if is_such { height(topic) } else { None }
    });
    if let Some(name) = found {
        log.report.remark(format!(
            "{name} is above the ellipsoid of WGS 84 by its definition, which lies up to 107 m from sea level"
        ));
    }
}

/// Notes a checksum that does not fit; zero says that nobody computed one.
fn compare(said: u32, found: u32, what: &str, log: &mut Log) {
    if said != 0 && said != found {
        log.report.remark(format!(
            "{what} does not fit: values may be wrong that look right"
        ));
    }
}
