//! Tests of `systems`; those against pyproj are with the end-to-end tests.

use pilotage_base::frames::{Geodetic, wrap_pi};
use proptest::prelude::*;

use super::*;

fn name(text: &str) -> Result<Option<u32>, SystemError> {
    by_name(text).map(|system| system.epsg())
}

#[test]
fn systems_are_known_by_code_and_by_the_names_of_epsg_and_esri() {
    for (text, code) in [
        ("EPSG:25832", 25832),
        ("urn:ogc:def:crs:EPSG::25832", 25832),
        ("2154", 2154),
        ("ETRS89 / UTM zone 32N", 25832),
        ("ETRS_1989_UTM_Zone_32N", 25832),
        ("NAD83 / UTM zone 17N", 26917),
        ("NAD_1983_UTM_Zone_17N", 26917),
        ("GDA2020 / MGA zone 56", 7856),
        ("OSGB36 / British National Grid", 27700),
        ("British_National_Grid", 0),
        ("ETRS89", 4258),
        ("WGS 84 / UTM zone 17N", 32617),
        ("RGF93 v1 / Lambert-93", 2154),
    ] {
        let expected = if code == 0 { None } else { Some(code) };
        assert_eq!(name(text).ok().flatten(), expected, "{text}");
    }
}

/// A name of WGS 84 with a projection is not longitude and latitude.
#[test]
fn every_projected_system_of_wgs_84_is_known_by_its_name() {
    use code_table::{codes_of, rows, stepped, unit_of};

    let mut count = 0;
    for (codes, name, _) in rows() {
        for (first, last, datum, unit) in codes_of(codes) {
            for code in (first..=last).filter(|_| datum == 4326) {
                let rest = stepped(name, code - first).unwrap();
                let text = format!("WGS 84 / {rest}{}", unit_of(unit).1);
                assert_eq!(by_name(&text), by_code(code), "{text}");
                count += 1;
            }
        }
    }
    assert!(count > 40, "{count}");
    assert_eq!(
        by_name("WGS_1984_World_Mercator")
            .ok()
            .and_then(|s| s.epsg()),
        Some(3395)
    );
    for text in ["WGS 84", "WGS84", "WGS 84 (EPSG::4326)", "GCS_WGS_1984"] {
        assert_eq!(by_name(text), Ok(ReferenceSystem::Geographic), "{text}");
    }
}

#[test]
fn a_shift_in_a_text_is_used_and_told() {
    let text = |shift: &str| {
        format!(
            r#"PROJCS["Local",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563],TOWGS84[{shift}]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]"#
        )
    };
    let plain = by_name(&text("0,0,0,0,0,0,0")).unwrap();
    assert_eq!(
        plain,
        ReferenceSystem::Utm {
            zone: 32,
            is_south: false
        }
    );
    let shifted = by_name(&text("0,0,100,0,0,0,0")).unwrap();
    assert!(
        shifted
            .note()
            .unwrap()
            .contains("shift that the file states")
    );
    let place = |system: &ReferenceSystem| system.geodetic(500_000.0, 5_300_000.0).unwrap();
    let north = (place(&shifted).latitude - place(&plain).latitude) * 6.37e6;
    assert!((60.0..75.0).contains(&north), "{north}");
}

#[test]
fn what_is_not_known_is_refused_by_its_name() {
    let refused = |text: &str| by_name(text).unwrap_err().to_string();
    assert!(refused("EPSG:99999").contains("EPSG:99999"));
    let datum = r#"GEOGCS["Batavia",DATUM["Batavia_of_old",SPHEROID["Bessel 1841",6377397.155,299.1528128]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]]"#;
    assert!(
        refused(datum).contains("Batavia_of_old"),
        "{}",
        refused(datum)
    );
    let method = r#"PROJCS["Odd",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Robinson"],PARAMETER["central_meridian",9],UNIT["metre",1]]"#;
    assert!(refused(method).contains("Robinson"), "{}", refused(method));
    let lost = method.replace("Robinson", "Albers_Conic_Equal_Area");
    assert!(refused(&lost).contains("parallels"), "{}", refused(&lost));
}

#[test]
fn a_datum_near_wgs_84_is_told() {
    let note = by_code(25832).unwrap().note().unwrap();
    assert_eq!(
        note,
        "ETRS89 / UTM zone 32N: its datum ETRS89 is taken for WGS 84; places may be off by up to 2 m"
    );
    assert_eq!(by_code(32632).unwrap().note(), None);
    let note = by_code(27700).unwrap().note().unwrap();
    assert!(
        note.ends_with("its standard shift, which is good to 2 m"),
        "{note}"
    );
}

#[test]
fn every_code_is_a_system_with_a_name() {
    let codes = codes();
    assert!(codes.len() > 1000);
    for code in codes {
        let system = by_code(code).unwrap_or_else(|cause| panic!("{cause}"));
        assert!(!system.name().is_empty());
        assert!(system.epsg().is_some(), "{code}");
    }
}

proptest! {
    #[test]
    fn any_place_survives_the_way_through_any_system_to_a_tenth_of_a_millimetre(
        pick in 0_usize..5000,
        latitude in -89.0_f64..89.0,
        longitude in -180.0_f64..180.0,
    ) {
        let codes = codes();
        let code = codes[pick % codes.len()];
        let system = by_code(code).unwrap();
        let place = Geodetic::from_degrees(latitude, longitude, 0.0);
        if let Some((x, y)) = system.coordinates(&place)
            && let Some(back) = system.geodetic(x, y)
        {
            let north = (back.latitude - place.latitude) * 6.4e6;
            let east = wrap_pi(back.longitude - place.longitude) * latitude.to_radians().cos() * 6.4e6;
            prop_assert!(north.hypot(east) < 1e-4, "{code}: {north} {east}");
        }
    }

    #[test]
    fn hostile_texts_are_refused_and_no_more(text in ".{0,80}", nested in 0_usize..60) {
        let _ = by_name(&text);
        let _ = by_name(&"PROJCS[\"a\",".repeat(nested));
        let _ = by_name(&format!("PROJCS[\"{text}\",GEOGCS[{text}],{text}]"));
    }
}

#[test]
fn web_mercator_is_known_by_the_text_that_gdal_writes_with_that_of_proj_in_it() {
    let text = r#"PROJCS["WGS 84 / Pseudo-Mercator",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Mercator_1SP"],PARAMETER["central_meridian",0],PARAMETER["scale_factor",1],PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1],EXTENSION["PROJ4","+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +lon_0=0 +x_0=0 +y_0=0 +k=1 +units=m +nadgrids=@null +wktext +no_defs"],AUTHORITY["EPSG","3857"]]"#;
    assert_eq!(super::by_name(text), Ok(ReferenceSystem::WebMercator));
}
