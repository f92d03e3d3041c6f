//! Angles on the globe as people write them: degrees, minutes and seconds, with a sign or the letter of a hemisphere.

/// Degrees of a text such as `33.85 S`, `W18°25.2'`, `33° 51' 0.5" S`, `33 51 00 S` or `-33°51'`; south and west are negative.
///
/// `None` where nothing but the number says that it is an angle (neither a letter nor a degree sign), or where [`sexagesimal`]
/// reads nothing. Of a negative number with a letter the letter counts.
///
/// ```
/// use pilotage_base::angle_text::degrees_of_text;
///
/// // 51' 36" are 51.6', and these 0.86°.
/// assert_eq!(degrees_of_text("33° 51' 36\" S"), Some(-33.86));
/// assert_eq!(degrees_of_text("W18°30'"), Some(-18.5));
/// // A bare number may be anything.
/// assert_eq!(degrees_of_text("33.85"), None);
/// ```
pub fn degrees_of_text(text: &str) -> Option<f64> {
    let text = text.trim();
    let (rest, letter) = hemisphere(text);
    let is_marked = letter.is_some() || rest.contains(['°', 'º', '˚']);
    let (rest, is_negative) = match rest.strip_prefix(['-', '−']) {
        Some(rest) => (rest, true),
        None => (rest.strip_prefix('+').unwrap_or(rest), false),
    };
    let degrees = sexagesimal(rest)?;
    let is_south_or_west = letter.map_or(is_negative, |letter| "SW".contains(letter));
    is_marked.then_some(if is_south_or_west { -degrees } else { degrees })
}

/// Degrees of one to three numbers without a sign, of which the last alone may have a fraction: degrees, minutes and
/// seconds, with whatever marks people put between them (`33°51'00"`, `33:51:00`, `33d51m0s`).
///
/// `None` of anything else, and where minutes are 60 or seconds over 60.
pub fn sexagesimal(text: &str) -> Option<f64> {
    let is_seam = |c: char| c.is_whitespace() || "°º˚'′’´\"″”:_dDmMsS".contains(c);
    let mut parts = text.split(is_seam).filter(|part| !part.is_empty());
    let (mut degrees, mut unit, mut is_whole) = (0.0, 1.0, true);
    for count in 0.. {
        let Some(part) = parts.next() else { break };
        let is_number = part.bytes().all(|b| b.is_ascii_digit() || b == b'.');
        let value: f64 = part.parse().ok().filter(|_| is_number)?;
        let is_too_large = count == 1 && value >= 60.0 || count == 2 && value > 60.0;
        // Behind a fraction nothing follows.
        if count > 2 || !is_whole || is_too_large {
            return None;
        }
        is_whole = !part.contains('.');
        degrees += value / unit;
        unit *= 60.0;
    }
    (unit > 1.0).then_some(degrees)
}

/// A text without the letter or word of a hemisphere before or behind it, and that letter.
pub(crate) fn hemisphere(text: &str) -> (&str, Option<char>) {
    const WORDS: [(&str, char); 8] = [
        ("north", 'N'),
        ("south", 'S'),
        ("east", 'E'),
        ("west", 'W'),
        ("n", 'N'),
        ("s", 'S'),
        ("e", 'E'),
        ("w", 'W'),
    ];
    for (word, letter) in WORDS {
        let ends = text
            .len()
            .checked_sub(word.len())
            .filter(|at| text.is_char_boundary(*at));
        if let Some((rest, end)) = ends.map(|at| text.split_at(at))
            && end.eq_ignore_ascii_case(word)
        {
            return (rest.trim(), Some(letter));
        }
        if let Some(begin) = text.get(..word.len())
            && begin.eq_ignore_ascii_case(word)
        {
            return (text[word.len()..].trim(), Some(letter));
        }
    }
    (text, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_angle_is_read_in_every_spelling() {
        for text in [
            "33.85 S",
            "33.85S",
            "S33.85",
            "s 33.85",
            "33.85° South",
            "-33.85°",
            "33°51'S",
            "33° 51' 0\" S",
            "33°51′00.0″S",
            "33 51 00 S",
            "33:51:00 S",
            "S 33° 51.000'",
            "−33°51’",
        ] {
            let found = degrees_of_text(text);
            assert!(
                found.is_some_and(|d| (d + 33.85).abs() < 1e-12),
                "{text}: {found:?}"
            );
        }
        assert_eq!(degrees_of_text("18.5 E"), Some(18.5));
        assert_eq!(degrees_of_text("0°30'W"), Some(-0.5));
    }

    #[test]
    fn what_is_no_angle_is_none() {
        for text in [
            "",
            "33.85",
            "33 51 00",
            "33°61'S",
            "33.5°10'",
            "S",
            "5°C",
            "1 2 3 4 N",
            "north",
            "see",
            "1e5 N",
        ] {
            assert_eq!(degrees_of_text(text), None, "{text}");
        }
    }
}
