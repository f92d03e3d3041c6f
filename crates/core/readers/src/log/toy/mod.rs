//! A toy format: rows of time, heading and airspeed, each behind a mark and before the sum of its bytes.

use super::stepping::{LogStep, LogSteps, Stepping};
use super::{FieldKind, FieldLayout, Log, LogFormat, LogFormatInfo, TopicName};
use crate::role::{DEGREE, Meaning, Role, field};

const MAGIC: &[u8] = b"TOYLOG1\n";
const MARK: u8 = 0xa5;
const TOPIC: &str = "TOY";
/// Bytes of a time and of the fields behind it.
const TIME: usize = 8;
const FIELDS: usize = 8;
const ROW: usize = 1 + TIME + FIELDS + 1;

/// The format.
pub(super) const INFO: LogFormatInfo = LogFormatInfo {
    format: LogFormat::Toy,
    begins: |head| head.starts_with(MAGIC),
    reader: || Box::new(Stepping::<Toy>::default()),
};

/// Meaning of the topic for a flight.
pub(super) const MEANING: Meaning = Meaning {
    roles: &[&[
        field(Role::Heading, TOPIC, "heading", DEGREE),
        field(Role::Airspeed, TOPIC, "airspeed", 1.0),
    ]],
    triggers: &[],
    conditions: &[],
};

#[derive(Default)]
struct Toy;

impl LogSteps for Toy {
    fn step(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep {
        let wanted = if offset == 0 { MAGIC.len() } else { ROW };
        if bytes.len() < wanted && !over {
            return LogStep::Wait;
        }
        if offset == 0 && bytes.starts_with(MAGIC) {
            log.report.used_bytes += MAGIC.len() as u64;
            return LogStep::Took(MAGIC.len());
        }
        let Some((time, fields)) = bytes.get(..ROW).and_then(parts) else {
            log.report.skip(offset, 1, "no row of a toy log");
            return LogStep::Took(1);
        };
        let layout = || {
            vec![
                FieldLayout::plain("heading", FieldKind::F32, 0),
                FieldLayout::plain("airspeed", FieldKind::F32, 4),
            ]
        };
        let place = log.topic_or_new(&TopicName::single(TOPIC), layout);
        log.topics[place].push(time, fields);
        log.report.message(ROW);
        LogStep::Took(ROW)
    }
}

/// Time and fields of a row, if it is one.
fn parts(row: &[u8]) -> Option<(f64, &[u8])> {
    let (sum, body) = row.split_last()?;
    let (mark, body) = body.split_first()?;
    let whole = body.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
    let (time, fields) = body.split_at_checked(TIME)?;
    let time = f64::from_le_bytes(time.try_into().ok()?);
    (*mark == MARK && *sum == whole).then_some((time, fields))
}

#[cfg(test)]
mod tests {
    use super::super::testing::read;
    use super::*;
    use crate::interpret::series;

    #[test]
    fn the_example_tells_a_turn_to_the_right() {
        let log = read(&INFO, include_bytes!("example.toy"), 5);
        assert!(log.report.is_clean());
        let heading = series(&log, Role::Heading).expect("a heading");
        assert_eq!(heading.times, [1.0, 1.5, 2.0, 2.5]);
        assert!((heading.values[3] - heading.values[0] - 30.0 * DEGREE).abs() < 1e-6);
    }
}
