//! Contents of a log, without its rows.

use pilotage_base::sorting::sort;
use serde::{Deserialize, Serialize};

use super::{Log, LogFormat, LogMessage, ModeChange, ReadReport, SetParameter, Topic, TopicName};

/// A field of a topic.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FieldOutline {
    /// Name.
    pub name: String,
    /// Unit as the log states it, or empty.
    pub unit: String,
    /// Whether it holds numbers that can be plotted.
    pub is_number: bool,
}

/// A topic without its rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TopicOutline {
    /// Name.
    pub name: TopicName,
    /// Number of rows.
    pub rows: usize,
    /// First and last time, seconds, from when logging began on if any row is; `None` without rows.
    pub span: Option<(f64, f64)>,
    /// Fields in the order of the file.
    pub fields: Vec<FieldOutline>,
}

impl TopicOutline {
    fn of(topic: &Topic, begins: Option<f64>) -> Self {
        let is_logged = |time: &&f64| begins.is_none_or(|begins| **time >= begins);
        let first = topic.times.iter().find(is_logged).or(topic.times.first());
        let fields = topic.fields.iter().map(|field| FieldOutline {
            name: field.name.clone(),
            unit: field.unit.clone(),
            is_number: field.kind.is_number(),
        });
        Self {
            name: topic.name.clone(),
            rows: topic.len(),
            span: first.copied().zip(topic.times.last().copied()),
            fields: fields.collect(),
        }
    }

    /// Rows per second from the first to the last, 0 with fewer than two.
    ///
    /// ```
    /// # use pilotage_readers::bytes::MemoryBytes;
    /// use pilotage_readers::log::{LogOutline, read_log};
    ///
    /// # let text = "FMT, 1, 13, ATT, Qc, TimeUS,Roll\nATT, 1000000, 1.5\nATT, 1500000, -2.25\nATT, 2000000, 0\n";
    /// # let source = MemoryBytes::new("flight.log", text.as_bytes());
    /// // Three rows within a second.
    /// let outline = LogOutline::of(&read_log(&source)?.ok_or("no log")?);
    /// let attitude = outline.topics.iter().find(|topic| topic.name.name == "ATT").ok_or("no attitude")?;
    /// assert_eq!((attitude.rows, attitude.span), (3, Some((1.0, 2.0))));
    /// assert_eq!(attitude.rate(), 2.0);
    /// # Ok::<(), String>(())
    /// ```
    pub fn rate(&self) -> f64 {
        match self.span {
            Some((from, to)) if to > from && self.rows > 1 => (self.rows - 1) as f64 / (to - from),
            _ => 0.0,
        }
    }
}

/// Contents of a log, without its rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogOutline {
    /// Name of the file.
    pub name: String,
    /// Format that it was read from.
    pub format: LogFormat,
    /// Kind of vehicle and software, in the log's words, or empty.
    pub vehicle: String,
    /// Systems that are vehicles, where the log tells several apart, in the order in which they were heard.
    pub vehicles: Vec<u32>,
    /// The one of them that flies.
    pub chosen_vehicle: Option<u32>,
    /// Seconds since 1970 (UTC) at second zero of the log's time base, where the log tells.
    pub utc_at_zero: Option<f64>,
    /// First and last time of any row, seconds.
    pub span: Option<(f64, f64)>,
    /// Topics with rows, by name.
    pub topics: Vec<TopicOutline>,
    /// Every parameter as it was last set, by name.
    pub parameters: Vec<SetParameter>,
    /// Words of the autopilot.
    pub messages: Vec<LogMessage>,
    /// Changes of mode.
    pub modes: Vec<ModeChange>,
    /// Report of the bytes read and skipped.
    pub report: ReadReport,
}

impl LogOutline {
    /// The outline of a log as far as it has been read.
    pub fn of(log: &Log) -> Self {
        let with_rows = log.topics.iter().filter(|topic| !topic.is_empty());
        let mut topics: Vec<TopicOutline> = with_rows
            .map(|topic| TopicOutline::of(topic, log.begins))
            .collect();
        sort(&mut topics, &|a, b| a.name.cmp(&b.name));
        Self {
            name: log.name.clone(),
            format: log.format,
            vehicle: log.vehicle.clone(),
            vehicles: log.vehicles.clone(),
            chosen_vehicle: log.chosen_vehicle(),
            utc_at_zero: log.utc_at_zero,
            span: log.span(),
            topics,
            parameters: log.set_parameters(),
            messages: log.messages.clone(),
            modes: log.modes.clone(),
            report: log.report.clone(),
        }
    }
}
