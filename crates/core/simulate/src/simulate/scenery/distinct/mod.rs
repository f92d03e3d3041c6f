//! The distinct places: the nine buildings under the first leg, the pool, and a few elsewhere.
//!
//! Their layout is the same for every seed; flight scenarios rely on it.

mod board;
mod country;
mod elsewhere;
mod public;
mod works;

use super::plan::SceneryPlan;

/// Builds all of them, in the order in which the first flights meet them.
pub(super) fn build(plan: &mut SceneryPlan) {
    country::dairy_barn(plan);
    country::greenhouses(plan);
    country::church(plan);
    public::school(plan);
    public::sports_hall(plan);
    public::hospital(plan);
    works::supermarket(plan);
    works::water_tanks(plan);
    works::sawtooth_factory(plan);
    country::pool(plan);
    works::warehouse(plan);
    elsewhere::running_track(plan);
    elsewhere::quarry(plan);
    elsewhere::cemetery(plan);
}
