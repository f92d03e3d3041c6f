//! Elevation models in `GeoTIFF` files whose place says something of their heights.

use std::sync::Arc;

use super::made_tiffs::{CORNER, Made, STEP};
use super::*;
use pilotage_base::bytes::MemoryBytes;
use pilotage_base::frames::Geodetic;

/// Posts of 1200 in a file of `GeoTIFF` 1.1 with heights above EGM96.
fn above_egm96() -> Made {
    Made {
        minor: 1,
        keys: vec![(4096, 5773)],
        ..Made::level(16, 2, &1200_i16.to_le_bytes())
    }
}

fn open(made: &Made) -> Dem {
    let source = Arc::new(MemoryBytes::new("dem.tif", made.write()));
    Dem::open(source, None, None).unwrap()
}

/// Height of the second post of the second row.
fn height(made: &Made) -> f64 {
    let dem = open(made);
    let place = Geodetic::from_degrees(CORNER.1 - 1.5 * STEP, CORNER.0 + 1.5 * STEP, 0.0);
    let place = dem.frame().ground_from_geodetic(&place);
    dem.height_at(&place).unwrap()
}

#[test]
fn third_numbers_of_pixel_and_tie_are_scale_and_offset_beside_a_system_of_heights() {
    // Scales and offsets by GDAL 3.10.3 (rasterio 1.4.4) for the same files.
    let cases = [
        ([0.1, 0.0, 0.0], 120.0),
        ([0.1, 0.0, 100.0], 220.0),
        ([0.1, 10.0, 100.0], 219.0),
        ([1.0, 0.0, 100.0], 1300.0),
        ([1.0, 10.0, 0.0], 1190.0),
        ([-1.0, 0.0, 0.0], -1200.0),
        ([1.0, 0.0, 0.0], 1200.0),
        // All heights would be the same: a 0 says nothing.
        ([0.0, 0.0, 0.0], 1200.0),
        ([0.0, 10.0, 100.0], 1200.0),
    ];
    for (third, right) in cases {
        let made = Made {
            third,
            ..above_egm96()
        };
        let found = height(&made);
        assert!((found - right).abs() < 1e-9, "{third:?}: {found}");
    }
    // They go before the band's own scale, and their unit is that of the heights.
    let third = [0.1, 0.0, 100.0];
    let both = Made {
        third,
        ..above_egm96()
    };
    let both = both.with_items(&[("SCALE", 0, "scale", "0.5")]);
    assert!((height(&both) - 220.0).abs() < 1e-9);
    let feet = Made {
        third,
        keys: vec![(4096, 8228)],
        ..above_egm96()
    };
    assert!((height(&feet) - 220.0 * 0.3048).abs() < 1e-9);
    // Nor without a system of heights, nor in GeoTIFF 1.0, of whose systems of heights GDAL takes no note.
    let third = [0.1, 0.0, 0.0];
    let (keys, minor) = (Vec::new(), 0);
    for made in [
        Made {
            keys,
            third,
            ..above_egm96()
        },
        Made {
            minor,
            third,
            ..above_egm96()
        },
    ] {
        assert!((height(&made) - 1200.0).abs() < 1e-9);
    }
}

#[test]
fn heights_of_systems_of_three_dimensions_are_above_the_ellipsoid() {
    for geographic in [4979, 4937, 7912, 6319, 7843] {
        let made = Made {
            keys: Vec::new(),
            geographic,
            ..above_egm96()
        };
        let dem = open(&made);
        assert_eq!(*dem.datum(), HeightDatum::Ellipsoid, "{geographic}");
        let origin = dem.frame().origin;
        let off = origin.longitude.to_degrees() - (CORNER.0 + 2.0 * STEP);
        assert!(off.abs() < 1e-9, "{geographic}: {off}");
    }
}
