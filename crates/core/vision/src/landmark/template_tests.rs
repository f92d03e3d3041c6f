//! Tests of `template`.

use nalgebra::Point3;

use super::*;
use pilotage_base::frames::{Attitude, GroundRect, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Pyramid;

#[test]
fn a_search_over_kilometres_looks_at_no_more_ground_than_the_picture_shows() {
    let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
    let luminance = Pyramid::new(Gray::filled(640, 480, 90.0), 3);
    let view = FrameView {
        camera: &camera,
        pose: Pose {
            position_in_world: Point3::new(300.0, -200.0, -122.0),
            attitude: Attitude {
                roll: 0.1,
                pitch: -0.05,
                yaw: 0.7,
            },
        },
        ground_down: 0.0,
        luminance: &luminance,
    };
    let reach = (9000, 9000);
    let around = |north, east| {
        let center = GroundPoint::new(north, east);
        window_around(center, 0.3, (120, 120), reach)
    };
    let wide = around(1200.0, 900.0);
    let cut = in_picture(&wide, &view).unwrap();
    let footprint = camera.footprint(&view.pose, 0.0);
    let shown = GroundRect::around(footprint).unwrap();
    assert!(cut.rect().contains_rect(&shown), "{cut:?}");
    assert!(shown.grown(0.31).contains_rect(&cut.rect()), "{cut:?}");
    // On the very grid of the wide window.
    let steps = (wide.north_edge - cut.north_edge) / 0.3;
    assert!((steps - steps.round()).abs() < 1e-6);
    assert_eq!(in_picture(&around(8000.0, 0.0), &view), None);
    let near = window_around(shown.center(), 0.3, (40, 40), (9, 9));
    assert_eq!(in_picture(&near, &view), Some(near));
}
