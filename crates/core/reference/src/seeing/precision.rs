//! Precision of what is seen, as it was measured.
//!
//! By `pilotage classes places --countries 8 --pictures 12`, shares that are seen, and by
//! `pilotage classes pairs --first 300 --countries 8 --pictures 12`, errors of places: 96 pictures each of eight generated
//! countries from 1000 ft, each on a day of its own between spring and autumn, against tables of the map's day. None of
//! them is the country of the scenarios. The errors are those of the right pairs that are accepted, which make the fix:
//! what is nearest within 8 m, with groups of trees that grew together or fell apart, errs by 1.3 times as much.

use crate::{GenericClass, GenericLandmark};

/// Sizes that divide landmarks into the groups for which errors are measured, metres.
pub const GROUP_SIZES: [f64; 4] = [6.5, 9.0, 13.0, 20.0];

/// Error of the place of an accepted pair per axis (RMS, metres), and share of the landmarks in view that are seen, by size.
type Measured = [(f64, f64); GROUP_SIZES.len() + 1];

/// Of 981 buildings in view, and 1023 pairs.
const BUILDINGS: Measured = [
    (1.17, 0.39),
    (0.75, 0.81),
    (0.50, 0.94),
    (1.11, 0.81),
    (1.28, 0.77),
];
/// Of 1545 trees and groups of trees in view, and 896 pairs.
const TREES: Measured = [
    (1.38, 0.30),
    (1.47, 0.56),
    (2.07, 0.56),
    (2.14, 0.55),
    (2.81, 0.29),
];
/// Of what was in view too seldom to be measured: as bad as a large tree.
const OTHERS: Measured = [(2.6, 0.5); GROUP_SIZES.len() + 1];

/// Standard deviation of the place of a landmark in a picture from that in the map, metres per axis.
pub fn place_deviation(landmark: &GenericLandmark) -> f64 {
    measured(landmark).0
}

/// Probability that a landmark of the table is seen where it is in view.
pub fn detection(landmark: &GenericLandmark) -> f64 {
    (measured(landmark).1 * landmark.stability).clamp(0.05, 0.95)
}

fn measured(landmark: &GenericLandmark) -> (f64, f64) {
    let of_class = match landmark.class {
        GenericClass::Building => &BUILDINGS,
        GenericClass::Tree => &TREES,
        _ => &OTHERS,
    };
    of_class[size_group(landmark.size)]
}

/// Group of landmarks of this size (metres): how many of [`GROUP_SIZES`] are smaller.
pub fn size_group(size: f64) -> usize {
    GROUP_SIZES.partition_point(|least| *least < size)
}
