//! `pilotage map` as a user calls it.

use std::fmt::Write as _;
use std::process::{Command, Output};

use pilotage_core::raster::{Picture, decode_picture, encode_jpeg, encode_png};
use pilotage_tests::pmtiles::archive_of_one_tile;
use serde_json::Value;

use super::folder::Folder;

const WORLD_FILE: &str = "0.5\n0\n0\n-0.5\n570000.25\n5189999.75\n";
const WIDTH: u32 = 40;
const HEIGHT: u32 = 30;

fn shade(x: usize, y: usize) -> [u8; 3] {
    [(6 * x) as u8, (8 * y) as u8, ((x * y) % 251) as u8]
}

/// A TIFF of one strip in three colours; with its place in UTM zone 15 north, or without.
pub fn tiff(says_where: bool) -> Vec<u8> {
    let pixels: Vec<u8> = (0..HEIGHT as usize)
        .flat_map(|y| (0..WIDTH as usize).flat_map(move |x| shade(x, y)))
        .collect();
    let long = |value: u32| value.to_le_bytes().to_vec();
    let mut tags: Vec<(u16, u16, u32, Vec<u8>)> = vec![
        (256, 4, 1, long(WIDTH)),
        (257, 4, 1, long(HEIGHT)),
        (258, 3, 3, shorts(&[8, 8, 8])),
        (259, 3, 1, shorts(&[1, 0])),
        (262, 3, 1, shorts(&[2, 0])),
        (273, 4, 1, long(8)),
        (277, 3, 1, shorts(&[3, 0])),
        (278, 4, 1, long(HEIGHT)),
        (279, 4, 1, long(pixels.len() as u32)),
    ];
    if says_where {
        let keys = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32_615];
        let tie = [0.0, 0.0, 0.0, 570_000.0, 5_190_000.0, 0.0];
        tags.push((33_550, 12, 3, reals(&[0.5, 0.5, 0.0])));
        tags.push((33_922, 12, 6, reals(&tie)));
        tags.push((34_735, 3, 16, shorts(&keys)));
    }
    tiff_of(&pixels, tags)
}

/// Numbers as tags of a TIFF have them.
fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

fn reals(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A TIFF of one strip, which begins at byte 8: number, kind, count and value of each tag, in the order of the numbers.
fn tiff_of(pixels: &[u8], tags: Vec<(u16, u16, u32, Vec<u8>)>) -> Vec<u8> {
    let directory = 8 + pixels.len();
    let after = directory + 2 + 12 * tags.len() + 4;
    let mut beyond: Vec<u8> = Vec::new();
    let mut file = b"II\x2a\x00".to_vec();
    file.extend((directory as u32).to_le_bytes());
    file.extend(pixels);
    file.extend((tags.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in tags {
        file.extend(tag.to_le_bytes());
        file.extend(kind.to_le_bytes());
        file.extend(count.to_le_bytes());
        if value.len() == 4 {
            file.extend(value);
        } else {
            file.extend(((after + beyond.len()) as u32).to_le_bytes());
            beyond.extend(value);
        }
    }
    file.extend([0; 4]);
    file.extend(beyond);
    file
}

impl Folder {
    fn map(&self, words: &[&str]) -> Output {
        let done = self.call(&[&["map"], words].concat());
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{said}");
        done
    }

    fn info(&self, words: &[&str]) -> Value {
        let done = self.map(&[&["info"], words].concat());
        serde_json::from_slice(&done.stdout).expect("JSON")
    }
}

#[test]
fn a_geotiff_tells_its_size_its_system_and_its_corners() {
    let folder = Folder::new("map-info");
    folder.write("area.tif", tiff(true));
    let info = folder.info(&["area.tif"]);
    assert_eq!((&info["width"], &info["height"]), (&40.into(), &30.into()));
    assert_eq!(
        (&info["kind"], &info["epsg"]),
        (&"GeoTIFF".into(), &32_615.into())
    );
    assert_eq!(
        (&info["samples"], &info["cut"]),
        (&3.into(), &"strips".into())
    );
    let gsd = info["gsd_m"].as_f64().expect("a size of pixels");
    assert!((gsd - 0.5).abs() < 1e-3, "{gsd}");
    // The top left corner, by pyproj: 46.85797 north, 92.08141 west, to a few metres.
    let corner = &info["corners_lat_lon"][0];
    let degrees = |i: usize| corner[i].as_f64().expect("degrees");
    assert!((degrees(0) - 46.858).abs() < 5e-3, "{corner}");
    assert!((degrees(1) + 92.081).abs() < 5e-3, "{corner}");
}

#[test]
fn an_archive_of_tiles_tells_where_it_lies_its_zooms_and_who_made_it() {
    let folder = Folder::new("map-archive");
    let tile = encode_png(&Picture::filled(64, 64, [10, 200, 30])).expect("a picture");
    folder.write("area.pmtiles", archive_of_one_tile(&tile));
    let info = folder.info(&["area.pmtiles"]);
    assert_eq!(
        (&info["kind"], &info["epsg"]),
        (&"PMTiles".into(), &3857.into())
    );
    assert_eq!(info["attribution"], "© Whoever");
    assert_eq!(info["zooms"], serde_json::json!([0, 0]));
    let corner = &info["corners_lat_lon"][0];
    let degrees = |i: usize| corner[i].as_f64().expect("degrees");
    assert!((degrees(0) - 46.87).abs() < 1e-4, "{corner}");
    assert!((degrees(1) + 92.1).abs() < 1e-4, "{corner}");
}

#[test]
fn a_tile_cut_out_of_a_picture_has_its_pixels() {
    let folder = Folder::new("map-tile");
    let picture = Picture::from_fn(WIDTH as usize, HEIGHT as usize, shade);
    folder.write("area.png", encode_png(&picture).expect("a picture"));
    // Metres of no place on the globe: nothing is turned or stretched.
    let local = WORLD_FILE.replace("570000.25", "100.25");
    folder.write("area.pgw", local.replace("5189999.75", "99.75"));
    folder.map(&[
        "tile",
        "area.png",
        "--window",
        "8,6,16,12",
        "--out",
        "part.png",
    ]);
    let part = std::fs::read(folder.0.join("part.png")).expect("the part");
    let part = decode_picture(&part).expect("a picture");
    assert_eq!((part.width(), part.height()), (16, 12));
    for (x, y) in [(0, 0), (15, 0), (0, 11), (15, 11), (7, 5)] {
        assert_eq!(part.get(x, y), shade(8 + x, 6 + y), "{x}, {y}");
    }
    let beside = [
        "map",
        "tile",
        "area.png",
        "--window",
        "900,900,16,12",
        "--out",
        "no.png",
    ];
    let why = folder.run(&beside).expect_err("there is no map there");
    assert!(
        why.contains("--window: 900,900,16,12 is not on the map"),
        "{why}"
    );
    // Twice as coarse: a quarter of the pixels, each the mean of four.
    folder.map(&["tile", "area.png", "--gsd", "1", "--out", "coarse.png"]);
    let coarse = std::fs::read(folder.0.join("coarse.png")).expect("the picture");
    let coarse = decode_picture(&coarse).expect("a picture");
    assert_eq!((coarse.width(), coarse.height()), (20, 15));
    let (ours, wanted) = (coarse.get(5, 4), [63, 68]);
    for (ours, wanted) in ours.iter().zip(wanted) {
        assert!(ours.abs_diff(wanted) <= 2, "{ours}, not {wanted}");
    }
}

#[test]
fn parts_of_a_map_that_cannot_be_read_are_told_whatever_kind_the_map_is_of() {
    let folder = Folder::new("map-damaged");
    folder.write("area.pmtiles", archive_of_one_tile(&[7; 200]));
    // The strip ends beyond the end of the file.
    let mut cut = tiff(false);
    let count = cut
        .windows(4)
        .position(|word| word == [17, 1, 4, 0])
        .expect("tag 273");
    cut[count + 8..count + 12].copy_from_slice(&9_000_000_u32.to_le_bytes());
    folder.write("part.tif", cut);
    folder.write(
        "corners.csv",
        "file,north,west,south,east\npart.tif,0.001,0,0,0.001\n",
    );
    for (map, place) in [
        ("area.pmtiles", "tile 0/0/0"),
        ("corners.csv", "part.tif, "),
    ] {
        let done = folder.map(&["tile", map, "--gsd", "20", "--out", "part.png"]);
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(
            said.contains("note: ") && said.contains(place),
            "{map}: {said}"
        );
    }
}

#[test]
fn every_kind_of_world_file_is_found_beside_its_kind_of_picture() {
    let folder = Folder::new("map-world-files");
    let picture = Picture::from_fn(WIDTH as usize, HEIGHT as usize, shade);
    let jpeg = encode_jpeg(&picture, 90).expect("a picture");
    let png = encode_png(&picture).expect("a picture");
    let files = [
        ("a.jpg", "a.jgw", &jpeg),
        ("b.jpeg", "b.wld", &jpeg),
        ("c.png", "c.pgw", &png),
        ("d.png", "d.wld", &png),
        ("e.tif", "e.tfw", &tiff(false)),
        ("f.tif", "f.wld", &tiff(false)),
    ];
    for (name, beside, bytes) in files {
        folder.write(name, bytes);
        folder.write(beside, WORLD_FILE);
        let info = folder.info(&[name, "--system", "EPSG:32615"]);
        let metres = |name: &str| info[name].as_f64().expect("metres");
        assert!((metres("width_m") - 20.0).abs() < 0.3, "{name}: {info}");
        assert!((metres("height_m") - 15.0).abs() < 0.3, "{name}: {info}");
        let north = info["corners_lat_lon"][0][0].as_f64().expect("a latitude");
        assert!((north - 46.858).abs() < 5e-3, "{name}: {info}");
    }
}

#[test]
fn several_pictures_with_a_table_of_their_corners_are_one_map() {
    const DEGREE: f64 = 1e-5;
    let (west, north) = (8.5, 47.4);
    let folder = Folder::new("map-several");
    let mut table = "mapname,LT_lat_map,LT_lon_map,RB_lat_map,RB_lon_map\n".to_owned();
    for (name, x, width) in [("left.png", 0, 24), ("right.png", 24, 16)] {
        let part = Picture::from_fn(width, HEIGHT as usize, |i, j| shade(x + i, j));
        folder.write(name, encode_png(&part).expect("a picture"));
        let lon = |column: usize| west + column as f64 * DEGREE;
        let south = north - f64::from(HEIGHT) * DEGREE;
        writeln!(
            table,
            "{name},{north},{},{south},{}",
            lon(x),
            lon(x + width)
        )
        .expect("a line");
    }
    folder.write("map.csv", &table);
    let info = folder.info(&["map.csv"]);
    assert_eq!(info["kind"], "several pictures");
    assert_eq!(info["pictures"], 2);
    let corner = |i: usize, k: usize| info["corners_lat_lon"][i][k].as_f64().expect("degrees");
    assert!((corner(0, 0) - north).abs() < 1e-7 && (corner(0, 1) - west).abs() < 1e-7);
    assert!((corner(2, 1) - west - f64::from(WIDTH) * DEGREE).abs() < 1e-7);
    // A pixel is 0.75487 m wide and 1.11179 m high there: by the radii of curvature of the WGS 84 ellipsoid.
    let metres = |name: &str| info[name].as_f64().expect("metres");
    assert!((metres("width_m") - 40.0 * 0.75487).abs() < 0.01, "{info}");
    assert!((metres("height_m") - 30.0 * 1.11179).abs() < 0.01, "{info}");
    folder.map(&["tile", "map.csv", "--gsd", "0.25", "--out", "map.png"]);
    let map = decode_picture(&std::fs::read(folder.0.join("map.png")).expect("the map"));
    let map = map.expect("a picture");
    for (x, y) in [(3, 4), (20, 25), (30, 10), (38, 28)] {
        let column = ((x as f64 + 0.5) * 0.75487 / 0.25) as usize;
        let row = ((y as f64 + 0.5) * 1.11179 / 0.25) as usize;
        let (seen, wanted) = (map.get(column, row), shade(x, y));
        for (seen, wanted) in seen.iter().zip(wanted) {
            assert!(seen.abs_diff(wanted) <= 9, "{x}, {y}: {seen}, not {wanted}");
        }
    }
    folder.write("map.csv", table.replace("right.png", "missing.png"));
    let mut program = Command::new(env!("CARGO_BIN_EXE_pilotage"));
    let program = program
        .current_dir(&folder.0)
        .args(["map", "info", "map.csv"]);
    let out = program.output().expect("the program starts");
    let told = String::from_utf8_lossy(&out.stderr).into_owned();
    assert!(
        !out.status.success() && told.contains("missing.png: there is no such file"),
        "{told}"
    );
}

/// An elevation model of four by four whole numbers of 16 bits without a sign, a thousandth of a degree
/// apart from 47° N 8° E; the first is the mark for missing heights.
fn heights() -> Vec<u8> {
    heights_from((8.0, 47.0), false, 8)
}

/// The same from another corner, degrees of longitude and latitude; with a sign it says itself that it holds heights. The
/// samples are in the file 8 bytes from its beginning, which it says of `offset`.
pub fn heights_from(corner: (f64, f64), is_signed: bool, offset: u32) -> Vec<u8> {
    let mut samples = [1200_u16; 16];
    samples[0] = 9;
    let pixels: Vec<u8> = samples.iter().flat_map(|v| v.to_le_bytes()).collect();
    let keys = [1, 1, 0, 3, 1024, 0, 1, 2, 1025, 0, 1, 1, 2048, 0, 1, 4326];
    let tags = vec![
        (256, 3, 1, shorts(&[4, 0])),
        (257, 3, 1, shorts(&[4, 0])),
        (258, 3, 1, shorts(&[16, 0])),
        (259, 3, 1, shorts(&[1, 0])),
        (262, 3, 1, shorts(&[1, 0])),
        (273, 4, 1, offset.to_le_bytes().to_vec()),
        (277, 3, 1, shorts(&[1, 0])),
        (278, 3, 1, shorts(&[4, 0])),
        (279, 4, 1, vec![32, 0, 0, 0]),
        (339, 3, 1, shorts(&[1 + u16::from(is_signed), 0])),
        (33_550, 12, 3, reals(&[1e-3, 1e-3, 0.0])),
        (
            33_922,
            12,
            6,
            reals(&[0.0, 0.0, 0.0, corner.0, corner.1, 0.0]),
        ),
        (34_735, 3, 16, shorts(&keys)),
        (42_113, 2, 2, b"9\0\0\0".to_vec()),
    ];
    tiff_of(&pixels, tags)
}

#[test]
fn a_height_that_is_asked_for_is_told_or_its_lack_is_an_error() {
    let folder = Folder::new("map-height-at");
    folder.write("dem.tif", heights());
    folder.write(
        "picture.png",
        encode_png(&Picture::filled(4, 4, [9; 3])).expect("a picture"),
    );
    folder.write("picture.pgw", "0.001\n0\n0\n-0.001\n8.0005\n46.9995\n");
    // By itself it is a grey picture.
    assert_eq!(folder.info(&["dem.tif"])["kind"], "GeoTIFF");
    let info = folder.info(&["dem.tif", "--height-at", "46.9985,8.0015"]);
    assert_eq!(info["kind"], "elevation model");
    let height = info["height_at_place_m"].as_f64().expect("metres");
    assert!((height - 1200.0).abs() < 1e-6, "{info}");
    for (file, place, word) in [
        ("dem.tif", "46.9995,8.0005", "data are missing there"),
        ("dem.tif", "48,8.0015", "does not reach there"),
        (
            "picture.png",
            "46.9985,8.0015",
            "picture.png is no elevation model",
        ),
    ] {
        let output = folder.call(&["map", "info", file, "--height-at", place]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            !output.status.success() && output.stdout.is_empty(),
            "{told}"
        );
        assert!(told.contains(word), "{file} {place}: {told}");
    }
}
