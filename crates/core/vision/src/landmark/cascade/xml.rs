//! The elements of a cascade's file as a tree.

use quick_xml::Reader;
use quick_xml::events::Event;

use super::CascadeError;

/// Deepest nesting that is read; cascades have about ten levels.
const DEEPEST: usize = 64;

/// An element with its text and what is in it.
#[derive(Debug, Default)]
pub(super) struct CascadeElement {
    pub name: String,
    pub type_id: Option<String>,
    pub text: String,
    pub children: Vec<CascadeElement>,
}

impl CascadeElement {
    /// The first child of that name.
    pub fn child(&self, name: &str) -> Option<&Self> {
        self.children.iter().find(|c| c.name == name)
    }

    /// The children that stand for the items of a list.
    pub fn items(&self) -> impl Iterator<Item = &Self> {
        self.children.iter().filter(|c| c.name == "_")
    }

    /// The numbers of the text, which spaces part; `None` if one of them is none.
    pub fn numbers<T: std::str::FromStr>(&self) -> Option<Vec<T>> {
        self.text
            .split_whitespace()
            .map(|w| w.parse().ok())
            .collect()
    }
}

/// The root of a text.
pub(super) fn read(file: &str, text: &str) -> Result<CascadeElement, CascadeError> {
    let mut reader = Reader::from_str(text);
    reader.config_mut().allow_dangling_amp = true;
    let error = |offset: u64, cause: String| CascadeError::Xml {
        file: file.to_owned(),
        offset,
        cause,
    };
    let mut open = vec![CascadeElement::default()];
    loop {
        let event = reader
            .read_event()
            .map_err(|cause| error(reader.error_position(), cause.to_string()))?;
        match event {
            Event::Start(ref start) | Event::Empty(ref start) => {
                let type_id = start.attributes().flatten();
                let type_id = type_id
                    .filter(|a| a.key.as_ref() == "type_id")
                    .map(|a| a.value.into_owned())
                    .next();
                let element = CascadeElement {
                    name: start.local_name().as_ref().to_owned(),
                    type_id,
                    ..CascadeElement::default()
                };
                if open.len() > DEEPEST {
                    let cause = format!("elements are nested over {DEEPEST} deep");
                    return Err(error(reader.buffer_position(), cause));
                }
                if matches!(event, Event::Empty(_)) {
                    if let Some(around) = open.last_mut() {
                        around.children.push(element);
                    }
                } else {
                    open.push(element);
                }
            }
            Event::End(_) => {
                if let (Some(done), Some(around)) = (open.pop(), open.last_mut()) {
                    around.children.push(done);
                }
            }
            Event::Text(words) => {
                if let Some(around) = open.last_mut() {
                    around.text.push_str(words.as_ref());
                }
            }
            Event::Eof => break,
            _ => {}
        }
    }
    let cause = || "the file ends inside an element".to_owned();
    let [root] = <[CascadeElement; 1]>::try_from(open)
        .map_err(|_| error(reader.buffer_position(), cause()))?;
    let mut top = root.children;
    if top.len() != 1 {
        return Err(error(
            0,
            format!("{} root elements instead of one", top.len()),
        ));
    }
    Ok(top.swap_remove(0))
}
