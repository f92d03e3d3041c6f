//! Places of `GeoTIFF` files that say them in unusual ways.

use std::sync::Arc;

use super::super::tiff::tests::{Recipe, write};
use super::*;
use nalgebra::Point2;
use pilotage_base::bytes::MemoryBytes;

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A file with pixels of 60 m of that height, its corner at 500 km east and 5000 km north, and with keys.
fn file(height: f64, keys: &[[u16; 2]]) -> GeoTiffFile {
    let mut numbers = vec![1, 1, 0, keys.len() as u16];
    numbers.extend(keys.iter().flat_map(|[key, value]| [*key, 0, 1, *value]));
    let keys = numbers.into_iter().flat_map(u16::to_le_bytes).collect();
    let tags = [
        (33_550, 12, doubles(&[60.0, height, 0.0])),
        (33_922, 12, doubles(&[0.0, 0.0, 0.0, 5e5, 5e6, 0.0])),
        (34_735, 3, keys),
    ];
    let source = MemoryBytes::new("map.tif", write(&Recipe::default(), &tags));
    GeoTiffFile::open(Arc::new(source), None, None).expect("a place")
}

/// Both corners on the ground, metres from 45.1° N, 9° E.
fn corners(file: &GeoTiffFile) -> [[f64; 2]; 2] {
    let frame = LocalFrame::new(Geodetic::from_degrees(45.1, 9.0, 0.0));
    let (width, height) = file.size();
    let placement = file.placement(&frame).expect("it lies near");
    [(0.0, 0.0), (width as f64, height as f64)].map(|(x, y)| {
        let corner = placement.ground_at(&Point2::new(x, y));
        [corner.north, corner.east]
    })
}

#[test]
fn a_zone_by_the_code_of_its_projection_is_that_by_the_code_of_its_system() {
    let right = file(60.0, &[[1024, 1], [1025, 1], [3072, 32_632]]);
    let right = corners(&right);
    // By GDAL 3.10.3 both are EPSG:32632.
    for keys in [
        &[[1024, 1], [1025, 1], [2048, 4326], [3074, 16_032]][..],
        &[[1025, 1], [2048, 4326], [3074, 16_032]],
        &[
            [1024, 1],
            [1025, 1],
            [2048, 4326],
            [3072, 32_767],
            [3074, 16_032],
        ],
    ] {
        let found = corners(&file(60.0, keys));
        for (a, b) in found.as_flattened().iter().zip(right.as_flattened()) {
            assert!((a - b).abs() < 1e-6, "{keys:?}: {a} {b}");
        }
    }
}

#[test]
fn pixels_of_a_negative_height_have_north_up_and_that_is_told() {
    let keys = [[1024, 1], [1025, 1], [3072, 32_632]];
    let (usual, negative) = (file(60.0, &keys), file(-60.0, &keys));
    // GDAL 3.10.3: its rows go south by 60 m as well.
    assert_eq!(corners(&negative), corners(&usual));
    assert_eq!(usual.notes, Vec::<String>::new());
    assert!(negative.notes[0].starts_with("map.tif: the height of its pixels is negative"));
}

#[test]
fn names_are_found_behind_letters_of_other_code_pages() {
    // A comment in Latin-1 before the name of the heights; both end in a bar.
    let (comment, name) = (&b"H\xf6hen in Metern|"[..], &b"EGM96 height|"[..]);
    let (first, second) = (comment.len() as u16, name.len() as u16);
    let ascii = 34_737;
    let keys = [
        [1, 1, 0, 5],
        [1024, 0, 1, 1],
        [1026, ascii, first, 0],
        [3072, 0, 1, 32_632],
        [4096, 0, 1, 32_767],
        [4097, ascii, second, first],
    ];
    let keys = keys.as_flattened().iter().flat_map(|v| v.to_le_bytes());
    let tags = [
        (33_550, 12, doubles(&[60.0, 60.0, 0.0])),
        (33_922, 12, doubles(&[0.0, 0.0, 0.0, 5e5, 5e6, 0.0])),
        (34_735, 3, keys.collect()),
        (ascii, 2, [comment, name].concat()),
    ];
    let source = MemoryBytes::new("map.tif", write(&Recipe::default(), &tags));
    let file = GeoTiffFile::open(Arc::new(source), None, None).expect("a system");
    assert_eq!(file.keys.vertical_name.as_deref(), Some("EGM96 height"));
}

#[test]
fn pixels_that_a_satellites_camera_places_are_told_to_be_orthorectified() {
    let coefficients = (50_844, 12, doubles(&[1.0; 92]));
    let source = MemoryBytes::new("map.tif", write(&Recipe::default(), &[coefficients]));
    let error = GeoTiffFile::open(Arc::new(source), None, None).err();
    let told = error.map(|error| error.to_string()).unwrap_or_default();
    assert!(told.contains("gdalwarp -rpc"), "{told}");
}
