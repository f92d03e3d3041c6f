//! A document of an earlier visit that could not be read.

/// What becomes of it.
pub(super) enum Aside {
    /// It is kept aside.
    Keep(Vec<u8>),
    /// It was aside and can be read now.
    Taken,
}
