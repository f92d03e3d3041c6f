//! Places of every form, beside those that other programs read.

use super::*;
use crate::frames::LocalFrame;

fn degrees(text: &str) -> Result<[f64; 2], PlaceTextError> {
    let place = place_of_text(text)?;
    Ok([place.latitude, place.longitude].map(f64::to_degrees))
}

fn refusal(text: &str) -> String {
    match degrees(text) {
        Ok(place) => panic!("{text} is {place:?}"),
        Err(why) => why.to_string(),
    }
}

/// Distance of the place that a text names from a latitude and longitude, metres.
fn off(text: &str, [latitude, longitude]: [f64; 2]) -> f64 {
    let place = place_of_text(text).unwrap_or_else(|why| panic!("{text}: {why}"));
    let frame = LocalFrame::new(Geodetic::from_degrees(latitude, longitude, 0.0));
    frame.world_from_geodetic(&place).coords.norm()
}

#[test]
fn latitude_and_longitude_are_read_as_people_write_them() {
    for text in [
        "46.5, -92.25",
        " 46.5 -92.25 ",
        "46.5;-92.25",
        "46.5° N, 92.25° W",
        "92.25° W, 46.5° N",
        "92.25W 46.5N",
        "-92.25, 46.5 north",
        "46°30'N 92°15'W",
        "46° 30' 0\" N, 92° 15' 0\" W",
        "46 30 N 92 15 W",
        "n46.5 w92.25",
        "N 46° 30', W 92° 15'",
        "46°30', -92°15'",
    ] {
        let [latitude, longitude] = degrees(text).unwrap_or_default();
        assert!(
            (latitude - 46.5).abs() < 1e-12 && (longitude + 92.25).abs() < 1e-12,
            "{text}: {latitude} {longitude}"
        );
    }
}

#[test]
fn degrees_that_are_no_place_are_refused_with_the_reason() {
    for text in ["", "here", "46.5", "46.5, x", "1, 2, 3", "46 30 92 15"] {
        assert!(refusal(text).contains("46.8571"), "{text}");
    }
    assert!(refusal("95, 10").contains("95 and 10"));
    assert!(refusal("10, 200").contains("up to 180"));
    assert!(refusal("46 N, 92 S").contains("one with E or W"));
    assert!(refusal("46 E, 92 W").contains("one number with N or S"));
    assert!(refusal("448251 5211932").contains("zone before them"));
}

#[test]
fn addresses_of_maps_are_read_with_their_mark_or_else_their_middle() {
    for text in [
        "geo:46.5,-92.25",
        "geo:46.5,-92.25,430;crs=wgs84;u=35",
        "geo:0,0?q=46.5,-92.25(Hangar)",
        "geo:46.5,-92.25?z=15",
        "https://www.google.com/maps/@46.5,-92.25,15z",
        "https://www.google.com/maps?q=46.5,-92.25",
        "https://maps.google.com/?q=loc:46.5,+-92.25&z=12",
        "https://www.google.com/maps/search/?api=1&query=46.5%2C-92.25",
        "https://www.google.com/maps/search/46.5,+-92.25?entry=tts",
        "https://www.google.com/maps/place/Duluth/@46.7,-92.1,12z/data=!3m1!4b1!4m6!3m5!1s0x52:0xa7!8m2!3d46.5!4d-92.25!16zL20",
        "https://www.google.com/maps/place/Duluth/@46.7,-92.1,12z/data=!8m2!3d46.5!4d-92.25?entry=ttu",
        "google.com/maps/@46.5,-92.25,1200m/data=!3m1!1e3",
        "https://www.openstreetmap.org/#map=12/46.5/-92.25",
        "https://www.openstreetmap.org/#map=12/46.5/-92.25&layers=N",
        "https://www.openstreetmap.org/?mlat=46.5&mlon=-92.25#map=15/46.7/-92.1",
        "https://www.bing.com/maps?cp=46.5~-92.25&lvl=12",
        "https://www.bing.com/maps?cp=46.7~-92.1&sp=point.46.5_-92.25_Hangar",
        "https://maps.apple.com/?ll=46.5,-92.25&q=Hangar",
        "https://maps.apple.com/place?coordinate=46.5,-92.25&name=Hangar",
        "https://example.org/map#12.5/46.5/-92.25",
    ] {
        let [latitude, longitude] = degrees(text).unwrap_or_default();
        assert!(
            (latitude - 46.5).abs() < 1e-12 && (longitude + 92.25).abs() < 1e-12,
            "{text}: {latitude} {longitude}"
        );
    }
    for text in [
        "https://maps.app.goo.gl/AbC+dEf123",
        "https://www.google.com/maps/place/Duluth",
        "https://www.openstreetmap.org/",
        "geo:323482,4306480;crs=EPSG:32618;u=20",
        "geo:here",
    ] {
        assert!(refusal(text).contains("copy the long one"), "{text}");
    }
    assert!(refusal("geo:95,10").contains("95 and 10"));
    assert!(refusal("https://www.google.com/maps/@46.5,-192.25,15z").contains("-192.25"));
}

#[test]
fn whole_numbers_of_autopilots_are_ten_millionths_of_degrees() {
    for (text, [latitude, longitude]) in [
        ("465000000 -922500000", [46.5, -92.25]),
        ("465000000, -922500000", [46.5, -92.25]),
        ("-353632621;1491652374", [-35.363_262_1, 149.165_237_4]),
        ("512345678, -1234567", [51.234_567_8, -0.123_456_7]),
    ] {
        let found = degrees(text).unwrap_or_default();
        let off = (found[0] - latitude).hypot(found[1] - longitude);
        assert!(off < 1e-12, "{text}: {found:?}");
    }
    // Millionths as well, metres with their zone, more than the globe has, and no whole numbers.
    for text in [
        "46500000, -92250000",
        "32448251 5211932",
        "950000000 100000000",
        "465000000.5 -922500000",
    ] {
        assert!(refusal(text).contains("zone before them"), "{text}");
    }
}

/// Values of the Python package mgrs 1.6.0 (`MGRS().UTMToMGRS` and `toLatLon`), which is NGA's GEOTRANS.
#[test]
fn utm_coordinates_are_read_with_the_band_or_the_half_of_their_zone() {
    let north = [47.058_879_634_172_89, 8.318_577_666_255_399];
    for text in [
        "32T 448251.5 5211932.5",
        "32 T 448251.5mE 5211932.5mN",
        "UTM zone 32T 448251.5E, 5211932.5N",
        // As Google Earth shows it.
        "32 T 448251.50 m E 5211932.50 m N",
        "32T 448251.50 m, 5211932.50 m",
        "32 T 448251.5 mE 5211932.5 mN",
        "32n 448251.5 5211932.5",
        "32 north 448251.5 5211932.5",
    ] {
        assert!(off(text, north) < 1e-3, "{text}: {}", off(text, north));
    }
    let south = [-33.866_040_088_120_89, 151.209_356_196_854_12];
    for text in [
        "56H 334368.5 6251254.5",
        "56S 334368.5 6251254.5",
        "56 South 334368.5 6251254.5",
    ] {
        assert!(off(text, south) < 1e-3, "{text}");
    }
}

#[test]
fn a_zone_keeps_its_own_letter_beside_letters_of_units() {
    // By pyproj: EPSG:32732 to EPSG:4326.
    let place = [-0.999_998_563_269_485_8, 9.0];
    assert!(off("32 M 500000 m E 9889470 m N", place) < 1e-3);
    assert!(off("32M 500000 9889470", place) < 1e-3);
}

#[test]
fn degrees_and_minutes_are_no_utm_coordinates() {
    for text in ["46 N 30 15 E", "46 N 30 15E", "46 N, 30 15 E"] {
        assert_eq!(degrees(text), Ok([46.0, 30.25]), "{text}");
    }
}

#[test]
fn wrong_utm_coordinates_are_refused_with_the_reason() {
    assert!(refusal("61T 448251 5211932").contains("1 to 60"));
    assert!(refusal("32I 448251 5211932").contains("I is no latitude band"));
    assert!(refusal("32T 448251 5411932").contains("48.86°, outside of band T, 40° to 48°"));
    assert!(refusal("32T 48251 5211932").contains("eastings go from"));
    assert!(refusal("32 north 448251 9911932").contains("84° north"));
    assert!(refusal("32Z 448251 5211932").contains("UPS"));
    // 38° north, or by the Falkland Islands.
    assert!(refusal("21S 430000 4270000").contains("21 north or 21 south"));
    let south = degrees("21 south 430000 4270000").unwrap_or_default();
    assert!((south[0] + 51.7).abs() < 0.1, "{south:?}");
}

/// Values of the Python package mgrs 1.6.0 (`MGRS().toLatLon`), which is NGA's GEOTRANS: middles of the squares.
#[test]
fn mgrs_references_are_the_middles_of_their_squares() {
    for (text, latitude, longitude) in [
        (
            "32TMT4825111932",
            47.058_879_634_172_89,
            8.318_577_666_255_399,
        ),
        (
            "32t mt 48251 11932",
            47.058_879_634_172_89,
            8.318_577_666_255_399,
        ),
        ("32TMT4811", 47.055_007_402_360_076, 8.321_899_009_163_58),
        ("32TMT", 47.401_538_120_175_196, 8.337_344_507_395_958),
        (
            "15TWN7699693690",
            47.791_968_483_714_68,
            -91.971_934_115_943_37,
        ),
        (
            "18SUJ2337106519",
            38.889_805_116_317_19,
            -77.036_537_282_091_56,
        ),
        (
            "56HLH3436851254",
            -33.866_040_088_120_89,
            151.209_356_196_854_12,
        ),
        (
            "33XVG7459043593",
            77.865_494_198_868_8,
            13.917_119_919_809_357,
        ),
        (
            "31NEA0000000000",
            4.523_656_831_636_744_5e-6,
            3.000_004_493_373_770_4,
        ),
        (
            "21FUC5000099999",
            -51.431_324_490_042_8,
            -59.157_851_141_046_22,
        ),
        (
            "04QFJ1234056789",
            21.309_519_022_809_976,
            -157.916_861_988_853_2,
        ),
        (
            "4QFJ1234056789",
            21.309_519_022_809_976,
            -157.916_861_988_853_2,
        ),
        (
            "01NAA6602150000",
            0.451_745_963_256_251_8,
            179.999_907_799_253_35,
        ),
    ] {
        let off = off(text, [latitude, longitude]);
        assert!(off < 1e-3, "{text}: {off} m");
    }
}

#[test]
fn wrong_mgrs_references_are_refused_with_the_reason() {
    assert!(refusal("61TMT4811").contains("1 to 60"));
    assert!(refusal("32OMT4811").contains("O is no latitude band"));
    assert!(
        refusal("32TAT4811")
            .contains("A is no column of zone 32, whose squares have the letters JKLMNPQR")
    );
    assert!(refusal("32TMX4811").contains("X is no row"));
    assert!(refusal("32TMT481").contains("this has 3 in all"));
    assert!(refusal("32TMT482511193211").contains("this has 12 in all"));
    assert!(refusal("32UMT4825111932").contains("47.06°, outside of band U, 48° to 56°"));
    assert!(refusal("ZAH1234").contains("UPS"));
}

/// Values of the Python package openlocationcode 1.0.1 (`decode(code).latitudeCenter`, `.longitudeCenter`).
#[test]
fn plus_codes_are_the_middles_of_their_squares() {
    for (text, latitude, longitude) in [
        ("8FVC9G8F+6X", 47.365_562_5, 8.524_937_5),
        ("8fvc9g8f+6x Zürich", 47.365_562_5, 8.524_937_5),
        ("8FVC9G8F+6XQ", 47.365_587_5, 8.524_984_375),
        ("8FVC9G8F+6XQ2345", 47.365_575_02, 8.524_972_106_933_596),
        ("86P8VW4F+R9", 44.857_062_5, -93.076_562_5),
        ("4RRH46J8+9QHXV", -33.869_050_5, 151.216_995_117_187_48),
        ("8FVC9G00+", 47.375, 8.525),
        ("62G20000+", 0.5, -179.5),
        ("CFX3X2X2+X2", 89.999_937_5, 1.000_062_5),
        ("22222222+22", -89.999_937_5, -179.999_937_5),
    ] {
        let found = degrees(text).unwrap_or_default();
        let error = (found[0] - latitude)
            .abs()
            .max((found[1] - longitude).abs());
        assert!(error < 1e-9, "{text}: {found:?}");
    }
}

/// Values of the same package (`recoverNearest`, then `decode`).
#[test]
fn short_plus_codes_are_the_squares_nearest_to_a_place() {
    for (text, near, found) in [
        ("9G8F+6X Zürich", [47.37, 8.54], [47.365_562_5, 8.524_937_5]),
        ("9g8f+6x", [47.4, 9.0], [47.365_562_5, 8.524_937_5]),
        ("8F+6X, Zürich", [47.37, 8.54], [47.365_562_5, 8.524_937_5]),
        ("WF8Q+WF", [0.0, -160.03], [-0.082_687_5, -160.511_312_5]),
        ("22VJ+22", [51.01, -1.0], [51.042_562_5, -0.969_937_5]),
        // Over the date line.
        ("9G8F+6X", [-47.9, -179.99], [-47.634_437_5, 179.524_937_5]),
    ] {
        let near = Geodetic::from_degrees(near[0], near[1], 0.0);
        let place = place_of_text_near(text, &near).unwrap_or_else(|why| panic!("{text}: {why}"));
        let place = [place.latitude, place.longitude].map(f64::to_degrees);
        let error = (place[0] - found[0]).abs().max((place[1] - found[1]).abs());
        assert!(error < 1e-9, "{text}: {place:?}");
    }
    let anywhere = Geodetic::from_degrees(0.0, 0.0, 0.0);
    for text in ["9G8F+6", "F+6X2", "9G8+6X", "9G8A+6X"] {
        assert!(place_of_text_near(text, &anywhere).is_err(), "{text}");
    }
    assert_eq!(town_of_short_code("46.5, 8"), None);
    assert_eq!(town_of_short_code("+46.5, +8"), None);
}

/// The same package (`isValid`, `isFull`) takes none of these for whole codes.
#[test]
fn wrong_plus_codes_are_refused_with_the_reason() {
    assert!(refusal("9G8F+6X").contains("short"));
    assert!(refusal("8FVC9A8F+6X").contains("A stands in no plus code"));
    for text in [
        "8FVC9G8F+6",
        "8FVC0000+6X",
        "8FV00000+",
        "FFVC9G8F+6X",
        "8XVC9G8F+6X",
        "8FVC9G8F6+X2",
    ] {
        assert!(refusal(text).contains("eight letters"), "{text}");
    }
    // A sign is no code.
    assert!(degrees("+46.5, +92").is_ok());
}

#[test]
fn short_links_of_open_street_map_are_places() {
    // The example of its wiki, and links made by its own encoder's rule.
    for text in [
        "https://osm.org/go/0EEQjE--",
        "http://www.openstreetmap.org/go/0EEQjE==?m",
        "osm.org/go/0EEQjE",
    ] {
        let place = place_of_text(text).unwrap();
        assert!(
            (place.latitude.to_degrees() - 51.510_772_705_078_125).abs() < 1e-12,
            "{text}"
        );
        assert!(
            (place.longitude.to_degrees() - 0.054_931_640_625).abs() < 1e-12,
            "{text}"
        );
    }
    // Letters of another case are another place.
    let other = place_of_text("https://osm.org/go/0eEQjE--").unwrap();
    assert!((other.latitude.to_degrees() - 51.51).abs() > 0.1);
    for text in [
        "https://osm.org/go/",
        "https://osm.org/go/0E.QjE",
        "https://osm.org/go/AAAAAAAAAAAAAAAA",
    ] {
        assert!(place_of_text(text).is_err(), "{text}");
    }
}
