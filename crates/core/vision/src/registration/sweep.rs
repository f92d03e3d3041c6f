//! The whole frame against the map at every heading, height and place that the prior allows: first as finely as
//! there is time for, then around the likeliest places at the full fineness. Of the ways in which the picture may be
//! stored, those after the first are looked at only where the first leaves doubt.

use super::grid::{Poses, SweepGrid, cell};
use super::guess::{BELIEVED, PoseGuess};
use super::limits::REACH;
use super::look::FrameLook;
use super::prior::PosePrior;
use super::weighed::WeighedPoses;

/// Heights over which one ground sample distance serves, as a logarithm.
const HEIGHTS_AT_ONCE: f64 = 0.3;
/// Places of a coarse sweep that are looked at finely.
const LOOKED_AT: usize = 12;
/// Likeliest places that are looked at once more where there is doubt, and the probability of the likeliest below which
/// that cannot help.
const LIKELY: usize = 2;
const HOPELESS: f64 = 0.2;
/// Doubt, as a logarithm (base 10), with which no other turn of the picture is looked at; as much of it as they have of
/// the prior is that it lies in one of them.
const LITTLE_DOUBT: f64 = -2.0;

/// The best `most` poses, best first, none beside a better one, with their probabilities. `looks` have the
/// picture turned in the possible ways, the one to be tried first before the others.
pub fn sweep(looks: &[FrameLook<'_>], prior: &PosePrior, most: usize) -> Vec<PoseGuess> {
    let Some(grid) = SweepGrid::affordable(looks, prior) else {
        return Vec::new();
    };
    let step = grid.step();
    let (heights, headings) = (prior.heights(step), prior.heading.candidates(step));
    let mut poses = Poses {
        center: prior.position,
        reach: REACH * prior.position_deviation,
        cell: cell(&headings, &heights),
        heights,
        headings,
        turns: (0..looks.len()).collect(),
    };
    let mut swept = WeighedPoses::new(prior, &poses, grid);
    let mut left = poses.turns.split_off(1);
    loop {
        look_at_all(&mut swept, looks, prior, &poses, grid);
        let guesses = finely(&mut swept, looks, prior, grid, most);
        let is_sure = |best: &PoseGuess| best.log_doubt <= LITTLE_DOUBT;
        if left.is_empty() || guesses.first().is_some_and(is_sure) {
            return guesses;
        }
        poses.turns = std::mem::take(&mut left);
    }
}

/// Looks at all poses, as many heights at once as one ground sample distance serves.
fn look_at_all(
    swept: &mut WeighedPoses,
    looks: &[FrameLook<'_>],
    prior: &PosePrior,
    poses: &Poses,
    grid: SweepGrid,
) {
    let mut at_once: &[f64] = &poses.heights;
    while let Some(&first) = at_once.first() {
        let are_near = |h: &&f64| (**h / first).ln() < HEIGHTS_AT_ONCE;
        // The first goes with itself, even where it is no number.
        let together = at_once.iter().take_while(are_near).count().max(1);
        let (these, rest) = at_once.split_at(together);
        let these = Poses {
            heights: these.to_vec(),
            ..poses.clone()
        };
        swept.look(looks, prior, &these, grid);
        at_once = rest;
    }
}

/// The best `most` poses of what was swept; the likeliest of a coarse grid are looked at at the full fineness first, and
/// the likeliest of all once more still more finely where that leaves doubt.
fn finely(
    swept: &mut WeighedPoses,
    looks: &[FrameLook<'_>],
    prior: &PosePrior,
    grid: SweepGrid,
    most: usize,
) -> Vec<PoseGuess> {
    if !grid.is_full() {
        let coarse = swept.guesses(looks, LOOKED_AT);
        // Half a step to each side: between them.
        return again(swept, looks, prior, &coarse, (grid, 0.5, SweepGrid::full()))
            .guesses(looks, most);
    }
    let guesses = swept.guesses(looks, most);
    let Some(best) = guesses.first() else {
        return guesses;
    };
    if best.probability >= BELIEVED || best.probability < HOPELESS {
        return guesses;
    }
    let likely: Vec<PoseGuess> = guesses.iter().take(LIKELY).copied().collect();
    again(
        swept,
        looks,
        prior,
        &likely,
        (grid, 1.0, SweepGrid::finest()),
    )
    .guesses(looks, most)
}

/// Sweep with some places looked at on a finer grid, up to some steps of the coarse one to each side.
fn again(
    swept: &WeighedPoses,
    looks: &[FrameLook<'_>],
    prior: &PosePrior,
    guesses: &[PoseGuess],
    (grid, steps, finer): (SweepGrid, f64, SweepGrid),
) -> WeighedPoses {
    let mut fine = swept.without(looks, guesses, finer);
    for guess in guesses {
        let around = Poses::around((&looks[guess.turn], prior), guess, grid, steps, finer);
        fine.look(looks, prior, &around, finer);
    }
    fine
}
