//! A document of an earlier visit that could not be read.

/// Its fate.
pub(super) enum Aside {
    /// It is kept aside.
    Keep(Vec<u8>),
    /// It was aside and can be read now.
    Taken,
}
