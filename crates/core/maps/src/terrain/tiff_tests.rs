//! Elevation models in `GeoTIFF` files made here: kinds of samples, scale, units, bands and masks.

use std::sync::Arc;

use super::made_tiffs::{CORNER, Made, STEP};
use super::*;
use pilotage_base::bytes::MemoryBytes;
use pilotage_base::frames::{Geodetic, ReferenceSystem};

fn open(made: &Made) -> Result<Dem, TerrainError> {
    let source = Arc::new(MemoryBytes::new("dem.tif", made.write()));
    Dem::open(source, None, None)
}

/// Height in the middle of a pixel.
fn at(dem: &Dem, column: f64, row: f64) -> Option<f64> {
    let (longitude, latitude) = (
        CORNER.0 + STEP * (column + 0.5),
        CORNER.1 - STEP * (row + 0.5),
    );
    let place = Geodetic::from_degrees(latitude, longitude, 0.0);
    dem.height_at(&dem.frame().ground_from_geodetic(&place))
}

fn level(made: &Made) -> f64 {
    at(&open(made).unwrap(), 1.0, 1.0).unwrap()
}

fn refusal(made: &Made) -> String {
    open(made).err().unwrap().to_string()
}

/// Posts of 1200 with a sign and 16 bits.
fn plain() -> Made {
    Made::level(16, 2, &1200_i16.to_le_bytes())
}

#[test]
fn every_kind_of_whole_and_real_samples_serves_as_heights() {
    let kinds: [(u16, u16, Vec<u8>, f64); 14] = [
        (8, 1, vec![200], 200.0),
        (8, 2, vec![0x9c], -100.0),
        (16, 1, 1200_u16.to_le_bytes().to_vec(), 1200.0),
        (16, 2, (-401_i16).to_le_bytes().to_vec(), -401.0),
        (32, 1, 8848_u32.to_le_bytes().to_vec(), 8848.0),
        (32, 2, (-28_i32).to_le_bytes().to_vec(), -28.0),
        (64, 1, 4807_u64.to_le_bytes().to_vec(), 4807.0),
        (64, 2, (-430_i64).to_le_bytes().to_vec(), -430.0),
        (32, 3, 431.25_f32.to_le_bytes().to_vec(), 431.25),
        (64, 3, 0.1_f64.to_le_bytes().to_vec(), 0.1),
        // Halves as NumPy writes them: 1200, -12.5, 0.1, and the smallest above zero.
        (16, 3, 0x64b0_u16.to_le_bytes().to_vec(), 1200.0),
        (16, 3, 0xca40_u16.to_le_bytes().to_vec(), -12.5),
        (
            16,
            3,
            0x2e66_u16.to_le_bytes().to_vec(),
            0.099_975_585_937_5,
        ),
        (
            16,
            3,
            0x0001_u16.to_le_bytes().to_vec(),
            5.960_464_477_539_063e-8,
        ),
    ];
    for (bits, format, sample, height) in kinds {
        let found = level(&Made::level(bits, format, &sample));
        assert!(
            (found - height).abs() < 1e-12,
            "{bits} bits, format {format}: {found}"
        );
    }
    // Infinite halves and halves that are no numbers are unknown.
    for sample in [0x7c00_u16, 0xfc00, 0x7e00] {
        let dem = open(&Made::level(16, 3, &sample.to_le_bytes())).unwrap();
        assert_eq!(at(&dem, 1.0, 1.0), None);
    }
}

#[test]
fn scale_and_offset_of_the_band_turn_samples_into_heights() {
    let made = plain().with_items(&[
        ("OFFSET", 0, "offset", "5"),
        ("SCALE", 0, "scale", "0.1"),
        ("SCALE", 1, "scale", "77"),
    ]);
    assert!((level(&made) - 125.0).abs() < 1e-12);
    // 0.1 · 1200 + 5 = 125 feet.
    let feet = plain().with_items(&[
        ("SCALE", 0, "scale", " 1e-1 "),
        ("OFFSET", 0, "offset", "5"),
        ("UNITTYPE", 0, "unittype", "ft"),
    ]);
    assert!((level(&feet) - 38.1).abs() < 1e-12);
    let broken = plain().with_items(&[("SCALE", 0, "scale", "a tenth")]);
    let text = refusal(&broken);
    assert!(
        text.contains("tag GdalMetadata (42112)") && text.contains("a tenth"),
        "{text}"
    );
    assert!(refusal(&plain().with_items(&[("SCALE", 0, "scale", "0")])).contains("scale 0"));
}

#[test]
fn the_mark_for_missing_heights_is_a_sample_and_not_a_scaled_height() {
    let mut made = plain().with_items(&[("SCALE", 0, "scale", "0.1")]);
    made.bytes[..2].copy_from_slice(&120_i16.to_le_bytes());
    made.more.push((42_113, 2, b"120\0".to_vec()));
    let dem = open(&made).unwrap();
    assert_eq!(at(&dem, 0.0, 0.0), None);
    assert!((at(&dem, 2.0, 2.0).unwrap() - 120.0).abs() < 1e-12);
    // Reals of 32 bits are marked with more digits than they have.
    let mut made = Made::level(32, 3, &(-9999.9_f32).to_le_bytes());
    made.more.push((42_113, 2, b"-9999.9\0".to_vec()));
    assert_eq!(at(&open(&made).unwrap(), 1.0, 1.0), None);
}

#[test]
fn heights_come_in_metres_whatever_their_unit() {
    // Name of the unit and metres in it, by definition.
    for (name, metres) in [
        ("m", 1.0),
        ("metre", 1.0),
        ("cm", 0.01),
        ("ft", 0.3048),
        ("US survey foot", 1200.0 / 3937.0),
    ] {
        let made = plain().with_items(&[("UNITTYPE", 0, "unittype", name)]);
        assert!((level(&made) - 1200.0 * metres).abs() < 1e-9, "{name}");
    }
    // VerticalGeoKey and VerticalUnitsGeoKey, with the factors of PROJ's database.
    for (keys, metres) in [
        (vec![(4099, 9001)], 1.0),
        (vec![(4099, 9002)], 0.3048),
        (vec![(4099, 9003)], 0.304_800_609_601_219),
        (vec![(4099, 1033)], 0.01),
        (vec![(4096, 5703)], 1.0),
        (vec![(4096, 8228)], 0.3048),
        (vec![(4096, 6360)], 0.304_800_609_601_219),
        (vec![(4096, 8050)], 0.3048),
        (vec![(4096, 5754)], 0.304_800_749_1),
        (vec![(4096, 8228), (4099, 9001)], 1.0),
    ] {
        let made = Made {
            keys: keys.clone(),
            ..plain()
        };
        assert!((level(&made) - 1200.0 * metres).abs() < 1e-6, "{keys:?}");
    }
}

#[test]
fn values_that_are_no_heights_are_refused_by_name() {
    for (made, word) in [
        (
            plain().with_items(&[("UNITTYPE", 0, "unittype", "degC")]),
            "\"degC\"",
        ),
        (
            Made {
                keys: vec![(4099, 9101)],
                ..plain()
            },
            "EPSG:9101",
        ),
        (
            Made {
                keys: vec![(4096, 5715)],
                ..plain()
            },
            "EPSG:5715 counts depths",
        ),
    ] {
        let text = refusal(&made);
        assert!(
            text.starts_with("dem.tif: ") && text.contains(word),
            "{text}"
        );
    }
}

#[test]
fn of_several_bands_the_first_is_taken_and_this_is_said() {
    let two = [1200_i16, 7].map(i16::to_le_bytes).concat();
    let made = Made {
        samples: 2,
        ..Made::level(16, 2, &two)
    };
    let dem = open(&made).unwrap();
    assert_eq!(at(&dem, 2.0, 3.0), Some(1200.0));
    assert_eq!(
        dem.notes(),
        ["dem.tif: the first of 2 bands is taken for heights."]
    );
    assert!(open(&plain()).unwrap().notes().is_empty());
    // Three bands of colours are none of heights.
    let rgb = Made {
        samples: 3,
        photometric: 2,
        ..Made::level(8, 1, &[9, 9, 9])
    };
    assert!(refusal(&rgb).contains("3 samples of colour"));
}

#[test]
fn a_transparent_post_has_no_height() {
    let mut made = Made {
        samples: 2,
        ..Made::level(8, 1, &[90, 255])
    };
    made.bytes[1] = 0;
    made.more.push((338, 3, 2_u16.to_le_bytes().to_vec()));
    let dem = open(&made).unwrap();
    assert_eq!(at(&dem, 0.0, 0.0), None);
    assert_eq!(at(&dem, 2.0, 2.0), Some(90.0));
    assert!(dem.notes().is_empty());
}

#[test]
fn grey_pictures_are_heights_only_where_they_are_asked_for_as_such() {
    let is_one = |made: &Made| Dem::is_one(Arc::new(MemoryBytes::new("dem.tif", made.write())));
    assert!(!is_one(&Made::level(8, 1, &[7])));
    assert!(!is_one(&Made::level(16, 1, &[7, 7])));
    assert!(!is_one(&Made {
        samples: 3,
        photometric: 2,
        ..Made::level(8, 1, &[9, 9, 9])
    }));
    assert!(is_one(&plain()));
    assert!(is_one(&Made {
        samples: 2,
        ..Made::level(32, 3, &[0; 8])
    }));
}

#[test]
fn a_system_that_is_named_leaves_the_unit_and_the_place_of_pixels() {
    // An unknown projected system, pixels as points, heights in feet.
    let made = Made {
        keys: vec![(4099, 9002)],
        ..plain()
    };
    let mut bytes = made.write();
    let keys = |v: &[u16]| v.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<u8>>();
    let known = keys(&[1025, 0, 1, 1, 2048, 0, 1, 4326]);
    let at_keys = (0..bytes.len()).find(|i| bytes[*i..].starts_with(&known));
    let at_keys = at_keys.unwrap();
    bytes[at_keys..at_keys + 16].copy_from_slice(&keys(&[1025, 0, 1, 2, 2048, 0, 1, 4211]));
    let source = Arc::new(MemoryBytes::new("dem.tif", bytes));
    assert!(Dem::open(source.clone(), None, None).is_err());
    let dem = Dem::open(source, None, Some(ReferenceSystem::Geographic)).unwrap();
    // The tie is the centre of the first pixel, whose edge lies half a pixel further north-west.
    let at = |x: f64, y: f64| {
        let place = Geodetic::from_degrees(CORNER.1 - y * STEP, CORNER.0 + x * STEP, 0.0);
        dem.height_at(&dem.frame().ground_from_geodetic(&place))
    };
    assert!((at(-0.4, -0.4).unwrap() - 365.76).abs() < 1e-9);
    assert_eq!(at(-0.6, 1.0), None);
}

#[test]
fn a_model_is_placed_by_what_lies_beside_it_where_it_says_nothing_itself() {
    let mut bytes = Made::level(16, 2, &300_i16.to_le_bytes()).write();
    // Scale, tie and keys under numbers that mean nothing.
    for (tag, kind) in [(33_550_u16, 12_u16), (33_922, 12), (34_735, 3)] {
        let head = [tag.to_le_bytes(), kind.to_le_bytes()].concat();
        let at = bytes.windows(4).position(|four| four == head).unwrap();
        bytes[at] += 1;
    }
    let mut files = pilotage_base::files::MemoryFiles::default();
    files.0.insert("a/dem.tif".to_owned(), bytes);
    let refused = crate::open_dem(&files, "a/dem.tif", None, None).err();
    assert!(refused.unwrap().to_string().contains("world file"));
    let world = format!("{STEP}\n0\n0\n-{STEP}\n10.0005\n50.0\n");
    files.0.insert("a/dem.tfw".to_owned(), world.into_bytes());
    files
        .0
        .insert("a/dem.prj".to_owned(), b"EPSG:4326".to_vec());
    let dem = crate::open_dem(&files, "a/dem.tif", None, None).unwrap();
    let origin = dem.frame().origin;
    assert!((origin.longitude.to_degrees() - 10.002).abs() < 1e-9);
    assert_eq!(dem.height_at(&GroundPoint::default()), Some(300.0));
}

#[test]
fn what_lies_beside_a_model_that_says_its_place_itself_is_none_of_its_concern() {
    let catalogue = "{\"type\": \"Feature\", \"stac_version\": \"1.0.0\", \"geometry\": null}";
    let sound = format!("{STEP}\n0\n0\n-{STEP}\n99.0\n9.0\n");
    for (name, text) in [
        ("a/dem.json", catalogue),
        ("a/dem.json", "{"),
        ("a/dem.tfw", "no numbers"),
        ("a/dem.tfw", &sound),
        ("a/dem.prj", "PROJCS[\"Nowhere\""),
    ] {
        let bytes = Made::level(16, 2, &300_i16.to_le_bytes()).write();
        let mut files = pilotage_base::files::MemoryFiles::default();
        files.0.insert("a/dem.tif".to_owned(), bytes);
        files.0.insert(name.to_owned(), text.as_bytes().to_vec());
        let dem = crate::open_dem(&files, "a/dem.tif", None, None);
        let dem = dem.unwrap_or_else(|error| panic!("{name} {text}: {error}"));
        assert!(dem.frame().origin.longitude.to_degrees() < 20.0, "{name}");
    }
}
