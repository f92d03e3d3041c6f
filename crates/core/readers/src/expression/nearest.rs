//! The most similar of many names.

/// The name that needs fewest changes to become `wanted`, if they are few; letters may be small or capital.
pub(super) fn nearest<'a>(wanted: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: Vec<char> = wanted.to_lowercase().chars().collect();
    let of = |name: &'a str| {
        let letters: Vec<char> = name.to_lowercase().chars().collect();
        // A third of the letters: more, and the names have little in common.
        let most = (wanted.len().max(letters.len()) / 3).max(1);
        if letters.len().abs_diff(wanted.len()) > most {
            return None;
        }
        let changes = changes(&wanted, &letters);
        (changes <= most).then_some((changes, name))
    };
    let found = names.filter_map(of).min_by_key(|(changes, _)| *changes);
    found.map(|(_, name)| name)
}

/// Letters to add, take away, replace or swap with their neighbour to make `b` of `a` (Damerau 1964).
fn changes(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut row = vec![i + 1];
        for (j, y) in b.iter().enumerate() {
            let mut least = (row[j] + 1).min(last[j + 1] + 1);
            least = least.min(last[j] + usize::from(x != y));
            if i > 0 && j > 0 && *x == b[j - 1] && a[i - 1] == *y {
                least = least.min(before[j - 1] + 1);
            }
            row.push(least);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(a: &str, b: &str) -> usize {
        let letters = |text: &str| text.chars().collect::<Vec<char>>();
        changes(&letters(a), &letters(b))
    }

    #[test]
    fn a_letter_added_lost_replaced_or_swapped_is_one_change() {
        assert_eq!(count("ATT.Roll", "ATT.Roll"), 0);
        assert_eq!(count("ATT.Rol", "ATT.Roll"), 1);
        assert_eq!(count("ATTT.Roll", "ATT.Roll"), 1);
        assert_eq!(count("ATT.Rall", "ATT.Roll"), 1);
        assert_eq!(count("ATT.oRll", "ATT.Roll"), 1);
        assert_eq!(count("", "GPS"), 3);
    }

    #[test]
    fn nothing_is_near_to_a_name_of_other_letters() {
        let names = ["ATT.Roll", "GPS.Spd"];
        assert_eq!(nearest("att.roll", names.into_iter()), Some("ATT.Roll"));
        assert_eq!(nearest("GPS.Speed", names.into_iter()), Some("GPS.Spd"));
        assert_eq!(nearest("BARO.Alt", names.into_iter()), None);
    }
}
