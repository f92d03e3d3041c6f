//! The whole frame against the map, coarsely, at every heading, height and place that the prior allows.

use nalgebra::Point3;

use super::ground::GroundPicture;
use super::look::{Look, MapPose};
use super::prior::{PosePrior, REACH};
use pilotage_base::frames::{GroundPoint, GroundRect, Pose, wrap_pi};
use pilotage_raster::raster::{Raster, SearchSpectrum, Template};

/// Pixels across the longer side of the frame.
const ACROSS: f64 = 64.0;
/// Shift of a pixel that the texture forgives, pixels; it is about as wide as its correlation.
const FORGIVEN: f64 = 1.5;
/// Pixels to each side that decide what is bright.
pub(super) const SURROUNDINGS: usize = 6;

/// A pose at which the frame looks like the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guess {
    /// The pose over the map.
    pub at: MapPose,
    /// Which of the possible turns of the stored picture.
    pub turn: usize,
    /// Correlation of the whole frame with the map.
    pub score: f64,
}

impl Guess {
    /// Whether two guesses over ground at `ground_down` mean one: refinement finds each from the other.
    fn is_beside(&self, other: &Self, ground_down: f64) -> bool {
        self.turn == other.turn && are_beside(&self.at, &other.at, ground_down)
    }
}

/// The best `most` poses, best first, none beside a better one. `looks` have the picture turned in the
/// possible ways.
pub fn sweep(looks: &[Look<'_>], prior: &PosePrior, most: usize) -> Vec<Guess> {
    let mut guesses: Vec<Guess> = Vec::new();
    for height in prior.heights(2.0 * FORGIVEN / (0.5 * ACROSS)) {
        for (turn, look) in looks.iter().enumerate() {
            guesses.extend(
                at_height(look, prior, height, most).map(|(at, score)| Guess { at, turn, score }),
            );
        }
    }
    guesses.sort_by(|a, b| b.score.total_cmp(&a.score));
    let mut kept: Vec<Guess> = Vec::new();
    for guess in guesses {
        let known = |k: &Guess| k.is_beside(&guess, looks[guess.turn].ground_down);
        if kept.len() < most && !kept.iter().any(known) {
            kept.push(guess);
        }
    }
    kept
}

/// Whether two poses over ground at `ground_down` are so near that refinement finds each from the other.
pub fn are_beside(a: &MapPose, b: &MapPose, ground_down: f64) -> bool {
    let (p, q) = (a.pose.position_in_world, b.pose.position_in_world);
    let distance = (p.x - q.x).hypot(p.y - q.y);
    let turn = wrap_pi(a.pose.attitude.yaw - b.pose.attitude.yaw).abs();
    distance < 0.15 * (ground_down - p.z) && turn < 0.2
}

/// Poses at one height, with their scores.
fn at_height(
    look: &Look<'_>,
    prior: &PosePrior,
    height: f64,
    most: usize,
) -> impl Iterator<Item = (MapPose, f64)> {
    let mut found = Vec::new();
    let down = look.ground_down - height;
    let above = |heading: f64, below: GroundPoint| MapPose {
        pose: Pose {
            position_in_world: Point3::new(below.north, below.east, down),
            attitude: prior.attitude(heading),
        },
        shape: prior.shape,
    };
    let extent = look.footprint(&above(0.0, prior.position));
    let Some(extent) = extent else {
        return found.into_iter();
    };
    let gsd = extent.width().max(extent.height()) / ACROSS;
    // The frame at any heading, tilted by the prior, lies in a circle about the farther of its ends.
    let reach = REACH * prior.position_deviation;
    let half = extent
        .corners()
        .into_iter()
        .map(|c| c.distance(&prior.position));
    let side = 2.0 * (reach + half.fold(0.0, f64::max) + gsd);
    let area = GroundRect::centered(prior.position, side, side);
    let ground = GroundPicture::of_map(look.map, &area, gsd, SURROUNDINGS);
    let search = SearchSpectrum::new(&ground.texture);
    for heading in prior.heading.candidates(2.0 * FORGIVEN / (0.5 * ACROSS)) {
        let at = above(heading, prior.position);
        let rect = look.footprint(&at);
        // Cut at the pixels of the map, so that offsets are whole.
        let Some((window, (left, top))) = rect.and_then(|r| ground.window.touching(&r)) else {
            continue;
        };
        let frame = GroundPicture::of_frame(look, &at, &window, SURROUNDINGS);
        let Some(template) = Template::new(&frame.texture) else {
            continue;
        };
        for (column, row, score) in peaks(&search.correlate(&template), most) {
            let east = (column as f64 - left as f64) * gsd;
            let north = (top as f64 - row as f64) * gsd;
            if east.abs() > reach + gsd || north.abs() > reach + gsd {
                continue;
            }
            let place = GroundPoint::new(prior.position.north + north, prior.position.east + east);
            found.push((above(heading, place), f64::from(score)));
        }
    }
    found.into_iter()
}

/// The highest `most` local maxima: column, row, value.
fn peaks(surface: &Raster<f32>, most: usize) -> Vec<(usize, usize, f32)> {
    let (width, height) = (surface.width(), surface.height());
    let mut found: Vec<(usize, usize, f32)> = Vec::new();
    for row in 0..height {
        for column in 0..width {
            let value = surface.get(column, row);
            if found.len() == most && value <= found[most - 1].2 {
                continue;
            }
            let summit = (row.saturating_sub(1)..(row + 2).min(height)).all(|r| {
                (column.saturating_sub(1)..(column + 2).min(width))
                    .all(|c| surface.get(c, r) <= value)
            });
            if summit {
                found.push((column, row, value));
                found.sort_by(|a, b| b.2.total_cmp(&a.2));
                found.truncate(most);
            }
        }
    }
    found
}
