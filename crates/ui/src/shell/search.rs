//! Commands found by what people type: words of theirs, begun or mistyped, or letters in their order.

/// Letters from which on a word may have one that is wrong, missing or too many.
const LONG: usize = 5;

/// Score of a command with that label, and other words for it, for a query of which every word is one of theirs: begun,
/// within one, or with a letter mistyped; `None` if one is not. Any command fits an empty query.
pub fn by_words(query: &str, label: &str, also: &str) -> Option<i32> {
    let mut score = 0;
    let (label, also) = (label.to_lowercase(), also.to_lowercase());
    for asked in query.to_lowercase().split_whitespace() {
        let in_label = words(&label).enumerate();
        let in_label = in_label.filter_map(|(at, word)| {
            let first = match at {
                0 => 3,
                1..=2 => 1,
                _ => 0,
            };
            Some(4 + first + likeness(asked, word)?)
        });
        let in_also = words(&also).filter_map(|word| likeness(asked, word));
        score += in_label.chain(in_also).max()?;
    }
    Some(score)
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    let parts = text.split(|c: char| !c.is_alphanumeric());
    parts.filter(|word| !word.is_empty())
}

/// Likeness of a typed word to another: the whole, be it one or many, its beginning, a part, or mistyped.
fn likeness(asked: &str, word: &str) -> Option<i32> {
    let is_plural = |many: &str, one: &str| many.strip_suffix('s') == Some(one);
    if word == asked || is_plural(word, asked) || is_plural(asked, word) {
        Some(20)
    } else if word.starts_with(asked) {
        Some(12)
    } else if asked.chars().count() > 2 && word.contains(asked) {
        Some(5)
    } else if is_mistyped(asked, word) {
        Some(2)
    } else {
        None
    }
}

/// Whether a long word is another but for one letter: wrong, missing, too many, or in its neighbour's place.
fn is_mistyped(asked: &str, word: &str) -> bool {
    let (a, b): (Vec<char>, Vec<char>) = (asked.chars().collect(), word.chars().collect());
    if a.len() < LONG || a.len().abs_diff(b.len()) > 1 {
        return false;
    }
    let head = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
    let (a, b) = (&a[head..], &b[head..]);
    let is_swapped = a.len() > 1 && b.len() > 1 && (a[0], a[1]) == (b[1], b[0]) && a[2..] == b[2..];
    let tail = |letters: &'_ [char]| letters.get(1..).unwrap_or_default().to_vec();
    is_swapped || tail(a) == tail(b) || tail(a) == b || a == tail(b)
}

/// Score of a text that has the letters of a query in their order, each at the begin of a word or behind the one before
/// it, and better when together; `None` if it has not.
pub fn in_order(query: &str, text: &str) -> Option<i32> {
    let letters = |text: &str| -> Vec<char> { text.to_lowercase().chars().collect() };
    let query: Vec<char> = (letters(query).into_iter())
        .filter(|c| !c.is_whitespace())
        .collect();
    found_from(&query, &letters(text), 0)
}

/// Best score of the letters of a query from a place of a text on.
fn found_from(query: &[char], text: &[char], from: usize) -> Option<i32> {
    let Some((first, rest)) = query.split_first() else {
        return Some(0);
    };
    let begins = |at: usize| at == 0 || !text[at - 1].is_alphanumeric();
    let places =
        (from..text.len()).filter(|at| text[*at] == *first && (*at == from || begins(*at)));
    let score = |at: usize| {
        let together = if from > 0 && at == from { 6 } else { 4 };
        Some(together - (at - from).min(8) as i32 + found_from(rest, text, at + 1)?)
    };
    places.filter_map(score).max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_in_any_order_begun_or_mistyped_and_others_are_not() {
        let found = |query| {
            by_words(
                query,
                "Export the route as WPL…",
                "save download mission planner",
            )
        };
        for query in [
            "route export",
            "exp",
            "download",
            "misson",
            "exprot",
            "",
            "planner wpl",
        ] {
            assert!(found(query).is_some(), "{query}");
        }
        for query in ["undo", "rotue planer x", "xp", "landmark"] {
            assert!(found(query).is_none(), "{query}");
        }
    }

    #[test]
    fn a_command_is_found_before_those_that_have_its_name_among_other_words() {
        let score = |label, also| by_words("help", label, also);
        assert!(score("Help", "") > score("Show all help", ""));
        assert!(score("Show all help", "") > score("Show all shortcuts", "help"));
        assert!(score("Show all shortcuts", "help") > score("Show all shortcuts", "helper"));
    }

    #[test]
    fn letters_in_order_are_found_and_others_are_not() {
        assert!(in_order("plpa", "Play or pause").is_some());
        assert!(in_order("pap", "Play a pause").is_some());
        assert!(in_order("zq", "Play or pause").is_none());
        // Letters from anywhere are what any long text has.
        assert!(in_order("lost", "Lay photos on the map").is_none());
        let open = "Open a flight, map, mission, route or run…";
        assert!(in_order("reference map", open).is_none());
    }

    #[test]
    fn letters_together_score_higher_than_letters_apart() {
        assert!(in_order("undo", "Undo") > in_order("undo", "Turn the map with no order"));
    }
}
