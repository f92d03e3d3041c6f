use nalgebra::Vector2;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use std::f64::consts::PI;

use super::*;
use crate::{GenericClass, GenericLandmark, ReferenceTable};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{GeoreferencedPicture, Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};

const CLASS: GenericClass = GenericClass::Other(0);

fn edge(random: &mut ChaCha8Rng, half: [f64; 2]) -> GenericLandmark {
    let place = half.map(|half| random.random_range(-half..half));
    GenericLandmark {
        place: GroundPoint::new(place[0], place[1]),
        class: CLASS,
        size: random.random_range(6.0..25.0),
        orientation: random.random_range(0.0..PI),
        confidence: 1.0,
        stability: 1.0,
    }
}

/// A table, and what a picture of 160 m by 90 m shows of it: seven tenths of its edges, a metre off, and half as many others.
fn drawn(seed: u64) -> (Vec<GenericLandmark>, Vec<GenericLandmark>) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let table: Vec<_> = (0..500).map(|_| edge(&mut random, [200.0; 2])).collect();
    let half = [45.0, 80.0];
    let mut seen = Vec::new();
    for known in &table {
        let (north, east) = (known.place.north, known.place.east);
        if north.abs() < half[0] && east.abs() < half[1] && random.random_bool(0.7) {
            let mut error = || -> f64 { StandardNormal.sample(&mut random) };
            seen.push(GenericLandmark {
                place: GroundPoint::new(north + error(), east + error()),
                orientation: (known.orientation + 0.05 * error()).rem_euclid(PI),
                ..*known
            });
        }
    }
    for _ in 0..seen.len() / 2 {
        seen.push(edge(&mut random, half));
    }
    (table, seen)
}

/// Edges that are seen as they lie by an assumed pose that turns it by `yaw` and moves it by `off`.
fn assumed(seen: &[GenericLandmark], yaw: f64, off: Vector2<f64>) -> Vec<GenericLandmark> {
    let (sin, cos) = yaw.sin_cos();
    let turned = seen.iter().map(|edge| {
        let place = edge.place.to_vector();
        let turned = Vector2::new(place.x * cos - place.y * sin, place.x * sin + place.y * cos);
        GenericLandmark {
            place: GroundPoint::from(turned + off),
            orientation: (edge.orientation + yaw).rem_euclid(PI),
            ..*edge
        }
    });
    turned.collect()
}

fn believed(off: Vector2<f64>) -> EdgePrior {
    EdgePrior {
        middle: GroundPoint::from(off),
        deviation: 11.0,
        turn: 0.26,
        log_height: 0.05,
        map_deviation: 0.5,
    }
}

#[test]
fn a_picture_is_found_by_the_edges_that_the_table_has_and_nowhere_else() {
    let off = Vector2::new(9.0, -14.0);
    for seed in 0..2 {
        let (edges, seen) = drawn(seed);
        let table = ReferenceTable::new(edges, vec![EDGE.to_owned()]);
        let field = EdgeField::around(GroundPoint::from(off), 150.0, &table);
        let seen = assumed(&seen, 0.15, off);
        let found = place_by_edges(&seen, &believed(off), &field).unwrap();
        let error = found.middle.to_vector();
        assert!(error.norm() < 2.5, "{found:?}");
        let squared = (found.covariance.try_inverse().unwrap() * error).dot(&error);
        assert!(squared < 13.8, "{found:?}");
        assert!(found.probability > 0.9, "{found:?}");
        let (_, others) = drawn(100 + seed);
        let others = assumed(&others, 0.15, off);
        let elsewhere = place_by_edges(&others, &believed(off), &field).unwrap();
        assert!(elsewhere.probability < 0.9, "{elsewhere:?}");
    }
}

#[test]
fn no_edges_tell_no_place() {
    let field = EdgeField::around(GroundPoint::default(), 50.0, &ReferenceTable::default());
    assert_eq!(
        place_by_edges(&[], &believed(Vector2::zeros()), &field),
        None
    );
}

#[test]
fn a_map_has_each_edge_of_a_roof_once_wherever_its_tiles_end() {
    // Roofs of 20 m by 20 m, 64 m apart.
    let picture = Raster::<Rgba>::from_fn(800, 800, |x, y| {
        let is_roof = (20..60).contains(&(x % 128)) && (20..60).contains(&(y % 128));
        if is_roof {
            [190, 180, 170, 255]
        } else {
            [70, 90, 60, 255]
        }
    });
    let place = pilotage_base::georeference::GroundFromPixel::north_up(GroundPoint::default(), 0.5);
    let map = GeoreferencedPicture::new("roofs", picture, place).unwrap();
    let edges = edges_in_map(&map, EDGE_GSD, CLASS);
    let inside = GroundRect {
        south: map.bounds().south + 40.0,
        north: map.bounds().north - 2.0,
        west: map.bounds().west + 2.0,
        east: map.bounds().east - 40.0,
    };
    let window = Window::covering(&inside, EDGE_GSD);
    assert!(window.width > 600);
    let count = edges
        .iter()
        .filter(|edge| inside.contains(&edge.place))
        .count();
    assert_eq!(count, 6 * 6 * 4);
    assert!(edges.iter().all(|edge| (edge.size - 20.0).abs() < 3.0));
}

#[test]
fn nothing_is_known_beyond_a_table_and_its_mean_is_that_of_its_own_ground() {
    let (edges, _) = drawn(1);
    let table = ReferenceTable::new(edges, vec![EDGE.to_owned()]);
    let inside = EdgeField::around(GroundPoint::default(), 100.0, &table);
    let beyond = EdgeField::around(GroundPoint::new(0.0, 260.0), 100.0, &table);
    let mean = |field: &EdgeField| {
        let all = field.log_ratios.iter().flat_map(Raster::pixels);
        let known: Vec<f64> = all
            .filter(|v| **v != 0.0)
            .map(|v| f64::from(v.exp()))
            .collect();
        (known.iter().sum::<f64>() / known.len() as f64, known.len())
    };
    let (of_inside, whole) = mean(&inside);
    let (of_beyond, part) = mean(&beyond);
    assert!((of_inside - 1.0).abs() < 1e-3 && (of_beyond - 1.0).abs() < 1e-3);
    assert!(
        (0.15..0.25).contains(&(part as f64 / whole as f64)),
        "{part} of {whole}"
    );
}
