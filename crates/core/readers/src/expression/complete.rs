//! Completions of a half-written name.

use std::ops::Range;

use super::token::name_length;
use super::{FUNCTIONS, written};

/// Most names proposed.
const MOST: usize = 12;

/// A name that may be meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NameCandidate {
    /// Text that takes the place of the half-written name.
    pub text: String,
    /// Unit of a series, or description of a function's result.
    pub about: String,
}

/// Candidates for a half-written name, and the place that they go to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Completion {
    /// Bytes that a candidate takes the place of.
    pub place: Range<usize>,
    /// Names that may be meant, the likeliest first.
    pub candidates: Vec<NameCandidate>,
    /// Whether what stands there is a name already: to be left alone unless another one is chosen.
    pub is_whole: bool,
}

/// Completes the name at byte `cursor` of `text`, by series (`names`: name and unit) and functions; empty
/// where no name stands.
pub fn complete<'a>(
    text: &str,
    cursor: usize,
    names: impl Iterator<Item = (&'a str, &'a str)>,
) -> Completion {
    let Some((place, partial)) = half_name(text, cursor) else {
        return Completion::default();
    };
    let in_braces = text[place.clone()].starts_with('{');
    let mut found: Vec<(u8, usize, NameCandidate)> = Vec::new();
    let mut is_whole = false;
    let functions = FUNCTIONS.iter().filter(|_| !in_braces);
    for info in functions {
        is_whole |= info.name == partial;
        if let Some(rank) = rank(info.name, &partial) {
            let text = format!("{}(", info.name);
            let about = format!("({}): {}", info.arguments, info.about);
            found.push((rank, info.name.len(), NameCandidate { text, about }));
        }
    }
    for (name, unit) in names {
        is_whole |= name == partial;
        if let Some(rank) = rank(name, &partial) {
            let text = written(name);
            let about = unit.to_owned();
            found.push((rank, name.len(), NameCandidate { text, about }));
        }
    }
    pilotage_base::sorting::sort(&mut found, &|a, b| {
        (a.0, a.1, &a.2.text).cmp(&(b.0, b.1, &b.2.text))
    });
    found.truncate(MOST);
    Completion {
        place,
        candidates: found
            .into_iter()
            .map(|(_, _, candidate)| candidate)
            .collect(),
        is_whole,
    }
}

/// The name that `cursor` stands in or behind: its bytes, and what of it stands before the cursor.
fn half_name(text: &str, cursor: usize) -> Option<(Range<usize>, String)> {
    let before = text.get(..cursor)?;
    if let Some(open) = before
        .rfind('{')
        .filter(|open| !before[*open..].contains('}'))
    {
        let partial = before[open + 1..].trim_start();
        let rest = &text[cursor..];
        let end = rest
            .find(['}', '{'])
            .filter(|at| rest[*at..].starts_with('}'));
        let end = end.map_or(cursor, |at| cursor + at + 1);
        return Some((open..end, partial.to_owned()));
    }
    let is_inside = |sign: char| sign.is_alphanumeric() || matches!(sign, '_' | '.' | '[' | ']');
    let start = before.rfind(|sign: char| !is_inside(sign));
    let start = start.map_or(0, |at| {
        at + text[at..].chars().next().map_or(1, char::len_utf8)
    });
    let partial = &before[start..];
    if name_length(partial) == 0 {
        return None;
    }
    let end = start + name_length(&text[start..]).max(cursor - start);
    Some((start..end, partial.to_owned()))
}

/// Rank of a name for the letters that were written, 0 best; `None` if it does not fit.
fn rank(name: &str, partial: &str) -> Option<u8> {
    if name.starts_with(partial) {
        return Some(0);
    }
    let (name, partial) = (name.to_lowercase(), partial.to_lowercase());
    if name.starts_with(&partial) {
        return Some(1);
    }
    let at = name.find(&partial)?;
    let begins_word = |at: usize| name[..at].ends_with(['.', '_', ' ', '[', ']']);
    let any_word = name.match_indices(&partial).any(|(at, _)| begins_word(at));
    Some(if any_word {
        2
    } else {
        3 + u8::from(at > name.len() / 2)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [(&str, &str); 5] = [
        ("ATT.Roll", "deg"),
        ("ATT.DesRoll", "deg"),
        ("GPS[1].Spd", "m/s"),
        ("Roll rate", "deg/s"),
        ("BARO.Alt", "m"),
    ];

    fn texts(text: &str, cursor: usize) -> Vec<String> {
        let found = complete(text, cursor, NAMES.into_iter());
        found.candidates.into_iter().map(|c| c.text).collect()
    }

    #[test]
    fn names_that_begin_so_come_before_names_that_contain_it() {
        assert_eq!(
            texts("2 * roll", 8),
            ["{Roll rate}", "ATT.Roll", "ATT.DesRoll"]
        );
        assert_eq!(texts("at", 2)[..2], ["atan(", "atan2("]);
        assert_eq!(texts("ATT.R", 5)[0], "ATT.Roll");
    }

    #[test]
    fn the_whole_name_under_the_cursor_is_replaced() {
        let text = "abs(GPS[1].S + 3";
        let found = complete(text, 12, NAMES.into_iter());
        assert_eq!(&text[found.place], "GPS[1].S");
        let text = "1 + {Roll r} * 2";
        let found = complete(text, 8, NAMES.into_iter());
        assert_eq!(&text[found.place.clone()], "{Roll r}");
        assert_eq!(found.candidates[0].text, "{Roll rate}");
    }

    #[test]
    fn nothing_is_proposed_for_numbers_and_between_words() {
        assert!(texts("12", 2).is_empty());
        assert!(texts("ATT.Roll + ", 11).is_empty());
        assert!(texts("", 0).is_empty());
        assert!(complete("ATT.Roll", 8, NAMES.into_iter()).is_whole);
        assert!(!complete("ATT.Rol", 7, NAMES.into_iter()).is_whole);
    }

    #[test]
    fn letters_beyond_ascii_do_not_upset_places() {
        let found = complete("−ATT.Ro", "−ATT.Ro".len(), NAMES.into_iter());
        assert_eq!(found.place, 3..9);
        assert!(complete("−ATT", 1, NAMES.into_iter()).candidates.is_empty());
    }
}
