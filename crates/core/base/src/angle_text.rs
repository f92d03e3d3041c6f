//! Angles on the globe as people write them: degrees, minutes and seconds, with a sign or the letter of a hemisphere.

/// Units that people write behind the numbers of an angle.
const UNITS: [&str; 15] = [
    "d", "deg", "degs", "degree", "degrees", "m", "min", "mins", "minute", "minutes", "s", "sec",
    "secs", "second", "seconds",
];

/// Words of names of columns in languages in which O is the east, and in those in which it is the west.
const EAST_IS_O: [&str; 10] = [
    "breite",
    "länge",
    "laenge",
    "breitengrad",
    "längengrad",
    "laengengrad",
    "höhe",
    "hoehe",
    "bezeichnung",
    "punkt",
];
const WEST_IS_O: [&str; 12] = [
    "latitud",
    "longitud",
    "nombre",
    "altitud",
    "nom",
    "hauteur",
    "lieu",
    "latitudine",
    "longitudine",
    "nome",
    "quota",
    "altura",
];

/// Degrees of a text such as `33.85 S`, `W18°25.2'`, `33° 51' 0.5" S`, `33 51 00 S`, `-33°51'`, `33 deg 51' 0.00" S`,
/// `33-51-00S`, or packed as `3351.5S`, `335130.0S` and `01825.2W`; south and west are negative.
///
/// `None` where nothing but the number says that it is an angle (neither a letter nor a degree sign), or where
/// [`angle_of_text`] reads nothing. Of a negative number with a letter the letter counts.
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
    let angle = angle_of_text(text).filter(|angle| angle.is_marked)?;
    Some(angle.signed())
}

/// An angle taken apart.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

impl AngleText {
    /// Degrees, south and west negative; of a negative number with a letter the letter counts.
    pub fn signed(&self) -> f64 {
        let is_south_or_west = self
            .letter
            .map_or(self.is_negative, |letter| "SW".contains(letter));
        if is_south_or_west {
            -self.degrees
        } else {
            self.degrees
        }
    }
}

/// The angle that a text says, in the spellings of [`degrees_of_text`], a bare number as well: one to three numbers, of
/// which the last alone may have a fraction, with whatever marks or words people put between them.
///
/// `None` of anything else, and where minutes are 60 or seconds over 60. A last `s` is the south, but for that of seconds
/// directly behind their digits (`33d51m0s`).
pub fn angle_of_text(text: &str) -> Option<AngleText> {
    let mut read = Reading::default();
    let (mut rest, mut is_close) = (text.trim(), false);
    while let Some(first) = rest.chars().next() {
        let end = |is_in: fn(char) -> bool| rest.find(|c| !is_in(c)).unwrap_or(rest.len());
        let length = if is_part_of_number(first) {
            let length = end(is_part_of_number);
            read.number(&rest[..length])?;
            length
        } else if is_letter(first) {
            let length = end(is_letter);
            let is_last = length == rest.len();
            read.word(&rest[..length], is_last, is_close)?;
            length
        } else {
            read.sign(first)?;
            first.len_utf8()
        };
        is_close = is_part_of_number(first);
        rest = &rest[length..];
    }
    read.angle()
}

fn is_part_of_number(c: char) -> bool {
    c.is_ascii_digit() || c == '.' || c == ','
}

/// Whether a sign of degrees is meant; one of them counts as a letter elsewhere.
fn is_degree_sign(c: char) -> bool {
    "°º˚".contains(c)
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() && !is_degree_sign(c)
}

/// A text while it is read from its beginning.
#[derive(Default)]
struct Reading<'a> {
    angle: AngleText,
    /// Numbers so far, the first and the last of them as they stand.
    count: usize,
    first: &'a str,
    last: &'a str,
    /// Whether dashes stand between numbers or words.
    has_dash: bool,
    /// Whether a word of a unit stands anywhere.
    has_unit: bool,
    /// Whether a word stands for minutes, in capitals or not.
    minutes: Option<bool>,
}

impl<'a> Reading<'a> {
    fn number(&mut self, text: &'a str) -> Option<()> {
        let value: f64 = text.replacen(',', ".", 1).parse().ok()?;
        let is_too_large = self.count == 1 && value >= 60.0 || self.count == 2 && value > 60.0;
        // Behind a fraction nothing follows.
        if self.count > 2 || self.last.contains(['.', ',']) || is_too_large {
            return None;
        }
        if self.count == 0 {
            self.first = text;
        }
        self.last = text;
        self.angle.degrees += value / 60_f64.powi(self.count as i32);
        self.count += 1;
        Some(())
    }

    fn sign(&mut self, sign: char) -> Option<()> {
        let is_before = self.count == 0 && !self.angle.is_negative;
        match sign {
            '-' | '−' | '+' if is_before => self.angle.is_negative = sign != '+',
            '-' | '–' => self.has_dash = true,
            _ if is_degree_sign(sign) => self.angle.is_marked = true,
            _ if sign.is_whitespace() || "'′’´\"″”:_".contains(sign) => {}
            _ => return None,
        }
        Some(())
    }

    /// Takes a word; `is_last` ends the text, and before `is_close` ones a digit stands.
    fn word(&mut self, word: &str, is_last: bool, is_close: bool) -> Option<()> {
        let lower = word.to_lowercase();
        if lower == "s" && self.count > 0 {
            return self.lone_s(word, is_last, is_close);
        }
        if let Some(letter) = hemisphere(&lower) {
            return self.hemisphere(letter, is_last);
        }
        // A letter may stand behind the word of a unit without a gap: "degS", "0sS".
        let (unit, behind) = word.split_at(word.len() - word.chars().next_back()?.len_utf8());
        let parted = hemisphere(&behind.to_lowercase()).filter(|_| is_last && is_unit(unit));
        let is_plural = is_unit(word);
        let may_be_south = parted == Some('S') && self.angle.letter.is_none();
        if is_plural && may_be_south && unit.len() > 1 {
            let is_capital = behind == "S";
            let is_shouted = is_capital && unit == unit.to_uppercase();
            // "DEGS" may be either.
            return match (is_shouted, is_capital) {
                (true, _) => None,
                (false, true) => self.unit(unit).and_then(|()| self.hemisphere('S', true)),
                (false, false) => self.unit(word),
            };
        }
        match parted {
            Some(letter) if !is_plural && (letter != 'S' || behind == "S" || unit == "s") => {
                self.unit(unit)?;
                self.hemisphere(letter, true)
            }
            _ => self.unit(word),
        }
    }

    /// A single s behind a number: of seconds, or the south.
    fn lone_s(&mut self, word: &str, is_last: bool, is_close: bool) -> Option<()> {
        let is_like_minutes = is_close && self.minutes == Some(word == "S");
        let is_of_seconds = self.count == 3 && (self.angle.letter.is_some() || is_like_minutes);
        if is_of_seconds || !is_last {
            return self.unit(word);
        }
        self.hemisphere('S', is_last)
    }

    fn hemisphere(&mut self, letter: char, is_last: bool) -> Option<()> {
        if self.angle.letter.is_some() || (self.count > 0 && !is_last) {
            return None;
        }
        (self.angle.letter, self.angle.is_marked) = (Some(letter), true);
        Some(())
    }

    fn unit(&mut self, word: &str) -> Option<()> {
        // Nothing is measured before its number.
        if self.count == 0 || !is_unit(word) {
            return None;
        }
        self.has_unit = true;
        let lower = word.to_lowercase();
        self.angle.is_marked |= lower.starts_with("deg");
        if lower.starts_with('m') {
            self.minutes = Some(word == word.to_uppercase());
        }
        Some(())
    }

    fn angle(self) -> Option<AngleText> {
        let mut angle = self.angle;
        // Dashes part numbers only where a letter says that they are degrees: dates have them, too.
        if self.count == 0 || self.has_dash && angle.letter.is_none() {
            return None;
        }
        if let Some(letter) = angle.letter
            && self.count == 1
            && !self.has_unit
        {
            angle.degrees = packed_degrees(self.first, letter).unwrap_or(angle.degrees);
        }
        Some(angle)
    }
}

fn is_unit(word: &str) -> bool {
    UNITS.contains(&word.to_lowercase().as_str())
}

/// Letter of a hemisphere, N, S, E or W, by its letter or word in small letters: English, German, French, Spanish or Italian.
///
/// A lone `o` is the east in German and the west in the others, and `est` behind a time its zone: both are none.
pub fn hemisphere(word: &str) -> Option<char> {
    match word {
        "n" | "north" | "nord" | "norte" => Some('N'),
        "s" | "south" | "süd" | "sued" | "sud" | "sur" => Some('S'),
        "e" | "east" | "ost" | "este" => Some('E'),
        "w" | "west" | "ouest" | "oeste" | "ovest" => Some('W'),
        _ => None,
    }
}

/// Place of an O that stands alone at the end of a longitude, or before its number.
fn lone_o(cell: &str) -> Option<usize> {
    let cell = cell.trim_end();
    let is_o = |letter: char| letter.eq_ignore_ascii_case(&'o');
    if cell.starts_with(is_o) && !cell.chars().nth(1).is_some_and(char::is_alphabetic) {
        return Some(0);
    }
    let before = cell.strip_suffix(is_o)?;
    (!before.ends_with(char::is_alphabetic)).then_some(before.len())
}

/// The longitude of a cell with `letter` in place of an O that stands alone in it; `None` where none does.
///
/// ```
/// use pilotage_base::angle_text::with_letter_for_o;
///
/// assert_eq!(with_letter_for_o("18,42 O", 'W').as_deref(), Some("18,42 W"));
/// assert_eq!(with_letter_for_o("18,42 Ost", 'W'), None);
/// ```
pub fn with_letter_for_o(cell: &str, letter: char) -> Option<String> {
    let (before, behind) = cell.split_at(lone_o(cell)?);
    Some(format!("{before}{letter}{}", &behind[1..]))
}

/// The letter that an O stands for in a table, by the names of its columns and the cells of its longitudes and their letters:
/// E (German `Ost`) where west is W or names are German, W (`Ouest`, `Oeste`, `Ovest`) where east is E or names are of
/// those languages. `None` where nothing tells.
pub fn meaning_of_o<'a>(
    names: impl Iterator<Item = &'a str>,
    cells: &(impl Iterator<Item = &'a str> + Clone),
) -> Option<char> {
    let has = |letter: char| {
        cells.clone().any(|cell| {
            let cell = cell.to_uppercase();
            let mut words = cell.split(|c: char| !c.is_alphabetic());
            words.any(|word| word.chars().eq([letter]))
        })
    };
    match (has('W'), has('E')) {
        (true, false) => return Some('E'),
        (false, true) => return Some('W'),
        (true, true) => return None,
        (false, false) => {}
    }
    let names: Vec<String> = names.map(str::to_lowercase).collect();
    let says = |list: &[&str]| {
        names.iter().any(|name| {
            let mut words = name.split(|c: char| !c.is_alphabetic());
            words.any(|word| list.contains(&word))
        })
    };
    match (says(&EAST_IS_O), says(&WEST_IS_O)) {
        (true, false) => Some('E'),
        (false, true) => Some('W'),
        _ => None,
    }
}

/// Degrees of digits without seams: two of a latitude's degrees and three of a longitude's, two of minutes, and perhaps
/// two of seconds.
fn packed_degrees(text: &str, letter: char) -> Option<f64> {
    let digits = text.find(['.', ',']).unwrap_or(text.len());
    let (usual, most) = if "NS".contains(letter) {
        (2, 90)
    } else {
        (3, 180)
    };
    // Radios write no zeros before: beyond what degrees reach, the last two digits are minutes.
    let is_beyond = text[..digits].parse().is_ok_and(|whole: u32| whole > most);
    let of_degrees = if is_beyond && digits < usual + 2 {
        digits.checked_sub(2)?
    } else {
        usual
    };
    let has_seconds = match digits.checked_sub(of_degrees)? {
        2 => false,
        4 => true,
        _ => return None,
    };
    let mut read = Reading::default();
    let (degrees, rest) = text.split_at_checked(of_degrees)?;
    read.number(degrees)?;
    if has_seconds {
        let (minutes, seconds) = rest.split_at_checked(2)?;
        read.number(minutes)?;
        read.number(seconds)?;
    } else {
        read.number(rest)?;
    }
    Some(read.angle.degrees)
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
        for text in ["18,5° Ouest", "18.5 Oeste", "18°30' ovest", "18.5 West"] {
            assert_eq!(degrees_of_text(text), Some(-18.5), "{text}");
        }
        assert_eq!(degrees_of_text("18,5° Ost"), Some(18.5));
        assert_eq!(degrees_of_text("33,5° Süd"), Some(-33.5));
        assert_eq!(degrees_of_text("0°30'W"), Some(-0.5));
        assert_eq!(degrees_of_text("0083000.0E"), Some(8.5));
        assert_eq!(degrees_of_text("00830.0W"), Some(-8.5));
        // Without zeros before, as OpenTX 2.0 writes them.
        assert_eq!(degrees_of_text("1130.0W"), Some(-11.5));
        assert_eq!(degrees_of_text("830.0E"), Some(8.5));
        assert_eq!(degrees_of_text("330.0S"), Some(-3.5));
        assert_eq!(degrees_of_text("130.0E"), Some(130.0));
        // With the ordinal sign of Spanish keyboards, and words that end where the south begins.
        for text in [
            "33.85ºS",
            "33.85degS",
            "33 deg 51 min S",
            "33° 51.0 min S",
            "33deg51min0secS",
            "33d51m S",
            "33d51mS",
            "S33d51m0s",
            "33D51M0SS",
        ] {
            let found = degrees_of_text(text);
            let is_south = found.is_some_and(|d| (d + 33.85).abs() < 1e-12);
            assert!(is_south, "{text}: {found:?}");
        }
        assert_eq!(degrees_of_text("18.42ºW"), Some(-18.42));
        assert_eq!(degrees_of_text("33.85ºN"), Some(33.85));
        assert_eq!(degrees_of_text("W18:30:36s"), Some(-18.51));
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
            "33.85DEGS",
            "N 33.85 S",
            "33-51-00",
            "18.5 O",
            "10:00:00 EST",
        ] {
            assert_eq!(degrees_of_text(text), None, "{text}");
        }
    }
}
