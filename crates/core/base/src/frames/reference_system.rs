//! The coordinate reference systems that maps come in.

use std::f64::consts::{FRAC_PI_2, TAU};

use serde::{Deserialize, Serialize};

use super::ellipsoid::SEMI_MAJOR;
use super::other_system::ProjectionMethod;
use super::{Ellipsoid, Geodetic, OtherSystem, TransverseMercator};

/// False easting of a UTM zone, metres.
const FALSE_EASTING: f64 = 500_000.0;
/// False northing of a southern UTM zone, metres.
const FALSE_NORTHING_SOUTH: f64 = 10_000_000.0;
/// Farthest from its central meridian that a zone is used, radians: beyond lies another part of the
/// world, and coordinates that lead there are a mistake.
const WIDEST: f64 = 0.7;
/// The projection of UTM zones.
const UTM: TransverseMercator = TransverseMercator::new(Ellipsoid::WGS84, 0.9996);

/// A coordinate reference system: what the x and y of a map mean.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum ReferenceSystem {
    /// EPSG:4326: x is longitude, y is latitude, degrees.
    Geographic,
    /// EPSG:3857: metres on the sphere of web maps, x east of Greenwich, y north of the equator.
    WebMercator,
    /// EPSG:32601-32660 and 32701-32760: metres in a zone of the Universal Transverse Mercator.
    Utm {
        /// Zone, 1 to 60, six degrees each from 180° west.
        zone: u8,
        /// Whether northings count from ten thousand kilometres south of the equator.
        is_south: bool,
    },
    /// Another projection or datum. Only programs that open maps know these; messages and saved
    /// documents do not hold them.
    #[serde(skip)]
    Other(OtherSystem),
}

impl ReferenceSystem {
    /// The system with that EPSG code, if it is one of WGS 84 here.
    ///
    /// ```
    /// use pilotage_base::frames::{Geodetic, ReferenceSystem};
    ///
    /// let system = ReferenceSystem::from_epsg(32_617).ok_or("not known")?;
    /// assert_eq!(system.name(), "WGS 84, UTM zone 17N");
    /// // Zone 17 has its middle at 81° W, where x is 500 km; y counts from the equator.
    /// let place = Geodetic::from_degrees(0.0, -81.0, 0.0);
    /// let (x, y) = system.coordinates(&place).ok_or("too far")?;
    /// assert!((x - 500_000.0).abs() < 1e-6 && y.abs() < 1e-6);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn from_epsg(code: u32) -> Option<Self> {
        let utm = |is_south: bool| Self::Utm {
            zone: (code % 100) as u8,
            is_south,
        };
        match code {
            4326 => Some(Self::Geographic),
            // 900913 and 3785 are older names of the same.
            3857 | 900_913 | 3785 => Some(Self::WebMercator),
            32_601..=32_660 => Some(utm(false)),
            32_701..=32_760 => Some(utm(true)),
            _ => None,
        }
    }

    /// UTM zone of WGS 84 by its number and the letter of its hemisphere, with whatever follows.
    fn utm_named(text: &str) -> Option<Self> {
        let length = text.find(|c: char| !c.is_ascii_digit())?;
        let (zone, hemisphere) = text.split_at(length);
        let south = match hemisphere.chars().next()? {
            'N' => 0,
            'S' => 100,
            _ => return None,
        };
        let zone: u32 = zone.parse().ok().filter(|zone| *zone <= 60)?;
        Self::from_epsg(32_600 + south + zone)
    }

    /// The system that a text names: "EPSG:32617", a bare code, a name like "WGS 84 / UTM zone 17N",
    /// or the well-known text of a .prj file.
    pub fn from_name(text: &str) -> Option<Self> {
        let plain = text.to_ascii_uppercase().replace(['_', ' ', '/', '-'], "");
        let digits = plain.strip_prefix("EPSG:").unwrap_or(&plain);
        if let Ok(code) = digits.parse() {
            return Self::from_epsg(code);
        }
        // A shift makes another datum of it.
        if let Some((_, after)) = plain.split_once("TOWGS84")
            && after
                .split(']')
                .next()?
                .contains(|c| matches!(c, '1'..='9'))
        {
            return None;
        }
        // Names of other datums hold the same words; they must not pass for WGS 84.
        if !plain.contains("WGS84") && !plain.contains("WGS1984") && !plain.contains("PSEUDOMERC") {
            return None;
        }
        if plain.contains("PSEUDOMERCATOR") || plain.contains("WEBMERCATOR") {
            return Some(Self::WebMercator);
        }
        if let Some((_, after)) = plain.split_once("UTMZONE") {
            return Self::utm_named(after);
        }
        // "WGS84 UTM 32N", as OpenDroneMap writes it.
        if let Some((_, after)) = plain.split_once("UTM")
            && after.starts_with(|c: char| c.is_ascii_digit())
        {
            return Self::utm_named(after);
        }
        let is_projected = [
            "PROJCS",
            "PROJCRS",
            "PROJECTION",
            "COMPDCS",
            "GEOCCS",
            "UTM",
        ]
        .iter()
        .any(|word| plain.contains(word));
        // "WGS 84 / World Mercator": EPSG names a projected system behind that of its datum.
        let is_behind_datum = text.split_once(" / ").is_some_and(|(before, _)| {
            let before = before.to_ascii_uppercase().replace([' ', '_', '-'], "");
            before.ends_with("WGS84")
        });
        (!is_projected && !is_behind_datum).then_some(Self::Geographic)
    }

    /// EPSG code, if it has one.
    pub fn epsg(&self) -> Option<u32> {
        match self {
            Self::Geographic => Some(4326),
            Self::WebMercator => Some(3857),
            Self::Utm { zone, is_south } => {
                Some(32_600 + 100 * u32::from(*is_south) + u32::from(*zone))
            }
            Self::Other(other) => other.code,
        }
    }

    /// Whether coordinates are longitude and latitude.
    pub fn is_geographic(&self) -> bool {
        match self {
            Self::Geographic => true,
            Self::WebMercator | Self::Utm { .. } => false,
            Self::Other(other) => other.numbers.method == ProjectionMethod::Geographic,
        }
    }

    /// x of once around the Earth, where x counts along parallels: 360 in degrees.
    pub fn around(&self) -> Option<f64> {
        match self {
            Self::Geographic => Some(360.0),
            Self::WebMercator => Some(TAU * SEMI_MAJOR),
            Self::Utm { .. } => None,
            Self::Other(other) => other.numbers.around(),
        }
    }

    /// Note on places that come through another datum than WGS 84.
    pub fn note(&self) -> Option<String> {
        match self {
            Self::Other(other) => other.note(),
            _ => None,
        }
    }

    /// [`Self::note`] as a sentence about the file of that name.
    pub fn note_on(&self, file: &str) -> Option<String> {
        Some(format!("{file}: {}.", self.note()?))
    }

    /// Name for people.
    pub fn name(&self) -> String {
        match self {
            Self::Geographic => "WGS 84, longitude and latitude".to_owned(),
            Self::WebMercator => "WGS 84, Web Mercator".to_owned(),
            Self::Utm { zone, is_south } => {
                let hemisphere = if *is_south { 'S' } else { 'N' };
                format!("WGS 84, UTM zone {zone}{hemisphere}")
            }
            Self::Other(other) => other.methods.name(other),
        }
    }

    /// Well-known text as .prj files hold it, in the words of ESRI, which most programs read.
    pub fn well_known_text(&self) -> String {
        let globe = r#"GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]"#;
        match self {
            Self::Geographic => globe.to_owned(),
            Self::WebMercator => format!(
                r#"PROJCS["WGS_1984_Web_Mercator_Auxiliary_Sphere",{globe},PROJECTION["Mercator_Auxiliary_Sphere"],PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",0.0],PARAMETER["Standard_Parallel_1",0.0],PARAMETER["Auxiliary_Sphere_Type",0.0],UNIT["Meter",1.0]]"#
            ),
            Self::Utm { zone, is_south } => {
                let hemisphere = if *is_south { 'S' } else { 'N' };
                let north = if *is_south { FALSE_NORTHING_SOUTH } else { 0.0 };
                let meridian = 6 * i32::from(*zone) - 183;
                format!(
                    r#"PROJCS["WGS_1984_UTM_Zone_{zone}{hemisphere}",{globe},PROJECTION["Transverse_Mercator"],PARAMETER["False_Easting",{FALSE_EASTING:.1}],PARAMETER["False_Northing",{north:.1}],PARAMETER["Central_Meridian",{meridian}.0],PARAMETER["Scale_Factor",0.9996],PARAMETER["Latitude_Of_Origin",0.0],UNIT["Meter",1.0]]"#
                )
            }
            Self::Other(other) => other.methods.well_known_text(other),
        }
    }

    /// The UTM zone that holds a place, without the exceptions of Norway and Svalbard.
    pub fn utm_around(place: &Geodetic) -> Self {
        let zones = (place.longitude.to_degrees() + 180.0).rem_euclid(360.0) / 6.0;
        Self::Utm {
            zone: (zones.floor() as u8).min(59) + 1,
            is_south: place.latitude < 0.0,
        }
    }

    /// Latitude and longitude of the coordinates (x, y), at height zero; `None` where they name no
    /// place on Earth.
    pub fn geodetic(&self, x: f64, y: f64) -> Option<Geodetic> {
        let (latitude, longitude) = match self {
            Self::Geographic => (y.to_radians(), x.to_radians()),
            Self::WebMercator => {
                let latitude = (y / SEMI_MAJOR).sinh().atan();
                (latitude, x / SEMI_MAJOR)
            }
            Self::Utm { zone, is_south } => {
                let south = if *is_south { FALSE_NORTHING_SOUTH } else { 0.0 };
                let (east, north) = (x - FALSE_EASTING, y - south);
                if !(east.abs() < 0.8 * SEMI_MAJOR && north.abs() < 1.6 * SEMI_MAJOR) {
                    return None;
                }
                let (latitude, longitude) = UTM.unproject(east, north);
                (latitude, longitude + central_meridian(*zone))
            }
            Self::Other(other) => return other.methods.geodetic(other, x, y),
        };
        // Pixels of maps of the world whose middles lie on a pole reach over it.
        let is_place =
            latitude.abs() <= 90.6_f64.to_radians() && longitude.abs() <= 720.0_f64.to_radians();
        is_place.then_some(Geodetic {
            latitude: latitude.clamp(-FRAC_PI_2, FRAC_PI_2),
            longitude,
            height: 0.0,
        })
    }

    /// Coordinates (x, y) of a place; `None` where the system does not reach.
    pub fn coordinates(&self, place: &Geodetic) -> Option<(f64, f64)> {
        let Geodetic {
            latitude,
            longitude,
            ..
        } = *place;
        let (x, y) = match self {
            Self::Geographic => (longitude.to_degrees(), latitude.to_degrees()),
            Self::WebMercator => (SEMI_MAJOR * longitude, SEMI_MAJOR * latitude.tan().asinh()),
            Self::Utm { zone, is_south } => {
                let from_meridian = super::wrap_pi(longitude - central_meridian(*zone));
                if from_meridian.abs() > WIDEST {
                    return None;
                }
                let (east, north) = UTM.project(latitude, from_meridian);
                let south = if *is_south { FALSE_NORTHING_SOUTH } else { 0.0 };
                (east + FALSE_EASTING, north + south)
            }
            Self::Other(other) => return other.methods.coordinates(other, place),
        };
        (x.is_finite() && y.is_finite()).then_some((x, y))
    }
}

/// Longitude of the middle of a UTM zone, radians.
fn central_meridian(zone: u8) -> f64 {
    (6.0 * f64::from(zone) - 183.0).to_radians()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn every_code_comes_back() {
        for code in [4326, 3857, 32_601, 32_660, 32_701, 32_733, 32_760] {
            let system = ReferenceSystem::from_epsg(code).unwrap();
            assert_eq!(system.epsg(), Some(code));
        }
        for code in [0, 4269, 26_917, 32_600, 32_661, 32_700, 32_761] {
            assert_eq!(ReferenceSystem::from_epsg(code), None);
        }
    }

    #[test]
    fn systems_are_known_by_the_names_that_programs_write() {
        let named = |text| ReferenceSystem::from_name(text).and_then(|system| system.epsg());
        for (text, code) in [
            ("EPSG:3857", 3857),
            ("32733", 32_733),
            ("WGS 84 / UTM zone 17N", 32_617),
            ("WGS 84 / Pseudo-Mercator", 3857),
            ("WGS 84", 4326),
            ("WGS 84 (EPSG::4326)", 4326),
            ("WGS_1984_Web_Mercator_Auxiliary_Sphere", 3857),
            (
                r#"PROJCS["WGS_1984_UTM_Zone_33S",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984","#,
                32_733,
            ),
            (
                r#"GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984","#,
                4326,
            ),
        ] {
            assert_eq!(named(text), Some(code), "{text}");
        }
        for text in [
            "",
            "NAD83 / UTM zone 17N",
            "EPSG:26917",
            "WGS 84 / UTM zone 99N",
            "WGS 84 / World Mercator",
            " WGS 84 / World Mercator (EPSG::3395)",
            r#"GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257],TOWGS84[0,0.5,0,0,0,0,0]],"#,
            r#"PROJCS["WGS_1984_Lambert",GEOGCS["GCS_WGS_1984","#,
        ] {
            assert_eq!(named(text), None, "{text}");
        }
    }

    #[test]
    fn a_system_is_known_by_the_text_that_is_written_for_it() {
        for code in [4326, 3857, 32_601, 32_615, 32_760] {
            let system = ReferenceSystem::from_epsg(code).unwrap();
            let text = system.well_known_text();
            assert_eq!(ReferenceSystem::from_name(&text), Some(system), "{text}");
        }
    }

    #[test]
    fn the_corner_of_the_web_map_is_its_well_known_number() {
        let place = ReferenceSystem::WebMercator
            .geodetic(20_037_508.342_789_244, 20_037_508.342_789_244)
            .unwrap();
        assert!((place.longitude.to_degrees() - 180.0).abs() < 1e-9);
        assert!((place.latitude.to_degrees() - 85.051_128_779_806_6).abs() < 1e-9);
    }

    #[test]
    fn the_zone_around_a_place_holds_it() {
        let duluth = Geodetic::from_degrees(46.84, -91.99, 0.0);
        let zone = ReferenceSystem::utm_around(&duluth);
        assert_eq!(zone.name(), "WGS 84, UTM zone 15N");
        let date_line = Geodetic::from_degrees(-20.0, 180.0, 0.0);
        assert_eq!(ReferenceSystem::utm_around(&date_line).epsg(), Some(32_701));
    }

    #[test]
    fn coordinates_that_name_no_place_are_refused() {
        let utm = ReferenceSystem::from_epsg(32_617).unwrap();
        assert_eq!(utm.geodetic(f64::NAN, 0.0), None);
        assert_eq!(utm.geodetic(5e7, 0.0), None);
        assert_eq!(ReferenceSystem::Geographic.geodetic(0.0, 91.0), None);
        let far = Geodetic::from_degrees(0.0, 100.0, 0.0);
        assert_eq!(utm.coordinates(&far), None);
    }

    proptest! {
        #[test]
        fn coordinates_survive_the_round_trip_to_a_micrometre(
            latitude in -84.0_f64..84.0,
            from_meridian in -20.0_f64..20.0,
            zone in 1_u8..=60,
            is_south: bool,
        ) {
            let meridian = 6.0 * f64::from(zone) - 183.0;
            let place = Geodetic::from_degrees(latitude, meridian + from_meridian, 0.0);
            let systems = [
                ReferenceSystem::Geographic,
                ReferenceSystem::WebMercator,
                ReferenceSystem::Utm { zone, is_south },
            ];
            for system in systems {
                let (x, y) = system.coordinates(&place).unwrap();
                let back = system.geodetic(x, y).unwrap();
                let north = (back.latitude - place.latitude) * SEMI_MAJOR;
                let east = super::super::wrap_pi(back.longitude - place.longitude) * SEMI_MAJOR;
                prop_assert!(north.hypot(east) < 1e-6, "{system:?}: {north} {east}");
            }
        }
    }
}
