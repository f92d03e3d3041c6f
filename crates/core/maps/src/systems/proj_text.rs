//! Reference systems as PROJ writes them: `+proj=utm +zone=32 +datum=WGS84 +units=m`.

use pilotage_base::frames::ReferenceSystem;

use super::names::shortened;
use super::{SystemError, by_code};

/// Words that are looked at below, or change no number.
const HARMLESS: [&str; 20] = [
    "init", "proj", "zone", "south", "datum", "ellps", "towgs84", "units", "a", "b", "lat_ts",
    "lon_0", "x_0", "y_0", "k", "nadgrids", "wktext", "no_defs", "type", "over",
];

/// The system of such a text: a code, or degrees, a UTM zone or the Mercator projection of the web of WGS 84. Others are
/// refused by their text.
pub(super) fn read(text: &str) -> Result<ReferenceSystem, SystemError> {
    let word = |key: &str| {
        let mut words = text.split_whitespace().filter_map(|word| {
            let word = word.strip_prefix('+')?;
            Some(word.split_once('=').unwrap_or((word, "")))
        });
        words.find(|(name, _)| *name == key).map(|(_, value)| value)
    };
    let unknown = || SystemError::unknown(format!("\"{}\"", shortened(text)));
    if let Some(code) = word("init").and_then(|name| name.split_once(':')) {
        return code.1.parse().map_err(|_| unknown()).and_then(by_code);
    }
    // Whatever else stands there may change the numbers: units in `to_meter`, axes, other meridians.
    let is_known = |word: &str| {
        let name = word.trim_start_matches('+').split('=').next();
        name.is_some_and(|name| HARMLESS.contains(&name))
    };
    if !text.split_whitespace().all(is_known) {
        return Err(unknown());
    }
    let is_zero = |key: &str| word(key).is_none_or(|number| number.parse() == Ok(0.0));
    let is_unshifted = word("towgs84").is_none_or(|shift| {
        let mut numbers = shift.split(',').map(|number| number.trim().parse());
        numbers.all(|number| number == Ok(0.0))
    });
    let is_in_metres = word("units").is_none_or(|unit| unit == "m");
    let datum = word("datum").or(word("ellps"));
    let is_usual = datum == Some("WGS84") && is_unshifted && is_in_metres;
    let found = match word("proj") {
        Some("longlat" | "latlong") if is_usual => Some(ReferenceSystem::Geographic),
        Some("utm") if is_usual => {
            let zone = word("zone").and_then(|zone| zone.parse().ok());
            let south = if word("south").is_some() { 100 } else { 0 };
            let zone = zone.filter(|zone| (1..=60).contains(zone));
            zone.and_then(|zone: u32| ReferenceSystem::from_epsg(32_600 + south + zone))
        }
        // A sphere under numbers of WGS 84.
        Some("merc")
            if [word("a"), word("b")] == [Some("6378137"); 2]
                && ["lat_ts", "lon_0", "x_0", "y_0"].into_iter().all(is_zero)
                && word("k").is_none_or(|scale| scale.parse() == Ok(1.0))
                && is_in_metres =>
        {
            Some(ReferenceSystem::WebMercator)
        }
        _ => None,
    };
    found.ok_or_else(unknown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_of_proj_are_the_codes_that_pyproj_gives_them() {
        // pyproj.CRS(text).to_epsg()
        for (text, code) in [
            ("+proj=utm +zone=32 +datum=WGS84 +units=m +no_defs", 32_632),
            (
                "+proj=utm +zone=34 +south +ellps=WGS84 +towgs84=0,0,0 +units=m",
                32_734,
            ),
            ("+proj=longlat +datum=WGS84 +no_defs +type=crs", 4326),
            ("+init=epsg:25832", 25_832),
            (
                "+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +lon_0=0 +x_0=0 +y_0=0 +k=1 +units=m +nadgrids=@null +wktext",
                3857,
            ),
        ] {
            assert_eq!(read(text), by_code(code), "{text}");
        }
        for text in [
            "+proj=utm +zone=61 +datum=WGS84",
            "+proj=utm +zone=32 +datum=WGS84 +units=us-ft",
            "+proj=utm +zone=32 +ellps=intl +towgs84=-87,-98,-121",
            "+proj=sterea +lat_0=52 +datum=WGS84",
            "+proj=utm +zone=17 +datum=WGS84 +to_meter=0.3048006096",
            "+proj=merc +a=6378137 +b=6378137 +lon_0=150",
            "+proj=merc +a=6378137 +b=6378137 +units=km",
            "+proj=longlat +datum=WGS84 +pm=paris",
        ] {
            let refusal = read(text).unwrap_err().to_string();
            assert!(refusal.contains(&text[..20]), "{refusal}");
        }
    }
}
