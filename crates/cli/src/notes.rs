//! Sentences on what was assumed of files or left out.

/// Tells them to whoever sits at the terminal, beside what the command prints.
pub fn tell(notes: &[String]) {
    for note in notes {
        eprintln!("note: {note}");
    }
}
