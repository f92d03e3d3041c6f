//! Angles on the globe as people write them: degrees, minutes and seconds, with a sign or the letter of a hemisphere.

/// Degrees of a text such as `33.85 S`, `W18°25.2'`, `33° 51' 0.5" S`, `33 51 00 S`, `-33°51'`, `33 deg 51' 0.00" S`,
/// `33-51-00S`, or packed as `3351.5S`, `335130.0S` and `01825.2W`; south and west are negative.
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
    let angle = angle_of_text(text)?;
    let is_south_or_west = angle
        .letter
        .map_or(angle.is_negative, |letter| "SW".contains(letter));
    let degrees = angle.degrees;
    angle
        .is_marked
        .then_some(if is_south_or_west { -degrees } else { degrees })
}

/// An angle taken apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngleText {
    /// Its amount, degrees.
    pub degrees: f64,
    /// Whether a minus stands before it.
    pub is_negative: bool,
    /// Letter of its hemisphere, N, S, E or W.
    pub letter: Option<char>,
    /// Whether a letter or a sign says that it is degrees.
    pub is_marked: bool,
}

/// The angle that a text says, in the spellings of [`degrees_of_text`], a bare number as well.
pub fn angle_of_text(text: &str) -> Option<AngleText> {
    let text = text.trim();
    let (rest, letter) = hemisphere(text);
    let is_marked =
        letter.is_some() || rest.contains(['°', 'º', '˚']) || rest.to_lowercase().contains("deg");
    let (rest, is_negative) = match rest.strip_prefix(['-', '−']) {
        Some(rest) => (rest, true),
        None => (rest.strip_prefix('+').unwrap_or(rest), false),
    };
    let packed = letter.and_then(|letter| packed(rest, letter));
    // Dashes part numbers only where a letter says that they are degrees: dates have them, too.
    let spaced = letter.map(|_| rest.replace(['-', '–'], " "));
    let degrees = packed.or_else(|| sexagesimal(spaced.as_deref().unwrap_or(rest)))?;
    Some(AngleText {
        degrees,
        is_negative,
        letter,
        is_marked,
    })
}

/// Degrees of digits without seams: two of a latitude's degrees and three of a longitude's, two of minutes, and perhaps
/// two of seconds.
fn packed(text: &str, letter: char) -> Option<f64> {
    let digits = text.find(['.', ',']).unwrap_or(text.len());
    let of_degrees = if "NS".contains(letter) { 2 } else { 3 };
    let has_seconds = match digits.checked_sub(of_degrees)? {
        2 => false,
        4 => true,
        _ => return None,
    };
    let (degrees, rest) = text.split_at_checked(of_degrees)?;
    let spaced = if has_seconds {
        let (minutes, seconds) = rest.split_at_checked(2)?;
        format!("{degrees} {minutes} {seconds}")
    } else {
        format!("{degrees} {rest}")
    };
    sexagesimal(&spaced)
}

/// Degrees of one to three numbers without a sign, of which the last alone may have a fraction: degrees, minutes and
/// seconds, with whatever marks or words people put between them (`33°51'00"`, `33:51:00`, `33d51m0s`, `33 deg 51 min`).
///
/// `None` of anything else, and where minutes are 60 or seconds over 60.
pub fn sexagesimal(text: &str) -> Option<f64> {
    const WORDS: [&str; 12] = [
        "d", "deg", "degs", "degree", "degrees", "m", "min", "minutes", "s", "sec", "secs",
        "seconds",
    ];
    let is_seam = |c: char| c.is_whitespace() || "°º˚'′’´\"″”:_".contains(c);
    let is_digit = |c: char| c.is_ascii_digit() || c == '.' || c == ',';
    let (mut degrees, mut unit, mut is_whole) = (0.0, 1.0, true);
    let mut count = 0;
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if is_seam(first) {
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let end =
            |is_in: &dyn Fn(char) -> bool| rest.find(|c: char| !is_in(c)).unwrap_or(rest.len());
        if first.is_alphabetic() {
            let (word, after) = rest.split_at(end(&char::is_alphabetic));
            // Nothing is measured before its number.
            if count == 0 || !WORDS.contains(&word.to_lowercase().as_str()) {
                return None;
            }
            rest = after;
            continue;
        }
        let (part, after) = rest.split_at(end(&is_digit));
        rest = after;
        let value: f64 = part.replacen(',', ".", 1).parse().ok()?;
        let is_too_large = count == 1 && value >= 60.0 || count == 2 && value > 60.0;
        // Behind a fraction nothing follows.
        if count > 2 || !is_whole || is_too_large {
            return None;
        }
        is_whole = !part.contains(['.', ',']);
        degrees += value / unit;
        unit *= 60.0;
        count += 1;
    }
    (count > 0).then_some(degrees)
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
    // A last s may be that of seconds: 33d51m0s.
    let lower = text.to_lowercase();
    let ends_in_second =
        lower.contains(['d', '°']) && lower.contains('m') && lower.matches('s').count() == 1;
    for (word, letter) in WORDS {
        let ends = text
            .len()
            .checked_sub(word.len())
            .filter(|at| text.is_char_boundary(*at));
        if let Some((rest, end)) = ends.map(|at| text.split_at(at))
            && end.eq_ignore_ascii_case(word)
            && !(word == "s" && ends_in_second)
            && is_end_of_number(rest)
        {
            return (rest.trim(), Some(letter));
        }
        if let Some(begin) = text.get(..word.len())
            && begin.eq_ignore_ascii_case(word)
            && !text[word.len()..].starts_with(char::is_alphabetic)
        {
            return (text[word.len()..].trim(), Some(letter));
        }
    }
    (text, None)
}

/// Whether a text ends in a number, perhaps with the letter of seconds, or in no letter at all.
fn is_end_of_number(text: &str) -> bool {
    let rest = text.strip_suffix(['s', 'S', 'm', 'M', 'd', 'D']);
    !text.ends_with(char::is_alphabetic)
        || rest.is_some_and(|rest| rest.ends_with(|c: char| c.is_ascii_digit()))
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
            "33 deg 51' 0.00\" S",
            "33deg 51min 0sec S",
            "33d51m0sS",
            "33-51-00S",
            "33-51.000 S",
            "33°51'0,0\"S",
            "33,85 S",
            "335100.0S",
            "335100S",
            "3351.000S",
        ] {
            let found = degrees_of_text(text);
            assert!(
                found.is_some_and(|d| (d + 33.85).abs() < 1e-12),
                "{text}: {found:?}"
            );
        }
        assert_eq!(degrees_of_text("18.5 E"), Some(18.5));
        assert_eq!(degrees_of_text("0°30'W"), Some(-0.5));
        assert_eq!(degrees_of_text("0083000.0E"), Some(8.5));
        assert_eq!(degrees_of_text("00830.0W"), Some(-8.5));
        // A last s of seconds is no south.
        assert_eq!(degrees_of_text("33°30m0s"), Some(33.5));
        assert_eq!(degrees_of_text("33d30m0sN"), Some(33.5));
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
