//! Notes of files and jobs in the words of a notice.

use std::fmt::Write as _;

use pilotage_core::text::capitalised;

/// Most notes that are shown of a file; the others are counted.
const MOST_NOTES: usize = 6;

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_become_sentences_and_many_are_counted() {
        let notes: Vec<String> = (0..8).map(|i| format!("note {i}")).collect();
        let text = sentences(&notes);
        assert!(text.starts_with("Note 0. Note 1. "), "{text}");
        assert!(text.ends_with("Note 5. And 2 more."), "{text}");
        assert_eq!(sentences(&[]), "");
    }
}
