//! `GeoTIFF` files made here, seen through windows.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use proptest::prelude::*;

use super::super::tiff::Compression;
use super::super::tiff::tests::{Recipe, sample, write};
use super::*;
use pilotage_base::bytes::{ByteSource, MemoryBytes};
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::GeoreferencedPicture;

fn doubles(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Tags of a north-up map of half-metre pixels in UTM zone 17 north.
fn tags() -> Vec<(u16, u16, Vec<u8>)> {
    let keys = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32_617];
    vec![
        (33_550, 12, doubles(&[0.5, 0.5, 0.0])),
        (
            33_922,
            12,
            doubles(&[0.0, 0.0, 0.0, 500_000.0, 4_000_000.0, 0.0]),
        ),
        (34_735, 3, shorts(&keys)),
    ]
}

fn file(bytes: Vec<u8>) -> Result<GeoTiffFile, GeoTiffError> {
    GeoTiffFile::open(Arc::new(MemoryBytes::new("map.tif", bytes)), None, None)
}

fn map(bytes: Vec<u8>, memory: MapMemory) -> Result<GeoTiff, GeoTiffError> {
    let file = file(bytes)?;
    let frame = LocalFrame::new(
        file.origin()
            .unwrap_or(Geodetic::from_degrees(0.0, 0.0, 0.0)),
    );
    GeoTiff::new(file, &frame, memory)
}

fn around(map: &GeoTiff, gsd: f64) -> Window {
    Window::covering(&map.bounds().grown(3.0 * gsd), gsd)
}

fn large(is_tiled: bool) -> Vec<u8> {
    let recipe = Recipe {
        width: 3000,
        height: 2500,
        chunk: if is_tiled { 256 } else { 7 },
        is_tiled,
        samples: 1,
        ..Recipe::default()
    };
    write(&recipe, &tags())
}

#[test]
fn a_mask_beside_a_map_is_told() {
    let mut files = pilotage_base::files::MemoryFiles::default();
    let tiff = write(&Recipe::default(), &tags());
    files.0.insert("a/map.tif".to_owned(), tiff);
    let notes = |files: &pilotage_base::files::MemoryFiles| {
        let map = crate::open_map(files, "a/map.tif", None).unwrap();
        map.notes()
    };
    assert_eq!(notes(&files), Vec::<String>::new());
    files.0.insert("a/map.TIF.msk".to_owned(), b"II*".to_vec());
    let told = notes(&files);
    assert!(
        told.len() == 1 && told[0].starts_with("a/map.TIF.msk: this mask"),
        "{told:?}"
    );
}

#[test]
fn a_map_equals_the_same_picture_in_memory() {
    let recipe = Recipe::default();
    let map = map(write(&recipe, &tags()), MapMemory::default()).unwrap();
    let picture = Raster::from_fn(recipe.width, recipe.height, |x, y| {
        [sample(x, y, 0), sample(x, y, 1), sample(x, y, 2), 255]
    });
    let placed = GeoreferencedPicture::placed("map", picture, map.placement().clone()).unwrap();
    assert_eq!(map.bounds(), placed.bounds());
    for gsd in [0.2, 0.5, 0.77] {
        let window = around(&map, gsd);
        assert_eq!(map.window(&window), placed.window(&window), "{gsd}");
    }
    assert!(map.problems().is_empty());
}

#[test]
fn a_file_without_overviews_gets_a_coarse_pyramid_within_its_memory() {
    for is_tiled in [true, false] {
        let bytes = large(is_tiled);
        let memory = MapMemory {
            tiles: 2 << 20,
            coarse: 1 << 20,
        };
        let map = map(bytes, memory).unwrap();
        for gsd in [5.0, 9.0, 33.0] {
            let window = Window {
                north_edge: 100.0,
                west_edge: -150.0,
                gsd,
                width: 20,
                height: 15,
            };
            let seen = map.window(&window);
            for row in 0..15 {
                for column in 0..20 {
                    let ground = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                    let pixel = map.placement().pixel_at(&ground).unwrap();
                    // The mean of a linear function is its value in the middle.
                    let margin = 0.5 * gsd / 0.5;
                    let inside = |v: f64, most: f64| v > margin && v < most - margin;
                    let value = 40.0 + 3.0 * (pixel.x - 0.5) + 2.0 * (pixel.y - 0.5);
                    if inside(pixel.x, 3000.0) && inside(pixel.y, 2500.0) && value < 150.0 {
                        let off = f64::from(seen.get(column, row)[0]) - value;
                        assert!(off.abs() < 6.0, "{is_tiled} {gsd}: {off} at {pixel}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_coarse_pyramid_can_be_made_ahead_step_by_step() {
    let map = map(large(true), MapMemory::default()).unwrap();
    let window = around(&map, 20.0);
    let (nothing, is_whole) = map.window_so_far(&window);
    assert!(!is_whole && nothing.pixels().iter().all(|p| p[3] == 0));
    let (_, all) = map.prepare(0);
    let mut steps = 0;
    while map.prepare(1).0 < all {
        steps += 1;
    }
    assert_eq!(steps + 1, all);
    let (prepared, is_whole) = map.window_so_far(&window);
    assert!(is_whole);
    assert_eq!(prepared, map.window(&window));
    let fresh = super::tests::map(large(true), MapMemory::default()).unwrap();
    assert_eq!(prepared, fresh.window(&window));
}

#[test]
fn a_large_window_equals_its_parts() {
    let map = map(large(true), MapMemory::default()).unwrap();
    let whole = Window {
        north_edge: 600.0,
        west_edge: -700.0,
        gsd: 0.5,
        width: 2800,
        height: 2900,
    };
    let seen = map.window(&whole);
    for (column, row) in [(0, 0), (1390, 1440), (2700, 2850), (1399, 700)] {
        let part = Window {
            north_edge: whole.north_edge - row as f64 * whole.gsd,
            west_edge: whole.west_edge + column as f64 * whole.gsd,
            width: 40,
            height: 40,
            ..whole
        };
        let part = map.window(&part);
        for y in 0..40 {
            for x in 0..40 {
                let (a, b) = (part.get(x, y), seen.get(column + x, row + y));
                let off = a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max();
                assert!(off <= Some(1), "{column} {row} {x} {y}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn ties_count_from_the_corner_or_from_the_centre_of_a_pixel() {
    let corner = file(write(&Recipe::default(), &tags())).unwrap();
    let mut point = tags();
    point[2].2[22] = 2;
    let centre = file(write(&Recipe::default(), &point)).unwrap();
    let frame = LocalFrame::new(corner.origin().unwrap());
    let first = |file: &GeoTiffFile| {
        let placement = file.placement(&frame).unwrap();
        placement.ground_at(&nalgebra::Point2::new(0.0, 0.0))
    };
    let (corner, centre) = (first(&corner), first(&centre));
    let shift = GroundPoint::new(centre.north - corner.north, centre.east - corner.east);
    assert!((shift.north - 0.25).abs() < 1e-3, "{shift:?}");
    assert!((shift.east + 0.25).abs() < 1e-3, "{shift:?}");
}

#[test]
fn a_file_without_a_place_or_with_an_unknown_system_says_what_it_lacks() {
    let recipe = Recipe::default();
    let open = |bytes: Vec<u8>, system| {
        let source = Arc::new(MemoryBytes::new("map.tif", bytes));
        GeoTiffFile::open(source, None, system)
    };
    let nowhere = file(write(&recipe, &[])).err().unwrap().to_string();
    assert!(
        nowhere.starts_with("map.tif") && nowhere.contains(".tfw"),
        "{nowhere}"
    );
    let unnamed = write(&recipe, &tags()[..2]);
    let error = open(unnamed.clone(), None).err().unwrap().to_string();
    assert!(error.contains("EPSG:3857"), "{error}");
    let utm = ReferenceSystem::from_epsg(32_617);
    assert!(open(unnamed, utm).is_ok());
    let mut foreign = tags();
    let end = foreign[2].2.len();
    foreign[2].2[end - 2..].copy_from_slice(&29_999_u16.to_le_bytes());
    let error = file(write(&recipe, &foreign)).err().unwrap().to_string();
    assert!(
        error.contains("EPSG:29999") && error.contains("34735"),
        "{error}"
    );
    assert!(open(write(&recipe, &foreign), utm).is_ok());
}

/// A file whose server does not answer for a while.
struct Faltering(MemoryBytes, AtomicBool);

impl ByteSource for Faltering {
    fn name(&self) -> &str {
        self.0.name()
    }
    fn length(&self) -> u64 {
        self.0.length()
    }
    fn read(&self, offset: u64, length: usize) -> Result<Vec<u8>, String> {
        if self.1.load(Ordering::Relaxed) {
            return Err("there is no network".to_owned());
        }
        self.0.read(offset, length)
    }
}

#[test]
fn a_window_whose_bytes_could_not_be_had_is_not_whole() {
    let bytes = write(&Recipe::default(), &tags());
    let bytes = MemoryBytes::new("map.tif", bytes);
    let source = Arc::new(Faltering(bytes, AtomicBool::new(false)));
    let file = GeoTiffFile::open(source.clone(), None, None).unwrap();
    let frame = LocalFrame::new(file.origin().unwrap());
    let map = GeoTiff::new(file, &frame, MapMemory::default()).unwrap();
    let window = around(&map, 0.5);
    source.1.store(true, Ordering::Relaxed);
    let (nothing, is_whole) = map.window_so_far(&window);
    assert!(!is_whole && nothing.pixels().iter().all(|p| p[3] == 0));
    source.1.store(false, Ordering::Relaxed);
    let (seen, is_whole) = map.window_so_far(&window);
    assert!(is_whole && seen.pixels().iter().any(|p| p[3] == 255));
    assert!(map.problems()[0].contains("there is no network"));
}

#[test]
fn a_tile_that_cannot_be_read_leaves_a_hole_and_is_told() {
    let recipe = Recipe {
        compression: Compression::Lzw,
        ..Recipe::default()
    };
    let mut bytes = write(&recipe, &tags());
    bytes[8..60].fill(0xff);
    let map = map(bytes, MapMemory::default()).unwrap();
    let seen = map.window(&around(&map, 0.5));
    assert!(seen.pixels().iter().any(|p| p[3] == 255));
    let problems = map.problems();
    assert_eq!(problems.len(), 1);
    assert!(problems[0].contains("tile 0, 0"), "{problems:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn a_damaged_map_is_refused_or_drawn_with_holes(
        is_tiled: bool,
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..8), 1..12),
    ) {
        let recipe = Recipe { is_tiled, ..Recipe::default() };
        let mut bytes = write(&recipe, &tags());
        for (place, bit) in flips {
            let place = place.index(bytes.len());
            bytes[place] ^= 1 << bit;
        }
        if let Ok(map) = map(bytes, MapMemory::default()) {
            let bounds = map.bounds();
            let gsd = bounds.width().max(bounds.height()) / 60.0;
            if gsd.is_finite() && gsd > 0.0 {
                map.window(&Window::covering(&bounds, gsd));
            }
        }
    }
}
