//! Metadata of an archive of tiles, and texts of web pages as plain ones.

use serde::Deserialize;

/// Most letters of a text that are kept.
const LONGEST: usize = 400;

/// Metadata of an archive.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ArchiveMetadata {
    /// Name of the map.
    pub name: Option<String>,
    /// Who made it, to be shown with it.
    pub attribution: Option<String>,
}

impl ArchiveMetadata {
    /// Reads the JSON of an archive; what is not there or no text is left out.
    pub fn read(json: &[u8]) -> Self {
        #[derive(Default, Deserialize)]
        #[serde(default)]
        struct Members {
            name: serde_json::Value,
            attribution: serde_json::Value,
        }
        let members: Members = serde_json::from_slice(json).unwrap_or_default();
        let text = |value: &serde_json::Value| {
            let plain = plain(value.as_str()?);
            (!plain.is_empty()).then_some(plain)
        };
        Self {
            name: text(&members.name),
            attribution: text(&members.attribution),
        }
    }
}

/// The text of a piece of a web page, without its tags and in one line.
fn plain(html: &str) -> String {
    let mut text = String::new();
    let mut rest = html;
    while let Some(at) = rest.find('<') {
        let (before, tagged) = rest.split_at(at);
        let Some((tag, after)) = tagged[1..].split_once('>') else {
            break;
        };
        text.push_str(before);
        // Behind a tag of a block there would be a new line.
        let tag = tag.trim_start_matches('/');
        if ["br", "p", "div", "li"]
            .iter()
            .any(|block| is_tag(tag, block))
        {
            text.push(' ');
        }
        rest = after;
    }
    text.push_str(rest);
    for (written, meant) in [
        ("&copy;", "©"),
        ("&#169;", "©"),
        ("&nbsp;", " "),
        ("&lt;", "<"),
        ("&gt;", ">"),
        ("&quot;", "\""),
        ("&#39;", "'"),
        ("&amp;", "&"),
    ] {
        text = text.replace(written, meant);
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    words.join(" ").chars().take(LONGEST).collect()
}

fn is_tag(tag: &str, name: &str) -> bool {
    let end = tag.find(|c: char| !c.is_ascii_alphanumeric());
    tag[..end.unwrap_or(tag.len())].eq_ignore_ascii_case(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_attribution_is_shown_without_the_tags_of_its_links() {
        let json =
            r#"{"attribution": "<a href=\"https://a.org\">&copy; A &amp; B</a><br/>C", "name": 3}"#;
        let metadata = ArchiveMetadata::read(json.as_bytes());
        assert_eq!(metadata.attribution.as_deref(), Some("© A & B C"));
        assert_eq!(metadata.name, None);
        assert_eq!(plain("2 < 3 people"), "2 < 3 people");
        assert_eq!(ArchiveMetadata::read(b"<html>"), ArchiveMetadata::default());
        let empty = br#"{"attribution": "<b> </b>"}"#;
        assert_eq!(ArchiveMetadata::read(empty).attribution, None);
    }
}
