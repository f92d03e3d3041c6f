//! Routes and areas anywhere on the globe, through every exchange format and back, beside pyproj.

use std::collections::BTreeMap;

use pilotage_core::exchange::{Format, Imported, Places, read_any, write_places};
use pilotage_tests::oracle::{ask, hex_of_bytes};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

/// Files that are made, and places in each: 10,000 together.
const FILES: usize = 200;
const PLACES: usize = 50;
/// Farthest that a place may be from where it was, metres.
const BAR: f64 = 1e-3;

const FORMATS: [(&str, Format); 9] = [
    ("plan", Format::Plan),
    ("waypoints", Format::Waypoints),
    ("kml", Format::Kml),
    ("kmz", Format::Kmz),
    ("geojson", Format::GeoJson),
    ("gpx", Format::Gpx),
    ("csv", Format::Csv),
    ("litchi", Format::Litchi),
    ("wpml", Format::Wpml),
];

#[derive(Serialize)]
struct Case {
    asked: Vec<[f64; 2]>,
    files: BTreeMap<&'static str, String>,
}

/// Places around a middle: the whole globe is visited, the poles and the date line most of all.
fn places(file: usize, random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let middle: [f64; 2] = match file % 5 {
        0 => [90.0, random.random_range(-180.0..180.0)],
        1 => [-90.0, random.random_range(-180.0..180.0)],
        2 => [random.random_range(-89.0..89.0), 180.0],
        _ => [
            f64::asin(random.random_range(-1.0..1.0)).to_degrees(),
            random.random_range(-180.0..180.0),
        ],
    };
    let reach: f64 = [1e-5, 1e-3, 0.1, 5.0, 40.0, 100.0][file / 5 % 6];
    let mut places = vec![middle];
    while places.len() < PLACES {
        let mut latitude: f64 = middle[0] + random.random_range(-reach..reach);
        let mut longitude: f64 =
            middle[1] + random.random_range(-reach..reach) / middle[0].to_radians().cos().max(0.02);
        // Over the pole, and on.
        if latitude.abs() > 90.0 {
            latitude = latitude.signum() * 180.0 - latitude;
            longitude += 180.0;
        }
        places.push([latitude, (longitude + 180.0).rem_euclid(360.0) - 180.0]);
    }
    places
}

/// A file of somebody else with the places as a route, and every three of them as an area.
fn geojson(places: &[[f64; 2]]) -> String {
    let position = |p: &[f64; 2]| format!("[{}, {}]", p[1], p[0]);
    let line: Vec<String> = places.iter().map(position).collect();
    let feature = |kind: &str, coordinates: &str| {
        format!(
            "{{ \"type\": \"Feature\", \"properties\": {{}}, \"geometry\": {{ \"type\": \"{kind}\", \
             \"coordinates\": [{coordinates}] }} }}"
        )
    };
    let mut features = vec![feature("LineString", &line.join(", "))];
    for corners in line.chunks_exact(3) {
        let ring = format!("[{}, {}]", corners.join(", "), corners[0]);
        features.push(feature("Polygon", &ring));
    }
    format!(
        "{{ \"type\": \"FeatureCollection\", \"features\": [{}] }}",
        features.join(", ")
    )
}

fn written(imported: &Imported, format: Format) -> Vec<u8> {
    let places = Places {
        routes: &imported.routes,
        landmarks: if [Format::Kml, Format::Kmz, Format::GeoJson].contains(&format) {
            &imported.landmarks
        } else {
            &[]
        },
        ..Places::default()
    };
    let file = write_places(format, &places, &imported.frame);
    file.expect("the format holds a route").bytes
}

#[test]
fn ten_thousand_places_go_through_every_format_and_back_or_are_refused() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let (mut cases, mut refused) = (Vec::new(), 0);
    for file in 0..FILES {
        let asked = places(file, &mut random);
        let imported = match read_any("a.geojson", geojson(&asked).as_bytes(), None) {
            Ok(imported) => imported,
            Err(cause) => {
                assert!(cause.to_string().contains("its places lie"), "{cause}");
                refused += 1;
                continue;
            }
        };
        // Once written, and once more after it was read.
        let mut files = BTreeMap::new();
        let mut again = BTreeMap::new();
        for (name, format) in FORMATS {
            let bytes = written(&imported, format);
            files.insert(name, hex_of_bytes(&bytes));
            // Without the areas the middle is another, and the farthest place may be too far from it.
            let back = match read_any("x", &bytes, None) {
                Ok(back) => back,
                Err(cause) => {
                    assert!(
                        cause.to_string().contains("its places lie"),
                        "{name}: {cause}"
                    );
                    continue;
                }
            };
            assert_eq!(back.routes[0].way_points.len(), PLACES, "{name}");
            again.insert(name, hex_of_bytes(&written(&back, format)));
        }
        for files in [files, again] {
            let asked = asked.clone();
            cases.push(Case { asked, files });
        }
    }
    // Only places that are as far apart as half the globe may be refused.
    assert!(refused <= FILES / 4, "{refused} files are refused");
    let Some(answer) = ask::<_, Vec<BTreeMap<String, [f64; 2]>>>("globe_places.py", &cases) else {
        return;
    };
    assert_eq!(answer.len(), cases.len());
    let mut worst: BTreeMap<&str, f64> = BTreeMap::new();
    for (case, answer) in cases.iter().zip(&answer) {
        assert_eq!(answer.len(), case.files.len());
        for (name, [line, areas]) in answer {
            let (name, line, areas) = (name.as_str(), *line, *areas);
            assert_eq!(
                areas >= 0.0,
                ["kml", "kmz", "geojson"].contains(&name),
                "{name}"
            );
            assert!(
                line < BAR && areas < BAR,
                "{name}: {line} m, {areas} m: {:?}",
                &case.asked[..3]
            );
            let worst = worst.entry(name).or_default();
            *worst = worst.max(line).max(areas);
        }
    }
    println!(
        "farthest of {} places, {refused} files refused, metres: {worst:?}",
        cases.len() * PLACES
    );
}
