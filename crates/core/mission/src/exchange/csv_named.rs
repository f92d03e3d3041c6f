//! A table that came without names of its columns, with those that other tables have.

/// A table that was given names.
pub(super) struct NamedTable {
    /// Its text, with commas between cells and points before decimals.
    pub text: String,
    /// Lines that were put before its own.
    pub added: u64,
    /// Sentences on what was assumed and left out.
    pub notes: Vec<String>,
}
