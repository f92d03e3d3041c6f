//! Tests of `georeference`.

use super::*;

const BRIGHTON: &str = r#"{"origin_lat": 46.84265666666667, "origin_lon": -91.99400802469137,
    "gsd": 0.08566359690280188,
    "R": [[0.9999642049944301, 0.008461012342369262], [-0.008461012342369236, 0.99996420499443]],
    "T": [-68.76551123546528, 34.52891982244265], "size": [1865, 1085]}"#;

#[test]
fn a_similarity_puts_the_centre_of_the_first_pixel_at_its_translation() {
    let georeference = Georeference::from_json(BRIGHTON).unwrap();
    let frame = LocalFrame::new(georeference.origin(1865, 1085).unwrap());
    let map = georeference.in_world(&frame, 1865, 1085).unwrap();
    let p = map.ground_at(&Point2::new(0.5, 0.5));
    // The sphere's metres differ from those of WGS 84 by 0.14 % northward, -0.18 % eastward.
    assert!((p.north - 34.52892 * 0.998_63).abs() < 0.01, "{p:?}");
    assert!((p.east + 68.76551 * 1.001_78).abs() < 0.01, "{p:?}");
    let right = map.ground_at(&Point2::new(1000.5, 0.5));
    assert!((right.east - p.east - 85.66 * 1.001_78).abs() < 0.02);
    assert!((right.north - p.north + 0.7248).abs() < 0.01);
}

#[test]
fn a_world_file_in_metres_counts_from_the_centre_of_the_first_pixel() {
    let georeference = Georeference::from_world_file("0.5\n0\n0\n-0.5\n100\n200\n").unwrap();
    let frame = LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0));
    let map = georeference.in_world(&frame, 10, 10).unwrap();
    let corner = map.ground_at(&Point2::new(0.0, 0.0));
    assert_eq!((corner.north, corner.east), (200.25, 99.75));
}

#[test]
fn a_world_file_in_degrees_meets_the_tangent_plane() {
    let text = "0.000001\n0\n0\n-0.000001\n10.0\n45.0\n";
    let georeference = Georeference::from_world_file(text).unwrap();
    assert!(matches!(
        georeference,
        Georeference::Projected {
            system: ReferenceSystem::Geographic,
            ..
        }
    ));
    let frame = LocalFrame::new(Geodetic::from_degrees(45.0, 10.0, 0.0));
    let map = georeference.in_world(&frame, 1000, 1000).unwrap();
    let p = map.ground_at(&Point2::new(0.5, 0.5));
    assert!(p.north.abs() < 1e-3 && p.east.abs() < 1e-3, "{p:?}");
    assert!((map.gsd() - (0.111_13_f64 * 0.078_85).sqrt()).abs() < 1e-3);
}

#[test]
fn a_broken_world_file_names_the_line() {
    let wrong = Georeference::from_world_file("1\n0\n0\nminus one\n0\n0\n").unwrap_err();
    assert!(
        matches!(wrong, GeoreferenceError::WorldFile { line: 4, .. }),
        "{wrong}"
    );
    assert!(Georeference::from_world_file("1\n0\n0\n").is_err());
    assert!(Georeference::from_json("{\"gsd\": 1}").is_err());
    let flat = Georeference::from_world_file("0\n0\n0\n0\n1000\n0\n").unwrap();
    let frame = LocalFrame::new(Geodetic::from_degrees(0.0, 0.0, 0.0));
    assert_eq!(
        flat.in_world(&frame, 9, 9),
        Err(GeoreferenceError::Degenerate)
    );
}
