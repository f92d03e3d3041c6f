//! `.points` files of every age of QGIS.

use super::*;
use pilotage_base::frames::ReferenceSystem;

/// Two lines as QGIS 3.16 wrote them, with the system `names` in each.
fn with_systems(names: [&str; 2]) -> String {
    let lines = names.map(|name| {
        let quoted = name.replace('"', "\"\"");
        format!("8.5,47.25,10.5,-20.25,1,0,0,0,\"{quoted}\"\n")
    });
    format!(
        "mapX,mapY,pixelX,pixelY,enable,dX,dY,residual,CRS\n{}",
        lines.concat()
    )
}

const GLOBE: &str = r#"GEOGCRS["WGS 84",DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],PRIMEM["Greenwich",0],CS[ellipsoidal,2],AXIS["geodetic latitude (Lat)",north],ID["EPSG",4326]]"#;
const ZONE: &str = r#"PROJCRS["WGS 84 / UTM zone 32N",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,298.257223563]]],CONVERSION["UTM zone 32N",METHOD["Transverse Mercator"]],CS[Cartesian,2],ID["EPSG",32632]]"#;
const LAMBERT: &str = r#"PROJCRS["RGF93 v1 / Lambert-93",BASEGEOGCRS["RGF93 v1"],ID["EPSG",2154]]"#;

#[test]
fn the_system_in_every_line_is_that_of_the_points() {
    for (name, epsg) in [(GLOBE, 4326), (ZONE, 32_632), ("EPSG:3857", 3857)] {
        let (points, system) = read_points(&with_systems([name, name])).unwrap();
        assert_eq!(system, ReferenceSystem::from_epsg(epsg), "{name}");
        let point = &points[1];
        assert_eq!((points.len(), point.enabled), (2, true));
        assert_eq!((point.place.x, point.place.y), (8.5, 47.25));
        assert_eq!((point.pixel.x, point.pixel.y), (10.5, 20.25));
    }
}

#[test]
fn a_system_that_is_not_known_is_named_unless_another_is_given() {
    let rows = with_systems([LAMBERT, LAMBERT]);
    let comment = format!("#CRS: {LAMBERT}\nmapX,mapY,sourceX,sourceY\n8.5,47.25,1,-1\n");
    for (text, line) in [(rows, "line 2"), (comment, "line 1")] {
        let error = read_points(&text).unwrap_err().to_string();
        assert!(
            error.starts_with(line) && error.contains("Lambert-93"),
            "{error}"
        );
        let given = Some(ReferenceSystem::Geographic);
        assert_eq!(
            read_points_in(&text, given, ReferenceSystem::from_name)
                .unwrap()
                .1,
            given
        );
    }
}

#[test]
fn lines_of_different_systems_are_refused() {
    let error = read_points(&with_systems([GLOBE, ZONE]))
        .unwrap_err()
        .to_string();
    assert!(
        error.starts_with("line 3") && error.contains("zone 32N"),
        "{error}"
    );
}

#[test]
fn names_may_stand_behind_a_number_sign() {
    let text = "# mapX,mapY,pixelX,pixelY,enable\n8.0,47.0,20,-30,1.0\n";
    let (points, system) = read_points(text).unwrap();
    assert_eq!((points[0].pixel.x, points[0].pixel.y), (20.0, 30.0));
    assert_eq!(system, None);
}

#[test]
fn semicolons_and_decimal_commas_are_read_and_a_comma_between_commas_is_none_of_decimals() {
    let plain = "mapX,mapY,sourceX,sourceY,enable\n391234.5,5432100.25,20.5,-30.25,1\n1100.5,2000.25,120,-30,0\n";
    let right = read_points(plain).unwrap().0;
    let semicolons = plain.replace(',', ";").replace('.', ",");
    let grouped = semicolons
        .replace("391234,5", "391.234,5")
        .replace("5432100,25", "5 432 100,25");
    for text in [
        semicolons,
        grouped,
        plain.replace(',', "\t"),
        plain.replace(',', ";"),
    ] {
        let read = read_points(&text).unwrap().0;
        assert_eq!(read, right, "{text}");
    }
    let shifted = plain.replace("391234.5", "391234,5");
    let told = read_points(&shifted.replace("391234,5", "\"391234,5\""))
        .unwrap_err()
        .to_string();
    assert!(
        told.contains("line 2") && told.contains("391234,5"),
        "{told}"
    );
}
