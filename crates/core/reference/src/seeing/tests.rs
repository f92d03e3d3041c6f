use std::sync::Arc;

use super::*;
use crate::GenericClass;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};
use pilotage_vision::ground_class::{CoverMap, CoverNetwork, FEATURES, GroundCover, HIDDEN};

/// Classes of 60 × 60 cells of 1.5 m, open ground but for rectangles (column, row, width, height).
fn cells(cover: GroundCover, rectangles: &[(usize, usize, usize, usize)]) -> CoverMap {
    let mut probabilities = vec![[0.9, 0.025, 0.025, 0.025, 0.025]; 3600];
    for (left, top, width, height) in rectangles {
        for row in *top..top + height {
            for column in *left..left + width {
                let told = &mut probabilities[row * 60 + column];
                *told = [0.025; 5];
                told[cover.index()] = 0.9;
            }
        }
    }
    CoverMap {
        window: Window {
            north_edge: 100.0,
            west_edge: -20.0,
            gsd: 1.5,
            width: 60,
            height: 60,
        },
        probabilities,
        seen: vec![true; 3600],
    }
}

#[test]
fn a_building_is_seen_where_it_lies_with_its_size_and_direction() {
    let seen = landmarks_seen(&cells(GroundCover::Building, &[(20, 10, 12, 6)]));
    let [barn] = &seen[..] else {
        panic!("{seen:?}")
    };
    assert_eq!(barn.class, GenericClass::Building);
    let there = GroundPoint::new(100.0 - 13.0 * 1.5, -20.0 + 26.0 * 1.5);
    assert!(barn.place.distance(&there) < 1e-6, "{barn:?}");
    assert!(
        (barn.size - (72.0_f64).sqrt() * 1.5).abs() < 1.5,
        "{barn:?}"
    );
    let east = std::f64::consts::FRAC_PI_2;
    assert!((barn.orientation - east).abs() < 1e-6, "{barn:?}");
}

#[test]
fn a_slanting_thing_points_north_east() {
    let steps: Vec<_> = (0..10).map(|i| (20 + 2 * i, 40 - 2 * i, 4, 4)).collect();
    let seen = landmarks_seen(&cells(GroundCover::Tree, &steps));
    assert!(
        (seen[0].orientation.to_degrees() - 45.0).abs() < 1.0,
        "{seen:?}"
    );
}

#[test]
fn what_is_cut_off_or_too_small_is_no_landmark() {
    let cut = cells(GroundCover::Tree, &[(0, 10, 8, 8), (30, 30, 1, 1)]);
    assert_eq!(landmarks_seen(&cut), []);
    let mut unseen = cells(GroundCover::Tree, &[(20, 10, 8, 8)]);
    unseen.seen[15 * 60 + 28] = false;
    assert_eq!(landmarks_seen(&unseen), []);
}

#[test]
fn a_road_is_no_parking_place_and_the_place_beside_it_is_one() {
    let seen = landmarks_seen(&cells(GroundCover::Paved, &[(0, 20, 60, 5)]));
    assert_eq!(seen, []);
    let both = cells(GroundCover::Paved, &[(0, 20, 60, 5), (20, 25, 20, 20)]);
    let seen = landmarks_seen(&both);
    assert_eq!(seen.len(), 1);
    assert_eq!(seen[0].class, GenericClass::Parking);
}

/// Ground with a bright square of 12 m every 100 m.
struct Squares;

impl Imagery for Squares {
    fn name(&self) -> &'static str {
        "squares"
    }

    fn bounds(&self) -> GroundRect {
        GroundRect::centered(GroundPoint::new(0.0, 0.0), 600.0, 600.0)
    }

    fn native_gsd(&self) -> f64 {
        0.75
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let bounds = self.bounds();
        Raster::from_fn(window.width, window.height, |column, row| {
            let place = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
            if !bounds.contains(&place) {
                return [0; 4];
            }
            let within = |metres: f64| (44.0..56.0).contains(&metres.rem_euclid(100.0));
            if within(place.north) && within(place.east) {
                [200, 200, 200, 255]
            } else {
                [80, 80, 80, 255]
            }
        })
    }
}

#[test]
fn every_thing_of_a_map_is_once_in_its_table_wherever_the_tiles_end() {
    // A network that takes what is bright for a building.
    let mut network = CoverNetwork {
        hidden: [[0.0; FEATURES + 1]; HIDDEN],
        output: [[0.0; HIDDEN + 1]; GroundCover::ALL.len()],
    };
    network.hidden[0][0] = 1.0;
    network.output[GroundCover::Building.index()][0] = 20.0;
    network.output[GroundCover::Open.index()][HIDDEN] = 30.0;
    let mut mapping = ReferenceMapping::of(Arc::new(Squares), network);
    assert_eq!(mapping.progress().0, 0);
    while mapping.advance() {}
    let table = mapping.into_table();
    assert_eq!(table.landmarks().len(), 36);
    for landmark in table.landmarks() {
        let off = |metres: f64| (metres.rem_euclid(100.0) - 50.0).abs();
        assert!(off(landmark.place.north) < 0.8 && off(landmark.place.east) < 0.8);
    }
}
