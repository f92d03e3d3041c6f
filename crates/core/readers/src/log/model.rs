//! A log and what stands in it beside rows.

use std::collections::HashMap;

use serde::{Deserialize, Serialize};

use super::{FieldLayout, LogFormat, ReadReport, Topic, TopicName};
use crate::role::RoleSeries;
use crate::times::{TimeVerdict, judge};

/// A parameter of the autopilot at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Seconds in the log's time base.
    pub time: f64,
}

/// The value that a parameter has unless somebody sets it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DefaultValue {
    /// Name of the parameter.
    pub name: String,
    /// Value.
    pub value: f64,
    /// Whether it holds for this kind of airframe only, and outweighs the one of the whole system.
    pub of_airframe: bool,
}

/// Something that the log says of itself: a version, a serial number, what was printed at start.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fact {
    /// Name of the fact, in the log's words.
    pub name: String,
    /// Text of the fact.
    pub text: String,
}

/// Words that the autopilot wrote.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogMessage {
    /// Seconds in the log's time base.
    pub time: f64,
    /// Number of the speaker, where the log tells several apart.
    pub source: Option<u32>,
    /// Urgency as syslog counts it, 0 (emergency) to 7 (debug), where it is told.
    pub severity: Option<u8>,
    /// The words.
    pub text: String,
}

/// The autopilot changed how it flies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeChange {
    /// Seconds in the log's time base.
    pub time: f64,
    /// Name of the new mode, or its number where the name is not known.
    pub mode: String,
}

/// A flight log: everything that a file holds, as it was written.
#[derive(Clone, Debug)]
pub struct Log {
    /// Name of the file.
    pub name: String,
    /// Format that it was read from.
    pub format: LogFormat,
    /// Seconds since 1970 (UTC) at second zero of the log's time base, where the log tells.
    pub utc_at_zero: Option<f64>,
    /// When logging began by the file's header, seconds in the log's time base, where it tells. Rows may have been
    /// measured before.
    pub begins: Option<f64>,
    /// Kind of vehicle and software, in the log's words, or empty.
    pub vehicle: String,
    /// Systems that fly, where the log tells several apart, in the order in which they were heard.
    pub vehicles: Vec<u32>,
    /// System that people chose among them.
    pub(super) chosen: Option<u32>,
    /// Every kind of row, in the order in which they were first met.
    pub topics: Vec<Topic>,
    /// Series of which people, or a file beside them, said what they mean; of others the format tells it.
    pub given: Vec<RoleSeries>,
    /// Topics and fields of them that were not measured, whatever they are called: they count for no role.
    pub not_measured: Vec<(TopicName, String)>,
    /// Every parameter in the order of the file; later values of one name stand after earlier ones.
    pub parameters: Vec<Parameter>,
    /// Default values of parameters, where the log has them.
    pub defaults: Vec<DefaultValue>,
    /// Facts that the log states of itself, in the order of the file; long texts come in several pieces.
    pub facts: Vec<Fact>,
    /// Words of the autopilot.
    pub messages: Vec<LogMessage>,
    /// Changes of mode.
    pub modes: Vec<ModeChange>,
    /// Report of the bytes read and skipped.
    pub report: ReadReport,
    index: HashMap<TopicName, usize>,
}

impl Log {
    /// A log of which nothing was read yet.
    pub fn new(name: impl Into<String>, format: LogFormat) -> Self {
        Self {
            name: name.into(),
            format,
            utc_at_zero: None,
            begins: None,
            vehicle: String::new(),
            vehicles: Vec::new(),
            chosen: None,
            topics: Vec::new(),
            given: Vec::new(),
            not_measured: Vec::new(),
            parameters: Vec::new(),
            defaults: Vec::new(),
            facts: Vec::new(),
            messages: Vec::new(),
            modes: Vec::new(),
            report: ReadReport::default(),
            index: HashMap::new(),
        }
    }

    /// Place of the topic of that name, which is made if it is new.
    pub fn topic_or_new(
        &mut self,
        name: &TopicName,
        fields: impl FnOnce() -> Vec<FieldLayout>,
    ) -> usize {
        if let Some(place) = self.index.get(name) {
            return *place;
        }
        let place = self.topics.len();
        self.topics.push(Topic::new(name.clone(), fields()));
        self.index.insert(name.clone(), place);
        place
    }

    /// Place of the topic of that name and instance.
    pub fn place(&self, name: &TopicName) -> Option<usize> {
        self.index.get(name).copied()
    }

    /// Gives the topic at `place` another name; says whether it could: no other topic may have it.
    pub fn rename(&mut self, place: usize, name: &TopicName) -> bool {
        let Some(topic) = self.topics.get_mut(place) else {
            return false;
        };
        if self.index.contains_key(name) {
            return false;
        }
        self.index.remove(&topic.name);
        self.index.insert(name.clone(), place);
        topic.name = name.clone();
        true
    }

    /// The topic of that name and instance.
    pub fn topic(&self, name: &TopicName) -> Option<&Topic> {
        self.index.get(name).map(|place| &self.topics[*place])
    }

    /// The first topic of that name, whichever instance.
    pub fn first(&self, name: &str) -> Option<&Topic> {
        self.topics.iter().find(|t| t.name.name == name)
    }

    /// The last value of a parameter.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        let mut values = self.parameters.iter().rev();
        values.find(|p| p.name == name).map(|p| p.value)
    }

    /// First and last time of any row, seconds, from when logging [began](Self::begins) on; `None` without rows. A time
    /// far from those of the rows around it, as one damaged byte makes it, is none.
    pub fn span(&self) -> Option<(f64, f64)> {
        let sound = self.topics.iter().flat_map(|topic| {
            let verdicts = judge(&topic.times);
            let is_wrong = move |at: usize| {
                let verdict = verdicts.as_ref().map(|verdicts| verdicts[at]);
                verdict == Some(TimeVerdict::Wrong)
            };
            let kept = topic.times.iter().enumerate();
            let kept = kept.filter(move |(at, _)| !is_wrong(*at));
            kept.map(|(_, time)| *time)
        });
        let span =
            sound
                .filter(|time| time.is_finite())
                .fold(None, |span: Option<(f64, f64)>, time| {
                    let (first, last) = span.unwrap_or((time, time));
                    Some((time.min(first), time.max(last)))
                });
        span.map(|(first, last)| match self.begins {
            Some(begins) if begins <= last => (begins, last),
            _ => (first, last),
        })
    }

    /// Bytes that the rows and their times take in memory.
    pub fn memory(&self) -> usize {
        let of = |topic: &Topic| topic.rows.memory() + topic.times.capacity() * size_of::<f64>();
        self.topics.iter().map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::super::FieldKind;
    use super::*;

    #[test]
    fn a_topic_is_made_once_and_found_by_name_and_instance() {
        let mut log = Log::new("a.bin", LogFormat::Dataflash);
        let fields = || vec![FieldLayout::plain("Alt", FieldKind::U8, 0)];
        let second = TopicName {
            name: "BARO".to_owned(),
            instance: Some(1),
        };
        let place = log.topic_or_new(&second, fields);
        assert_eq!(log.topic_or_new(&second, Vec::new), place);
        log.topics[place].push(4.0, &[3]);
        log.topics[place].push(2.0, &[3]);
        assert!(log.topic(&TopicName::single("BARO")).is_none());
        assert_eq!(log.first("BARO").map(Topic::len), Some(2));
        assert_eq!(log.span(), Some((2.0, 4.0)));
    }

    #[test]
    fn times_far_off_are_no_part_of_the_span_however_many_follow_one_another() {
        let mut log = Log::new("a.bin", LogFormat::Dataflash);
        let place = log.topic_or_new(&TopicName::single("A"), Vec::new);
        for row in 0..100 {
            let is_wrong = (40..43).contains(&row);
            let time = if is_wrong { 9e12 } else { f64::from(row) };
            log.topics[place].push(time, &[]);
        }
        assert_eq!(log.span(), Some((0.0, 99.0)));
    }

    #[test]
    fn a_topic_is_found_by_its_new_name_only() {
        let mut log = Log::new("a.bin", LogFormat::Dataflash);
        let [old, new] = ["GPS", "GPS2"].map(TopicName::single);
        let place = log.topic_or_new(&old, Vec::new);
        assert!(log.rename(place, &new));
        assert_eq!((log.place(&old), log.place(&new)), (None, Some(place)));
        assert_eq!(log.topics[place].name, new);
        log.topic_or_new(&old, Vec::new);
        assert!(!log.rename(place, &old));
        assert!(!log.rename(9, &TopicName::single("IMU")));
    }

    #[test]
    fn the_last_value_of_a_parameter_counts() {
        let mut log = Log::new("a.bin", LogFormat::Dataflash);
        for (time, value) in [(0.0, 1.0), (5.0, 2.0)] {
            log.parameters.push(Parameter {
                name: "ARSPD_RATIO".to_owned(),
                value,
                time,
            });
        }
        assert_eq!(log.parameter("ARSPD_RATIO"), Some(2.0));
        assert_eq!(log.parameter("ARSPD"), None);
    }
}
