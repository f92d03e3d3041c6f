//! Precision of what is seen, as it was measured.
//!
//! By `pilotage classes places --countries 8 --pictures 12`: 96 pictures of eight generated countries from 1000 ft,
//! each on a day of its own between spring and autumn, against tables of the map's day. None of them is the country of
//! the scenarios.

use crate::{GenericClass, GenericLandmark};

/// Sizes that divide landmarks into the groups for which errors are measured, metres.
pub const GROUP_SIZES: [f64; 4] = [6.5, 9.0, 13.0, 20.0];

/// Error of a place per axis (RMS, metres), and share of the landmarks in view that are seen, by size.
type Measured = [(f64, f64); GROUP_SIZES.len() + 1];

/// Of 981 buildings in view.
const BUILDINGS: Measured = [
    (1.9, 0.39),
    (0.93, 0.81),
    (0.78, 0.94),
    (1.56, 0.81),
    (2.98, 0.77),
];
/// Of 1545 trees and groups of trees in view.
const TREES: Measured = [
    (2.04, 0.30),
    (1.73, 0.56),
    (2.35, 0.56),
    (2.61, 0.55),
    (2.26, 0.29),
];
/// Of what was in view too seldom to be measured: as bad as a large tree.
const OTHERS: Measured = [(2.6, 0.5); GROUP_SIZES.len() + 1];

/// Deviation of the place of a landmark in a picture from that in the map, metres per axis.
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
