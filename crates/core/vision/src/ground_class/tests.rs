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
fn means_over_squares_are_those_of_their_cells_also_at_the_rim() {
    let picture = Raster::<Rgba>::from_fn(60, 40, |c, r| {
        let v = 40 + ((c * c + 31 * r) % 97) as u8;
        [v, 200 - v, v / 3, 255]
    });
    let features = CoverFeatures::of(&picture);
    for (column, row) in [(0, 0), (12, 9), (29, 19)] {
        let own = features.cell(column, row);
        for (first, radius) in [(4, 1), (9, 3), (14, 8)] {
            let rows = row.saturating_sub(radius)..(row + radius + 1).min(20);
            let cells = rows.flat_map(|r| {
                let columns = column.saturating_sub(radius)..(column + radius + 1).min(30);
                columns.map(move |c| (c, r))
            });
            let around: Vec<_> = cells.map(|(c, r)| features.cell(c, r)).collect();
            let count = around.len() as f32;
            let mean = |k: usize| around.iter().map(|f| f[k]).sum::<f32>() / count;
            let squares = around.iter().map(|f| f[0] * f[0]).sum::<f32>() / count;
            let spread = (squares - mean(0) * mean(0)).max(0.0).sqrt();
            let expected = [mean(0), spread, mean(1), mean(2), mean(3)];
            for (k, expected) in expected.into_iter().enumerate() {
                assert!((own[first + k] - expected).abs() < 1e-3, "{radius} {k}");
            }
        }
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

/// Prints the time of a whole picture; `cargo test -p pilotage-vision --lib -- --ignored --nocapture study_of_the_time`.
#[test]
#[ignore = "a study: times"]
fn study_of_the_time_of_a_picture_of_1280_by_960() {
    let mut state = 1_u32;
    let picture = Raster::<Rgba>::from_fn(1280, 960, |_, _| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let [a, b, c, _] = state.to_be_bytes();
        [a, b, c, 255]
    });
    let window = Window {
        north_edge: 0.0,
        west_edge: 0.0,
        gsd: CLASS_GSD,
        width: 1280,
        height: 960,
    };
    let network = CoverNetwork::usual();
    let mut times: Vec<f64> = (0..40)
        .map(|_| {
            let start = std::time::Instant::now();
            let map = classify_ground(&window, &picture, &network);
            assert_eq!(map.probabilities.len(), 640 * 480);
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("least {:.1} ms, median {:.1} ms", times[0], times[20]);
}
