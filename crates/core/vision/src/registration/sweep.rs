//! The whole frame against the map at every heading, height and place that the prior allows: first as finely as
//! there is time for, then around the likeliest places at the full fineness.

use super::grid::{Grid, Poses};
use super::guess::Guess;
use super::limits::REACH;
use super::look::Look;
use super::prior::PosePrior;
use super::weighed::Weighed;

/// Heights over which one ground sample distance serves, as a logarithm.
const HEIGHTS_AT_ONCE: f64 = 0.3;
/// Places of a coarse sweep that are looked at finely.
const LOOKED_AT: usize = 12;

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
