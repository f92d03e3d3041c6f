//! Reference systems that a line of a table of places names.

use pilotage_base::frames::ReferenceSystem;

/// The system that a line is, as `OpenDroneMap` has it above its tables: `EPSG:32632`, `WGS84 UTM 32N`, `+proj=utm …`; `None`
/// where the line is something else.
///
/// The error says in words which system is not known.
pub(super) fn system(text: &str) -> Option<Result<ReferenceSystem, String>> {
    let line = text.lines().next()?.trim();
    let lower = line.to_lowercase();
    let found = if let Some(code) = lower.strip_prefix("epsg:") {
        ReferenceSystem::from_epsg(code.trim().parse().ok()?)
    } else if lower.starts_with("+proj=") {
        of_proj(&lower)
    } else {
        let rest = lower.strip_prefix("wgs84")?.trim();
        if !rest.is_empty() && !rest.starts_with("utm") {
            return None;
        }
        ReferenceSystem::from_name(line).or_else(|| of_band(line))
    };
    Some(found.ok_or_else(|| {
        format!(
            "its places are in the reference system `{line}`, which is not read here: save it in degrees (EPSG:4326) or in a \
             zone of UTM (EPSG:32632)"
        )
    }))
}

/// The zone whose band stands where others have the hemisphere: `WGS84 UTM 30U`.
fn of_band(line: &str) -> Option<ReferenceSystem> {
    let band = line.chars().next_back()?.to_ascii_uppercase();
    let half = match band {
        'C'..='H' | 'J'..='M' => 'S',
        'P'..='X' => 'N',
        _ => return None,
    };
    let zone = line.strip_suffix(|c: char| c.is_ascii_alphabetic())?;
    ReferenceSystem::from_name(&format!("{zone}{half}"))
}

/// The system that a remark of Metashape names.
pub(super) fn system_of_remark(line: &str) -> Option<ReferenceSystem> {
    let (before, name) = line.strip_prefix('#')?.split_once(':')?;
    let is_system = before.trim().eq_ignore_ascii_case("CoordinateSystem");
    ReferenceSystem::from_name(name).filter(|_| is_system)
}

fn of_proj(line: &str) -> Option<ReferenceSystem> {
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
        "longlat" | "latlong" | "lonlat" | "latlon" => Some(ReferenceSystem::Geographic),
        "utm" => {
            let zone: u32 = value("+zone=")?.parse().ok()?;
            let half = if words.contains(&"+south") {
                32_700
            } else {
                32_600
            };
            let code = (1..=60).contains(&zone).then_some(half + zone)?;
            ReferenceSystem::from_epsg(code)
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_are_known_by_their_lines() {
        let utm = |zone: u8, is_south: bool| Some(Ok(ReferenceSystem::Utm { zone, is_south }));
        assert_eq!(system("EPSG:4326\n"), Some(Ok(ReferenceSystem::Geographic)));
        assert_eq!(system("epsg:32760"), utm(60, true));
        assert_eq!(system("WGS84 UTM 32 N"), utm(32, false));
        assert_eq!(system("WGS84 UTM 30U"), utm(30, false));
        assert_eq!(system("WGS84 UTM 19H"), utm(19, true));
        assert_eq!(
            system("+proj=utm +zone=7 +south +ellps=WGS84 +units=m +no_defs"),
            utm(7, true)
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
