//! Reference systems as PROJ writes them: `+proj=utm +zone=32 +datum=WGS84 +units=m`.

use pilotage_base::frames::{Datum, Ellipsoid, ProjectionMethod, ReferenceSystem};

use super::definition::{ParameterRole, ProjectedDefinition};
use super::made::of_numbers;
use super::names::shortened;
use super::{SystemError, by_code, code_table, datums};

/// Words that are looked at below, or change no number.
const HARMLESS: [&str; 30] = [
    "init", "proj", "zone", "south", "datum", "ellps", "towgs84", "units", "a", "b", "rf", "f",
    "lat_ts", "lat_0", "lat_1", "lat_2", "lon_0", "x_0", "y_0", "k", "k_0", "alpha", "nadgrids",
    "wktext", "no_defs", "type", "over", "vunits", "title", "ellipse",
];

/// Names of PROJ for projections, and the names that well-known text has for them.
const METHODS: [(&str, &str); 9] = [
    ("utm", "TRANSVERSEMERCATOR"),
    ("tmerc", "TRANSVERSEMERCATOR"),
    ("lcc", "LAMBERTCONFORMALCONIC"),
    ("aea", "ALBERS"),
    ("laea", "LAMBERTAZIMUTHALEQUALAREA"),
    ("sterea", "OBLIQUESTEREOGRAPHIC"),
    ("stere", "STEREOGRAPHIC"),
    ("merc", "MERCATOR"),
    ("somerc", "SWISSOBLIQUECYLINDRICAL"),
];

/// Ellipsoids by their names in PROJ: the greater half axis and the inverse flattening.
const ELLIPSOIDS: [(&str, f64, f64); 11] = [
    ("WGS84", 6_378_137.0, 298.257_223_563),
    ("GRS80", 6_378_137.0, 298.257_222_101),
    ("bessel", 6_377_397.155, 299.152_812_8),
    ("airy", 6_377_563.396, 299.324_964_6),
    ("mod_airy", 6_377_340.189, 299.324_964_6),
    ("intl", 6_378_388.0, 297.0),
    ("clrk66", 6_378_206.4, 294.978_698_213_898_2),
    ("clrk80ign", 6_378_249.2, 293.466_021_293_626_5),
    ("aust_SA", 6_378_160.0, 298.25),
    ("krass", 6_378_245.0, 298.3),
    ("GRS67", 6_378_160.0, 298.247_167_427),
];

/// Datums by their names in PROJ, with the names of files that are known.
const DATUMS: [(&str, &str); 4] = [
    ("NAD83", "NAD83"),
    ("OSGB36", "OSGB 1936"),
    ("potsdam", "DHDN"),
    ("GGRS87", "GGRS87"),
];

/// Units of coordinates, in metres.
const UNITS: [(&str, f64); 4] = [
    ("m", 1.0),
    ("us-ft", 1200.0 / 3937.0),
    ("ft", 0.3048),
    ("km", 1000.0),
];

/// A text of PROJ by its words.
struct ProjWords<'a>(Vec<(&'a str, &'a str)>);

impl<'a> ProjWords<'a> {
    fn of(text: &'a str) -> Self {
        let words = text.split_whitespace().filter_map(|word| {
            let word = word.strip_prefix('+')?;
            Some(word.split_once('=').unwrap_or((word, "")))
        });
        Self(words.collect())
    }

    fn word(&self, key: &str) -> Option<&'a str> {
        let found = self.0.iter().find(|(name, _)| *name == key);
        found.map(|(_, value)| *value)
    }

    /// A number; the default where the word is missing, `None` where it is no number.
    fn number(&self, key: &str, default: f64) -> Option<f64> {
        let number = self
            .word(key)
            .map_or(Some(default), |word| word.parse().ok());
        number.filter(|number: &f64| number.is_finite())
    }

    /// The datum, `None` where its shift to WGS 84 is not known.
    fn datum(&self) -> Option<Datum> {
        if self.word("nadgrids").is_some() {
            return None;
        }
        let shift = match self.word("towgs84") {
            Some(shift) => {
                let numbers: Result<Vec<f64>, _> =
                    shift.split(',').map(|n| n.trim().parse()).collect();
                Some(numbers.ok()?)
            }
            None => None,
        };
        let name = self.word("datum");
        if name == Some("WGS84") {
            return shift
                .is_none_or(|shift| shift.iter().all(|n| *n == 0.0))
                .then_some(datums::WGS84);
        }
        if let Some(name) = name {
            let (_, known) = DATUMS.iter().find(|(own, _)| *own == name)?;
            return datums::named(known);
        }
        let ellipsoid = self.ellipsoid()?;
        if let Some(shift) = shift {
            let is_none = shift.iter().all(|n| *n == 0.0);
            if is_none && ellipsoid == Ellipsoid::WGS84 {
                return Some(datums::WGS84);
            }
            return match self.word("ellps") {
                Some("GRS80") if is_none => datums::named("ETRS89"),
                _ => datums::stated(None, Some(ellipsoid), shift),
            };
        }
        match self.word("ellps") {
            Some("WGS84") => Some(datums::WGS84),
            // It says no datum: today's lie within two metres, older ones do not.
            Some("GRS80") => datums::named("Unknown based on GRS80 ellipsoid"),
            _ => None,
        }
    }

    fn ellipsoid(&self) -> Option<Ellipsoid> {
        let (semi_major, inverse) = if let Some(name) = self.word("ellps") {
            let (_, a, rf) = ELLIPSOIDS.iter().find(|(own, ..)| *own == name)?;
            (*a, *rf)
        } else {
            let a = self.number("a", f64::NAN)?;
            let b = self.number("b", f64::NAN);
            let stated = self.number("rf", f64::NAN);
            (a, stated.or_else(|| b.map(|b| a / (a - b)))?)
        };
        inverse.is_finite().then(|| Ellipsoid {
            semi_major,
            flattening: 1.0 / inverse,
        })
    }
}

/// The system of such a text: a code, or degrees or a projection on a datum whose shift to WGS 84 it states or that is known.
/// Others are refused by their text.
pub(super) fn read(text: &str) -> Result<ReferenceSystem, SystemError> {
    let words = ProjWords::of(text);
    let unknown = || SystemError::unknown(format!("\"{}\"", shortened(text)));
    if let Some(code) = words.word("init").and_then(|name| name.split_once(':')) {
        return code.1.parse().map_err(|_| unknown()).and_then(by_code);
    }
    // Whatever else stands there may change the numbers: units in `to_meter`, axes, other meridians.
    if !words.0.iter().all(|(name, _)| HARMLESS.contains(name)) {
        return Err(unknown());
    }
    described(text, &words).unwrap_or_else(|| Err(unknown()))
}

/// The system of the words; `None` where they say what is not known.
fn described(text: &str, words: &ProjWords) -> Option<Result<ReferenceSystem, SystemError>> {
    let unit = words.word("units").unwrap_or("m");
    let (_, unit) = *UNITS.iter().find(|(name, _)| *name == unit)?;
    let method = words.word("proj")?;
    // A sphere under numbers of WGS 84.
    let is_sphere = [words.word("a"), words.word("b")] == [Some("6378137"); 2];
    if method == "merc" && is_sphere {
        let is_plain = ["lat_ts", "lon_0", "x_0", "y_0"]
            .into_iter()
            .all(|key| words.number(key, 0.0) == Some(0.0));
        let is_web = is_plain && words.number("k", 1.0) == Some(1.0) && unit == 1.0;
        return is_web.then_some(Ok(ReferenceSystem::WebMercator));
    }
    let datum = words.datum()?;
    if ["longlat", "latlong", "lonlat", "latlon"].contains(&method) {
        if datum == datums::WGS84 {
            return Some(Ok(ReferenceSystem::Geographic));
        }
        let numbers = code_table::plain_numbers(datum, ProjectionMethod::Geographic);
        let name = format!("\"{}\"", shortened(text));
        return Some(
            of_numbers(None, numbers).map_err(|cause| SystemError::Number { name, cause }),
        );
    }
    let zone = match method {
        "utm" => {
            let zone: u32 = words.word("zone")?.parse().ok()?;
            Some((1..=60).contains(&zone).then_some(zone)?)
        }
        _ => None,
    };
    let is_south = words.word("south").is_some();
    if let Some(zone) = zone.filter(|_| datum == datums::WGS84 && unit == 1.0) {
        let code = 32_600 + if is_south { 100 } else { 0 } + zone;
        return ReferenceSystem::from_epsg(code).map(Ok);
    }
    // PROJ has the origin of a cone of one parallel there where none is stated, and GDAL on the equator, with a second
    // parallel there: nobody knows what was meant.
    let is_unstated = |key: &str| words.word(key).is_none();
    if method == "lcc" && ["lat_0", "lat_2"].into_iter().all(is_unstated) {
        return None;
    }
    let angle = |key: &str| words.number(key, 0.0).map(f64::to_radians);
    let stated = |key: &str| words.word(key).map(|_| angle(key));
    let scale = match words.word("k_0") {
        Some(_) => words.number("k_0", 1.0)?,
        None => words.number("k", 1.0)?,
    };
    let mut numbers = [None; 8];
    let mut set = |role: ParameterRole, value: Option<f64>| numbers[role as usize] = value;
    set(ParameterRole::Latitude, Some(angle("lat_0")?));
    set(ParameterRole::Longitude, Some(angle("lon_0")?));
    for (key, role) in [
        ("lat_1", ParameterRole::FirstParallel),
        ("lat_2", ParameterRole::SecondParallel),
        ("lat_ts", ParameterRole::FirstParallel),
    ] {
        if let Some(value) = stated(key) {
            set(role, Some(value?));
        }
    }
    set(ParameterRole::Scale, Some(scale));
    set(ParameterRole::Easting, Some(words.number("x_0", 0.0)?));
    set(ParameterRole::Northing, Some(words.number("y_0", 0.0)?));
    if let Some(zone) = zone {
        set(
            ParameterRole::Longitude,
            Some((6.0 * f64::from(zone) - 183.0).to_radians()),
        );
        set(ParameterRole::Scale, Some(0.9996));
        set(ParameterRole::Easting, Some(500_000.0));
        set(
            ParameterRole::Northing,
            Some(if is_south { 1e7 } else { 0.0 }),
        );
    }
    let (_, method) = METHODS.iter().find(|(own, _)| *own == method)?;
    let definition = ProjectedDefinition {
        name: shortened(text),
        datum,
        prime_meridian: 0.0,
        unit,
        numbers,
    };
    Some(definition.system(method))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projections_of_other_datums_are_those_of_their_codes() {
        // The texts are those of pyproj and epsg.io for the codes.
        for (text, code, [x, y]) in [
            (
                "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel +towgs84=674.374,15.056,405.346,0,0,0,0 +units=m +no_defs",
                2056,
                [2_683_000.0, 1_247_000.0],
            ),
            (
                "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +ellps=airy +towgs84=446.448,-125.157,542.06,0.15,0.247,0.842,-20.489 +units=m",
                27_700,
                [430_000.0, 300_000.0],
            ),
            (
                "+proj=lcc +lat_0=46.5 +lon_0=3 +lat_1=49 +lat_2=44 +x_0=700000 +y_0=6600000 +ellps=GRS80 +towgs84=0,0,0,0,0,0,0 +units=m",
                2154,
                [650_000.0, 6_860_000.0],
            ),
            (
                "+proj=tmerc +lat_0=0 +lon_0=173 +k=0.9996 +x_0=1600000 +y_0=10000000 +ellps=GRS80 +units=m",
                2193,
                [1_750_000.0, 5_430_000.0],
            ),
            (
                "+proj=lcc +lat_0=40.1666666666667 +lon_0=-74 +lat_1=41.0333333333333 +lat_2=40.6666666666667 +x_0=300000 +y_0=0 +datum=NAD83 +units=us-ft",
                2263,
                [987_000.0, 190_000.0],
            ),
            (
                "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80 +units=m",
                3035,
                [4_300_000.0, 3_000_000.0],
            ),
            (
                "+proj=utm +zone=56 +south +ellps=GRS80 +units=m",
                28_356,
                [334_000.0, 6_250_000.0],
            ),
        ] {
            let place = |system: ReferenceSystem| system.geodetic(x, y).unwrap();
            let (found, right) = (place(read(text).unwrap()), place(by_code(code).unwrap()));
            let off = (found.latitude - right.latitude).hypot(found.longitude - right.longitude);
            assert!(off * 6.4e6 < 0.005, "{text}: {} m", off * 6.4e6);
        }
        let cone = |text: &str| {
            let text = format!("+proj=lcc {text} +lon_0=2.34 +x_0=600000 +datum=WGS84 +units=m");
            read(&text).map(|system| system.geodetic(600_000.0, 2_200_000.0).unwrap())
        };
        let found = cone("+lat_1=46.8 +lat_0=46.8 +y_0=2200000").unwrap();
        assert!((found.latitude.to_degrees() - 46.8).abs() < 1e-8);
        // By `proj` its origin lies at 46.8° north, by GDAL 3.9 on the equator.
        let refused = cone("+lat_1=46.8 +y_0=2200000").unwrap_err().to_string();
        assert!(refused.contains("+lat_1=46.8"), "{refused}");
    }

    #[test]
    fn an_ellipsoid_alone_is_no_datum_and_grids_are_known_by_their_numbers() {
        let greek = "+proj=tmerc +lat_0=0 +lon_0=24 +k=0.9996 +x_0=500000 +y_0=0 +ellps=GRS80 +units=m +no_defs";
        let israeli = "+proj=tmerc +lat_0=31.7343936111111 +lon_0=35.2045169444444 +k=1.0000067 +x_0=219529.584 +y_0=626907.39 +ellps=GRS80 +units=m";
        // pyproj: EPSG:2100 near Athens, EPSG:25884 in Latvia, EPSG:2039.
        for (text, x, y, latitude, longitude) in [
            (greek, 476_000.0, 4_205_000.0, 37.994_935_57, 23.728_366_90),
            (greek, 500_000.0, 6_290_000.0, 56.753_974_02, 24.0),
            (israeli, 180_000.0, 660_000.0, 32.032_513_04, 34.786_742_58),
        ] {
            let system = read(text).unwrap();
            let again = super::super::by_name(&system.well_known_text()).unwrap();
            for system in [system, again] {
                let place = system.geodetic(x, y).unwrap();
                let (north, east) = (
                    place.latitude - f64::to_radians(latitude),
                    place.longitude - f64::to_radians(longitude),
                );
                assert!(north.hypot(east) * 6.4e6 < 1.0, "{text}: {place:?}");
                let (e, n) = system.coordinates(&place).unwrap();
                assert!((e - x).hypot(n - y) < 0.01, "{e} {n}");
            }
        }
        for text in [
            "+proj=utm +zone=34 +ellps=GRS80 +units=m +no_defs",
            r#"GEOGCS["unknown",DATUM["Unknown_based_on_GRS80_ellipsoid",SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]"#,
        ] {
            let system = super::super::by_name(text).unwrap();
            let note = system.note().unwrap();
            assert!(
                note.contains("no datum") && note.contains("326 m"),
                "{note}"
            );
        }
        let stated = "+proj=utm +zone=34 +ellps=GRS80 +towgs84=0,0,0 +units=m";
        assert!(read(stated).unwrap().note().unwrap().contains("up to 2 m"));
    }

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
            "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +ellps=airy +units=m",
            "+proj=utm +zone=32 +ellps=intl +nadgrids=spain.gsb",
            "+proj=omerc +lat_0=52 +datum=WGS84",
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
