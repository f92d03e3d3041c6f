//! References of a KML document to other files of its archive.

use super::xml::XmlElement;

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
