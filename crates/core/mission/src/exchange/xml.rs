//! A small tree of an XML text whose elements know where they stand.

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use super::ExchangeError;

/// Deepest nesting that is read; files of people have ten levels.
const DEEPEST: usize = 200;

/// An element with its text and its children; names are without their prefixes.
#[derive(Default)]
pub(super) struct XmlElement {
    /// Name without prefix.
    pub name: String,
    /// Attributes by their names without prefixes.
    pub attributes: Vec<(String, String)>,
    /// Elements in it, in order.
    pub children: Vec<XmlElement>,
    /// Text in it beside its children, without space around.
    pub text: String,
    /// First byte of the element in the text.
    pub begin: usize,
    /// Byte after the element in the text.
    pub end: usize,
}

impl XmlElement {
    /// The first child of that name.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|c| c.name == name)
    }

    /// All children of that name.
    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Self> {
        self.children.iter().filter(move |c| c.name == name)
    }

    /// Text of the first child of that name, if it is not empty.
    pub fn child_text(&self, name: &str) -> Option<&str> {
        let text = self.child(name)?.text.as_str();
        (!text.is_empty()).then_some(text)
    }

    /// An attribute.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(own, _)| own == name);
        found.map(|(_, value)| value.as_str())
    }
}

/// A text with the name of its file, to say where something is wrong.
pub(super) struct NamedText<'a> {
    /// Name of the file.
    pub file: &'a str,
    /// The text.
    pub text: &'a str,
}

impl NamedText<'_> {
    /// A complaint about the byte at `offset`.
    pub fn error(&self, offset: usize, cause: impl Into<String>) -> ExchangeError {
        let before = self.text.as_bytes();
        let before = &before[..offset.min(before.len())];
        let line_begin = before
            .iter()
            .rposition(|b| *b == b'\n')
            .map_or(0, |i| i + 1);
        ExchangeError::Place {
            file: self.file.to_owned(),
            line: before.split(|b| *b == b'\n').count(),
            column: before.len() - line_begin + 1,
            cause: cause.into(),
        }
    }

    /// The root element.
    pub fn root(&self) -> Result<XmlElement, ExchangeError> {
        let mut reader = Reader::from_str(self.text);
        reader.config_mut().allow_dangling_amp = true;
        let mut open: Vec<XmlElement> = Vec::new();
        loop {
            let begin = reader.buffer_position() as usize;
            let event = reader
                .read_event()
                .map_err(|e| self.error(reader.error_position() as usize, e.to_string()))?;
            let end = reader.buffer_position() as usize;
            let done = match event {
                Event::Start(tag) => {
                    if open.len() == DEEPEST {
                        return Err(self.error(begin, "elements are nested too deeply"));
                    }
                    open.push(element(&tag, begin));
                    None
                }
                Event::Empty(tag) => Some(element(&tag, begin)),
                Event::End(_) => open.pop(),
                Event::Text(text) => {
                    add(&mut open, &text.xml10_content());
                    None
                }
                Event::CData(text) => {
                    add(&mut open, &text.xml10_content());
                    None
                }
                Event::GeneralRef(name) => {
                    let known = match &*name {
                        "lt" => Some('<'),
                        "gt" => Some('>'),
                        "amp" => Some('&'),
                        "quot" => Some('"'),
                        "apos" => Some('\''),
                        _ => name.resolve_char_ref().ok().flatten(),
                    };
                    match known {
                        Some(character) => add(&mut open, character.encode_utf8(&mut [0; 4])),
                        // What the file does not declare stays as it stands.
                        None => add(&mut open, &format!("&{};", &*name)),
                    }
                    None
                }
                Event::Eof => {
                    let cause = match open.last() {
                        Some(open) => format!("the file ends before </{}>", open.name),
                        None => "there is no element in the file".to_owned(),
                    };
                    return Err(self.error(begin, cause));
                }
                _ => None,
            };
            if let Some(mut done) = done {
                done.end = end;
                done.text.truncate(done.text.trim_end().len());
                let space = done.text.len() - done.text.trim_start().len();
                done.text.drain(..space);
                match open.last_mut() {
                    Some(parent) => parent.children.push(done),
                    None => return Ok(done),
                }
            }
        }
    }
}

fn add(open: &mut [XmlElement], text: &str) {
    if let Some(element) = open.last_mut() {
        element.text.push_str(text);
    }
}

fn element(tag: &BytesStart, begin: usize) -> XmlElement {
    let mut attributes = tag.html_attributes();
    let attributes = attributes.with_checks(false).flatten();
    XmlElement {
        name: tag.local_name().as_ref().to_owned(),
        attributes: attributes
            .map(|a| {
                let value = a.normalized_value(XmlVersion::Implicit1_0);
                (
                    a.key.local_name().as_ref().to_owned(),
                    value.map_or_else(|_| String::new(), std::borrow::Cow::into_owned),
                )
            })
            .collect(),
        begin,
        ..XmlElement::default()
    }
}
