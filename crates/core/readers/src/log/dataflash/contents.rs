//! Effects of rows on the log as a whole: announcements, units, parameters, words, times.

use super::super::wrong_times::SecondZero;
use super::super::{Log, Topic};
use super::clock::{Clock, is_receiver};
use super::format::{FORMAT, HEADER, MessageFormat};
use super::topics::{MessageKind, Owners};
use super::units::{Labels, UnitTables};
use super::words::LogTexts;
use pilotage_base::sorting::sort;
use pilotage_base::text::by_count;

/// Why a message is skipped whose kind was never announced.
pub const UNANNOUNCED: &str = "a kind of message that was not announced";
const TOO_MANY: &str = "too many kinds of message";

/// Messages that mean more than their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SpecialMessage {
    None,
    Format,
    Labels,
    Unit,
    Multiplier,
    Parameter,
    Message,
    Mode,
    Version,
    Receiver,
}

impl SpecialMessage {
    fn of(format: &MessageFormat) -> Self {
        match format.name.as_str() {
            _ if format.number == FORMAT => Self::Format,
            "FMTU" => Self::Labels,
            "UNIT" => Self::Unit,
            "MULT" => Self::Multiplier,
            "PARM" => Self::Parameter,
            "MSG" => Self::Message,
            "MODE" => Self::Mode,
            "VER" => Self::Version,
            name if is_receiver(name) => Self::Receiver,
            _ => Self::None,
        }
    }
}

/// Way by which kinds of message become known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Announced {
    /// By the rows that announce them.
    ByRows,
    /// The reader says so itself.
    Otherwise,
}

/// The kinds of message that were announced, and all that was said of the log as a whole.
pub struct DataflashContents {
    kinds: Vec<Option<Box<(MessageKind, SpecialMessage)>>>,
    announced: Announced,
    units: UnitTables,
    clock: Clock,
    words: LogTexts,
    owners: Owners,
    /// Places of topics whose rows have times of their own.
    timed: Vec<usize>,
}

impl DataflashContents {
    /// Nothing but the announcement of announcements.
    pub fn new(announced: Announced) -> Self {
        let mut contents = Self {
            kinds: (0..256).map(|_| None).collect(),
            announced,
            units: UnitTables::default(),
            clock: Clock::new(),
            words: LogTexts::default(),
            owners: Owners::default(),
            timed: Vec::new(),
        };
        contents.set(MessageFormat::of_formats(), Labels::default());
        contents
    }

    /// The kind of message of that number.
    pub fn format(&self, number: u8) -> Option<&MessageFormat> {
        let kind = self.kinds[usize::from(number)].as_deref();
        kind.map(|(kind, _)| &kind.format)
    }

    /// Bytes of a message with its header, or `None` if its kind was not announced.
    #[inline]
    pub fn length(&self, number: u8) -> Option<usize> {
        Some(self.format(number)?.length + HEADER)
    }

    /// Bytes of a message with its header as the letters of its fields have it, where that is another number than the
    /// announced one and no row has told yet which is right.
    pub fn other_length(&self, number: u8) -> Option<usize> {
        let (kind, _) = self.kinds[usize::from(number)].as_deref()?;
        let length = kind.format.length_of_fields()?;
        (length != kind.format.length && kind.places().next().is_none()).then_some(length + HEADER)
    }

    /// Takes the length that the letters of its fields have for that of a kind of message.
    pub fn take_other_length(&mut self, number: u8, log: &mut Log) {
        let Some((format, length)) = self.format(number).cloned().zip(self.other_length(number))
        else {
            return;
        };
        log.report.remark(format!(
            "{}: announced with {} bytes, and read with the {length} that its fields have",
            format.name,
            format.length + HEADER
        ));
        let format = MessageFormat {
            length: length - HEADER,
            ..format
        };
        self.add(format, log);
    }

    /// Talk that is no message, such as the lines above a log that is text.
    pub fn talk(&mut self, text: &str, log: &mut Log) {
        self.words.talk(text, log);
    }

    /// Takes the bytes after a header.
    ///
    /// # Errors
    /// In words, if they have no place in the log.
    #[inline]
    pub fn row(&mut self, number: u8, body: &[u8], log: &mut Log) -> Result<(), &'static str> {
        let Some((kind, meaning)) = self.kinds[usize::from(number)].as_deref_mut() else {
            return Err(UNANNOUNCED);
        };
        let time = self.clock.time(kind.stamp.as_ref(), body, log);
        let place = kind.place(body, &mut self.owners, log).ok_or(TOO_MANY)?;
        let topic = &mut log.topics[place];
        if topic.is_empty() && kind.stamp.is_some() {
            self.timed.push(place);
        }
        topic.push(time, body);
        self.clock.put(place, topic.len() - 1);
        let meaning = *meaning;
        if meaning != SpecialMessage::None {
            self.understand(meaning, place, body, log);
        }
        Ok(())
    }

    fn understand(&mut self, meaning: SpecialMessage, place: usize, body: &[u8], log: &mut Log) {
        let row = MessageRow {
            topic: &log.topics[place],
            body,
        };
        let time = row.topic.times.last().copied().unwrap_or_default();
        match meaning {
            SpecialMessage::Format if self.announced == Announced::ByRows => {
                match MessageFormat::read(body) {
                    Ok(format) => self.add(format, log),
                    Err(cause) => log.report.remark(cause),
                }
            }
            SpecialMessage::None | SpecialMessage::Format => {}
            SpecialMessage::Labels => {
                let labels = Labels {
                    units: row.text("UnitIds").unwrap_or_default().into_bytes(),
                    multipliers: row.text("MultIds").unwrap_or_default().into_bytes(),
                };
                if let Some(number) = row.number("FmtType") {
                    self.label(number as u8, labels, log);
                }
            }
            SpecialMessage::Unit => {
                if let (Some(letter), Some(unit)) = (row.number("Id"), row.text("Label")) {
                    self.owners.is_changed |= self.units.unit(letter as i64 as u8, unit);
                }
            }
            SpecialMessage::Multiplier => {
                if let (Some(letter), Some(factor)) = (row.number("Id"), row.number("Mult")) {
                    self.owners.is_changed |= self.units.multiplier(letter as i64 as u8, factor);
                }
            }
            SpecialMessage::Parameter => {
                if let (Some(name), Some(value)) = (row.text("Name"), row.number("Value")) {
                    LogTexts::parameter(time, name, value, log);
                }
            }
            SpecialMessage::Message => {
                let number = row.number("ID").or_else(|| row.number("Id"));
                let piece = number.zip(row.number("Seq"));
                if let Some(text) = row.text("Message") {
                    self.words.message(time, &text, piece, log);
                }
            }
            SpecialMessage::Mode => {
                if let Some(name) = row.text("Mode") {
                    LogTexts::mode_name(time, &name, log);
                } else if let Some(number) = row.number("ModeNum").or_else(|| row.number("Mode")) {
                    self.words.mode_number(time, number as u32, log);
                }
            }
            SpecialMessage::Version => {
                let (build, firmware) = (row.number("BU"), row.text("FWS"));
                self.words.version(build, firmware.as_deref(), log);
            }
            SpecialMessage::Receiver => self.clock.fix(place, log),
        }
    }

    /// Learns a kind of message. One that is known already, under the same name, keeps its units.
    pub fn add(&mut self, format: MessageFormat, log: &mut Log) {
        if format.number == FORMAT || self.format(format.number) == Some(&format) {
            return;
        }
        if let Some(oddity) = format.oddity() {
            log.report.remark(oddity);
        }
        let known = self.kinds[usize::from(format.number)].as_deref_mut();
        let known = known.map(|(kind, _)| {
            kind.update(&self.units, &self.owners, log);
            kind
        });
        let known = known.filter(|kind| kind.format.name == format.name);
        let labels = known.map(|kind| kind.labels().clone());
        self.set(format, labels.unwrap_or_default());
    }

    fn set(&mut self, format: MessageFormat, labels: Labels) {
        let number = usize::from(format.number);
        let meaning = SpecialMessage::of(&format);
        let kind = MessageKind::new(format, labels, &self.units);
        self.kinds[number] = Some(Box::new((kind, meaning)));
    }

    fn label(&mut self, number: u8, labels: Labels, log: &mut Log) {
        let Some((kind, _)) = self.kinds[usize::from(number)].as_deref_mut() else {
            return;
        };
        if *kind.labels() == labels {
            return;
        }
        self.owners.is_changed = true;
        // What it may lose now keeps what was said so far.
        kind.update(&self.units, &self.owners, log);
        if kind.set_labels(labels, &self.units) {
            let whole = kind.whole();
            kind.sort(&mut self.owners, log);
            if kind.stamp.is_some() {
                self.timed.extend(kind.places());
            }
            // Another kind of the same name may share the topic that was taken apart.
            if let Some(place) = whole {
                let others = self.kinds.iter_mut().enumerate();
                for (_, other) in others.filter(|(i, _)| *i != usize::from(number)) {
                    if let Some((other, _)) = other.as_deref_mut()
                        && other.places().any(|other| other == place)
                    {
                        other.update(&self.units, &self.owners, log);
                        other.forget(place);
                    }
                }
            }
        }
    }

    /// Brings the topics up to what was said of units.
    pub fn settle(&mut self, log: &mut Log) {
        if std::mem::take(&mut self.owners.is_changed) {
            for (kind, _) in self.kinds.iter_mut().flatten().map(|kind| &mut **kind) {
                kind.update(&self.units, &self.owners, log);
            }
        }
    }

    /// Says what is odd about the times of a log that is over.
    pub fn finish(&mut self, log: &mut Log) {
        self.settle(log);
        let mut standing: Vec<(usize, String)> = Vec::new();
        self.timed.sort_unstable();
        self.timed.dedup();
        log.leave_out_wrong_times(SecondZero::OfClock, |place| {
            self.timed.binary_search(&place).is_ok()
        });
        self.clock.settle(log);
        for place in &self.timed {
            let topic = &log.topics[*place];
            let pairs = || topic.times.windows(2);
            let back = pairs().filter(|pair| pair[1] < pair[0]).count();
            let equal = pairs().filter(|pair| pair[1] == pair[0]).count();
            if equal > 0 {
                standing.push((equal, topic.name.to_string()));
            }
            let first = pairs().find(|pair| pair[1] < pair[0]);
            if let Some([before, after]) = first {
                let name = &topic.name;
                log.report.remark(format!(
                    "{name}: times go back {}from {before} s to {after} s",
                    match back {
                        1 => "once, ".to_owned(),
                        more => format!("{more} times, first "),
                    }
                ));
            }
        }
        if !standing.is_empty() {
            sort(&mut standing, &|a, b| {
                b.0.cmp(&a.0).then_with(|| a.1.cmp(&b.1))
            });
            let sum: usize = standing.iter().map(|(count, _)| count).sum();
            let most: Vec<_> = standing
                .iter()
                .take(5)
                .map(|(count, name)| format!("{name} {count}"))
                .collect();
            let most = most.join(", ");
            log.report.remark(format!(
                "{sum} {}: {most}",
                by_count(
                    sum,
                    "row has the time of the row before it",
                    "rows have the time of the row before them"
                )
            ));
        }
    }
}

/// A row with the fields of its topic.
struct MessageRow<'a> {
    topic: &'a Topic,
    body: &'a [u8],
}

impl MessageRow<'_> {
    /// The number as it is stored.
    fn number(&self, name: &str) -> Option<f64> {
        let field = self.topic.field(name)?;
        field.kind.number(field.bytes(self.body)?)
    }

    fn text(&self, name: &str) -> Option<String> {
        self.topic.field(name)?.text(self.body)
    }
}
