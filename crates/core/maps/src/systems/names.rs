//! Names of systems, datums and projections: as they are compared, and as messages show them.

/// The beginning of a text, for messages.
pub(super) fn shortened(text: &str) -> String {
    text.trim().chars().take(60).collect()
}

/// Letters and digits in capitals.
pub(super) fn plain(text: &str) -> String {
    (text.chars())
        .filter(char::is_ascii_alphanumeric)
        .map(|c| c.to_ascii_uppercase())
        .collect()
}
