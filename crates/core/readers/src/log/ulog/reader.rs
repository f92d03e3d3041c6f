//! From message to message through a `ULog` file.

use super::super::release::release;
use super::super::stepping::{LogStep, LogSteps};
use super::super::wrong_times::SecondZero;
use super::super::{DefaultValue, Fact, Log, LogMessage, Parameter, TopicName};
use super::belief::{MessageTrust, belief};
use super::definition::Definitions;
use super::header::{HEADER, MAGIC};
use super::message::{FRAME, UlogMessage, frame, may_begin, parse};
use super::rows::Subscriptions;
use super::search::next_sure;
use super::value::Keyed;

/// The version whose form this is.
const VERSION: u8 = 1;
/// Rows this long before the start were measured before it, seconds: those of slow sensors are a little late.
const EARLIER: f64 = 2.0;
/// Default values of parameters: for the airframe rather than for the whole system.
const OF_AIRFRAME: u8 = 2;

/// The state of reading.
#[derive(Default)]
pub(super) struct Ulog {
    definitions: Definitions,
    subscriptions: Subscriptions,
    /// Latest time, seconds since the autopilot started.
    time: f64,
    /// Places in the file where data were appended, which no message crosses.
    appended: Vec<u64>,
    /// Why the next message has to be looked for, if it has.
    lost: Option<&'static str>,
    is_begun: bool,
    software: Software,
}

/// Software and hardware of the vehicle, as the log states them.
#[derive(Default)]
struct Software {
    system: String,
    release: String,
    version: String,
    hardware: String,
}

impl LogSteps for Ulog {
    fn end(&mut self, log: &mut Log) {
        log.leave_out_wrong_times(SecondZero::OfClock, |_| true);
        tell_earlier(log);
    }

    fn step(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        if !self.is_begun {
            return self.header(bytes, over, log);
        }
        let before = |start: u64| start.checked_sub(offset).filter(|bytes| *bytes > 0);
        let limit = self
            .appended
            .iter()
            .filter_map(|start| before(*start))
            .min();
        let limit = limit.map_or(usize::MAX, |limit| {
            usize::try_from(limit).unwrap_or(usize::MAX)
        });
        if self.appended.contains(&offset) {
            self.lost = None;
        }
        let over = over || bytes.len() >= limit;
        let bytes = &bytes[..bytes.len().min(limit)];
        match self.lost {
            Some(cause) => self.search(bytes, offset, over, cause, log),
            None => self.next(bytes, offset, over, log),
        }
    }
}

impl Ulog {
    fn header(&mut self, bytes: &[u8], over: bool, log: &mut Log) -> LogStep {
        if bytes.len() < HEADER && !over {
            return LogStep::Wait;
        }
        self.is_begun = true;
        if self.begin(bytes, log) {
            log.begins = Some(self.time);
            return LogStep::Took(HEADER);
        }
        log.report.remark("the file has no header of a ULog");
        log.report.skip(0, 1, "no header of a ULog");
        self.lost = Some("no header of a ULog");
        LogStep::Took(1)
    }

    /// Takes a header, if `bytes` begin with one.
    fn begin(&mut self, bytes: &[u8], log: &mut Log) -> bool {
        let Some(header) = bytes
            .get(..HEADER)
            .filter(|bytes| bytes.starts_with(&MAGIC))
        else {
            return false;
        };
        if header[MAGIC.len()] > VERSION {
            let version = header[MAGIC.len()];
            log.report.remark(format!(
                "the file is of version {version}, of which only what version {VERSION} has is read"
            ));
        }
        let mut microseconds = [0; 8];
        microseconds.copy_from_slice(&header[8..]);
        self.time = u64::from_le_bytes(microseconds) as f64 / 1e6;
        log.report.used_bytes += HEADER as u64;
        true
    }

    /// Another log begins within the file: what one was told holds no more.
    pub(super) fn begin_again(&mut self, bytes: &[u8], offset: u64, log: &mut Log) -> LogStep {
        self.begin(bytes, log);
        self.definitions = Definitions::default();
        self.subscriptions.forget();
        self.appended.clear();
        self.lost = None;
        log.report
            .remark(format!("another log begins at byte {offset}"));
        LogStep::Took(HEADER)
    }

    /// Takes the message that begins here.
    fn next(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        let lose = |reader: &mut Self, cause: &'static str, log: &mut Log| {
            reader.lost = Some(cause);
            log.report.skip(offset, 1, cause);
            LogStep::Took(1)
        };
        if bytes.len() < HEADER && !over && bytes.starts_with(&MAGIC[..3]) {
            return LogStep::Wait;
        }
        if bytes.len() >= HEADER && bytes.starts_with(&MAGIC) {
            return self.begin_again(bytes, offset, log);
        }
        let whole = frame(bytes).map(|(length, kind)| (FRAME + length, kind));
        let Some((length, kind)) = whole.filter(|(length, _)| *length <= bytes.len()) else {
            if !over {
                return LogStep::Wait;
            }
            return lose(self, "a message reaches beyond the end", log);
        };
        let message = match parse(kind, &bytes[FRAME..length]) {
            Ok(message) => message,
            Err(cause) => return lose(self, cause, log),
        };
        match belief(&self.definitions, &self.subscriptions, &message) {
            Err(cause) => return lose(self, cause, log),
            Ok(MessageTrust::Sure) => {}
            Ok(MessageTrust::Likely) => {
                let behind = &bytes[length..];
                if behind.len() < FRAME && !over {
                    return LogStep::Wait;
                }
                if behind.len() >= FRAME
                    && !may_begin(behind)
                    && !behind.starts_with(&MAGIC[..FRAME])
                {
                    return lose(self, "no message follows", log);
                }
            }
        }
        match self.take(message, offset, log) {
            Ok(()) => log.report.message(length),
            Err(cause) => log.report.skip(offset, length as u64, cause),
        }
        LogStep::Took(length)
    }

    /// Puts into the log what a message says, or tells why that cannot be.
    fn take(
        &mut self,
        message: UlogMessage,
        offset: u64,
        log: &mut Log,
    ) -> Result<(), &'static str> {
        match message {
            UlogMessage::Flags { unknown, appended } => self.flags(unknown, appended, offset, log),
            UlogMessage::Definition(definition) => self.definitions.add(definition),
            UlogMessage::Fact(value) => self.fact(&value, log),
            UlogMessage::Parameter(value) => {
                if let Some(number) = value.parameter() {
                    log.parameters.push(Parameter {
                        name: value.name.to_owned(),
                        value: number,
                        time: self.time,
                    });
                }
            }
            UlogMessage::Default { kinds, value } => add_default(kinds, &value, log),
            UlogMessage::Subscribe {
                number,
                instance,
                name,
            } => {
                let name = TopicName {
                    name: name.to_owned(),
                    instance: Some(u32::from(instance)),
                };
                self.subscriptions
                    .announce(number, name, &mut self.definitions, log);
            }
            UlogMessage::Row { number, row } => {
                let definitions = &mut self.definitions;
                let time = &mut self.time;
                if !self
                    .subscriptions
                    .store(number, row, definitions, time, log)
                {
                    return Err("a row of a topic that was not announced or cannot be read");
                }
            }
            UlogMessage::Words {
                severity,
                tag,
                microseconds,
                text,
            } => log.messages.push(LogMessage {
                time: microseconds as f64 / 1e6,
                source: tag.map(u32::from),
                severity: Some(severity),
                text: String::from_utf8_lossy(text).into_owned(),
            }),
            UlogMessage::Dropout(milliseconds) => {
                log.report.gap(self.time, f64::from(milliseconds) / 1e3);
            }
            UlogMessage::Unknown => return Err("a kind of message that is not known"),
            UlogMessage::Unsubscribe | UlogMessage::Sync => {}
        }
        Ok(())
    }

    fn flags(&mut self, unknown: bool, appended: [u64; 3], offset: u64, log: &mut Log) {
        if offset != HEADER as u64 {
            log.report
                .remark("flags that do not stand at the beginning are not heeded");
            return;
        }
        if unknown {
            log.report.remark(
                "the file says that it deviates from the form that is known here: what was read may be wrong",
            );
        }
        self.appended = appended.into_iter().filter(|start| *start > 0).collect();
    }

    fn fact(&mut self, value: &Keyed, log: &mut Log) {
        let text = value.text();
        let software = &mut self.software;
        match value.name {
            "sys_name" => software.system.clone_from(&text),
            "ver_hw" => software.hardware.clone_from(&text),
            "ver_sw" => software.version = text.chars().take(8).collect(),
            "ver_sw_release" => {
                if let Some(number) = value.number() {
                    software.release = release(number as u32);
                }
            }
            _ => {}
        }
        if matches!(
            value.name,
            "sys_name" | "ver_hw" | "ver_sw" | "ver_sw_release"
        ) {
            log.vehicle = software.words();
        }
        log.facts.push(Fact {
            name: value.name.to_owned(),
            text,
        });
    }

    /// Looks for the next message that is surely one.
    fn search(
        &mut self,
        bytes: &[u8],
        offset: u64,
        over: bool,
        cause: &str,
        log: &mut Log,
    ) -> LogStep {
        let (count, is_found) = next_sure(&self.definitions, &self.subscriptions, bytes, over);
        if count > 0 {
            log.report.skip(offset, count as u64, cause);
        }
        if is_found {
            self.lost = None;
            if count == 0 {
                return self.next(bytes, offset, over, log);
            }
        }
        if count == 0 {
            LogStep::Wait
        } else {
            LogStep::Took(count)
        }
    }
}

impl Software {
    fn words(&self) -> String {
        let version = if self.release.is_empty() {
            &self.version
        } else {
            &self.release
        };
        let software = [self.system.as_str(), version.as_str()];
        let software: Vec<_> = software
            .into_iter()
            .filter(|word| !word.is_empty())
            .collect();
        let words = [software.join(" "), self.hardware.clone()];
        let words: Vec<_> = words.into_iter().filter(|word| !word.is_empty()).collect();
        words.join(", ")
    }
}

/// Says which topics have rows that were measured well before logging began: they count, but not for how long it lasts.
fn tell_earlier(log: &mut Log) {
    let Some(begins) = log.begins else { return };
    let is_earlier = |topic: &&super::super::Topic| {
        let first = topic.times.iter().copied().fold(f64::INFINITY, f64::min);
        first < begins - EARLIER
    };
    let names: Vec<String> = log
        .topics
        .iter()
        .filter(is_earlier)
        .map(|t| t.name.to_string())
        .collect();
    if !names.is_empty() {
        let more = names.len().saturating_sub(5);
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        let names = names[..names.len().min(5)].join(", ");
        log.report.remark(format!(
            "logging began at {begins:.1} s: rows of {names}{more} tell what was measured earlier"
        ));
    }
}

fn add_default(kinds: u8, value: &Keyed, log: &mut Log) {
    let Some(number) = value.parameter() else {
        return;
    };
    for (bit, of_airframe) in [(1, false), (OF_AIRFRAME, true)] {
        if kinds & bit != 0 {
            log.defaults.push(DefaultValue {
                name: value.name.to_owned(),
                value: number,
                of_airframe,
            });
        }
    }
}
