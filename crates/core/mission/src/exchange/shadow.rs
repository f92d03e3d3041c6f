//! Files in a zip that are nobody's.

/// Whether a file in a zip is what macOS puts beside another one of the same name.
pub(super) fn is_shadow(name: &str) -> bool {
    let own = name.rsplit('/').next().unwrap_or(name);
    name.starts_with("__MACOSX/") || own.starts_with("._")
}
