//! References of a KML document to other files of its archive.

use std::collections::BTreeSet;

use super::shadow::is_shadow;
use super::xml::XmlElement;

/// Documents of an archive in the order in which links lead to them, each once.
pub(super) struct LinkedDocuments {
    waiting: Vec<String>,
    next: usize,
    most: usize,
    known: BTreeSet<String>,
    beyond: BTreeSet<String>,
}

impl LinkedDocuments {
    /// The first document, with at most `most` in all.
    pub fn new(first: String, most: usize) -> Self {
        Self {
            known: BTreeSet::from([first.clone()]),
            waiting: vec![first],
            next: 0,
            most,
            beyond: BTreeSet::new(),
        }
    }

    /// The next one to be read.
    pub fn next(&mut self) -> Option<String> {
        let name = self.waiting.get(self.next).cloned()?;
        self.next += 1;
        Some(name)
    }

    /// Takes note that a link leads to a document.
    pub fn link_to(&mut self, name: String) {
        if self.known.contains(&name) {
            return;
        }
        if self.known.len() < self.most {
            self.known.insert(name.clone());
            self.waiting.push(name);
        } else {
            self.beyond.insert(name);
        }
    }

    /// Number of those that are left out, as too many links lead to documents.
    pub fn left_out(&self) -> usize {
        self.beyond.len()
    }

    /// Whether a link leads to a document, or it is the first.
    pub fn has(&self, name: &str) -> bool {
        self.known.contains(name) || self.beyond.contains(name)
    }
}

/// The document of a KMZ that others hang on.
pub(super) fn main_document(names: &[String]) -> Option<String> {
    let is_kml = |name: &&String| name.to_ascii_lowercase().ends_with(".kml") && !is_shadow(name);
    let mut all = names.iter();
    let main = all.find(|name| *name == "doc.kml");
    main.or_else(|| names.iter().find(is_kml)).cloned()
}

/// Reference of a `NetworkLink`; `None` where it has none.
pub(super) fn linked(element: &XmlElement) -> Option<&str> {
    let link = element.child("Link").or_else(|| element.child("Url"))?;
    link.child_text("href")
}

/// Name among the files of what a document refers to; `None` if it is not there.
pub(super) fn resolved(names: &[String], document: &str, href: &str) -> Option<String> {
    if href.contains("://") {
        return None;
    }
    let href = href.split(['#', '?']).next().unwrap_or(href);
    let href = unescaped(href).replace('\\', "/");
    let mut parts: Vec<&str> = match href.strip_prefix('/') {
        Some(_) => Vec::new(),
        None => document.split('/').collect(),
    };
    parts.pop();
    for part in href.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            other => parts.push(other),
        }
    }
    let wanted = parts.join("/");
    let is_it = |name: &&String| **name == wanted;
    let is_like_it = |name: &&String| name.eq_ignore_ascii_case(&wanted);
    let found = names.iter().find(is_it);
    found.or_else(|| names.iter().find(is_like_it)).cloned()
}

/// A reference with its `%20` and the like as letters.
fn unescaped(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut plain = Vec::with_capacity(bytes.len());
    let mut i = 0;
    while let Some(byte) = bytes.get(i) {
        let code = (*byte == b'%')
            .then(|| u8::from_str_radix(text.get(i + 1..i + 3)?, 16).ok())
            .flatten();
        plain.push(code.unwrap_or(*byte));
        i += if code.is_some() { 3 } else { 1 };
    }
    String::from_utf8_lossy(&plain).into_owned()
}
