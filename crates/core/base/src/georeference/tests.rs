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

/// A map in degrees whose top left corner is there, with square pixels of `step` degrees.
fn in_degrees(longitude: f64, latitude: f64, step: f64) -> Georeference {
    Georeference::Projected {
        system: ReferenceSystem::Geographic,
        file: WorldFile {
            a: step,
            d: 0.0,
            b: 0.0,
            e: -step,
            c: longitude + 0.5 * step,
            f: latitude - 0.5 * step,
        },
    }
}

#[test]
fn a_map_of_the_world_has_the_scale_of_its_middle() {
    let world = in_degrees(-180.0, 90.0, 0.1);
    let frame = LocalFrame::new(world.origin(3600, 1800).unwrap());
    let map = world.in_world(&frame, 3600, 1800).unwrap();
    // A tenth of a degree at the equator: 11,132 m eastward, 11,057 m northward.
    assert!((map.gsd() - 11_095.0).abs() < 20.0, "{}", map.gsd());
    // From the other side of the globe the part at the origin is taken.
    let other = LocalFrame::new(Geodetic::from_degrees(60.0, 170.0, 0.0));
    let map = world.in_world(&other, 3600, 1800).unwrap();
    assert!(
        (map.gsd() - 11_132.0 * 0.5_f64.sqrt()).abs() < 100.0,
        "{}",
        map.gsd()
    );
}

#[test]
fn a_map_on_the_other_side_of_the_globe_is_refused_as_such() {
    let frame = LocalFrame::new(Geodetic::from_degrees(-40.0, 170.0, 0.0));
    let error = in_degrees(0.0, 10.0, 0.001).in_world(&frame, 100, 100);
    assert_eq!(error, Err(GeoreferenceError::TooFar));
}

#[test]
fn a_map_over_the_date_line_is_whole() {
    let map = in_degrees(170.0, 10.0, 0.1);
    let frame = LocalFrame::new(map.origin(200, 100).unwrap());
    for (x, y) in [(5.0, 5.0), (99.0, 50.0), (101.0, 50.0), (195.0, 95.0)] {
        let ground = map.ground_at(&frame, x, y);
        let back = map.pixel_at(&frame, &ground).unwrap();
        assert!((back - Point2::new(x, y)).norm() < 1e-6, "{back}");
    }
}

#[test]
fn of_the_pixels_of_one_place_it_is_the_one_in_the_picture() {
    let around_greenwich = in_degrees(-180.0, 90.0, 0.1);
    let around_the_date_line = in_degrees(0.0, 90.0, 0.1);
    let frame = LocalFrame::new(Geodetic::from_degrees(45.0, -90.0, 0.0));
    let origin = GroundPoint::default();
    let middle = Point2::new(1800.0, 900.0);
    let pixel = |map: &Georeference| map.pixel_near(&frame, &origin, &middle).unwrap().x;
    assert!((pixel(&around_greenwich) - 900.0).abs() < 1e-6);
    assert!((pixel(&around_the_date_line) - 2700.0).abs() < 1e-6);
}

proptest::proptest! {
    #[test]
    fn any_pixel_of_a_map_of_the_world_survives_the_way_over_any_plane(
        origin in (-90.0_f64..=90.0, -180.0_f64..=180.0),
        pixel in (0.0_f64..3600.0, 1.0_f64..1799.0),
        west in -180.0_f64..=180.0,
    ) {
        let map = in_degrees(west, 90.0, 0.1);
        let frame = LocalFrame::new(Geodetic::from_degrees(origin.0, origin.1, 0.0));
        let ground = map.ground_at(&frame, pixel.0, pixel.1);
        if ground.north.is_finite() {
            let middle = Point2::new(1800.0, 900.0);
            let back = map.pixel_near(&frame, &ground, &middle).unwrap();
            let moved = (back.x - pixel.0).abs();
            // Both ends of the map are one meridian.
            let moved = moved.min((moved - 3600.0).abs());
            proptest::prop_assert!(moved < 1e-5 && (back.y - pixel.1).abs() < 1e-5, "{back}");
        }
        proptest::prop_assert!(map.in_world(&frame, 3600, 1800).is_ok());
    }
}
