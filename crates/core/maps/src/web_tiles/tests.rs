//! Tiles made here.

use std::collections::BTreeSet;
use std::io::Write;
use std::sync::{Arc, Mutex};

use flate2::{Compression, write::GzEncoder};
use proptest::prelude::*;

use super::*;
use crate::open_map;
use pilotage_base::bytes::MemoryBytes;
use pilotage_base::files::MemoryFiles;
use pilotage_base::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Picture, Raster, Rgba, encode_png};

const MIDDLE: (f64, f64) = (46.8427, -91.9940);

fn tile(zoom: u8, x: u32, y: u32) -> TileNumber {
    TileNumber { zoom, x, y }
}

#[test]
fn places_fall_into_the_tiles_that_everybody_numbers_so() {
    // From the wiki of OpenStreetMap on tile names.
    let place = Geodetic::from_degrees(35.659_069_9, 139.700_679_3, 0.0);
    assert_eq!(TileNumber::around(&place, 18), tile(18, 232_798, 103_246));
    let rim = Geodetic::from_degrees(89.9, 180.0, 0.0);
    assert_eq!(TileNumber::around(&rim, 3), tile(3, 7, 0));
}

#[test]
fn the_curve_of_hilbert_begins_as_the_specification_shows() {
    for (x, y, zoom, id) in [
        (0, 0, 0, 0),
        (0, 0, 1, 1),
        (0, 1, 1, 2),
        (1, 1, 1, 3),
        (1, 0, 1, 4),
        (0, 0, 2, 5),
        (3423, 1763, 12, 19_078_479),
    ] {
        assert_eq!(tile(zoom, x, y).hilbert(), id, "{zoom}/{x}/{y}");
    }
}

#[test]
fn a_template_names_every_tile_in_the_ways_that_servers_want() {
    let template = |address: &str| TileTemplate {
        name: "test".to_owned(),
        address: address.to_owned(),
        attribution: "© somebody".to_owned(),
        least_zoom: 0,
        most_zoom: 19,
        side: 256,
    };
    for (address, expected) in [
        ("https://a.org/{z}/{x}/{y}.png", "https://a.org/3/5/1.png"),
        ("https://a.org/{z}/{x}/{-y}", "https://a.org/3/5/6"),
        ("https://a.org/{q}?k", "https://a.org/103?k"),
        ("https://{s}.a.org/{z}/{x}/{y}", "https://a.a.org/3/5/1"),
    ] {
        let checked = template(address).checked().unwrap();
        assert_eq!(checked.address_of(&tile(3, 5, 1)), expected);
    }
    let error = template("https://a.org/{z}/{x}.png").checked().unwrap_err();
    assert!(error.to_string().contains("{y}"), "{error}");
    assert!(template("file:///{z}/{x}/{y}").checked().is_err());
    let mut zooms = template("https://a.org/{z}/{x}/{y}");
    zooms.least_zoom = 20;
    assert!(zooms.checked().is_err());
}

/// Tiles whose colours tell their pixel's place on the ground.
struct Places {
    frame: LocalFrame,
    zooms: (u8, u8),
    /// Metres for a radian of the colours' waves.
    wave: f64,
}

fn shade(place: &GroundPoint, wave: f64) -> Rgba {
    let level = |v: f64| (127.0 + 120.0 * (v / wave).sin()) as u8;
    [level(place.north), level(place.east), 90, 255]
}

impl TileStore for Places {
    fn name(&self) -> &'static str {
        "places"
    }
    fn zooms(&self) -> (u8, u8) {
        self.zooms
    }
    fn side(&self) -> usize {
        256
    }
    fn tile(&self, tile: &TileNumber) -> Result<Option<Raster<Rgba>>, TileLack> {
        let georeference = tile.georeference(256);
        Ok(Some(Raster::from_fn(256, 256, |x, y| {
            let (x, y) = (x as f64 + 0.5, y as f64 + 0.5);
            shade(&georeference.ground_at(&self.frame, x, y), self.wave)
        })))
    }
}

/// Tiles of one answer each: the first time the one, then the other.
struct Late {
    answers: [Result<Option<Raster<Rgba>>, TileLack>; 2],
    asked: Mutex<BTreeSet<TileNumber>>,
}

impl TileStore for Late {
    fn name(&self) -> &'static str {
        "late"
    }
    fn zooms(&self) -> (u8, u8) {
        (17, 17)
    }
    fn side(&self) -> usize {
        256
    }
    fn tile(&self, tile: &TileNumber) -> Result<Option<Raster<Rgba>>, TileLack> {
        let is_first = self.asked.lock().unwrap().insert(*tile);
        self.answers[usize::from(!is_first)].clone()
    }
}

/// A window of one pixel, looked at twice: whether it is whole and covered each time, and the problems told in all.
fn looked_twice(
    answers: [Result<Option<Raster<Rgba>>, TileLack>; 2],
) -> ([(bool, bool); 2], usize) {
    let frame = LocalFrame::new(Geodetic::from_degrees(MIDDLE.0, MIDDLE.1, 0.0));
    let area = GroundRect::centered(GroundPoint::default(), 3000.0, 3000.0);
    let asked = Mutex::default();
    let map = WebTiles::new(Box::new(Late { answers, asked }), frame, area, 64 << 20);
    let window = Window::covering(&GroundRect::centered(GroundPoint::default(), 1.0, 1.0), 1.0);
    let seen = [(); 2].map(|()| {
        let (pixels, is_whole) = map.window_so_far(&window);
        (is_whole, pixels.get(0, 0)[3] == 255)
    });
    (seen, map.problems().len())
}

#[test]
fn a_window_is_whole_once_no_tile_of_it_is_still_to_come() {
    let pixels = |side| Ok(Some(Raster::filled(side, side, [9, 9, 9, 255])));
    let why = || "a.pmtiles, tile: no network".to_owned();
    let (nothing, shown) = ((true, false), (true, true));
    for (first, then, seen, told) in [
        (
            Err(TileLack::Awaited),
            pixels(256),
            [(false, false), shown],
            0,
        ),
        (
            Err(TileLack::Unreachable(why())),
            pixels(256),
            [(false, false), shown],
            1,
        ),
        // What the map leaves out or spoils does not get better, and is not asked for again.
        (Ok(None), pixels(256), [nothing; 2], 0),
        (
            Err(TileLack::Unreadable(why())),
            pixels(256),
            [nothing; 2],
            1,
        ),
        (pixels(512), pixels(256), [nothing; 2], 1),
    ] {
        let case = format!("{:?}", first.as_ref().err());
        assert_eq!(looked_twice([first, then]), (seen, told), "{case}");
    }
}

#[test]
fn a_window_shows_what_lies_there_at_every_zoom() {
    let frame = LocalFrame::new(Geodetic::from_degrees(MIDDLE.0, MIDDLE.1, 0.0));
    let area = GroundRect::centered(GroundPoint::default(), 3000.0, 3000.0);
    let places = Places {
        frame,
        zooms: (10, 17),
        wave: 90.0,
    };
    let map = WebTiles::new(Box::new(places), frame, area, 64 << 20);
    assert!(
        (map.native_gsd() - 0.817).abs() < 0.01,
        "{}",
        map.native_gsd()
    );
    for gsd in [0.4, 0.9, 1.7, 3.1] {
        let window = Window {
            north_edge: 100.0,
            west_edge: -140.0,
            gsd,
            width: 60,
            height: 50,
        };
        let seen = map.window(&window);
        for row in 0..50 {
            for column in 0..60 {
                let ground = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let (ours, expected) = (seen.get(column, row), shade(&ground, 90.0));
                let off = ours.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max();
                assert!(off <= Some(6), "{gsd} {ground:?}: {ours:?} {expected:?}");
            }
        }
    }
    let elsewhere = Window {
        north_edge: 9000.0,
        west_edge: 9000.0,
        gsd: 1.0,
        width: 4,
        height: 4,
    };
    assert_eq!(map.window(&elsewhere).get(2, 2), [0; 4]);
}

/// A tile of the world, or of half of it, has sides that the world frame does not reach.
#[test]
fn tiles_of_the_whole_world_are_drawn_where_the_frame_reaches() {
    let wave = 3.0e6;
    for (latitude, longitude) in [MIDDLE, (-17.0, 178.5), (64.1, -21.9), (-34.0, -178.0)] {
        for zoom in [0, 1, 2] {
            let frame = LocalFrame::new(Geodetic::from_degrees(latitude, longitude, 0.0));
            let area = GroundRect::centered(GroundPoint::default(), 90_000.0, 90_000.0);
            let places = Places {
                frame,
                zooms: (zoom, zoom),
                wave,
            };
            let map = WebTiles::new(Box::new(places), frame, area, 64 << 20);
            let window = Window {
                north_edge: 20_000.0,
                west_edge: -20_000.0,
                gsd: 1000.0,
                width: 40,
                height: 40,
            };
            let seen = map.window(&window);
            for (column, row) in [(3, 3), (36, 3), (20, 20), (3, 36), (36, 36)] {
                let ground = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let (ours, expected) = (seen.get(column, row), shade(&ground, wave));
                let off = ours.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max();
                let place = (latitude, longitude, zoom);
                assert!(
                    off <= Some(8),
                    "{place:?} {ground:?}: {ours:?} {expected:?}"
                );
            }
        }
    }
}

#[test]
fn tiles_on_both_sides_of_the_date_line_are_drawn_beside_each_other() {
    for longitude in [180.0, -179.9985, 179.9985] {
        let frame = LocalFrame::new(Geodetic::from_degrees(-16.9, longitude, 0.0));
        let area = GroundRect::centered(GroundPoint::default(), 4000.0, 4000.0);
        let places = Places {
            frame,
            zooms: (8, 15),
            wave: 90.0,
        };
        let map = WebTiles::new(Box::new(places), frame, area, 64 << 20);
        let window = Window::covering(
            &GroundRect::centered(GroundPoint::default(), 800.0, 800.0),
            4.6,
        );
        let tiles = tiles_for(&window, &frame, (8, 15), 256).unwrap();
        // A tile is 1170 m wide there.
        assert!(tiles.first.zoom == 15 && tiles.count() <= 4, "{tiles:?}");
        let seen = map.window(&window);
        for row in 0..window.height {
            for column in 0..window.width {
                let ground = window.ground_at(column as f64 + 0.5, row as f64 + 0.5);
                let (ours, expected) = (seen.get(column, row), shade(&ground, 90.0));
                let off = ours.iter().zip(expected).map(|(a, b)| a.abs_diff(b)).max();
                assert!(
                    off <= Some(6),
                    "{longitude} {ground:?}: {ours:?} {expected:?}"
                );
            }
        }
    }
}

#[test]
fn an_archive_over_the_date_line_has_its_middle_there() {
    let mut bytes = archive();
    for (place, degrees) in [(102, 179.978), (106, -17.0), (110, -179.974), (114, -16.8)] {
        let angle = (degrees * 1e7) as i32;
        bytes[place..place + 4].copy_from_slice(&angle.to_le_bytes());
    }
    let archive = open(bytes).unwrap();
    let middle = archive.middle();
    assert!((middle.longitude.to_degrees() + 179.998).abs() < 1e-6);
    // 0.048° of longitude at 17° south are 5.1 km, 0.2° of latitude 22.1 km.
    let area = archive.area(&LocalFrame::new(middle)).unwrap();
    assert!((area.width() - 5113.0).abs() < 10.0, "{}", area.width());
    assert!((area.height() - 22_130.0).abs() < 20.0, "{}", area.height());
}

fn number(out: &mut Vec<u8>, mut value: u64) {
    while value >= 0x80 {
        out.push(value as u8 | 0x80);
        value >>= 7;
    }
    out.push(value as u8);
}

fn directory(entries: &[(u64, u64, u64, u64)]) -> Vec<u8> {
    let mut plain = Vec::new();
    number(&mut plain, entries.len() as u64);
    let mut last = 0;
    for (id, ..) in entries {
        number(&mut plain, id - last);
        last = *id;
    }
    for (_, run, ..) in entries {
        number(&mut plain, *run);
    }
    for (.., length) in entries {
        number(&mut plain, *length);
    }
    for (_, _, offset, _) in entries {
        number(&mut plain, offset + 1);
    }
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(&plain).unwrap();
    packed.finish().unwrap()
}

/// An archive of zoom 1 and 2 with a leaf directory; every tile is of one colour.
fn archive() -> Vec<u8> {
    let mut tiles: Vec<TileNumber> = (1..=2)
        .flat_map(|z| (0..1 << z).flat_map(move |x| (0..1 << z).map(move |y| tile(z, x, y))))
        .collect();
    tiles.sort_by_key(TileNumber::hilbert);
    let mut data = Vec::new();
    let entries: Vec<_> = (tiles.iter())
        .map(|t| {
            let colour = [t.zoom * 50, t.x as u8 * 40, t.y as u8 * 40];
            let png = encode_png(&Picture::filled(16, 16, colour)).unwrap();
            let entry = (t.hilbert(), 1, data.len() as u64, png.len() as u64);
            data.extend(png);
            entry
        })
        .collect();
    let (head, tail) = entries.split_at(7);
    let leaf = directory(tail);
    let mut root_entries = head.to_vec();
    root_entries.push((tail[0].0, 0, 0, leaf.len() as u64));
    let root = directory(&root_entries);
    let mut about = GzEncoder::new(Vec::new(), Compression::fast());
    about
        .write_all(br#"{"attribution": "&copy; <a href='https://a.org'>whoever</a>"}"#)
        .unwrap();
    let about = about.finish().unwrap();
    let mut out = b"PMTiles\x03".to_vec();
    let places = [
        127,
        127 + root.len(),
        127 + root.len() + about.len(),
        127 + root.len() + about.len() + leaf.len(),
    ];
    let lengths = [root.len(), about.len(), leaf.len(), data.len()];
    for (place, length) in places.iter().zip(lengths) {
        out.extend((*place as u64).to_le_bytes());
        out.extend((length as u64).to_le_bytes());
    }
    out.resize(96, 0);
    out.extend([1, 2, 1, 2, 1, 2]);
    for angle in [-1_800_000_000_i32, -850_000_000, 1_800_000_000, 850_000_000] {
        out.extend(angle.to_le_bytes());
    }
    out.resize(127, 0);
    [out, root, about, leaf, data].concat()
}

/// The archive with tiles that are packed by gzip one by one.
fn archive_of_packed_tiles() -> Vec<u8> {
    let png = encode_png(&Picture::filled(16, 16, [50, 60, 70])).unwrap();
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(&png).unwrap();
    let data = packed.finish().unwrap();
    let root = directory(&[(0, 1, 0, data.len() as u64)]);
    let mut out = b"PMTiles\x03".to_vec();
    for (place, length) in [
        (127, root.len()),
        (127 + root.len(), 0),
        (127 + root.len(), 0),
        (127 + root.len(), data.len()),
    ] {
        out.extend((place as u64).to_le_bytes());
        out.extend((length as u64).to_le_bytes());
    }
    out.resize(96, 0);
    out.extend([1, 2, 2, 2, 0, 0]);
    out.resize(127, 0);
    [out, root, data].concat()
}

#[test]
fn tiles_that_are_packed_are_unpacked_or_refused_by_the_name_of_their_method() {
    let packed = open(archive_of_packed_tiles()).unwrap();
    let pixels = packed.tile(&tile(0, 0, 0)).unwrap().unwrap();
    assert_eq!(pixels.get(3, 3), [50, 60, 70, 255]);
    // Plain ones are read whatever the header states.
    let mut plain = archive();
    plain[98] = 2;
    let plain = open(plain).unwrap();
    let pixels = plain.tile(&tile(1, 1, 0)).unwrap().unwrap();
    assert_eq!(pixels.get(3, 3), [50, 40, 0, 255]);
    let mut brotli = archive();
    brotli[98] = 3;
    let error = open(brotli).err().unwrap().to_string();
    assert!(error.contains("Brotli"), "{error}");
}

#[test]
fn of_an_archive_that_states_the_world_the_ground_about_its_centre_is_read_and_that_is_told() {
    let mut bytes = archive();
    let mut state = |at: usize, degrees: f64| {
        bytes[at..at + 4].copy_from_slice(&((degrees * 1e7) as i32).to_le_bytes());
    };
    state(119, 8.35);
    state(123, 47.34);
    let open = |bytes: &[u8]| {
        let mut files = MemoryFiles::default();
        files.0.insert("map.pmtiles".to_owned(), bytes.to_vec());
        open_map(&files, "map.pmtiles", None).unwrap()
    };
    let map = open(&bytes);
    let origin = map.frame().unwrap().origin;
    let place = [origin.latitude, origin.longitude].map(f64::to_degrees);
    assert!(
        (place[0] - 47.34).abs() < 1e-6 && (place[1] - 8.35).abs() < 1e-6,
        "{place:?}"
    );
    assert!(
        map.notes()[0].contains("100 km of 47.34"),
        "{:?}",
        map.notes()
    );
    // A centre beyond the bounds is none.
    let mut bounds = |at: usize, degrees: f64| {
        bytes[at..at + 4].copy_from_slice(&((degrees * 1e7) as i32).to_le_bytes());
    };
    bounds(102, 9.0);
    bounds(110, 30.0);
    let origin = *open(&bytes).frame().unwrap();
    assert!((origin.origin.longitude.to_degrees() - 19.5).abs() < 1e-6);
    // Nor are zeros, within bounds that hold them.
    let mut bounds = |at: usize, degrees: f64| {
        bytes[at..at + 4].copy_from_slice(&((degrees * 1e7) as i32).to_le_bytes());
    };
    for (at, degrees) in [(102, -20.0), (110, 55.0), (119, 0.0), (123, 0.0)] {
        bounds(at, degrees);
    }
    let origin = *open(&bytes).frame().unwrap();
    assert!((origin.origin.longitude.to_degrees() - 17.5).abs() < 1e-6);
}

fn open(bytes: Vec<u8>) -> Result<PmTiles, PmTilesError> {
    PmTiles::open(Arc::new(MemoryBytes::new("map.pmtiles", bytes)))
}

#[test]
fn every_tile_of_an_archive_is_found_also_behind_a_leaf() {
    let archive = open(archive()).unwrap();
    assert_eq!((archive.zooms(), archive.side()), ((1, 2), 16));
    assert_eq!(archive.format(), TileFormat::Png);
    assert_eq!(TileStore::attribution(&archive), Some("© whoever"));
    for zoom in 1..=2 {
        for x in 0..1 << zoom {
            for y in 0..1 << zoom {
                let pixels = archive.tile(&tile(zoom, x, y)).unwrap().unwrap();
                let expected = [zoom * 50, x as u8 * 40, y as u8 * 40, 255];
                assert_eq!(pixels.get(3, 3), expected, "{zoom}/{x}/{y}");
            }
        }
    }
    assert_eq!(archive.bytes(&tile(3, 0, 0)), Ok(None));
    assert_eq!(archive.bytes(&tile(0, 0, 0)), Ok(None));
}

#[test]
fn tiles_beyond_the_end_of_an_archive_that_was_cut_off_are_told() {
    let mut bytes = archive();
    bytes.truncate(bytes.len() - 200);
    let archive = open(bytes).unwrap();
    // The curve ends in the north-east.
    assert!(archive.tile(&tile(2, 0, 0)).unwrap().is_some());
    let Err(TileLack::Unreadable(why)) = archive.tile(&tile(2, 3, 0)) else {
        panic!("a tile beyond the end");
    };
    assert!(
        why.starts_with("map.pmtiles, tile: ") && why.ends_with("fetch it again"),
        "{why}"
    );
}

#[test]
fn archives_that_are_none_or_of_another_kind_are_named() {
    let error = open(b"PMTiles\x02".to_vec()).err().unwrap().to_string();
    assert!(error.starts_with("map.pmtiles: not"), "{error}");
    let mut vector = archive();
    vector[99] = 1;
    let error = open(vector).err().unwrap().to_string();
    assert!(error.contains("vector") && error.contains("PNG"), "{error}");
}

proptest! {
    #[test]
    fn a_damaged_archive_never_panics(
        kept in 0.0_f64..1.2,
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0_u8..8), 0..6),
    ) {
        let mut bytes = archive();
        let length = bytes.len();
        bytes.truncate((length as f64 * kept) as usize);
        for (place, bit) in flips {
            if !bytes.is_empty() {
                let place = place.index(bytes.len());
                bytes[place] ^= 1 << bit;
            }
        }
        if let Ok(archive) = open(bytes) {
            for x in 0..4 {
                for y in 0..4 {
                    let _ = archive.tile(&tile(2, x, y));
                }
            }
        }
    }

    #[test]
    fn the_tile_around_a_place_covers_it(
        latitude in -84.0_f64..84.0,
        longitude in -180.0_f64..180.0,
        zoom in 0_u8..20,
    ) {
        let place = Geodetic::from_degrees(latitude, longitude, 0.0);
        let number = TileNumber::around(&place, zoom);
        let frame = LocalFrame::new(place);
        let pixel = number.georeference(256).pixel_at(&frame, &GroundPoint::default()).unwrap();
        prop_assert!((-1e-3..256.001).contains(&pixel.x) && (-1e-3..256.001).contains(&pixel.y));
    }
}
