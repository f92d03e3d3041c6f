//! Words of the page around the lessons stand in their texts, where whoever translates them finds all.

use std::collections::BTreeSet;
use std::path::Path;

use pilotage_lessons::text::page_words;

fn read(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../www")
        .join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|why| panic!("{}: {why}", path.display()))
}

/// Text from each `mark` up to the next `end`, with the rest behind that.
fn after<'t>(text: &'t str, mark: &str, end: char) -> Vec<(&'t str, &'t str)> {
    let places = text.split(mark).skip(1);
    places.filter_map(|rest| rest.split_once(end)).collect()
}

#[test]
fn the_page_says_before_its_program_is_there_what_the_texts_say() {
    let (page, words) = (read("learn.html"), page_words());
    let said = after(&page, "data-word=\"", '"');
    for (key, rest) in &said {
        let (_, rest) = rest.split_once('>').unwrap();
        let (shown, _) = rest.split_once('<').unwrap();
        assert_eq!(words.find(key), Some(shown), "{key}");
    }
    let labels = after(&page, "aria-label=\"", '"');
    for (label, rest) in &labels {
        let (key, _) = after(rest, "data-word-label=\"", '"')[0];
        assert!(rest.starts_with(" data-word-label"), "{label}");
        assert_eq!(words.find(key), Some(*label), "{key}");
    }
    assert!(said.len() >= 13 && labels.len() >= 3);
}

#[test]
fn scripts_and_style_say_nothing_that_is_not_in_the_texts() {
    let words = page_words();
    let mut keys = BTreeSet::new();
    for name in ["main.js", "menu.js", "presenter.js"] {
        let script = read(&format!("learn/{name}"));
        for mark in ["this.words.", "page.words.", " words."] {
            for place in script.split(mark).skip(1) {
                let letters = place.chars().take_while(char::is_ascii_alphabetic);
                keys.insert(letters.collect::<String>());
            }
        }
        for mark in ["words[\"", "page.words, \""] {
            keys.extend(
                after(&script, mark, '"')
                    .iter()
                    .map(|(key, _)| (*key).to_owned()),
            );
        }
        let said = after(&script, "textContent: \"", '"');
        assert!(said.is_empty(), "{name} says {said:?} by itself");
    }
    assert!(keys.len() >= 7, "{keys:?}");
    for key in keys {
        assert!(words.find(&key).is_some(), "{key}");
    }
    let style = read("learn/style.css");
    let letters = after(&style, "content: \"", '"');
    assert!(
        letters.iter().all(|(said, _)| said.len() < 3),
        "{letters:?}"
    );
}
