//! The whole frame against the map at every heading, height and place that the prior allows: first as finely as
//! there is time for, then around the likeliest places at the full fineness.

use super::evidence::Evidence;
use super::grid::{Grid, Poses};
use super::look::{Look, MapPose};
use super::prior::{PosePrior, REACH};
use super::weighed::Weighed;
use pilotage_base::frames::wrap_pi;

/// Heights over which one ground sample distance serves, as a logarithm.
const HEIGHTS_AT_ONCE: f64 = 0.3;
/// Places of a coarse sweep that are looked at finely.
const LOOKED_AT: usize = 12;

/// A pose at which the frame looks like the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess {
    /// The pose over the map.
    pub at: MapPose,
    /// Which of the possible turns of the stored picture.
    pub turn: usize,
    /// Correlation of the whole frame with the map.
    pub score: f64,
    /// Natural logarithm of likelihood and prior.
    pub log_weight: f64,
    /// Probability of the poses beside this one, all that the prior allows and that the frame shows none
    /// of them taken into account.
    pub probability: f64,
    /// Logarithm (base 10) of the probability that it is none of these, however small.
    pub log_doubt: f64,
    /// What correlations of the frame mean at this height.
    pub evidence: Evidence,
}

/// Whether two poses over ground at `ground_down` are so near that refinement finds each from the other.
pub fn are_beside(a: &MapPose, b: &MapPose, ground_down: f64) -> bool {
    are_within(a, b, 0.15 * (ground_down - a.pose.position_in_world.z), 0.2)
}

/// Whether two poses differ by less than a distance, metres, and a turn, radians.
pub(super) fn are_within(a: &MapPose, b: &MapPose, distance: f64, turn: f64) -> bool {
    let (p, q) = (a.pose.position_in_world, b.pose.position_in_world);
    let apart = (p.x - q.x).hypot(p.y - q.y);
    let turned = wrap_pi(a.pose.attitude.yaw - b.pose.attitude.yaw).abs();
    apart < distance && turned < turn
}

/// The best `most` poses, best first, none beside a better one, with their probabilities. `looks` have the
/// picture turned in the possible ways.
pub fn sweep(looks: &[Look<'_>], prior: &PosePrior, most: usize) -> Vec<Guess> {
    let Some(grid) = Grid::affordable(looks, prior) else {
        return Vec::new();
    };
    let step = grid.step();
    let poses = Poses {
        center: prior.position,
        reach: REACH * prior.position_deviation,
        heights: prior.heights(step),
        headings: prior.heading.candidates(step),
        turns: (0..looks.len()).collect(),
    };
    let mut swept = Weighed::new(prior, &poses, grid);
    let mut at_once: &[f64] = &poses.heights;
    while let Some(&first) = at_once.first() {
        let together = at_once
            .iter()
            .take_while(|h| (**h / first).ln() < HEIGHTS_AT_ONCE)
            .count();
        let (these, rest) = at_once.split_at(together);
        let these = Poses {
            heights: these.to_vec(),
            ..poses.clone()
        };
        swept.look(looks, prior, &these, grid);
        at_once = rest;
    }
    if grid.is_full() {
        return swept.guesses(looks, most);
    }
    let coarse = swept.guesses(looks, LOOKED_AT);
    let full = Grid::full();
    let mut fine = swept.without(looks, &coarse, full);
    for guess in &coarse {
        let around = Poses::around(&looks[guess.turn], guess, grid);
        fine.look(looks, prior, &around, full);
    }
    fine.guesses(looks, most)
}
