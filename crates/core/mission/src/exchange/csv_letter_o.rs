//! The O of German and Romance languages in longitudes: east in the one, west in the others.

use pilotage_base::angle_text::with_letter_for_o;

/// The cell of a longitude with the letter that its O stands for.
///
/// # Errors
/// In words: nothing tells which that is.
pub(super) fn without_o(cell: &str, meaning: Option<char>) -> Result<String, String> {
    let Some(read) = with_letter_for_o(cell, meaning.unwrap_or('E')) else {
        return Ok(cell.to_owned());
    };
    meaning.map(|_| read).ok_or_else(|| {
        format!("`{cell}` may be east (Ost) or west (Ouest, Oeste): write E or W in place of O")
    })
}
