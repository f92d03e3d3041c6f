//! Bending of the straight plan of fields and woods over the ground.

use super::shape::{Spot, spot};
use super::texture::{LAND_SCALE, PeriodicTexture};

/// Amplitude with which field boundaries wander from the straight lines of the plan, metres.
pub(super) const BEND: f32 = 5.5;

/// Place on the ground at which a place of the straight plan lies.
pub(super) fn bent(land: &PeriodicTexture, planned: Spot) -> Spot {
    let [n, e, ..] = land.sample(planned * LAND_SCALE, 0.01);
    let first = planned - spot(n, e) * BEND;
    let [n, e, ..] = land.sample(first * LAND_SCALE, 0.01);
    planned - spot(n, e) * BEND
}

/// Place in the straight plan at which a place on the ground lies.
pub(super) fn unbent(land: &PeriodicTexture, p: Spot) -> Spot {
    let [n, e, ..] = land.sample(p * LAND_SCALE, 0.01);
    p + spot(n, e) * BEND
}
