//! The O of German and Romance languages in longitudes: east in the one, west in the others.

/// An O that stands alone at the end of a cell, or before its number.
fn lone_o(cell: &str) -> Option<usize> {
    let cell = cell.trim_end();
    let is_o = |letter: char| letter.eq_ignore_ascii_case(&'o');
    if cell.starts_with(is_o) && !cell.chars().nth(1).is_some_and(char::is_alphabetic) {
        return Some(0);
    }
    let before = cell.strip_suffix(is_o)?;
    (!before.ends_with(char::is_alphabetic)).then_some(before.len())
}

/// The cell of a longitude with the letter that its O stands for.
///
/// # Errors
/// In words: nothing tells which that is.
pub(super) fn without_o(cell: &str, meaning: Option<char>) -> Result<String, String> {
    let Some(at) = lone_o(cell) else {
        return Ok(cell.to_owned());
    };
    let letter = meaning.ok_or_else(|| {
        format!("`{cell}` may be east (Ost) or west (Ouest, Oeste): write E or W in place of O")
    })?;
    let (before, behind) = cell.split_at(at);
    Ok(format!("{before}{letter}{}", &behind[1..]))
}
