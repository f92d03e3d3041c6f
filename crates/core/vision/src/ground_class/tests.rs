use nalgebra::Point3;

use super::*;
use pilotage_base::frames::{Attitude, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Picture, Raster, Rgba};

#[test]
fn weights_come_back_from_their_bytes_and_other_lengths_are_refused() {
    let network = CoverNetwork::usual();
    let bytes = network.to_bytes();
    assert_eq!(CoverNetwork::from_bytes(&bytes), Ok(network));
    assert!(CoverNetwork::from_bytes(&bytes[1..]).is_err());
}

#[test]
fn brightness_alone_changes_no_feature_and_a_picture_turned_upside_down_turns_its_map() {
    let picture = Raster::<Rgba>::from_fn(60, 40, |c, r| {
        let v = 60 + ((c * 7 + r * 13) % 50) as u8;
        [v, v + 20, v / 2, 255]
    });
    let features = CoverFeatures::of(&picture);
    assert_eq!((features.width(), features.height()), (30, 20));
    // Twice the light, up to the rounding of colours.
    let brighter = picture.map(|[r, g, b, a]| [2 * r, (2 * u16::from(g)).min(255) as u8, 2 * b, a]);
    let again = CoverFeatures::of(&brighter);
    for (a, b) in features.cell(11, 9).iter().zip(again.cell(11, 9)) {
        assert!((a - b).abs() < 0.05, "{a} {b}");
    }
    let window = Window {
        north_edge: 0.0,
        west_edge: 0.0,
        gsd: CLASS_GSD,
        width: 60,
        height: 40,
    };
    let mut turned = picture.clone();
    turned.pixels_mut().reverse();
    let network = CoverNetwork::usual();
    let (map, upside_down) = (
        classify_ground(&window, &picture, &network),
        classify_ground(&window, &turned, &network),
    );
    assert!((map.window.gsd - 1.5).abs() < 1e-12);
    assert_eq!(map.probabilities.len(), upside_down.probabilities.len());
    for told in &map.probabilities {
        assert!((told.iter().sum::<f32>() - 1.0).abs() < 1e-5);
    }
}

#[test]
fn unseen_ground_has_no_class() {
    let mut picture = Raster::<Rgba>::filled(40, 40, [90, 120, 60, 255]);
    for row in 0..40 {
        picture.row_mut(row)[30..].fill([0; 4]);
    }
    let window = Window {
        north_edge: 0.0,
        west_edge: 0.0,
        gsd: CLASS_GSD,
        width: 40,
        height: 40,
    };
    let map = classify_ground(&window, &picture, &CoverNetwork::usual());
    assert!(map.seen[10] && !map.seen[16]);
    assert_eq!(map.probabilities[16], [0.0; 5]);
}

#[test]
fn a_picture_lies_north_up_on_the_ground_whatever_it_heads() {
    // Heading east, the top of the picture shows the east: red.
    let picture = Picture::from_fn(
        200,
        200,
        |_, row| {
            if row < 100 { [200, 0, 0] } else { [0, 0, 200] }
        },
    );
    let camera = CameraModel::pinhole(200, 200, 1.0);
    let pose = Pose {
        position_in_world: Point3::new(10.0, 20.0, -100.0),
        attitude: Attitude::level(90_f64.to_radians()),
    };
    let (window, ground) = ground_picture(&camera, &pose, 0.0, &picture, CLASS_GSD).unwrap();
    let colour = |north: f64, east: f64| {
        let (x, y) = window.pixel_at(&pilotage_base::frames::GroundPoint::new(north, east));
        ground.get(x as usize, y as usize)
    };
    assert_eq!(colour(10.0, 40.0), [200, 0, 0, 255]);
    assert_eq!(colour(10.0, 0.0), [0, 0, 200, 255]);
}
