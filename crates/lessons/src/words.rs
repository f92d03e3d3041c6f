//! Words by their keys: of figures, of the page, of the glossary.

use std::collections::BTreeMap;

/// Words by key.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Words(BTreeMap<String, String>);

impl Words {
    /// Reads lines `- key: words`; what is wrong is the line that has no key.
    pub fn read(text: &str) -> Result<Self, String> {
        let lines = text.lines().filter(|line| line.starts_with("- "));
        let pairs = lines.map(|line| {
            let (key, words) = line[2..].split_once(": ").ok_or_else(|| line.to_owned())?;
            Ok::<_, String>((key.trim().to_owned(), words.trim().to_owned()))
        });
        Ok(Self(pairs.collect::<Result<_, String>>()?))
    }

    /// Words of a key; the key in brackets where there are none, which no test lets through.
    pub fn get(&self, key: &str) -> String {
        self.find(key)
            .map_or_else(|| format!("⟦{key}⟧"), str::to_owned)
    }

    /// Words of a key, if there are any.
    pub fn find(&self, key: &str) -> Option<&str> {
        self.0.get(key).map(String::as_str)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0
            .iter()
            .map(|(key, words)| (key.as_str(), words.as_str()))
    }
}

/// Words of the page around lessons.
pub fn page_words() -> Words {
    Words::read(include_str!("../texts/en/page.md")).unwrap_or_default()
}

/// Terms and what they mean.
pub fn glossary() -> Words {
    Words::read(include_str!("../texts/en/glossary.md")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_no_words_is_seen() {
        let words = Words::read("Some text.\n\n- truth: where it was\n- time: time, s").unwrap();
        assert_eq!(words.get("truth"), "where it was");
        assert_eq!(words.get("lie"), "⟦lie⟧");
        assert!(Words::read("- no colon").is_err());
    }

    #[test]
    fn the_page_and_the_glossary_have_words() {
        assert!(page_words().iter().count() > 20);
        assert!(glossary().iter().count() > 20);
    }
}
