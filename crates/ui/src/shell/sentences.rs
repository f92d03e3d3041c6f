//! Notes of files and jobs in the words of a notice.

use std::fmt::Write as _;

use pilotage_core::text::{by_count, capitalised};

/// Most notes that are shown of a file; the others are counted.
const MOST_NOTES: usize = 6;

/// A number of things in words: `1 box`, `2 boxes`.
pub fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", by_count(count, one, several))
}

/// Notes as sentences.
pub fn sentences(notes: &[String]) -> String {
    let mut text = String::new();
    for note in notes.iter().take(MOST_NOTES) {
        let note = note.trim_end_matches('.');
        if !note.is_empty() {
            text.push_str(&capitalised(note));
            text.push_str(". ");
        }
    }
    if let Some(more) = notes.len().checked_sub(MOST_NOTES).filter(|n| *n > 0) {
        // Writing into a string cannot fail.
        let _ = write!(text, "And {more} more.");
    }
    text.trim_end().to_owned()
}

/// Notes as one text, all of them: each a sentence, whether it was written as one or not.
pub fn whole_sentences(notes: &[String]) -> String {
    let sentence = |note: &String| {
        let end = if note.ends_with(['.', '!', '?']) {
            ""
        } else {
            "."
        };
        format!("{}{end}", capitalised(note))
    };
    notes.iter().map(sentence).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_is_no_plural() {
        let said = [
            (0, "box", "boxes"),
            (1, "box", "boxes"),
            (2, "box", "boxes"),
            (1, "way-point", "way-points"),
            (3, "way-point", "way-points"),
        ];
        let said = said.map(|(count, one, several)| counted(count, one, several));
        assert_eq!(
            said,
            ["0 boxes", "1 box", "2 boxes", "1 way-point", "3 way-points"]
        );
    }

    #[test]
    fn notes_become_sentences_and_many_are_counted() {
        let notes: Vec<String> = (0..8).map(|i| format!("note {i}")).collect();
        let text = sentences(&notes);
        assert!(text.starts_with("Note 0. Note 1. "), "{text}");
        assert!(text.ends_with("Note 5. And 2 more."), "{text}");
        assert_eq!(sentences(&[]), "");
    }

    #[test]
    fn a_note_that_is_a_sentence_stays_one() {
        let notes = ["is this it?", "it is", "so it is."].map(String::from);
        assert_eq!(whole_sentences(&notes), "Is this it? It is. So it is.");
    }
}
