//! Fineness of the grid on which poses are tried.

use super::guess::{BESIDE, PoseGuess};
use super::limits::REACH;
use super::look::{FrameLook, MapPose};
use super::prior::{PosePrior, spread};
use nalgebra::Point3;
use pilotage_base::frames::{GroundPoint, GroundRect, Pose, wrap_pi};

/// Pixels across the longer side of the frame.
const ACROSS: f64 = 96.0;
/// Fewest pixels across that still tell one place from another.
const LEAST_ACROSS: f64 = 36.0;
/// Shift of a pixel at the edge of the frame that the edges forgive, pixels; it is about as wide as they are
/// spread.
const FORGIVEN: f64 = 2.5;
/// Pixels of the map times headings times heights that there is time for: some 0.3 s.
const AFFORDABLE: f64 = 5e6;

/// The fineness of a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SweepGrid {
    /// Pixels across the longer side of the frame.
    pub across: f64,
}

/// Poses that are tried.
#[derive(Clone, Debug)]
pub(super) struct Poses {
    /// Place around which it is looked for.
    pub center: GroundPoint,
    /// Distance to each side of that place, metres.
    pub reach: f64,
    /// Heights above the ground plane, metres.
    pub heights: Vec<f64>,
    /// Headings, radians.
    pub headings: Vec<f64>,
    /// Radians times logarithm of the height that each stands for.
    pub cell: f64,
    /// Turns of the stored picture that are tried, by their indices.
    pub turns: Vec<usize>,
}

impl SweepGrid {
    /// The grid of the finest whole sweep.
    pub fn full() -> Self {
        Self { across: ACROSS }
    }

    /// The grid on which doubtful places are looked at once more.
    pub fn finest() -> Self {
        Self {
            across: 1.5 * ACROSS,
        }
    }

    /// Whether no whole sweep is finer.
    pub fn is_full(self) -> bool {
        self.across >= ACROSS
    }

    /// From one heading to the next, radians, and from one height to the next, as a logarithm.
    pub fn step(self) -> f64 {
        2.0 * FORGIVEN / (0.5 * self.across)
    }

    /// Distance, against the height, and turn within which poses are one: what is found from one of them is
    /// found from the other, and neighbours on the grid are one.
    pub fn beside(self) -> (f64, f64) {
        let coarser = ACROSS / self.across;
        let (distance, turn) = BESIDE;
        (distance.max(0.06 * coarser), turn.max(1.2 * self.step()))
    }

    /// The ground sample distance for a frame that covers `extent`.
    pub fn gsd(self, extent: &GroundRect) -> f64 {
        extent.width().max(extent.height()) / self.across
    }

    /// The finest for which there is time; `None` if the frame does not look down.
    pub fn affordable(looks: &[FrameLook<'_>], prior: &PosePrior) -> Option<Self> {
        let full = Self::full();
        let look = looks.first()?;
        let extent = look.footprint(&above(look, prior, prior.height, 0.0, prior.position))?;
        let area = area(
            looks,
            prior,
            prior.position,
            REACH * prior.position_deviation,
            prior.height,
        )?;
        let pixels = area.width() * area.height() / full.gsd(&extent).powi(2);
        let tried = prior.heights(full.step()).len()
            * prior.heading.candidates(full.step()).len()
            * looks.len();
        // Twice as fine means four times the pixels, and twice the headings and the heights.
        let share = (AFFORDABLE / (pixels * tried as f64)).powf(0.25);
        Some(Self {
            across: (ACROSS * share).clamp(LEAST_ACROSS, ACROSS),
        })
    }
}

impl Poses {
    /// Poses of a finer grid up to `steps` of a coarse one to each side of a guess, no farther than the prior is wide.
    pub fn around(
        (look, prior): (&FrameLook<'_>, &PosePrior),
        guess: &PoseGuess,
        grid: SweepGrid,
        steps: f64,
        finer: SweepGrid,
    ) -> Self {
        let position = guess.at.pose.position_in_world;
        let height = look.ground_down - position.z;
        let side = steps * grid.step();
        let between = |most: f64| spread(side.min(most), finer.step());
        let heading = guess.at.pose.attitude.yaw;
        let extent = look.footprint(&guess.at);
        let heights: Vec<f64> = between(REACH * prior.log_height_deviation)
            .map(|off| height * off.exp())
            .collect();
        let headings: Vec<f64> = between(prior.heading.farthest())
            .map(|off| wrap_pi(heading + off))
            .collect();
        Self {
            center: GroundPoint::new(position.x, position.y),
            reach: 5.0 * steps * extent.map_or(0.0, |extent| grid.gsd(&extent)),
            cell: cell(&headings, &heights),
            heights,
            headings,
            turns: vec![guess.turn],
        }
    }
}

/// Radians times logarithm of the height that one of these poses stands for: as far as they lie from one another, and on
/// every grid the same where there is one alone, which is held.
pub(super) fn cell(headings: &[f64], heights: &[f64]) -> f64 {
    let alone = SweepGrid::full().step();
    let turned = match headings {
        [a, b, ..] => wrap_pi(b - a).abs(),
        _ => alone,
    };
    let higher = match heights {
        [a, b, ..] => (b / a).ln().abs(),
        _ => alone,
    };
    turned * higher
}

/// The pose with this height and heading over a place.
pub(super) fn above(
    look: &FrameLook<'_>,
    prior: &PosePrior,
    height: f64,
    heading: f64,
    below: GroundPoint,
) -> MapPose {
    MapPose {
        pose: Pose {
            position_in_world: Point3::new(below.north, below.east, look.ground_down - height),
            attitude: prior.attitude(heading),
        },
        shape: prior.shape,
    }
}

/// The ground that the frame may show at any heading, up to `height` and `reach` metres around `center`, no
/// farther than half a frame beyond the map; `None` if that is nowhere.
pub(super) fn area(
    looks: &[FrameLook<'_>],
    prior: &PosePrior,
    center: GroundPoint,
    reach: f64,
    height: f64,
) -> Option<GroundRect> {
    // The frame, tilted by the prior, lies in a circle about the farther of its ends.
    let ends = looks
        .iter()
        .filter_map(|look| look.footprint(&above(look, prior, height, 0.0, center)))
        .flat_map(|extent| extent.corners());
    let half = ends.map(|c| c.distance(&center)).fold(0.0, f64::max);
    let side = 2.0 * (reach + half);
    let wanted = GroundRect::centered(center, side, side);
    let map = looks.first()?.map.bounds().grown(half);
    let cut = wanted.intersection(&map)?;
    (half > 0.0 && cut.north > cut.south && cut.east > cut.west).then_some(cut)
}

#[cfg(test)]
mod tests {
    use super::super::evidence::Evidence;
    use super::super::prior_for_tests::{GreyFrame, around, usual_prior};
    use super::*;
    use pilotage_raster::camera::CameraModel;

    /// A prior with standard deviations of the height's logarithm and of the heading, radians.
    fn prior(log_height_deviation: f64, deviation: f64) -> PosePrior {
        PosePrior {
            height: 103.0,
            log_height_deviation,
            heading: around(0.4, deviation),
            ..usual_prior()
        }
    }

    /// The sum of the prior's density over heights and headings, times the cell of each.
    fn sum(prior: &PosePrior, poses: &Poses) -> f64 {
        let each = poses.heights.iter().flat_map(|height| {
            let density = |heading: &f64| prior.log_density(*height, *heading).exp();
            poses.headings.iter().map(density)
        });
        each.sum::<f64>() * poses.cell
    }

    #[test]
    fn a_finer_grid_sums_a_prior_to_as_much_as_the_coarse_one_however_sharp_it_is() {
        let frame = GreyFrame::new(CameraModel::pinhole(64, 48, 1.0));
        let look = frame.look();
        let grid = SweepGrid::full();
        for (of_height, of_heading) in [(0.0, 0.0), (0.0, 0.05), (0.004, 0.002), (0.03, 0.04)] {
            let prior = prior(of_height, of_heading);
            let (heights, headings) = (
                prior.heights(grid.step()),
                prior.heading.candidates(grid.step()),
            );
            let coarse = Poses {
                center: prior.position,
                reach: 0.0,
                cell: cell(&headings, &heights),
                heights,
                headings,
                turns: vec![0],
            };
            let guess = PoseGuess {
                at: above(&look, &prior, 103.0, 0.4, prior.position),
                turn: 0,
                score: 0.5,
                log_weight: 0.0,
                probability: 0.5,
                log_doubt: -0.3,
                evidence: Evidence { chance: 0.1 },
            };
            let fine = Poses::around((&look, &prior), &guess, grid, 1.0, SweepGrid::finest());
            let ratio = sum(&prior, &fine) / sum(&prior, &coarse);
            assert!(
                (ratio - 1.0).abs() < 0.2,
                "{of_height} {of_heading}: {ratio}"
            );
            if of_height == 0.0 {
                assert!(
                    fine.heights.iter().all(|h| (h - 103.0).abs() < 1e-9),
                    "{fine:?}"
                );
            }
        }
    }
}
