//! Datums, and how their places come to WGS 84.

use nalgebra::Vector3;
use pilotage_base::frames::{Datum, Ellipsoid};

use super::names::plain;
use super::three_dimensional::flat_code;

/// Radians in a second of arc.
const SECOND: f64 = std::f64::consts::PI / 648_000.0;
/// Accuracy of taking a datum of today's continents for WGS 84, metres.
pub(super) const NEAR: f64 = 2.0;
/// Distance of the places of Greece's datum (GGRS87) from those of WGS 84, metres: the furthest of those on GRS 80.
const OF_GREECE: f64 = 326.0;
/// Distance of the places of Vietnam's datum (VN-2000), metres: the furthest of those on the ellipsoid of WGS 84.
const OF_VIETNAM: f64 = 195.0;
/// Name of the datum of files that state GRS 80 and nothing else.
pub(super) const UNSTATED_ON_GRS80: &str = "an unnamed datum on GRS 80";
/// Name of the datum of files that state GRS 80 and the projection of the Greek Grid, which TM Baltic93 has as well.
pub(super) const GREEK_OR_BALTIC: &str = "GGRS87 (Greece) or one of today";
/// Latitude between Greece and the Baltic, radians.
const NORTH_OF_GREECE: f64 = 45.0 * std::f64::consts::PI / 180.0;
/// Ellipsoids whose squared eccentricities differ by less are the same to a tenth of a millimetre.
const SAME_ELLIPSOID: f64 = 1e-10;

const fn ellipsoid(semi_major: f64, inverse_flattening: f64) -> Ellipsoid {
    Ellipsoid {
        semi_major,
        flattening: 1.0 / inverse_flattening,
    }
}

const GRS80: Ellipsoid = ellipsoid(6_378_137.0, 298.257_222_101);
const BESSEL: Ellipsoid = ellipsoid(6_377_397.155, 299.152_812_8);
const AIRY: Ellipsoid = ellipsoid(6_377_563.396, 299.324_964_6);
const AIRY_MODIFIED: Ellipsoid = ellipsoid(6_377_340.189, 299.324_964_6);
const INTERNATIONAL: Ellipsoid = ellipsoid(6_378_388.0, 297.0);
const CLARKE_1866: Ellipsoid = ellipsoid(6_378_206.4, 294.978_698_213_898_2);
const CLARKE_1880_IGN: Ellipsoid = ellipsoid(6_378_249.2, 293.466_021_293_626_5);
const AUSTRALIAN: Ellipsoid = ellipsoid(6_378_160.0, 298.25);
const GRS67_MODIFIED: Ellipsoid = AUSTRALIAN;
const KRASSOWSKY: Ellipsoid = ellipsoid(6_378_245.0, 298.3);
const GRS67: Ellipsoid = ellipsoid(6_378_160.0, 298.247_167_427);

/// A datum by name, with the EPSG code of its system of longitude and latitude.
pub(super) struct KnownDatum {
    /// EPSG code of its longitude and latitude.
    pub code: u32,
    /// The datum itself.
    pub datum: Datum,
    /// Names that files have for it, in capitals and without anything but letters and digits; the name of the datum
    /// is one as well.
    names: &'static [&'static str],
}

const fn near(
    code: u32,
    name: &'static str,
    ellipsoid: Ellipsoid,
    names: &'static [&'static str],
) -> KnownDatum {
    shifted(code, name, ellipsoid, [0.0; 7], NEAR, names)
}

/// Shifts in metres, rotations in seconds of arc after the position-vector convention, scale in parts per
/// million; accuracy in metres as EPSG states it.
const fn shifted(
    code: u32,
    name: &'static str,
    ellipsoid: Ellipsoid,
    shift: [f64; 7],
    accuracy: f64,
    names: &'static [&'static str],
) -> KnownDatum {
    KnownDatum {
        code,
        datum: Datum {
            name,
            ellipsoid,
            shift: in_radians(shift),
            accuracy,
        },
        names,
    }
}

/// The shift with its rotations in radians and its scale as a difference from 1.
pub(super) const fn in_radians([x, y, z, rx, ry, rz, ppm]: [f64; 7]) -> [f64; 7] {
    [x, y, z, rx * SECOND, ry * SECOND, rz * SECOND, ppm * 1e-6]
}

/// Inverse of [`in_radians`].
pub(super) fn in_seconds([x, y, z, rx, ry, rz, scale]: [f64; 7]) -> [f64; 7] {
    [x, y, z, rx / SECOND, ry / SECOND, rz / SECOND, scale * 1e6]
}

/// WGS 84.
pub(super) const WGS84: Datum = Datum {
    name: "WGS 84",
    ellipsoid: Ellipsoid::WGS84,
    shift: [0.0; 7],
    accuracy: 0.0,
};

/// All that are known. Shifts are those of EPSG's transformations without a grid; where EPSG has others for parts of
/// the area, accuracies are what those differ by.
#[rustfmt::skip]
pub(super) const DATUMS: &[KnownDatum] = &[
    near(4258, "ETRS89", GRS80, &["EUROPEANTERRESTRIALREFERENCESYSTEM1989", "ETRF89", "ETRS1989", "EUREF89", "EUROPEANTERRESTRIALREFERENCESYSTEM1989ENSEMBLE"]),
    near(4269, "NAD83", GRS80, &["NORTHAMERICANDATUM1983", "NORTHAMERICAN1983", "NAD1983"]),
    near(6318, "NAD83(2011)", GRS80, &["NAD83NATIONALSPATIALREFERENCESYSTEM2011", "NAD1983NSRS2011", "NAD19832011"]),
    near(4152, "NAD83(HARN)", GRS80, &["NAD83HIGHACCURACYREFERENCENETWORK", "NORTHAMERICAN1983HARN", "NAD1983HARN"]),
    near(4759, "NAD83(NSRS2007)", GRS80, &["NAD83NATIONALSPATIALREFERENCESYSTEM2007", "NAD1983NSRS2007"]),
    near(4617, "NAD83(CSRS)", GRS80, &["NAD83CANADIANSPATIALREFERENCESYSTEM", "NORTHAMERICAN1983CSRS", "NAD1983CSRS", "NORTHAMERICAN1983CSRS98", "CSRS98"]),
    near(4283, "GDA94", GRS80, &["GEOCENTRICDATUMOFAUSTRALIA1994", "GDA1994"]),
    near(7844, "GDA2020", GRS80, &["GEOCENTRICDATUMOFAUSTRALIA2020"]),
    near(4167, "NZGD2000", GRS80, &["NEWZEALANDGEODETICDATUM2000", "NZGD2000"]),
    near(4171, "RGF93", GRS80, &["RESEAUGEODESIQUEFRANCAIS1993", "RGF1993", "RESEAUGEODESIQUEFRANCAIS1993V1", "RGF93V1"]),
    near(9777, "RGF93 v2", GRS80, &["RESEAUGEODESIQUEFRANCAIS1993V2"]),
    near(9782, "RGF93 v2b", GRS80, &["RESEAUGEODESIQUEFRANCAIS1993V2B"]),
    near(4619, "SWEREF99", GRS80, &["SWEREF99"]),
    near(4173, "IRENET95", GRS80, &["IRENET95"]),
    near(4612, "JGD2000", GRS80, &["JAPANESEGEODETICDATUM2000"]),
    near(6668, "JGD2011", GRS80, &["JAPANESEGEODETICDATUM2011"]),
    near(4674, "SIRGAS 2000", GRS80, &["SISTEMADEREFERENCIAGEOCENTRICOPARALASAMERICAS2000", "SIRGAS2000", "SISTEMADEREFERENCIAGEOCENTRICOPARAAMERICADELSUR2000"]),
    near(4490, "CGCS2000", GRS80, &["CHINA2000", "CHINAGEODETICCOORDINATESYSTEM2000"]),
    near(4737, "KGD2002", GRS80, &["KOREA2000", "KOREANGEODETICDATUM2002", "GEOCENTRICDATUMOFKOREA", "KOREAGEODETICDATUM2002"]),
    near(3824, "TWD97", GRS80, &["TAIWANDATUM1997", "TWD1997"]),
    near(4148, "Hartebeesthoek94", Ellipsoid::WGS84, &["HARTEBEESTHOEK1994"]),
    near(9702, "ETRF2000-PL", GRS80, &["ETRF2000POLAND"]),
    near(4659, "ISN93", GRS80, &["ISLANDSNET1993", "ISLANDSNETWORK1993", "ISN1993"]),
    near(5324, "ISN2004", GRS80, &["ISLANDSNET2004", "ISLANDSNETWORK2004"]),
    near(4180, "EST97", GRS80, &["ESTONIA1997"]),
    near(4669, "LKS94", GRS80, &["LITHUANIA1994ETRS89", "LITHUANIA1994", "LKS1994"]),
    near(4661, "LKS92", GRS80, &["LATVIA1992", "LKS1992"]),
    near(4761, "HTRS96", GRS80, &["CROATIANTERRESTRIALREFERENCESYSTEM"]),
    near(4765, "Slovenia 1996", GRS80, &["SLOVENIAGEODETICDATUM1996"]),
    near(6706, "RDN2008", GRS80, &["RETEDINAMICANAZIONALE2008"]),
    near(4081, "REGCAN95", GRS80, &["REDGEODESICADECANARIAS1995"]),
    near(4190, "POSGAR 98", GRS80, &["POSICIONESGEODESICASARGENTINAS1998", "POSGAR1998"]),
    near(5340, "POSGAR 2007", GRS80, &["POSICIONESGEODESICASARGENTINAS2007"]),
    near(5365, "CR05", Ellipsoid::WGS84, &["COSTARICA2005"]),
    near(4686, "MAGNA-SIRGAS", GRS80, &["MARCOGEOCENTRICONACIONALDEREFERENCIA", "MAGNA"]),
    near(6365, "Mexico ITRF2008", GRS80, &["MEXICOITRF2008"]),
    near(4742, "GDM2000", GRS80, &["GEODETICDATUMOFMALAYSIA2000"]),
    near(4757, "SVY21", Ellipsoid::WGS84, &["SVY21"]),
    near(5252, "TUREF", GRS80, &["TURKISHNATIONALREFERENCEFRAME"]),
    near(5886, "TGD2005", GRS80, &["TONGAGEODETICDATUM2005"]),
    shifted(0, "an unnamed datum on WGS 84's ellipsoid", Ellipsoid::WGS84, [0.0; 7], OF_VIETNAM, &["UNKNOWNBASEDONWGS84ELLIPSOID", "UNKNOWNBASEDONWGS84ELLIPSOIDUSINGTOWGS84000", "UNKNOWNBASEDONWGS84"]),
    shifted(0, UNSTATED_ON_GRS80, GRS80, [0.0; 7], OF_GREECE, &["UNKNOWNBASEDONGRS80ELLIPSOID", "UNKNOWNBASEDONGRS1980ELLIPSOID", "UNKNOWNBASEDONGRS80", "GGRS87GREECEORONEOFTODAY"]),
    shifted(4277, "OSGB36", AIRY, [446.448, -125.157, 542.06, 0.15, 0.247, 0.842, -20.489], 2.0, &["ORDNANCESURVEYOFGREATBRITAIN1936", "OSGB1936"]),
    shifted(4300, "TM75", AIRY_MODIFIED, [482.5, -130.6, 564.6, -1.042, -0.214, -0.631, 8.15], 1.0, &["GEODETICDATUMOF1965", "TM65", "TM75"]),
    shifted(4289, "Amersfoort", BESSEL, [565.4171, 50.3319, 465.5524, -0.398_957_388_243_134, 0.343_987_817_378_283, -1.877_401_639_980_45, 4.0725], 1.0, &["AMERSFOORT"]),
    shifted(4149, "CH1903", BESSEL, [674.374, 15.056, 405.346, 0.0, 0.0, 0.0, 0.0], 1.5, &["CH1903"]),
    shifted(4150, "CH1903+", BESSEL, [674.374, 15.056, 405.346, 0.0, 0.0, 0.0, 0.0], 1.0, &["CH1903PLUS"]),
    shifted(4314, "DHDN", BESSEL, [598.1, 73.7, 418.2, 0.202, 0.045, -2.455, 6.7], 3.0, &["DEUTSCHESHAUPTDREIECKSNETZ"]),
    shifted(4312, "MGI", BESSEL, [577.326, 90.129, 463.919, 5.137, 1.474, 5.297, 2.4232], 1.5, &["MILITARGEOGRAPHISCHEINSTITUT", "MILITARGEOGRAPHISCHESINSTITUT"]),
    shifted(4313, "BD72", INTERNATIONAL, [-106.8686, 52.2978, -103.7239, 0.3366, -0.457, 1.8422, -1.2747], 1.0, &["RESEAUNATIONALBELGE1972", "BELGE1972"]),
    shifted(4156, "S-JTSK", BESSEL, [570.8, 85.7, 462.8, 4.998, 1.587, 5.261, 3.56], 3.0, &["SYSTEMOFTHEUNIFIEDTRIGONOMETRICALCADASTRALNETWORK", "SYSTEMJEDNOTNETRIGONOMETRICKESITEKATASTRALNI", "SJTSK", "JTSK"]),
    shifted(4230, "ED50", INTERNATIONAL, [-87.0, -98.0, -121.0, 0.0, 0.0, 0.0, 0.0], 15.0, &["EUROPEANDATUM1950", "EUROPEAN1950"]),
    shifted(4267, "NAD27", CLARKE_1866, [-8.0, 160.0, 176.0, 0.0, 0.0, 0.0, 0.0], 30.0, &["NORTHAMERICANDATUM1927", "NORTHAMERICAN1927"]),
    shifted(4301, "Tokyo", BESSEL, [-146.414, 507.337, 680.507, 0.0, 0.0, 0.0, 0.0], 9.0, &["TOKYO"]),
    shifted(4202, "AGD66", AUSTRALIAN, [-117.808, -51.536, 137.784, 0.303, 0.446, 0.234, -0.29], 3.0, &["AUSTRALIANGEODETICDATUM1966", "AUSTRALIAN1966", "AGD1966"]),
    shifted(4203, "AGD84", AUSTRALIAN, [-117.763, -51.51, 139.061, 0.292, 0.443, 0.277, -0.191], 3.0, &["AUSTRALIANGEODETICDATUM1984", "AUSTRALIAN1984", "AGD1984"]),
    shifted(4272, "NZGD49", INTERNATIONAL, [59.47, -5.04, 187.44, 0.47, -0.1, 1.024, -4.5993], 4.0, &["NEWZEALANDGEODETICDATUM1949", "NEWZEALAND1949", "NZGD1949"]),
    shifted(4265, "Monte Mario", INTERNATIONAL, [-104.1, -49.1, -9.9, 0.971, -2.917, 0.714, -11.68], 10.0, &["MONTEMARIO"]),
    shifted(4275, "NTF", CLARKE_1880_IGN, [-168.0, -60.0, 320.0, 0.0, 0.0, 0.0, 0.0], 2.0, &["NOUVELLETRIANGULATIONFRANCAISE", "NOUVELLETRIANGULATIONFRANCAISEPARIS", "NTFPARIS"]),
    shifted(4274, "Datum 73", INTERNATIONAL, [-239.749, 88.181, 30.488, 0.263, 0.082, 1.211, 2.229], 1.0, &["DATUM73"]),
    shifted(4121, "GGRS87", GRS80, [-199.87, 74.79, 246.62, 0.0, 0.0, 0.0, 0.0], 1.0, &["GREEKGEODETICREFERENCESYSTEM1987", "GGRS1987"]),
    shifted(4123, "KKJ", INTERNATIONAL, [-96.062, -82.428, -121.753, 4.801, 0.345, -1.376, 1.496], 1.0, &["KARTASTOKOORDINAATTIJARJESTELMA1966", "KKJ"]),
    shifted(4124, "RT90", BESSEL, [414.1, 41.3, 603.1, -0.855, 2.141, -7.023, 0.0], 1.0, &["RIKETSKOORDINATSYSTEM1990", "RT1990"]),
    shifted(4237, "HD72", GRS67, [52.17, -71.82, -14.9, 0.0, 0.0, 0.0, 0.0], 1.0, &["HUNGARIANDATUM1972", "HUNGARIAN1972"]),
    shifted(4179, "Pulkovo 1942(58)", KRASSOWSKY, [2.329, -147.042, -92.08, -0.309, 0.325, 0.497, 5.69], 3.0, &["PULKOVO194258", "PULKOVO1942ADJ1958", "PULKOVO1942ADJ58", "DEALULPISCULUI1970"]),
    shifted(4618, "SAD69", GRS67_MODIFIED, [-67.35, 3.88, -38.22, 0.0, 0.0, 0.0, 0.0], 10.0, &["SOUTHAMERICANDATUM1969", "SOUTHAMERICAN1969"]),
    shifted(4611, "Hong Kong 1980", INTERNATIONAL, [-162.619, -276.959, -161.764, 0.067_753, -2.243_648, -1.158_828, -1.094_246], 1.0, &["HONGKONG1980"]),
    shifted(4141, "Israel 1993", GRS80, [23.772, 17.49, 17.859, -0.3132, -1.852_74, 1.672_99, -5.4262], 2.0, &["ISRAEL1993", "ISRAEL"]),
];

/// Names of WGS 84 and of the frames that are the same to a metre's fraction at map scale.
const WGS84_NAMES: [&str; 5] = [
    "WGS84",
    "WGS1984",
    "WORLDGEODETICSYSTEM1984",
    "WORLDGEODETICSYSTEM1984ENSEMBLE",
    "WGS84ENSEMBLE",
];

/// The datum of a system of longitude and latitude, by EPSG code.
pub(super) fn by_code(code: u32) -> Option<Datum> {
    // With three coordinates the datum is the same.
    let code = flat_code(code).unwrap_or(code);
    match code {
        4326 => return Some(WGS84),
        4807 => return by_code(4275),
        4299 => return by_code(4300),
        _ => {}
    }
    let known = DATUMS.iter().find(|known| known.code == code && code > 0);
    known.map(|known| known.datum)
}

/// The datum with its own EPSG code (6258, not 4258) where that is the code of the system and 2000.
pub(super) fn by_datum_code(code: u32) -> Option<Datum> {
    (6000..7000)
        .contains(&code)
        .then(|| by_code(code - 2000))
        .flatten()
}

/// A name as [`plain`] writes it; "CH1903+" is another datum than "CH1903".
pub(super) fn plain_name(name: &str) -> String {
    plain(&name.replace('+', "PLUS"))
}

/// The datum that a file calls so.
pub(super) fn named(name: &str) -> Option<Datum> {
    let name = plain_name(name);
    let name = name.as_str();
    let is_meant = |wanted: &str| {
        name == wanted
            || name.strip_prefix('D') == Some(wanted)
            || name.strip_prefix("GCS") == Some(wanted)
    };
    if WGS84_NAMES.iter().any(|wanted| is_meant(wanted)) {
        return Some(WGS84);
    }
    let own = |known: &KnownDatum| {
        is_meant(&plain_name(known.datum.name)) || known.names.iter().any(|wanted| is_meant(wanted))
    };
    DATUMS
        .iter()
        .find(|known| own(known))
        .map(|known| known.datum)
}

/// The datum whose shift a file states, in metres, seconds of arc and parts per million: the `known` one if that is its
/// own shift, else one on `ellipsoid`, or on that of the known one, whose accuracy is not known. `None` without an
/// ellipsoid.
pub(super) fn stated(
    known: Option<Datum>,
    ellipsoid: Option<Ellipsoid>,
    shift: impl IntoIterator<Item = f64>,
) -> Option<Datum> {
    let mut stated = [0.0; 7];
    for (to, from) in stated.iter_mut().zip(shift) {
        *to = from;
    }
    let is_own = |known: &Datum| {
        let own = in_seconds(known.shift);
        own.iter().zip(stated).all(|(a, b)| (a - b).abs() < 0.1)
    };
    known.filter(is_own).or_else(|| {
        Some(Datum {
            name: "a datum with a shift of its own",
            ellipsoid: ellipsoid.or(known.map(|known| known.ellipsoid))?,
            shift: in_radians(stated),
            accuracy: f64::NAN,
        })
    })
}

/// The datum at a latitude: that of Greece, where its grid or one of the Baltic may be meant.
fn at(datum: &Datum, latitude: f64) -> Datum {
    let is_greek = datum.name == GREEK_OR_BALTIC && latitude < NORTH_OF_GREECE;
    is_greek.then(|| by_code(4121)).flatten().unwrap_or(*datum)
}

/// Whether a datum's places are those of WGS 84 as they are.
fn is_same(datum: &Datum) -> bool {
    let difference =
        datum.ellipsoid.eccentricity_squared() - Ellipsoid::WGS84.eccentricity_squared();
    datum.shift == [0.0; 7]
        && difference.abs() < SAME_ELLIPSOID
        && datum.ellipsoid.semi_major == Ellipsoid::WGS84.semi_major
}

/// Latitude and longitude of WGS 84 of a place at height zero of `datum`, radians.
pub(super) fn to_wgs84(datum: &Datum, latitude: f64, longitude: f64) -> (f64, f64) {
    let datum = &at(datum, latitude);
    if is_same(datum) {
        return (latitude, longitude);
    }
    let p = datum.ellipsoid.geocentric(latitude, longitude, 0.0);
    let [x, y, z, rx, ry, rz, scale] = datum.shift;
    let turned = Vector3::new(
        p.x - rz * p.y + ry * p.z,
        rz * p.x + p.y - rx * p.z,
        -ry * p.x + rx * p.y + p.z,
    );
    let moved = (1.0 + scale) * turned + Vector3::new(x, y, z);
    let (latitude, longitude, _) = Ellipsoid::WGS84.geodetic(&moved);
    (latitude, longitude)
}

/// Inverse of [`to_wgs84`].
///
/// The heights at both ends are not the same, so that the way back is not one formula: the place is moved
/// by what it misses until it misses nothing.
pub(super) fn from_wgs84(datum: &Datum, latitude: f64, longitude: f64) -> (f64, f64) {
    let datum = &at(datum, latitude);
    if is_same(datum) {
        return (latitude, longitude);
    }
    let mut own = (latitude, longitude);
    for _ in 0..4 {
        let there = to_wgs84(datum, own.0, own.1);
        let east = pilotage_base::frames::wrap_pi(longitude - there.1);
        own = (own.0 + latitude - there.0, own.1 + east);
    }
    own
}
