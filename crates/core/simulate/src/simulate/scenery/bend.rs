//! How the straight plan of fields and woods is bent over the ground.

use super::shape::{Spot, spot};
use super::texture::{LAND_SCALE, Texture};

/// How far field boundaries wander from the straight lines of the plan, metres.
pub(super) const BEND: f32 = 5.5;

/// Where a place of the straight plan lies on the ground.
pub(super) fn bent(land: &Texture, planned: Spot) -> Spot {
    let [n, e, ..] = land.sample(planned * LAND_SCALE, 0.01);
    let first = planned - spot(n, e) * BEND;
    let [n, e, ..] = land.sample(first * LAND_SCALE, 0.01);
    planned - spot(n, e) * BEND
}

/// Where a place on the ground lies in the straight plan.
pub(super) fn unbent(land: &Texture, p: Spot) -> Spot {
    let [n, e, ..] = land.sample(p * LAND_SCALE, 0.01);
    p + spot(n, e) * BEND
}
