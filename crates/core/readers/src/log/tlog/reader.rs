//! From message to message through a file of stamped `MAVLink`.

use std::collections::HashMap;

use super::super::stepping::{LogStep, LogSteps};
use super::super::wrong_times::SecondZero;
use super::super::{Log, TopicName};
use super::dialect::{Dialect, MessageDefinition};
use super::frame::{MavlinkFrame, NoFrame, STAMP, may_begin};
use super::meaning::SpecialMessages;
use super::receiver::ReceiverLeaps;
use super::row::{PayloadRow, Sender};

/// Most topics: kinds of messages times their senders. A file made to harm could have millions.
const MOST_TOPICS: usize = 10_000;
/// Two times that are further apart do not follow one another unless others say the same.
const DAY: u64 = 86_400 * 1_000_000;
/// The year 2000 in microseconds since 1970: a clock that is behind it was never set.
const YEAR_2000: u64 = 946_684_800 * 1_000_000;
/// Factor of the system that makes room for a component, and the number that stands for system 0 then, which
/// would leave none.
const COMPONENTS: u32 = 1000;
const SYSTEM_0: u32 = 256;
/// `MAV_COMP_ID_AUTOPILOT1`.
const AUTOPILOT: u8 = 1;

/// The state of reading.
#[derive(Default)]
pub(super) struct Tlog {
    dialect: Dialect,
    /// Topic and instance of a kind of message from a system and a component.
    places: HashMap<(u32, u8, u8), (usize, u32)>,
    /// Time of the first message and of the last, microseconds since 1970.
    times: Option<(u64, u64)>,
    /// Why the next message has to be looked for, if it has.
    lost: Option<&'static str>,
    meaning: SpecialMessages,
    leaps: ReceiverLeaps,
}

impl LogSteps for Tlog {
    fn step(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        match self.lost {
            Some(cause) => self.search(bytes, offset, over, cause, log),
            None => self.next(bytes, offset, over, log),
        }
    }

    fn end(&mut self, log: &mut Log) {
        if let Some((first, _)) = self.times {
            self.leaps.straighten(first as f64 / 1e6, log);
        }
        self.meaning.end(log);
        super::clock::count_by_messages(log);
        log.leave_out_wrong_times(SecondZero::OfFirstRow, |_| true);
        super::airspeed::mark_ground_speed(log);
    }
}

impl Tlog {
    fn lose(&mut self, cause: &'static str, offset: u64, log: &mut Log) -> LogStep {
        self.lost = Some(cause);
        log.report.skip(offset, 1, cause);
        LogStep::Took(1)
    }

    /// Takes the message that begins here.
    fn next(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        let frame = match MavlinkFrame::parse(bytes) {
            Ok(frame) => frame,
            Err(NoFrame::Short) if !over => return LogStep::Wait,
            Err(NoFrame::Short) => {
                return self.lose("a message reaches beyond the end", offset, log);
            }
            Err(NoFrame::None) => return self.lose("no time and no message", offset, log),
        };
        let behind = &bytes[frame.length..];
        if let Some((_, last)) = self.times
            && frame.time.abs_diff(last) > DAY
        {
            match behind
                .first_chunk::<STAMP>()
                .copied()
                .map(u64::from_be_bytes)
            {
                None if !over => return LogStep::Wait,
                Some(next) if next.abs_diff(last) <= DAY => {
                    return self.lose("a time far from those around it", offset, log);
                }
                _ => {}
            }
        }
        let Some(definition) = self.dialect.get(frame.number) else {
            if behind.len() <= STAMP && !over {
                return LogStep::Wait;
            }
            if !may_begin(behind) {
                return self.lose("no time and no message", offset, log);
            }
            let remark = format!("messages of kind {} are not known", frame.number);
            log.report.remark(remark);
            let cause = "a kind of message that is not known";
            log.report.skip(offset, frame.length as u64, cause);
            return LogStep::Took(frame.length);
        };
        if !frame.is_sound(definition.seed) {
            return self.lose("a wrong checksum", offset, log);
        }
        let place = place(&mut self.places, &frame, definition, log);
        let Some((topic, instance)) = place else {
            log.report
                .skip(offset, frame.length as u64, "too many senders");
            return LogStep::Took(frame.length);
        };
        let (first, last) = self.times.get_or_insert_with(|| {
            let is_set = frame.time >= YEAR_2000;
            log.utc_at_zero = is_set.then_some(frame.time as f64 / 1e6);
            (frame.time, frame.time)
        });
        let step = (i128::from(frame.time) - i128::from(*last)) as f64 / 1e6;
        self.leaps.note(step, log);
        *last = frame.time;
        let time = (i128::from(frame.time) - i128::from(*first)) as f64 / 1e6;
        log.topics[topic].push(time, frame.payload);
        log.report.message(frame.length);
        let sender = Sender {
            system: frame.system,
            component: frame.component,
            instance,
        };
        let row = || PayloadRow::new(&definition.fields, frame.payload);
        self.meaning.take(frame.number, sender, time, row, log);
        LogStep::Took(frame.length)
    }

    /// Looks for the next message whose checksum is right.
    fn search(
        &mut self,
        bytes: &[u8],
        offset: u64,
        over: bool,
        cause: &str,
        log: &mut Log,
    ) -> LogStep {
        let mut count = bytes.len();
        let mut is_found = false;
        for place in 0..bytes.len() {
            match MavlinkFrame::parse(&bytes[place..]) {
                Err(NoFrame::None) => continue,
                Err(NoFrame::Short) if over => continue,
                Err(NoFrame::Short) => {}
                Ok(frame) => {
                    let definition = self.dialect.get(frame.number);
                    is_found = definition.is_some_and(|definition| frame.is_sound(definition.seed));
                    if !is_found {
                        continue;
                    }
                }
            }
            count = place;
            break;
        }
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

/// Topic and instance of what that sender sends of that kind; `None` beyond [`MOST_TOPICS`].
fn place(
    places: &mut HashMap<(u32, u8, u8), (usize, u32)>,
    frame: &MavlinkFrame,
    definition: &MessageDefinition,
    log: &mut Log,
) -> Option<(usize, u32)> {
    let sender = (frame.number, frame.system, frame.component);
    if let Some(place) = places.get(&sender) {
        return Some(*place);
    }
    if places.len() >= MOST_TOPICS {
        log.report.remark("messages are left out: too many senders");
        return None;
    }
    let system = u32::from(frame.system);
    let mut name = TopicName {
        name: definition.name.to_owned(),
        instance: Some(system),
    };
    let of_component = |component: u8| {
        let system = if system == 0 { SYSTEM_0 } else { system };
        Some(COMPONENTS * system + u32::from(component))
    };
    if log.topic(&name).is_some() {
        // The autopilot's own are those of the system, whoever else of it was heard before.
        let before = places.iter_mut().find(|((number, of, _), (_, instance))| {
            (*number, *of, *instance) == (frame.number, frame.system, system)
        });
        let before = before.filter(|_| frame.component == AUTOPILOT);
        let is_moved = before.is_some_and(|((_, _, component), (topic, instance))| {
            let moved = TopicName {
                instance: of_component(*component),
                ..name.clone()
            };
            let is_moved = log.rename(*topic, &moved);
            if is_moved {
                *instance = moved.instance.unwrap_or(system);
            }
            is_moved
        });
        if !is_moved {
            name.instance = of_component(frame.component);
        }
    }
    let instance = name.instance.unwrap_or(system);
    let topic = log.topic_or_new(&name, || definition.fields.clone());
    places.insert(sender, (topic, instance));
    Some((topic, instance))
}
