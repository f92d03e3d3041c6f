//! Poses weighed by likelihood and prior.

use super::evidence::Evidence;
use super::grid::{Poses, SweepGrid, above, area};
use super::ground::{GroundPicture, Texture};
use super::guess::{PoseGuess, are_within};
use super::lattice::{LatticePrior, reach_on};
use super::look::{FrameLook, MapPose};
use super::prior::PosePrior;
use pilotage_base::frames::GroundPoint;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{ChannelSearch, ChannelSurface, ChannelTemplate, Gray};

/// Places to each side from which chance is told, pixels, and headings at which it is.
const CHANCE_REACH: f64 = 12.0;
const CHANCES: usize = 3;
/// Summits kept of each heading and height.
const SUMMITS: usize = 8;
/// Share of a frame that must lie over the map.
const LEAST_SHARE: f32 = 0.15;
/// Logarithm of a weight against the heaviest below which it does not matter to the others' probability.
const NEGLIGIBLE: f64 = 25.0;
/// The same for its own.
const LIGHT: f64 = 7.0;
/// Heavy poses kept at most.
const HEAVY: usize = 60_000;
/// Probability, before it is looked at, that the frame shows nothing that the map has where it is looked for.
const NOT_HERE: f64 = 0.1;
/// Logarithm (base 10) of the least doubt that is told: models are not surer.
const LEAST_DOUBT: f64 = -9.0;

/// Poses that were looked at.
#[derive(Clone, Debug)]
pub(super) struct WeighedPoses {
    /// The highest summits at each heading and height.
    summits: Vec<PoseGuess>,
    /// All poses that say much: the pose, its turn, its weight.
    heavy: Vec<(MapPose, usize, f64)>,
    heaviest: f64,
    /// Sum of likelihood times prior over all poses that were looked at, and of the prior alone over those.
    weight: f64,
    prior_seen: f64,
    /// Sum of the prior over all poses, seen or not.
    prior_all: f64,
    /// Part of the prior that the first look did not reach, if this is a second, which sees none of it but once more.
    off_the_map: Option<f64>,
    /// Distance, against the height, and turn within which poses are one.
    beside: (f64, f64),
}

impl WeighedPoses {
    /// Before anything was looked at of `poses`.
    pub fn new(prior: &PosePrior, poses: &Poses, grid: SweepGrid) -> Self {
        let place = LatticePrior::sum(prior);
        let each = poses.heights.iter().flat_map(|height| {
            poses
                .headings
                .iter()
                .map(|heading| prior.log_density(*height, *heading).exp())
        });
        Self {
            summits: Vec::new(),
            heavy: Vec::new(),
            heaviest: f64::NEG_INFINITY,
            weight: 0.0,
            prior_seen: 0.0,
            prior_all: each.sum::<f64>() * place * poses.cell * poses.turns.len() as f64,
            off_the_map: None,
            beside: grid.beside(),
        }
    }

    /// Rest without the poses beside `guesses`, to be looked at on a finer grid.
    ///
    /// Light poses may lie on the slopes of what is taken away; chance is expected to give all poses together
    /// the weight of their prior.
    pub fn without(&self, looks: &[FrameLook<'_>], guesses: &[PoseGuess], grid: SweepGrid) -> Self {
        let left = self.heavy.iter().filter(|(at, turn, _)| {
            let mut guesses = guesses.iter();
            !guesses.any(|guess| self.is_beside(looks, guess, at, *turn))
        });
        Self {
            summits: Vec::new(),
            heavy: Vec::new(),
            heaviest: f64::NEG_INFINITY,
            weight: left.map(|(_, _, weight)| weight).sum::<f64>() + self.prior_seen,
            off_the_map: Some(self.off_the_map()),
            beside: grid.beside(),
            ..*self
        }
    }

    /// Whether a pose is one with a guess.
    fn is_beside(
        &self,
        looks: &[FrameLook<'_>],
        guess: &PoseGuess,
        at: &MapPose,
        turn: usize,
    ) -> bool {
        let height = looks[turn].ground_down - guess.at.pose.position_in_world.z;
        guess.turn == turn && are_within(&guess.at, at, self.beside.0 * height, self.beside.1)
    }

    /// All that the probabilities share.
    fn all(&self) -> f64 {
        self.weight + self.off_the_map() + self.nothing()
    }

    /// Part of the prior where there is no map, or that was not looked at.
    fn off_the_map(&self) -> f64 {
        let left = (self.prior_all - self.prior_seen).max(0.0);
        self.off_the_map.unwrap_or(left)
    }

    /// Weight of the frame showing nothing that the map has.
    fn nothing(&self) -> f64 {
        NOT_HERE / (1.0 - NOT_HERE) * self.prior_all
    }

    /// Looks at poses whose heights one ground sample distance serves.
    pub fn look(
        &mut self,
        looks: &[FrameLook<'_>],
        prior: &PosePrior,
        poses: &Poses,
        grid: SweepGrid,
    ) {
        let Some((place, height)) = looks.first().zip(poses.heights.last()) else {
            return;
        };
        let Some(extent) = place.footprint(&above(place, prior, *height, 0.0, poses.center)) else {
            return;
        };
        let gsd = grid.gsd(&extent);
        let reach = reach_on(poses.reach, gsd);
        // Chance is told from places beyond those that count, too.
        let looked_at = reach.max(CHANCE_REACH * gsd) + gsd;
        let Some(area) = area(looks, prior, poses.center, looked_at, *height) else {
            return;
        };
        let ground = GroundPicture::of_map(place.map, &area, gsd, Texture::EdgesAndContrast, 0);
        let search = ChannelSearch::new(&ground.channels, &ground.covered);
        // Where it is cut out of the map does not matter, as long as that is on it.
        let cut = |look: &FrameLook<'_>, height: f64, heading: f64| {
            let at = above(look, prior, height, heading, area.center());
            let (template, corner) =
                frame_template(look, &at, &ground.window, Texture::EdgesAndContrast)?;
            Some((at, template, corner))
        };
        let apart = poses.headings.len().div_ceil(CHANCES);
        let by_chance = poses.headings.iter().step_by(apart).filter_map(|heading| {
            let (_, template, _) = cut(place, *height, *heading)?;
            search.correlate(&template.turned_half())
        });
        let Some(evidence) = Evidence::from_chance(by_chance) else {
            return;
        };
        for height in &poses.heights {
            for (turn, heading) in poses
                .turns
                .iter()
                .flat_map(|turn| poses.headings.iter().map(move |heading| (*turn, *heading)))
            {
                let Some(look) = looks.get(turn) else {
                    continue;
                };
                let Some((at, template, corner)) = cut(look, *height, heading) else {
                    continue;
                };
                if let Some(surface) = search.correlate(&template) {
                    let seen = FrameAtHeading {
                        at,
                        height: *height,
                        turn,
                        surface: &surface,
                        corner,
                        gsd,
                        reach,
                        cell: poses.cell,
                        evidence,
                    };
                    self.weigh(&seen, prior, poses.center);
                }
            }
        }
    }

    /// Weighs all places of one heading and height.
    fn weigh(&mut self, seen: &FrameAtHeading<'_>, prior: &PosePrior, center: GroundPoint) {
        let score = &seen.surface.score;
        let of_pose = prior.log_density(seen.height, seen.at.pose.attitude.yaw);
        let cell = seen.cell * seen.gsd * seen.gsd;
        let places = LatticePrior::new(prior, seen.gsd);
        let mut summits = Summits::default();
        for row in 0..score.height() {
            for column in 0..score.width() {
                let below = seen.below(column, row);
                let (north, east) = (below.north - center.north, below.east - center.east);
                let share = seen.surface.share_at(row * score.width() + column);
                if north.abs() > seen.reach || east.abs() > seen.reach || share < LEAST_SHARE {
                    continue;
                }
                let log_prior = of_pose + places.log_density(&below);
                if log_prior == f64::NEG_INFINITY {
                    continue;
                }
                let value = f64::from(score.get(column, row));
                let log_weight = seen.evidence.log_likelihood(value, f64::from(share)) + log_prior;
                self.prior_seen += log_prior.exp() * cell;
                if log_weight > self.heaviest - NEGLIGIBLE {
                    let weight = log_weight.min(600.0).exp() * cell;
                    self.weight += weight;
                    if log_weight > self.heaviest - LIGHT {
                        self.heaviest = self.heaviest.max(log_weight);
                        self.heavy.push((seen.pose(column, row), seen.turn, weight));
                    }
                }
                summits.offer(score, column, row, log_weight);
            }
        }
        if self.heavy.len() > HEAVY {
            self.heavy.sort_by(|a, b| b.2.total_cmp(&a.2));
            self.heavy.truncate(HEAVY / 2);
        }
        let of_summit = |&(column, row, log_weight): &(usize, usize, f64)| PoseGuess {
            at: seen.pose(column, row),
            turn: seen.turn,
            score: f64::from(score.get(column, row)),
            log_weight,
            probability: 0.0,
            log_doubt: 0.0,
            evidence: seen.evidence,
        };
        self.summits.extend(summits.found.iter().map(of_summit));
    }

    /// The best `most`, none beside a better one, with the probability of all that is beside each.
    pub fn guesses(&mut self, looks: &[FrameLook<'_>], most: usize) -> Vec<PoseGuess> {
        self.summits
            .sort_by(|a, b| b.log_weight.total_cmp(&a.log_weight));
        let mut kept: Vec<PoseGuess> = Vec::new();
        for guess in &self.summits {
            if kept.len() == most {
                break;
            }
            let is_known = |k: &PoseGuess| self.is_beside(looks, k, &guess.at, guess.turn);
            if !kept.iter().any(is_known) {
                kept.push(*guess);
            }
        }
        let (all, nothing) = (self.all(), self.nothing());
        for (at, turn, weight) in &self.heavy {
            let own = kept
                .iter_mut()
                .find(|k| self.is_beside(looks, k, at, *turn));
            if let Some(own) = own {
                own.probability += weight / all;
            }
        }
        for guess in &mut kept {
            let doubt = (1.0 - guess.probability).max(nothing / all);
            guess.log_doubt = doubt.log10().max(LEAST_DOUBT);
        }
        kept
    }
}

/// A frame at one heading and height against the map.
struct FrameAtHeading<'a> {
    /// Its pose where it was cut out.
    at: MapPose,
    /// Above the ground, metres.
    height: f64,
    turn: usize,
    surface: &'a ChannelSurface,
    /// Column and row at which it was cut out.
    corner: (usize, usize),
    gsd: f64,
    reach: f64,
    /// Radians times logarithm of the height that it stands for.
    cell: f64,
    evidence: Evidence,
}

impl FrameAtHeading<'_> {
    /// The place below the camera with the frame's corner at a place of the surface.
    fn below(&self, column: usize, row: usize) -> GroundPoint {
        let from = self.at.pose.position_in_world;
        GroundPoint::new(
            from.x + (self.corner.1 as f64 - row as f64) * self.gsd,
            from.y + (column as f64 - self.corner.0 as f64) * self.gsd,
        )
    }

    fn pose(&self, column: usize, row: usize) -> MapPose {
        let below = self.below(column, row);
        let mut at = self.at;
        at.pose.position_in_world.x = below.north;
        at.pose.position_in_world.y = below.east;
        at
    }
}

/// The frame as it would lie on `window`, and where in it.
pub(super) fn frame_template(
    look: &FrameLook<'_>,
    at: &MapPose,
    window: &Window,
    texture: Texture,
) -> Option<(ChannelTemplate, (usize, usize))> {
    // Cut at the pixels of the map, so that offsets are whole.
    let (part, corner) = window.touching(&look.footprint(at)?)?;
    let frame = GroundPicture::of_frame(look, at, &part, texture, 0);
    let template = ChannelTemplate::new(&frame.channels, &frame.covered)?;
    Some((template, corner))
}

/// The heaviest summits of a surface: column, row, weight; best first.
#[derive(Default)]
struct Summits {
    found: Vec<(usize, usize, f64)>,
}

impl Summits {
    /// Takes a place if it is a summit of `surface` and among the best.
    fn offer(&mut self, surface: &Gray, column: usize, row: usize, weight: f64) {
        if self.found.len() == SUMMITS && weight <= self.found[SUMMITS - 1].2 {
            return;
        }
        let value = surface.get(column, row);
        let (width, height) = (surface.width(), surface.height());
        let is_summit = (row.saturating_sub(1)..(row + 2).min(height)).all(|r| {
            (column.saturating_sub(1)..(column + 2).min(width)).all(|c| surface.get(c, r) <= value)
        });
        if is_summit {
            self.found.push((column, row, weight));
            self.found.sort_by(|a, b| b.2.total_cmp(&a.2));
            self.found.truncate(SUMMITS);
        }
    }
}

#[cfg(test)]
#[path = "weighed_tests.rs"]
mod tests;
