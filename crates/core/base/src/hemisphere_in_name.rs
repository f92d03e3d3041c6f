//! Letters of hemispheres in the names of columns: `Latitude (S)`, `Lon W`, `South latitude`.

/// Letters of the hemispheres that the names of a table's columns state, `N`, `S`, `E` or `W`, one for each name; `None`
/// for all others.
///
/// A letter counts only where the name has nothing else than latitude or longitude and a degree, and no other column is
/// called latitude (or longitude): of `lat_n` and `lat_s` beside each other both are edges of a box, beside `lat_d` an s
/// stands for seconds, and beside `lat` for something else.
///
/// ```
/// use pilotage_base::hemisphere_in_name::hemispheres_in_names;
///
/// assert_eq!(hemispheres_in_names(&["Latitude (S)", "Lon W", "s"]), [Some('S'), Some('W'), None]);
/// assert_eq!(hemispheres_in_names(&["lat_d", "lat_m", "lat_s"]), [None; 3]);
/// assert_eq!(hemispheres_in_names(&["lat_n", "lat_s"]), [None; 2]);
/// ```
pub fn hemispheres_in_names<T: AsRef<str>>(names: &[T]) -> Vec<Option<char>> {
    let all: Vec<Vec<String>> = names.iter().map(|name| words(name.as_ref())).collect();
    let count = |of: &[&str]| {
        let is_of = |words: &&Vec<String>| words.iter().any(|word| of.contains(&word.as_str()));
        all.iter().filter(is_of).count()
    };
    let letter = |words: &Vec<String>| {
        let (of, letter) = stated(words)?;
        (count(of) == 1).then_some(letter)
    };
    all.iter().map(letter).collect()
}

const LATITUDE: &[&str] = &["lat", "latitude"];
const LONGITUDE: &[&str] = &["lon", "lng", "long", "longitude"];
/// Words that may stand beside them.
const BESIDE: [&str; 8] = [
    "gps", "deg", "degs", "degree", "degrees", "decimal", "dec", "°",
];
const LETTERS: [(&[&str], [&str; 2], char); 4] = [
    (LATITUDE, ["n", "north"], 'N'),
    (LATITUDE, ["s", "south"], 'S'),
    (LONGITUDE, ["e", "east"], 'E'),
    (LONGITUDE, ["w", "west"], 'W'),
];

/// The names of the coordinate and the letter that the words of a name state.
fn stated(words: &[String]) -> Option<(&'static [&'static str], char)> {
    let rest: Vec<&str> = words.iter().map(String::as_str).collect();
    let mut rest = rest.into_iter().filter(|word| !BESIDE.contains(word));
    let (a, b) = (rest.next()?, rest.next()?);
    if rest.next().is_some() {
        return None;
    }
    let fits = |(of, letters, _): &&(&[&str], [&str; 2], char)| {
        of.contains(&a) && letters.contains(&b) || of.contains(&b) && letters.contains(&a)
    };
    LETTERS
        .iter()
        .find(fits)
        .map(|(of, _, letter)| (*of, *letter))
}

/// Words of a name in small letters, parted at signs and before capitals behind small letters.
fn words(name: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    for letter in name.chars() {
        let is_degree = letter == '°' || before == '°';
        if !letter.is_alphanumeric() || is_degree || before.is_lowercase() && letter.is_uppercase()
        {
            words.push(String::new());
        }
        if (letter.is_alphanumeric() || letter == '°')
            && let Some(word) = words.last_mut()
        {
            word.extend(letter.to_lowercase());
        }
        before = letter;
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_found_in_the_spellings_that_people_use() {
        for name in [
            "Latitude (S)",
            "Lat S",
            "lat_s",
            "LatS",
            "LAT [°S]",
            "latitude (deg S)",
            "South Latitude",
            "GPS lat (south)",
            "Latitude, S",
        ] {
            assert_eq!(
                hemispheres_in_names(&[name, "Longitude (E)"]),
                [Some('S'), Some('E')],
                "{name}"
            );
        }
        for name in [
            "lat",
            "latitude (w)",
            "lats",
            "s",
            "lat speed",
            "latitude s m",
            "lat error (s)",
        ] {
            assert_eq!(hemispheres_in_names(&[name]), [None], "{name}");
        }
        assert_eq!(hemispheres_in_names(&["lat", "lat_s"]), [None; 2]);
        assert_eq!(
            hemispheres_in_names(&["lon_deg", "lon_min", "lon_w"]),
            [None; 3]
        );
    }
}
