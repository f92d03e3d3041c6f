//! Elevation models made here.

use std::sync::Arc;

use super::*;
use pilotage_base::bytes::MemoryBytes;
use pilotage_base::frames::{Geodetic, LocalFrame};

/// Heights that rise by one metre a post eastward and two southward, with a hole.
fn hgt() -> Vec<u8> {
    (0..1201_i16)
        .flat_map(|row| {
            (0..1201_i16).flat_map(move |column| {
                let height = match (row, column) {
                    (600, 600) => i16::MIN,
                    (700, 700) => -32_767,
                    (800, 800) => i16::MAX,
                    _ => column + 2 * row,
                };
                height.to_be_bytes()
            })
        })
        .collect()
}

fn open(name: &str, bytes: Vec<u8>) -> Result<Dem, TerrainError> {
    Dem::open(Arc::new(MemoryBytes::new(name, bytes)), None, None)
}

/// Column and row of posts as a place on the ground.
fn ground(column: f64, row: f64) -> GroundPoint {
    let frame = LocalFrame::new(Geodetic::from_degrees(46.5, -91.5, 0.0));
    let place = Geodetic::from_degrees(47.0 - row / 1200.0, -92.0 + column / 1200.0, 0.0);
    frame.ground_from_geodetic(&place)
}

#[test]
fn heights_between_posts_are_interpolated() {
    let dem = open("dem/n46w092.hgt", hgt()).unwrap();
    for (column, row) in [(0.0, 0.0), (10.25, 900.5), (1200.0, 1200.0), (333.3, 0.2)] {
        let height = dem.height_at(&ground(column, row)).unwrap();
        assert!(
            (height - column - 2.0 * row).abs() < 1e-3,
            "{column} {row}: {height}"
        );
    }
    assert_eq!(dem.datum().name(), "EGM96");
}

#[test]
fn heights_beside_a_hole_and_beyond_the_edge_are_unknown() {
    let dem = open("N46W092.hgt", hgt()).unwrap();
    assert_eq!(dem.height_at(&ground(600.0, 600.0)), None);
    assert_eq!(dem.height_at(&ground(600.4, 599.5)), None);
    // Marks that other programs put there.
    assert_eq!(dem.height_at(&ground(700.0, 700.0)), None);
    assert_eq!(dem.height_at(&ground(800.0, 800.0)), None);
    assert!(dem.height_at(&ground(602.0, 600.0)).is_some());
    assert_eq!(dem.height_at(&ground(-3.0, 600.0)), None);
    assert_eq!(dem.height_at(&ground(600.0, 1300.0)), None);
}

#[test]
fn a_file_of_another_size_or_name_is_refused_with_what_it_should_be() {
    let short = open("N46W092.hgt", vec![0; 100]).err().unwrap().to_string();
    assert!(short.contains("2884802"), "{short}");
    let unnamed = open("heights.hgt", hgt()).err().unwrap().to_string();
    assert!(unnamed.contains("N46W092.hgt"), "{unnamed}");
    assert!(open("é.hgt", hgt()).is_err());
}

#[test]
fn level_ground_is_level() {
    let ground = FlatGround {
        height: 183.0,
        datum: HeightDatum::NotStated,
    };
    assert_eq!(ground.height_at(&GroundPoint::new(5.0, 7e6)), Some(183.0));
}
