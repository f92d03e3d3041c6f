//! Rows that grow wider as messages bring more.

use std::fmt;

use super::{FieldKind, FieldLayout, Log, Rows, Topic, ValueScale};

/// Most fields of a topic.
const MOST_FIELDS: usize = 4096;
/// Most places for fields, made or not, that a topic may have.
const MOST_PLACES: usize = 1 << 16;
/// Longest text that is kept, in bytes.
const LONGEST_TEXT: usize = 256;
/// Shortest place of a text, in bytes.
const SHORTEST_TEXT: usize = 8;
/// Most elements of a list that are kept.
pub(super) const MOST_ELEMENTS: usize = 64;

/// Memory that rows may take: so much, and so many bytes for each byte of the messages. Messages that leave
/// out most of their fields take far less room than their rows.
const ROOM: u64 = 1 << 16;
const ROOM_PER_BYTE: u64 = 32;
/// Most times that all that memory may be moved because topics become wider.
const MOVES: u64 = 16;

/// Memory for the rows of all topics.
#[derive(Default)]
pub(super) struct Room {
    messages: u64,
    rows: u64,
    /// Bytes of rows that were moved because their topic became wider.
    moved: u64,
}

impl Room {
    /// Makes room for what a message of so many bytes may say.
    pub fn offer(&mut self, bytes: usize) {
        self.messages += bytes as u64;
    }

    fn whole(&self) -> u64 {
        ROOM + ROOM_PER_BYTE * self.messages
    }

    /// Bytes that more rows may take.
    fn left(&self) -> u64 {
        self.whole().saturating_sub(self.rows)
    }

    /// Greatest width that the rows of a topic may have, bytes.
    fn widest(&self, topic: &Topic) -> usize {
        let length = topic.len() as u64;
        let old = topic.rows.width() as u64;
        let by_room = (self.left() + old * length).saturating_sub(8) / (length + 1);
        let may_move = (MOVES * self.whole()).saturating_sub(self.moved);
        let by_moves = may_move.checked_div(length).unwrap_or(u64::MAX);
        usize::try_from(by_room.min(by_moves)).unwrap_or(usize::MAX)
    }
}

/// A step on the way to a field.
#[derive(Clone, Copy)]
pub(super) enum FieldStep<'a> {
    Name(&'a str),
    Index(usize),
}

/// The way to a field, from the last step back to the first.
#[derive(Clone, Copy, Default)]
pub(super) struct Path<'a> {
    last: Option<(&'a Path<'a>, FieldStep<'a>)>,
}

impl<'a> Path<'a> {
    pub fn then(&'a self, part: FieldStep<'a>) -> Self {
        Self {
            last: Some((self, part)),
        }
    }
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some((before, part)) = &self.last else {
            return Ok(());
        };
        before.fmt(f)?;
        match part {
            FieldStep::Index(index) => write!(f, "[{index}]"),
            FieldStep::Name(name) if before.last.is_some() => write!(f, ".{name}"),
            FieldStep::Name(name) => f.write_str(name),
        }
    }
}

/// Place for the values of a field, or of all fields of a part of a message.
#[derive(Debug, Default)]
pub(super) enum ValuePlace {
    /// Nothing came for it yet.
    #[default]
    New,
    /// There is no room for it.
    Refused,
    Field(usize),
    /// Places of its parts.
    Parts(Vec<ValuePlace>),
    /// Places of its parts by name, in the order in which they came.
    Named(Vec<(String, ValuePlace)>),
}

/// Unit of the values of a field by its name and kind, and what the stored number is multiplied by to have it.
pub(super) type FieldUnit = Box<dyn Fn(&str, FieldKind) -> (String, ValueScale) + Send>;

/// A row that is being filled, of a topic that may become wider for it.
pub(super) struct GrowingTable {
    topic: usize,
    units: FieldUnit,
    fields: Vec<FieldLayout>,
    row: Vec<u8>,
    /// Row of a message that says nothing.
    blank: Vec<u8>,
    /// Bytes of all fields together.
    width: usize,
    /// Most bytes of all fields together.
    widest: usize,
    /// Whether fields were made that do not lie side by side yet.
    is_wider: bool,
    places: usize,
    /// Something that was left out, if anything was.
    pub left_out: Option<String>,
}

impl GrowingTable {
    /// Rows for the topic at that place of the log, which has no fields yet.
    pub fn new(topic: usize, units: FieldUnit) -> Self {
        Self {
            topic,
            units,
            fields: Vec::new(),
            row: Vec::new(),
            blank: Vec::new(),
            width: 0,
            widest: 0,
            is_wider: false,
            places: 0,
            left_out: None,
        }
    }

    /// Place of the topic in the log.
    pub fn topic(&self) -> usize {
        self.topic
    }

    /// Begins a row.
    pub fn clear(&mut self, room: &Room, log: &Log) {
        let topic = &log.topics[self.topic];
        if self.is_wider {
            // The row before was not stored.
            self.lay_out();
        }
        self.widest = room.widest(topic);
        self.row.clear();
        self.row.extend_from_slice(&self.blank);
    }

    /// Puts a number, lowest byte first, where `place` says. Whether it could.
    #[inline]
    pub fn number(
        &mut self,
        place: &mut ValuePlace,
        path: &Path,
        kind: FieldKind,
        bytes: &[u8],
    ) -> bool {
        if let ValuePlace::New = place {
            *place = self.field(path, kind);
        }
        let ValuePlace::Field(field) = place else {
            return false;
        };
        let field = &self.fields[*field];
        if field.kind != kind {
            return false;
        }
        self.row[field.offset..field.offset + bytes.len()].copy_from_slice(bytes);
        true
    }

    /// Puts how many elements a list has.
    pub fn length(&mut self, place: &mut ValuePlace, path: &Path, length: usize) {
        let path = path.then(FieldStep::Name("length"));
        let length = u32::try_from(length).unwrap_or(u32::MAX);
        self.number(place, &path, FieldKind::U32, &length.to_le_bytes());
    }

    /// Notes that of a list no more than the first `kept` elements are put into rows.
    pub fn cut_list(&mut self, path: &Path, kept: usize) {
        self.leave_out(|| match kept {
            0 => format!("the bytes of {path}"),
            kept => format!("elements of {path} beyond the first {kept}"),
        });
    }

    /// Puts letters where `place` says; what is too long is cut.
    pub fn text(&mut self, place: &mut ValuePlace, path: &Path, letters: &[u8]) {
        let wanted = letters.len().min(LONGEST_TEXT);
        if wanted < letters.len() {
            self.leave_out(|| format!("letters of {path} beyond the first {LONGEST_TEXT}"));
        }
        let size = wanted.next_power_of_two().max(SHORTEST_TEXT) as u16;
        if let ValuePlace::New = place {
            *place = self.field(path, FieldKind::Text(size));
        }
        let ValuePlace::Field(field) = place else {
            return;
        };
        let field = &mut self.fields[*field];
        let FieldKind::Text(old) = field.kind else {
            return;
        };
        let more = usize::from(size.saturating_sub(old));
        if more > 0 && self.width + more <= self.widest {
            field.kind = FieldKind::Text(size);
            field.offset = self.row.len();
            self.row.resize(field.offset + usize::from(size), 0);
            self.width += more;
            self.is_wider = true;
        }
        let size = field.kind.size();
        let letters = whole_letters(&letters[..wanted.min(size)]);
        let bytes = &mut self.row[field.offset..field.offset + size];
        bytes[..letters.len()].copy_from_slice(letters);
    }

    /// Places of `count` parts, made if there are none; `None` if there is no room for so many.
    pub fn parts<'a>(
        &mut self,
        place: &'a mut ValuePlace,
        count: usize,
    ) -> Option<&'a mut [ValuePlace]> {
        if let ValuePlace::New = place {
            *place = ValuePlace::Parts(Vec::new());
        }
        let ValuePlace::Parts(parts) = place else {
            return None;
        };
        if parts.len() < count {
            let more = count - parts.len();
            if self.places + more > MOST_PLACES {
                return None;
            }
            self.places += more;
            parts.resize_with(count, ValuePlace::default);
        }
        Some(parts)
    }

    /// Place of the part of that name, which is most likely the one at `guess`; made if there is none.
    pub fn named<'a>(
        &mut self,
        place: &'a mut ValuePlace,
        name: &str,
        guess: usize,
    ) -> Option<&'a mut ValuePlace> {
        if let ValuePlace::New = place {
            *place = ValuePlace::Named(Vec::new());
        }
        let ValuePlace::Named(parts) = place else {
            return None;
        };
        let is_it = |part: &(String, ValuePlace)| part.0 == name;
        let found = match parts.get(guess) {
            Some(part) if is_it(part) => Some(guess),
            _ => parts.iter().position(is_it),
        };
        let found = match found {
            Some(found) => found,
            None if self.places < MOST_PLACES => {
                self.places += 1;
                parts.push((name.to_owned(), ValuePlace::New));
                parts.len() - 1
            }
            None => return None,
        };
        Some(&mut parts[found].1)
    }

    /// Makes a field, if there is room for it; none where there may be later.
    fn field(&mut self, path: &Path, kind: FieldKind) -> ValuePlace {
        if self.fields.len() >= MOST_FIELDS {
            self.leave_out(|| format!("fields beyond the first {MOST_FIELDS}"));
            return ValuePlace::Refused;
        }
        if self.width + kind.size() > self.widest {
            self.leave_out(|| format!("values of {path}, for want of room"));
            return ValuePlace::New;
        }
        let name = path.to_string();
        let name = if name.is_empty() {
            "value".to_owned()
        } else {
            name
        };
        let (unit, scale) = (self.units)(&name, kind);
        self.fields.push(FieldLayout {
            name,
            unit,
            scale,
            kind,
            offset: self.row.len(),
        });
        append_blank(&mut self.row, kind);
        self.width += kind.size();
        self.is_wider = true;
        ValuePlace::Field(self.fields.len() - 1)
    }

    fn leave_out(&mut self, what: impl FnOnce() -> String) {
        self.left_out.get_or_insert_with(what);
    }

    /// Appends the row to its topic. Whether there was room.
    pub fn store(&mut self, time: f64, room: &mut Room, log: &mut Log) -> bool {
        if self.is_wider {
            self.lay_out();
        }
        let topic = &mut log.topics[self.topic];
        let length = topic.len() as u64;
        let old = topic.rows.width();
        let growth = (self.width - old) as u64 * length;
        let row = (self.width + size_of::<f64>()) as u64;
        if growth + row > room.left() {
            return false;
        }
        if old != self.width {
            room.moved += self.width as u64 * length;
            self.widen(topic);
        }
        room.rows += growth + row;
        topic.push(time, &self.row);
        true
    }

    /// Puts the fields of the row side by side again.
    fn lay_out(&mut self) {
        let old = self.fields.clone();
        let mut offset = 0;
        self.blank.clear();
        for field in &mut self.fields {
            field.offset = offset;
            offset += field.kind.size();
            append_blank(&mut self.blank, field.kind);
        }
        self.row = moved(&self.row, &old, &self.fields, &self.blank);
        self.is_wider = false;
    }

    /// Puts all rows so far into the form of this one.
    fn widen(&self, topic: &mut Topic) {
        let mut rows = Rows::new(self.width);
        for old in topic.rows.iter() {
            rows.push(&moved(old, &topic.fields, &self.fields, &self.blank));
        }
        topic.rows = rows;
        topic.fields.clone_from(&self.fields);
    }
}

/// A row whose fields lie as `from` says, with its fields where `to` says.
fn moved(row: &[u8], from: &[FieldLayout], to: &[FieldLayout], blank: &[u8]) -> Vec<u8> {
    let mut new = blank.to_vec();
    for (from, to) in from.iter().zip(to) {
        let size = from.kind.size().min(to.kind.size());
        new[to.offset..to.offset + size].copy_from_slice(&row[from.offset..from.offset + size]);
    }
    new
}

/// Appends what stands for nothing: no number where there is such a thing, else zero.
fn append_blank(row: &mut Vec<u8>, kind: FieldKind) {
    match kind {
        FieldKind::F32 => row.extend_from_slice(&f32::NAN.to_le_bytes()),
        FieldKind::F64 => row.extend_from_slice(&f64::NAN.to_le_bytes()),
        _ => row.resize(row.len() + kind.size(), 0),
    }
}

/// The letters without those that were cut through.
fn whole_letters(letters: &[u8]) -> &[u8] {
    match str::from_utf8(letters) {
        Err(error) if error.error_len().is_none() => &letters[..error.valid_up_to()],
        _ => letters,
    }
}

#[cfg(test)]
mod tests {
    use super::super::{LogFormat, TopicName};
    use super::*;

    fn room() -> Room {
        let mut room = Room::default();
        room.offer(1 << 20);
        room
    }

    #[test]
    fn fields_that_come_late_leave_earlier_rows_without_a_value() {
        let mut log = Log::new("a.mcap", LogFormat::Mcap);
        let topic = log.topic_or_new(&TopicName::single("/a"), Vec::new);
        let (mut table, mut room) = (
            GrowingTable::new(topic, Box::new(|_, _| (String::new(), ValueScale::One))),
            room(),
        );
        let (mut word, mut numbers) = (ValuePlace::New, [ValuePlace::New, ValuePlace::New]);
        let root = Path::default();
        for (i, letters) in ["short", "a longer word", "ä"].into_iter().enumerate() {
            table.clear(&room, &log);
            table.text(
                &mut word,
                &root.then(FieldStep::Name("word")),
                letters.as_bytes(),
            );
            for (j, place) in numbers.iter_mut().enumerate().take(i) {
                let list = root.then(FieldStep::Name("list"));
                let bytes = (i as f64 + 0.5).to_le_bytes();
                table.number(
                    place,
                    &list.then(FieldStep::Index(j)),
                    FieldKind::F64,
                    &bytes,
                );
            }
            assert!(table.store(i as f64, &mut room, &mut log));
        }
        let topic = &log.topics[topic];
        let words = topic.texts("word").expect("there are words");
        assert_eq!(words, ["short", "a longer word", "ä"]);
        let first = topic.values("list[0]").expect("there are numbers");
        assert!(first[0].is_nan() && first[1..] == [1.5, 2.5]);
        let second = topic.values("list[1]").expect("there are numbers");
        assert!(second[..2].iter().all(|v| v.is_nan()) && second[2] == 2.5);
        assert_eq!(topic.rows.width(), 16 + 8 + 8);
    }

    #[test]
    fn rows_far_wider_than_what_they_say_are_refused() {
        let mut log = Log::new("a.mcap", LogFormat::Mcap);
        let topic = log.topic_or_new(&TopicName::single("/a"), Vec::new);
        let (mut table, mut room) = (
            GrowingTable::new(topic, Box::new(|_, _| (String::new(), ValueScale::One))),
            Room::default(),
        );
        let mut places: Vec<_> = (0..4000).map(|_| ValuePlace::New).collect();
        let root = Path::default();
        let mut stored = 0;
        for _ in 0..100 {
            table.clear(&room, &log);
            for (i, place) in places.iter_mut().enumerate() {
                table.number(
                    place,
                    &root.then(FieldStep::Index(i)),
                    FieldKind::F64,
                    &[0; 8],
                );
            }
            stored += usize::from(table.store(0.0, &mut room, &mut log));
        }
        assert!((1..4).contains(&stored), "{stored}");
        assert!(log.memory() < 3 << 16);
    }

    #[test]
    fn a_long_text_is_cut_between_letters_and_that_is_told() {
        let mut log = Log::new("a.mcap", LogFormat::Mcap);
        let topic = log.topic_or_new(&TopicName::single("/a"), Vec::new);
        let (mut table, mut room) = (
            GrowingTable::new(topic, Box::new(|_, _| (String::new(), ValueScale::One))),
            room(),
        );
        let mut place = ValuePlace::New;
        table.clear(&room, &log);
        let root = Path::default();
        let letters = format!("x{}", "ä".repeat(200));
        table.text(
            &mut place,
            &root.then(FieldStep::Name("word")),
            letters.as_bytes(),
        );
        table.store(0.0, &mut room, &mut log);
        let texts = log.topics[topic].texts("word").expect("there is a word");
        assert_eq!(texts, [format!("x{}", "ä".repeat(127))]);
        assert!(table.left_out.is_some_and(|what| what.contains("256")));
    }
}
