//! Reference systems of other datums and projections against pyproj and rasterio.
#![expect(
    clippy::too_many_lines,
    reason = "tables of systems and of maps stand where they are asked about"
)]

use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::Point2;
use pilotage_core::frames::{Geodetic, LocalFrame, ReferenceSystem, wrap_pi};
use pilotage_core::imagery::{
    ByteSource, GeoTiffFile, Georeference, GeoreferenceError, MemoryBytes, Placement, WorldFile,
    systems,
};
use pilotage_tests::oracle::ask;
use pilotage_tests::pyproj::{self, Coordinates};
use serde::{Deserialize, Serialize};

/// Radius that makes metres of small angles.
const RADIUS: f64 = 6.4e6;

#[derive(Serialize)]
struct Codes {
    codes: Vec<u32>,
}

#[derive(Deserialize)]
struct System {
    name: String,
    texts: Vec<String>,
    on_datum: Vec<[f64; 4]>,
    on_wgs84: Vec<[f64; 4]>,
}

/// Metres between a place and one in degrees.
fn off(place: &Geodetic, latitude: f64, longitude: f64) -> f64 {
    let theirs = Geodetic::from_degrees(latitude, longitude, 0.0);
    let north = place.latitude - theirs.latitude;
    let east = wrap_pi(place.longitude - theirs.longitude) * theirs.latitude.cos();
    north.hypot(east) * RADIUS
}

/// Whether places of a datum are given on it as on WGS 84.
fn is_near(system: &ReferenceSystem) -> bool {
    match system {
        ReferenceSystem::Other(other) => other.numbers.datum.shift == [0.0; 7],
        _ => true,
    }
}

#[test]
fn every_code_of_the_table_agrees_with_pyproj_to_a_millimetre() {
    let codes = systems::codes();
    let answer: Option<Vec<System>> = ask(
        "pyproj_systems.py",
        &Codes {
            codes: codes.clone(),
        },
    );
    let Some(answer) = answer else { return };
    let (mut furthest, mut back, mut places, mut shifted) = (0.0_f64, 0.0_f64, 0, 0.0_f64);
    let mut wrong = Vec::new();
    for (code, theirs) in codes.iter().zip(&answer) {
        let ours = systems::by_code(*code).unwrap();
        let accuracy = match &ours {
            ReferenceSystem::Other(other) => other.numbers.datum.accuracy,
            _ => 0.0,
        };
        let on_datum = theirs.on_datum.iter().filter(|_| is_near(&ours));
        let checked = on_datum.map(|place| (place, 1e-3));
        // The same shift is exact; for parts of some areas pyproj has others, which differ by some metres.
        let on_wgs84 = (theirs.on_wgs84.iter()).map(|place| (place, accuracy + 12.0));
        for (&[x, y, latitude, longitude], most) in checked.chain(on_wgs84) {
            places += 1;
            let Some(place) = ours.geodetic(x, y) else {
                wrong.push(format!("{code} {}: no place at {x} {y}", theirs.name));
                continue;
            };
            let missed = off(&place, latitude, longitude);
            if most > 1e-3 {
                shifted = shifted.max(missed);
            } else {
                furthest = furthest.max(missed);
            }
            if missed > most {
                wrong.push(format!(
                    "{code} {}: {missed} m at {latitude} {longitude}",
                    theirs.name
                ));
            }
            let unit = match &ours {
                ReferenceSystem::Other(other) if !ours.is_geographic() => other.numbers.unit,
                _ => 1.0,
            };
            let Some(again) = ours.coordinates(&place) else {
                wrong.push(format!(
                    "{code} {}: no coordinates of {place:?}",
                    theirs.name
                ));
                continue;
            };
            let scale = if ours.is_geographic() { 1.1e5 } else { unit };
            let missed = (again.0 - x).hypot(again.1 - y) * scale;
            back = back.max(missed);
            if missed > 1e-3 && (again.0 - x).abs() < 359.0 {
                wrong.push(format!(
                    "{code} {}: {missed} m on the way back",
                    theirs.name
                ));
            }
        }
        for text in &theirs.texts {
            match systems::by_name(text) {
                Err(cause) => wrong.push(format!("{code}: {cause}")),
                Ok(read) => {
                    let places = theirs.on_datum.iter().chain(&theirs.on_wgs84).take(3);
                    for &[x, y, ..] in places {
                        let (a, b) = (read.geodetic(x, y), ours.geodetic(x, y));
                        let is_same = a.zip(b).is_some_and(|(a, b)| {
                            off(&a, b.latitude.to_degrees(), b.longitude.to_degrees()) < 1e-3
                        });
                        if !is_same {
                            wrong.push(format!("{code}: {a:?} is not {b:?} in {}", &text[..80]));
                        }
                    }
                }
            }
        }
        // What is written is read again as the same.
        let own = systems::by_name(&ours.well_known_text());
        if own != Ok(ours) {
            wrong.push(format!(
                "{code}: {own:?} is read of {}",
                ours.well_known_text()
            ));
        }
    }
    println!(
        "{} codes, {places} places: furthest {furthest:.1e} m, back {back:.1e} m, shifts of datums differ \
         by up to {shifted:.2} m",
        codes.len()
    );
    assert!(
        wrong.is_empty(),
        "{} wrong:\n{}",
        wrong.len(),
        wrong[..wrong.len().min(200)].join("\n")
    );
}

#[derive(Serialize)]
struct Files {
    directory: PathBuf,
    systems: Vec<(&'static str, f64, f64)>,
    pixel: f64,
}

#[derive(Deserialize)]
struct File {
    path: PathBuf,
    corners: [[f64; 2]; 4],
}

#[test]
fn systems_that_the_keys_of_a_file_describe_put_it_where_rasterio_does() {
    let wanted = vec![
        ("EPSG:25832", 47.3, 9.1),
        ("EPSG:26910", 47.3, -123.1),
        ("EPSG:4258", 51.2, 7.9),
        ("EPSG:4269", 41.2, -97.9),
        ("EPSG:7856", -33.8, 151.2),
        ("EPSG:2154", 45.1, 2.2),
        ("EPSG:27700", 52.1, -1.2),
        ("EPSG:28992", 52.1, 5.2),
        ("EPSG:2056", 46.9, 7.5),
        ("EPSG:31467", 49.1, 9.2),
        ("EPSG:2263", 40.7, -74.0),
        ("EPSG:5070", 38.2, -101.0),
        ("EPSG:3035", 48.2, 16.3),
        ("EPSG:3031", -71.2, 12.3),
        (
            "+proj=tmerc +lat_0=40 +lon_0=-3 +k=0.9997 +x_0=200000 +y_0=100000 +ellps=GRS80 +towgs84=0,0,0,0,0,0,0",
            41.0,
            -3.5,
        ),
        (
            "+proj=tmerc +lat_0=0 +lon_0=9.5 +k=1.00003 +x_0=500000 +y_0=0 +datum=WGS84",
            48.1,
            9.2,
        ),
        (
            "+proj=lcc +lat_1=49 +lat_2=46 +lat_0=47.5 +lon_0=13.3 +x_0=400000 +y_0=400000 +datum=WGS84",
            47.1,
            13.9,
        ),
        (
            "+proj=lcc +lat_1=38 +lat_0=38 +lon_0=-97 +k_0=0.9998 +x_0=0 +y_0=0 +datum=NAD83",
            38.1,
            -98.2,
        ),
        (
            "+proj=aea +lat_1=29.5 +lat_2=45.5 +lat_0=23 +lon_0=-96 +datum=NAD83",
            40.1,
            -100.2,
        ),
        (
            "+proj=aea +lat_1=-18 +lat_2=-36 +lat_0=0 +lon_0=132 +ellps=GRS80",
            -25.0,
            133.2,
        ),
        (
            "+proj=stere +lat_0=90 +lat_ts=71 +lon_0=-39 +datum=WGS84",
            76.0,
            -42.0,
        ),
        (
            "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=10 +datum=WGS84",
            -76.0,
            42.0,
        ),
        ("+proj=laea +lat_0=45 +lon_0=100 +datum=WGS84", 42.0, 111.0),
        ("+proj=merc +lon_0=20 +k=0.99 +datum=WGS84", 12.0, 21.0),
        ("+proj=merc +lat_ts=41 +lon_0=50 +datum=WGS84", 38.0, 51.0),
        (
            "+proj=tmerc +lat_0=0 +lon_0=15 +k=1 +x_0=5500000 +y_0=0 +ellps=bessel +towgs84=582,105,414,1.04,0.35,-3.08,8.3",
            51.0,
            14.2,
        ),
        (
            "+proj=utm +zone=33 +ellps=intl +towgs84=-87,-98,-121",
            51.0,
            14.2,
        ),
        (
            "+proj=lcc +lat_1=33 +lat_2=45 +lat_0=39 +lon_0=-96 +x_0=600000 +datum=NAD83 +units=us-ft",
            38.1,
            -98.2,
        ),
    ];
    let directory = std::env::temp_dir().join(format!("systems-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let question = Files {
        directory: directory.clone(),
        systems: wanted.clone(),
        pixel: 300.0,
    };
    let answer: Option<Vec<File>> = ask("rasterio_systems.py", &question);
    let Some(answer) = answer else { return };
    let mut wrong = Vec::new();
    let mut furthest: f64 = 0.0;
    for ((definition, ..), file) in wanted.iter().zip(&answer) {
        let bytes = std::fs::read(&file.path).unwrap();
        let source: Arc<dyn ByteSource> = Arc::new(MemoryBytes::new("a.tif".to_owned(), bytes));
        let opened = match GeoTiffFile::open(source, None, None) {
            Ok(opened) => opened,
            Err(cause) => {
                wrong.push(format!("{definition}: {cause}"));
                continue;
            }
        };
        let placement = opened
            .placement(&LocalFrame::new(opened.origin().unwrap()))
            .unwrap();
        let corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)];
        for ((x, y), [latitude, longitude]) in corners.iter().zip(file.corners) {
            let place = placement.place_at(&Point2::new(*x, *y)).unwrap();
            let missed = off(&place, latitude, longitude);
            furthest = furthest.max(missed);
            if missed > 1e-3 {
                wrong.push(format!(
                    "{definition}: {missed} m, {:?}",
                    opened.keys.system
                ));
            }
        }
    }
    std::fs::remove_dir_all(&directory).unwrap();
    println!("{} files, furthest {furthest:.1e} m", wanted.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A map of a large part of the world: code, size, coordinates of its first corner, and of a pixel.
type World = (u32, (usize, usize), [f64; 2], [f64; 2]);

const WORLDS: [World; 9] = [
    (4326, (3600, 1800), [-180.0, 90.0], [0.1, -0.1]),
    (4326, (3600, 1800), [0.0, 90.0], [0.1, -0.1]),
    (4326, (1441, 721), [-180.125, 90.125], [0.25, -0.25]),
    (4326, (200, 300), [170.0, 15.0], [0.1, -0.1]),
    (
        3857,
        (4096, 4096),
        [-20_037_508.342_789_244, 20_037_508.342_789_244],
        [9_783.939_620_502_56, -9_783.939_620_502_56],
    ),
    (
        3857,
        (400, 400),
        [19_800_000.0, -1_900_000.0],
        [1200.0, -1200.0],
    ),
    (
        3031,
        (1000, 1000),
        [-3_000_000.0, 3_000_000.0],
        [6000.0, -6000.0],
    ),
    (
        3995,
        (1000, 1000),
        [-3_000_000.0, 3_000_000.0],
        [6000.0, -6000.0],
    ),
    (32601, (500, 500), [300_000.0, 4_000_000.0], [800.0, -800.0]),
];

#[test]
fn places_of_maps_of_the_world_lie_where_pyproj_puts_them() {
    let mut random = 0.37_f64;
    let mut next = move || {
        // A sequence that fills the interval evenly.
        random = (random + 0.618_033_988_749_895).fract();
        random
    };
    let mut cases = Vec::new();
    let mut pixels = Vec::new();
    for (epsg, (width, height), corner, step) in WORLDS {
        for origin in [
            [0.0, 0.0],
            [12.0, 179.9],
            [-17.0, -179.99],
            [89.9, 45.0],
            [-90.0, 10.0],
            [47.0, -91.0],
        ] {
            let own: Vec<[f64; 2]> = (0..200)
                .map(|_| [next() * width as f64, next() * height as f64])
                .collect();
            let inside = |p: &[f64; 2]| {
                let place = [corner[0] + p[0] * step[0], corner[1] + p[1] * step[1]];
                epsg != 4326 || place[1].abs() <= 90.0
            };
            let own: Vec<[f64; 2]> = own.into_iter().filter(inside).collect();
            cases.push(Coordinates {
                epsg,
                coordinates: own
                    .iter()
                    .map(|p| [corner[0] + p[0] * step[0], corner[1] + p[1] * step[1]])
                    .collect(),
                origin: [origin[0], origin[1], 0.0],
            });
            pixels.push(((width, height), corner, step, own));
        }
    }
    let Some(answer) = pyproj::places(&cases) else {
        return;
    };
    let (mut places, mut on_planes, mut refused) = (0, 0, 0);
    let (mut furthest, mut on_plane, mut back): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for ((case, (size, corner, step, pixels)), answers) in cases.iter().zip(&pixels).zip(&answer) {
        let file = WorldFile {
            a: step[0],
            d: 0.0,
            b: 0.0,
            e: step[1],
            c: corner[0] + 0.5 * step[0],
            f: corner[1] + 0.5 * step[1],
        };
        let georeference = Georeference::Projected {
            system: systems::by_code(case.epsg).unwrap(),
            file,
        };
        let frame = LocalFrame::new(Geodetic::from_degrees(case.origin[0], case.origin[1], 0.0));
        let placement = match Placement::on_globe(georeference, frame, size.0, size.1) {
            Ok(placement) => placement,
            Err(cause) => {
                // Refused is only what lies on the other side of the globe.
                assert_eq!(cause, GeoreferenceError::TooFar);
                refused += 1;
                continue;
            }
        };
        assert!(placement.gsd().is_finite() && placement.gsd() > 0.0);
        let bounds = placement.bounds();
        assert!(
            bounds.width().is_finite() && bounds.width() <= 1.1e7,
            "{bounds:?}"
        );
        for ([x, y], [latitude, longitude, north, east]) in pixels.iter().zip(answers) {
            places += 1;
            let pixel = Point2::new(*x, *y);
            let place = placement.place_at(&pixel).unwrap();
            furthest = furthest.max(off(&place, *latitude, *longitude));
            let ground = placement.ground_at(&pixel);
            if !ground.north.is_finite() {
                continue;
            }
            let again = placement.pixel_at(&ground);
            // Beyond the edge of its zone a projection may not reach.
            if let Some(again) = again {
                // At a pole every longitude is the same place.
                let moved = (again.y - y)
                    .abs()
                    .max((again.x - x).abs() * latitude.to_radians().cos());
                back =
                    back.max(moved * step[1].abs() * if case.epsg == 4326 { 1.1e5 } else { 1.0 });
            }
            if ground.north.hypot(ground.east) < 3e6 {
                on_planes += 1;
                on_plane = on_plane.max((ground.north - north).hypot(ground.east - east));
            }
        }
    }
    println!(
        "{places} places, {refused} maps beyond the plane: furthest {furthest:.1e} m, {on_planes} on the \
         plane {on_plane:.1e} m, there and back {back:.1e} m"
    );
    assert!(furthest < 1e-3, "{furthest} m");
    assert!(on_planes > 500 && on_plane < 1e-3, "{on_plane} m");
    assert!(back < 1e-3, "{back} m");
}
