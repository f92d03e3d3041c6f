//! Latitudes and longitudes as people write them: degrees, minutes and seconds, letters of hemispheres.

use pilotage_base::angle_text::angle_of_text;

/// Degrees of a text: `-33.85`, `33.85 S`, `S33°51.0'`, `33 51 00 S`, `33:51:00S`, `33d51m0s`.
///
/// `letters` are those of the positive and the negative hemisphere. `None` where the text says
/// anything else, has a sign and a letter that contradict each other, or minutes beyond 60.
pub(super) fn degrees(text: &str, letters: (char, char)) -> Option<f64> {
    let text = text.trim();
    // A number with an exponent is one number, whatever else the letter means.
    if let Ok(value) = text.parse::<f64>() {
        return value.is_finite().then_some(value);
    }
    let angle = angle_of_text(text)?;
    let is_negative = match angle.letter {
        Some(_) if angle.is_negative => return None,
        Some(letter) if letter == letters.0 => false,
        Some(letter) if letter == letters.1 => true,
        Some(_) => return None,
        None => angle.is_negative,
    };
    Some(if is_negative {
        -angle.degrees
    } else {
        angle.degrees
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_read_in_the_spellings_that_people_use() {
        let south = ('N', 'S');
        for text in [
            "-33.85",
            "33.85S",
            "33.85 s",
            "S 33.85",
            "S33°51.0'",
            "33°51'00\"S",
            "33° 51′ 0″ S",
            "33 51 00 S",
            "33:51:00S",
            "-33d51m0s",
            "-33:51",
            "33d51m0sS",
            "−33.85",
            "33°51''S",
            "33.85 South",
            "33 deg 51' 0.00\" S",
            "335100.0S",
            "33-51-00 S",
            "33°51'0,0\"S",
        ] {
            let found = degrees(text, south);
            assert!(
                found.is_some_and(|d| (d + 33.85).abs() < 1e-9),
                "{text}: {found:?}"
            );
        }
        assert_eq!(degrees("18.42W", ('E', 'W')), Some(-18.42));
        assert_eq!(degrees("18.42E", ('E', 'W')), Some(18.42));
        assert_eq!(degrees("1.842e1", ('E', 'W')), Some(18.42));
        for text in [
            "",
            "-33.85 S",
            "33 71 0 S",
            "east",
            "33.85W",
            "1 2 3 4",
            "33-51-00",
        ] {
            assert_eq!(degrees(text, south), None, "{text}");
        }
    }
}
