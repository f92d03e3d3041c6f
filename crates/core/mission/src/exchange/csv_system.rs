//! Reference systems that a line of a table of places names: degrees, and the zones of UTM on WGS 84.

/// System of the places of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum PlaceSystem {
    /// Longitude and latitude on WGS 84, degrees.
    Degrees,
    /// Easting and northing, metres, in a zone with its hemisphere: `32N`.
    Utm(String),
}

/// The system that a line is, as `OpenDroneMap` has it above its tables: `EPSG:32632`, `WGS84 UTM 32N`, `+proj=utm …`; `None`
/// where the line is something else.
///
/// The error says in words which system is not known.
pub(super) fn system(text: &str) -> Option<Result<PlaceSystem, String>> {
    let line = text.lines().next()?.trim();
    let lower = line.to_lowercase();
    let found = if let Some(code) = lower.strip_prefix("epsg:") {
        of_code(code.trim().parse().ok()?)
    } else if lower.starts_with("+proj=") {
        of_proj(&lower)
    } else {
        let rest = lower.strip_prefix("wgs84")?.trim();
        if rest.is_empty() {
            Some(PlaceSystem::Degrees)
        } else {
            zone(&rest.strip_prefix("utm")?.replace(' ', ""))
        }
    };
    Some(found.ok_or_else(|| {
        format!(
            "its places are in the reference system `{line}`, which is not read here: save it in degrees (EPSG:4326) or in a \
             zone of UTM (EPSG:32632)"
        )
    }))
}

/// The zone of UTM on WGS 84 that a remark of Metashape names.
pub(super) fn system_of_remark(line: &str) -> Option<PlaceSystem> {
    let lower = line.to_lowercase();
    let rest = lower.strip_prefix('#')?.trim_start();
    let rest = rest.strip_prefix("coordinatesystem:")?;
    let (_, behind) = rest.split_once("wgs 84 / utm zone ")?;
    let end = behind.find(|c: char| !c.is_alphanumeric());
    zone(&behind[..end.unwrap_or(behind.len())])
}

/// The zone of `32n`.
fn zone(text: &str) -> Option<PlaceSystem> {
    let text = text.to_uppercase();
    let number = text.strip_suffix(['N', 'S'])?;
    let is_zone = number.parse::<u8>().is_ok_and(|n| (1..=60).contains(&n));
    is_zone.then_some(PlaceSystem::Utm(text))
}

fn of_code(code: u32) -> Option<PlaceSystem> {
    match code {
        4326 | 4979 => Some(PlaceSystem::Degrees),
        32_601..=32_660 => zone(&format!("{}N", code - 32_600)),
        32_701..=32_760 => zone(&format!("{}S", code - 32_700)),
        _ => None,
    }
}

fn of_proj(line: &str) -> Option<PlaceSystem> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let value = |key: &str| {
        let mut found = words.iter().filter_map(|word| word.strip_prefix(key));
        found.next()
    };
    let is_wgs = value("+datum=").is_none_or(|datum| datum == "wgs84")
        && value("+ellps=").is_none_or(|ellipsoid| ellipsoid == "wgs84")
        && value("+towgs84=").is_none_or(|by| by.split(',').all(|n| n.parse() == Ok(0.0)))
        && value("+units=").is_none_or(|unit| unit == "m")
        && value("+nadgrids=").is_none()
        && value("+pm=").is_none();
    match value("+proj=").filter(|_| is_wgs)? {
        "longlat" | "latlong" | "lonlat" | "latlon" => Some(PlaceSystem::Degrees),
        "utm" => {
            let is_south = words.contains(&"+south");
            zone(&format!(
                "{}{}",
                value("+zone=")?,
                if is_south { 'S' } else { 'N' }
            ))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_are_known_by_their_lines() {
        let utm = |zone: &str| Some(Ok(PlaceSystem::Utm(zone.to_owned())));
        assert_eq!(system("EPSG:4326\n"), Some(Ok(PlaceSystem::Degrees)));
        assert_eq!(system("epsg:32760"), utm("60S"));
        assert_eq!(system("WGS84 UTM 32 N"), utm("32N"));
        assert_eq!(
            system("+proj=utm +zone=7 +ellps=WGS84 +units=m +no_defs"),
            utm("7N")
        );
        for line in [
            "EPSG:2056",
            "+proj=utm +zone=32 +ellps=bessel",
            "+proj=utm",
            "WGS84 UTM 61N",
        ] {
            assert!(system(line).is_some_and(|found| found.is_err()), "{line}");
        }
        for line in ["", "name,lat,lon", "epsg", "wgs84 is a datum"] {
            assert_eq!(system(line), None, "{line}");
        }
    }
}
