//! Well-known text as a tree of keywords.

/// Longest text that is read, bytes.
const MOST_BYTES: usize = 100_000;
/// Deepest nesting that is read.
const DEEPEST: usize = 24;

/// A keyword with what stands in its brackets.
#[derive(Clone, Debug, PartialEq)]
pub struct WktNode {
    /// In capitals.
    pub keyword: String,
    /// Values in the brackets, in order.
    pub values: Vec<WktValue>,
}

/// A value in brackets.
#[derive(Clone, Debug, PartialEq)]
pub enum WktValue {
    /// In quotes.
    Text(String),
    /// A number.
    Number(f64),
    /// A word without brackets, like the direction of an axis.
    Word(String),
    /// A keyword with brackets.
    Node(WktNode),
}

impl WktNode {
    /// Reads a text that is one node; `None` if it is none or ends early.
    pub fn parse(text: &str) -> Option<Self> {
        if text.len() > MOST_BYTES {
            return None;
        }
        let mut rest = text.trim();
        let WktValue::Node(node) = value(&mut rest, 0)? else {
            return None;
        };
        rest.trim().is_empty().then_some(node)
    }

    /// The first text.
    pub fn name(&self) -> &str {
        let text = |value: &WktValue| matches!(value, WktValue::Text(_));
        match self.values.iter().find(|value| text(value)) {
            Some(WktValue::Text(text)) => text,
            _ => "",
        }
    }

    /// The numbers, in order.
    pub fn numbers(&self) -> Vec<f64> {
        let number = |value: &WktValue| match value {
            WktValue::Number(number) => Some(*number),
            _ => None,
        };
        self.values.iter().filter_map(number).collect()
    }

    /// The nodes directly inside.
    pub fn children(&self) -> impl Iterator<Item = &Self> {
        self.values.iter().filter_map(|value| match value {
            WktValue::Node(node) => Some(node),
            _ => None,
        })
    }

    /// The first node directly inside with one of these keywords.
    pub fn child(&self, keywords: &[&str]) -> Option<&Self> {
        self.children()
            .find(|child| keywords.contains(&child.keyword.as_str()))
    }

    /// The code that EPSG gives to what the node describes.
    pub fn code(&self) -> Option<u32> {
        let id = self.child(&["AUTHORITY", "ID"])?;
        if !id.name().eq_ignore_ascii_case("EPSG") {
            return None;
        }
        match id.values.get(1)? {
            WktValue::Text(text) => text.trim().parse().ok(),
            WktValue::Number(number) => Some(*number as u32),
            _ => None,
        }
    }
}

fn value(rest: &mut &str, depth: usize) -> Option<WktValue> {
    if depth > DEEPEST {
        return None;
    }
    *rest = rest.trim_start();
    if let Some(after) = rest.strip_prefix('"') {
        return quoted(rest, after);
    }
    let end = rest.find(['[', '(', ',', ']', ')'])?;
    let word = rest[..end].trim();
    *rest = &rest[end..];
    if !rest.starts_with(['[', '(']) {
        let number = word.parse().ok().filter(|v: &f64| v.is_finite());
        return Some(number.map_or_else(|| WktValue::Word(word.to_owned()), WktValue::Number));
    }
    let mut values = Vec::new();
    loop {
        // Past the bracket or the comma.
        *rest = &rest[1..];
        values.push(value(rest, depth + 1)?);
        *rest = rest.trim_start();
        match rest.chars().next()? {
            ',' => {}
            ']' | ')' => {
                *rest = &rest[1..];
                break;
            }
            _ => return None,
        }
    }
    let keyword = word.to_ascii_uppercase();
    Some(WktValue::Node(WktNode { keyword, values }))
}

/// A text up to its closing quote; two quotes in it are one.
fn quoted<'a>(rest: &mut &'a str, mut after: &'a str) -> Option<WktValue> {
    let mut text = String::new();
    loop {
        let (part, behind) = after.split_once('"')?;
        text.push_str(part);
        let Some(more) = behind.strip_prefix('"') else {
            *rest = behind;
            return Some(WktValue::Text(text));
        };
        text.push('"');
        after = more;
    }
}
