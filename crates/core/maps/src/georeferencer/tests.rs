//! Fits to points that are known to come from a transform, and to some that are not.

use nalgebra::{Matrix3, Point2};
use proptest::prelude::*;

use super::*;
use pilotage_base::frames::ReferenceSystem;

fn points(pixels: &[(f64, f64)], place: impl Fn(f64, f64) -> (f64, f64)) -> Vec<ControlPoint> {
    (pixels.iter())
        .map(|&(x, y)| {
            let (east, north) = place(x, y);
            ControlPoint {
                pixel: Point2::new(x, y),
                place: Point2::new(east, north),
                enabled: true,
            }
        })
        .collect()
}

const SPREAD: [(f64, f64); 6] = [
    (12.0, 30.0),
    (980.0, 44.0),
    (955.0, 710.0),
    (40.0, 690.0),
    (500.5, 400.0),
    (333.0, 90.0),
];

/// A turned picture in UTM coordinates.
fn turned(x: f64, y: f64) -> (f64, f64) {
    (
        570_000.0 + 0.3 * x + 0.1 * y,
        5_190_000.0 + 0.1 * x - 0.3 * y,
    )
}

#[test]
fn every_transform_finds_a_turn_and_its_leave_one_out_error_is_zero() {
    for kind in TransformKind::ALL {
        let fit = fit(&points(&SPREAD, turned), kind).unwrap();
        assert!(fit.rms_in_plane < 1e-6, "{kind:?}: {}", fit.rms_in_plane);
        assert!(fit.rms_in_pixels < 1e-5, "{kind:?}");
        assert!(fit.rms_left_out.unwrap() < 1e-5, "{kind:?}");
        let place = fit.place_at(&Point2::new(700.0, 100.0)).unwrap();
        let (east, north) = turned(700.0, 100.0);
        assert!((place - Point2::new(east, north)).norm() < 1e-5);
    }
}

#[test]
fn a_wrong_point_stands_out_by_its_left_out_error_and_can_be_turned_off() {
    let mut wrong = points(&SPREAD, turned);
    wrong[4].place.x += 30.0;
    let with = fit(&wrong, TransformKind::Similarity).unwrap();
    let left_out = with.residuals[4].left_out.unwrap();
    assert!((left_out.x + 30.0).abs() < 1e-5, "{left_out}");
    assert!(with.residuals[4].in_plane.norm() < 30.0);
    wrong[4].enabled = false;
    let without = fit(&wrong, TransformKind::Similarity).unwrap();
    assert!(without.rms_in_plane < 1e-6);
    assert!((without.residuals[4].in_plane.norm() - 30.0).abs() < 1e-5);
    assert_eq!(without.residuals[4].left_out, None);
}

#[test]
fn a_similarity_becomes_the_world_file_that_it_is() {
    let fit = fit(&points(&SPREAD, turned), TransformKind::Similarity).unwrap();
    let file = fit.world_file().unwrap();
    let (east, north) = turned(0.5, 0.5);
    for (found, expected) in [
        (file.a, 0.3),
        (file.b, 0.1),
        (file.d, 0.1),
        (file.e, -0.3),
        (file.c, east),
        (file.f, north),
    ] {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    let text = file.to_string();
    let read = pilotage_base::georeference::Georeference::from_world_file(&text).unwrap();
    assert_eq!(
        read,
        pilotage_base::georeference::Georeference::Metres(file)
    );
    let askew = super::fit(&points(&SPREAD, turned), TransformKind::Projective).unwrap();
    assert_eq!(askew.world_file(), None);
}

#[test]
fn too_few_points_and_points_on_a_line_are_refused_with_what_is_missing() {
    let all = points(&SPREAD, turned);
    for kind in TransformKind::ALL {
        let least = kind.least_points();
        let error = fit(&all[..least - 1], kind).unwrap_err();
        assert!(error.to_string().contains(&least.to_string()), "{error}");
        let exact = fit(&all[..least], kind).unwrap();
        assert_eq!(exact.rms_left_out, None);
    }
    let line = points(
        &[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (5.0, 5.0), (9.0, 9.0)],
        turned,
    );
    for kind in [TransformKind::Affine, TransformKind::Projective] {
        assert_eq!(
            fit(&line, kind),
            Err(FitError::Degenerate { kind: kind.name() })
        );
    }
    let same = points(&[(3.0, 4.0); 5], turned);
    for kind in TransformKind::ALL {
        assert!(fit(&same, kind).is_err());
    }
}

#[test]
fn points_survive_the_file_of_qgis() {
    let mut all = points(&SPREAD, turned);
    all[2].enabled = false;
    let system = ReferenceSystem::from_epsg(32_615);
    let fit = fit(&all, TransformKind::Affine).unwrap();
    let text = write_points(&all, system, Some(&fit));
    assert_eq!(read_points(&text), Ok((all, system)));
}

#[test]
fn a_file_as_qgis_writes_it_is_read() {
    let text = "#CRS: EPSG:3857\nmapX,mapY,sourceX,sourceY,enable,dX,dY,residual\n\
                -10240000.5,5910000.25,12.5,-30.25,1,0,0,0\n1,2,3,-4,0,0,0,0\n";
    let (points, system) = read_points(text).unwrap();
    assert_eq!(system, Some(ReferenceSystem::WebMercator));
    assert_eq!(points[0].pixel, Point2::new(12.5, 30.25));
    assert_eq!(points[0].place, Point2::new(-10_240_000.5, 5_910_000.25));
    assert!(points[0].enabled && !points[1].enabled);
    let old = "mapX,mapY,pixelX,pixelY,enable\n1,2,3,-4,1\n";
    assert_eq!(read_points(old).unwrap().0[0].pixel.y, 4.0);
    let broken = "mapX,mapY,sourceX,sourceY\n1,2,three,4\n";
    let error = read_points(broken).unwrap_err().to_string();
    assert!(
        error.starts_with("line 2") && error.contains("three"),
        "{error}"
    );
    assert!(matches!(
        read_points("a,b\n"),
        Err(PointsFileError::Header { line: 1 })
    ));
}

proptest! {
    #[test]
    fn a_perspective_is_found_again(
        tilt in prop::array::uniform2(-4e-4_f64..4e-4),
        turn in -3.1_f64..3.1,
        shift in prop::array::uniform2(-1e6_f64..1e6),
    ) {
        let (sine, cosine) = turn.sin_cos();
        let true_matrix = Matrix3::new(
            0.2 * cosine + shift[0] * tilt[0], 0.2 * sine + shift[0] * tilt[1], shift[0],
            0.2 * sine + shift[1] * tilt[0], -0.2 * cosine + shift[1] * tilt[1], shift[1],
            tilt[0], tilt[1], 1.0,
        );
        let place = |x: f64, y: f64| {
            let h = true_matrix * Point2::new(x, y).to_homogeneous();
            (h.x / h.z, h.y / h.z)
        };
        let fit = fit(&points(&SPREAD, place), TransformKind::Projective).unwrap();
        prop_assert!(fit.rms_in_plane < 1e-5, "{}", fit.rms_in_plane);
        let pixel = Point2::new(600.0, 600.0);
        let there = fit.place_at(&pixel).unwrap();
        let (east, north) = place(600.0, 600.0);
        prop_assert!((there - Point2::new(east, north)).norm() < 1e-4);
        prop_assert!((fit.pixel_at(&there).unwrap() - pixel).norm() < 1e-4);
    }

    #[test]
    fn any_text_is_read_or_refused(text in "(mapX,mapY,sourceX,sourceY\n)?[0-9a-z,.#\n-]{0,200}") {
        let _ = read_points(&text);
    }
}

#[test]
fn a_picture_seen_askew_lies_where_its_points_do_there_and_back() {
    use pilotage_base::frames::LocalFrame;
    let askew = |x: f64, y: f64| {
        let w = 1.0 + 2e-4 * x - 1e-4 * y;
        (
            570_000.0 + (0.3 * x + 0.05 * y) / w,
            5_190_000.0 + (0.02 * x - 0.28 * y) / w,
        )
    };
    let utm = ReferenceSystem::from_epsg(32_615).unwrap();
    let fit = fit(&points(&SPREAD, askew), TransformKind::Projective).unwrap();
    let place = fit.georeference(utm);
    let frame = LocalFrame::new(place.origin(1000, 700).unwrap());
    for (x, y) in [(0.5, 0.5), (640.0, 333.0), (999.0, 699.0)] {
        let (east, north) = askew(x, y);
        let wanted = frame.ground_from_geodetic(&utm.geodetic(east, north).unwrap());
        let ground = place.ground_at(&frame, x, y);
        assert!(ground.distance(&wanted) < 1e-4, "{ground:?} {wanted:?}");
        let pixel = place.pixel_at(&frame, &ground).unwrap();
        assert!((pixel - Point2::new(x, y)).norm() < 1e-4, "{pixel}");
    }
}

#[test]
fn points_in_degrees_on_both_sides_of_the_date_line_are_fitted_where_they_lie() {
    let point = |longitude: f64| ControlPoint {
        pixel: Point2::new(longitude, 1.0),
        place: Point2::new(longitude, -17.0),
        enabled: true,
    };
    let points = [point(179.99), point(-179.99), point(180.001)];
    let (in_plane, plane) = in_metres(&points, ReferenceSystem::Geographic).unwrap();
    // The middle lies at 179.9997° west.
    assert_eq!(plane.epsg(), Some(32_701));
    let apart = in_plane[1].place.x - in_plane[0].place.x;
    // 0.02° of longitude at 17° south, by a scale of 1.0008 at the zone's edge.
    assert!((apart - 2131.4).abs() < 2.0, "{apart}");
}

#[test]
fn points_in_degrees_are_fitted_in_metres() {
    let utm = ReferenceSystem::from_epsg(32_615).unwrap();
    let in_degrees = points(&SPREAD, |x, y| {
        let (east, north) = turned(x, y);
        let place = utm.geodetic(east, north).unwrap();
        (place.longitude.to_degrees(), place.latitude.to_degrees())
    });
    let (in_plane, plane) = in_metres(&in_degrees, ReferenceSystem::Geographic).unwrap();
    assert_eq!(plane, utm);
    let fit = fit(&in_plane, TransformKind::Similarity).unwrap();
    assert!(fit.rms_in_plane < 1e-5);
    let (same, system) = in_metres(&in_plane, utm).unwrap();
    assert_eq!((same, system), (in_plane, utm));
}
