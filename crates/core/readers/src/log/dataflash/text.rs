//! The same messages as lines of text.

use std::borrow::Cow;
use std::collections::HashMap;

use super::super::{Log, LogReader};
use super::contents::{Announced, DataflashContents};
use super::format::{FORMAT, HEADER, MessageFormat};
use super::letters::Letter;
use super::values;

/// Longest line, bytes: many times what any message needs.
const LONGEST: usize = 1 << 16;

const TALK: &str = "no kind of message has this name";
const LONG: &str = "a line is too long";
const SHORT: &str = "a line has too few values";

/// Reads `ArduPilot`'s dataflash logs that are text.
pub struct DataflashTextReader {
    contents: DataflashContents,
    /// Fields of the lines that begin with a name.
    lines: HashMap<String, LineFields>,
    /// The beginning of a line whose end has not come.
    begun: Vec<u8>,
    /// Whether the line is too long and left out.
    is_overlong: bool,
    /// Place in the file of the first byte that is not accounted for.
    offset: u64,
    /// Separator of values: a comma and a space, or only a comma.
    separator: &'static str,
    /// Bytes of the message that is being put together.
    body: Vec<u8>,
}

/// Fields in the lines of a kind of message.
#[derive(Clone, Debug)]
struct LineFields {
    number: u8,
    fields: Vec<Letter>,
    /// Fields that are modes.
    modes: Vec<usize>,
}

impl LineFields {
    fn of(format: &MessageFormat) -> Self {
        let (columns, _) = format.fields();
        let letters = format.letters.iter().take(columns.len()).enumerate();
        Self {
            number: format.number,
            fields: columns.iter().map(|column| column.letter).collect(),
            modes: letters
                .filter(|(_, l)| **l == b'M')
                .map(|(i, _)| i)
                .collect(),
        }
    }
}

/// Whether a file that begins so is such a log: one of its first lines announces a kind of message.
pub fn begins(head: &[u8]) -> bool {
    let announces = |line: &[u8]| {
        let line = text_of(line);
        let mut values = line
            .trim_start_matches('\u{feff}')
            .split(',')
            .map(str::trim);
        let is_number = |value: Option<&str>| value.is_some_and(|v| v.parse::<u8>().is_ok());
        let is_word = |value: Option<&str>| value.is_some_and(|v| !v.is_empty());
        values.next() == Some("FMT")
            && is_number(values.next())
            && is_number(values.next())
            && is_word(values.next())
            && is_word(values.next())
    };
    head.split(|b| *b == b'\n').any(announces)
}

/// Letters in UTF-8, or else in Latin-1.
fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    match str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

impl DataflashTextReader {
    /// A reader at the beginning of a file.
    pub fn new() -> Self {
        let line = LineFields::of(&MessageFormat::of_formats());
        Self {
            contents: DataflashContents::new(Announced::Otherwise),
            lines: HashMap::from([("FMT".to_owned(), line)]),
            begun: Vec::new(),
            is_overlong: false,
            offset: 0,
            separator: ", ",
            body: Vec::new(),
        }
    }

    /// Takes a line without its end, which takes another `end` bytes.
    fn take(&mut self, line: &[u8], end: usize, log: &mut Log) {
        let length = line.len() + end;
        if line.trim_ascii().is_empty() {
            log.report.used_bytes += length as u64;
        } else {
            let text = text_of(line);
            match self.message(text.trim_matches(['\u{feff}', '\r']), log) {
                Ok(()) => log.report.message(length),
                Err(cause) => log.report.skip(self.offset, length as u64, cause),
            }
        }
        self.offset += length as u64;
    }

    fn message(&mut self, text: &str, log: &mut Log) -> Result<(), &'static str> {
        let (name, rest) = text.split_once(',').unwrap_or((text, ""));
        let Some(line) = self.lines.get(name.trim()) else {
            self.contents.talk(text, log);
            return Err(TALK);
        };
        if line.number == FORMAT && self.lines.len() == 1 {
            self.separator = if rest.starts_with(' ') { ", " } else { "," };
        }
        let number = line.number;
        let values = values_of(rest.trim_start(), &line.fields, self.separator)?;
        let is_word = |field: &&usize| values[**field].parse::<f64>().is_err();
        if let Some(field) = line.modes.iter().find(is_word) {
            self.spell_mode(number, *field, log);
        }
        if number == FORMAT {
            self.announce(&values, log)?;
        }
        let Some(line) = self.lines.get(name.trim()) else {
            return Err(TALK);
        };
        self.body.clear();
        for (value, letter) in values.iter().zip(&line.fields) {
            values::put(value, letter, &mut self.body)?;
        }
        self.contents.row(number, &self.body, log)
    }

    /// Learns a kind of message. Its length is that of its letters, up to what a binary log could have.
    fn announce(&mut self, values: &[&str], log: &mut Log) -> Result<(), &'static str> {
        let [number, _, name, letters, columns] = *values else {
            return Err(SHORT);
        };
        let number = number.parse().map_err(|_| "a value is no number")?;
        let known = letters.bytes().map_while(Letter::of);
        let length = known.map(Letter::size).sum::<usize>() + HEADER;
        let length = length.min(usize::from(u8::MAX));
        match MessageFormat::new(number, length, name.to_owned(), letters, columns) {
            Ok(format) if number != FORMAT => self.learn(format, log),
            Ok(_) => {}
            Err(cause) => log.report.remark(cause),
        }
        Ok(())
    }

    fn learn(&mut self, format: MessageFormat, log: &mut Log) {
        self.lines.retain(|_, line| line.number != format.number);
        if format.name != "FMT" {
            self.lines
                .insert(format.name.clone(), LineFields::of(&format));
        }
        self.contents.add(format, log);
    }

    /// Makes letters of a field whose format says the number of a mode, where the log has its name.
    fn spell_mode(&mut self, number: u8, field: usize, log: &mut Log) {
        let Some(mut format) = self.contents.format(number).cloned() else {
            return;
        };
        let size = |letter: u8| Letter::of(letter).map_or(0, Letter::size);
        if let Some(letter) = format.letters.get_mut(field) {
            format.length += size(b'N') - size(*letter);
            *letter = b'N';
        }
        self.learn(format, log);
    }

    /// Takes the rest of a line.
    fn end_line(&mut self, rest: &[u8], end: usize, log: &mut Log) {
        if self.begun.is_empty() && !self.is_overlong && rest.len() <= LONGEST {
            self.take(rest, end, log);
            return;
        }
        self.keep(rest, log);
        if self.is_overlong {
            self.leave_out(end, log);
            self.is_overlong = false;
            return;
        }
        let mut line = std::mem::take(&mut self.begun);
        self.take(&line, end, log);
        line.clear();
        self.begun = line;
    }

    /// Keeps the beginning of a line, unless the line is too long.
    fn keep(&mut self, bytes: &[u8], log: &mut Log) {
        if !self.is_overlong && self.begun.len() + bytes.len() <= LONGEST {
            self.begun.extend_from_slice(bytes);
            return;
        }
        self.is_overlong = true;
        self.leave_out(self.begun.len() + bytes.len(), log);
        self.begun.clear();
    }

    fn leave_out(&mut self, bytes: usize, log: &mut Log) {
        if bytes > 0 {
            log.report.skip(self.offset, bytes as u64, LONG);
            self.offset += bytes as u64;
        }
    }
}

/// The values of a line, one for each field. The last one has all that is left where it is letters; they
/// may be missing.
fn values_of<'a>(
    line: &'a str,
    fields: &[Letter],
    separator: &str,
) -> Result<Vec<&'a str>, &'static str> {
    let mut values = Vec::with_capacity(fields.len());
    let mut rest = Some(line);
    for (i, letter) in fields.iter().enumerate() {
        let is_text = !letter.kind.is_number();
        let is_last = i + 1 == fields.len();
        let (value, after) = match rest {
            None if is_text && is_last => ("", None),
            None => return Err(SHORT),
            Some(rest) if is_last && is_text => (rest, None),
            Some(rest) => match rest.split_once(separator) {
                Some((value, after)) => (value, Some(after)),
                None => (rest.trim_end().trim_end_matches(','), None),
            },
        };
        values.push(value.trim());
        rest = after;
    }
    Ok(values)
}

impl Default for DataflashTextReader {
    fn default() -> Self {
        Self::new()
    }
}

impl LogReader for DataflashTextReader {
    fn feed(&mut self, bytes: &[u8], log: &mut Log) {
        log.report.bytes += bytes.len() as u64;
        let mut bytes = bytes;
        while let Some(end) = bytes.iter().position(|b| *b == b'\n') {
            self.end_line(&bytes[..end], 1, log);
            bytes = &bytes[end + 1..];
        }
        self.keep(bytes, log);
        self.contents.settle(log);
    }

    fn finish(&mut self, log: &mut Log) {
        if !self.begun.is_empty() {
            log.report
                .remark("the last line has no end and may be cut off");
        }
        self.end_line(&[], 0, log);
        self.contents.finish(log);
    }
}
