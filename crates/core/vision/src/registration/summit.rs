//! A guess of the sweep brought to the top of its summit: heading, height and tilt between the steps, the
//! place between the pixels; and how sharp the summit is (Laplace's approximation).

use nalgebra::{Matrix2, SMatrix};

use super::evidence::Evidence;
use super::fit::{PoseFit, UNKNOWNS, differences, moved};
use super::grid::SweepGrid;
use super::ground::{GroundPicture, Texture};
use super::guess::PoseGuess;
use super::look::{FrameLook, MapPose};
use super::prior::PosePrior;
use super::weighed::frame_template;
use pilotage_base::frames::wrap_pi;
use pilotage_raster::raster::{ChannelSearch, Gray, Peak, highest_peak};

/// A stage of the climb.
struct ClimbStage {
    texture: Texture,
    /// Ground sample distance against that of the finest whole sweep.
    finer: f64,
    rounds: usize,
    /// First step against the axis' own; every round halves it.
    share: f64,
}

/// By edges and contrast, as the sweep weighed: where there are few edges, edges alone lead to another summit nearby.
const WEIGHED: ClimbStage = ClimbStage {
    texture: Texture::EdgesAndContrast,
    finer: 1.0,
    rounds: 3,
    share: 1.0,
};
/// By edges alone, because shadows and crops move contrast.
const EDGES: ClimbStage = ClimbStage {
    texture: Texture::Edges,
    finer: 0.7,
    rounds: 3,
    share: 0.25,
};
/// Largest distance of the summit from the guess, pixels of the sweep.
const MARGIN: f64 = 8.0;
/// First step of roll and of pitch, radians.
const TILT: f64 = 0.04;

/// Unknowns beside the place.
#[derive(Clone, Copy)]
enum Axis {
    Heading,
    LogHeight,
    Roll,
    Pitch,
}

/// A pose, its correlation, and the logarithm of its likelihood and prior.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summit {
    /// The pose over the map.
    pub at: MapPose,
    /// Correlation of the whole frame with the map.
    pub score: f64,
    /// Natural logarithm of likelihood and prior.
    pub log_weight: f64,
    /// Second derivatives of the logarithm by the place in the middle of the picture (north, east), per m².
    pub curvature: Matrix2<f64>,
}

/// A summit, and how sharp it is along the axes on which it was climbed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Climbed {
    /// The top.
    pub top: Summit,
    /// Variances of heading (radians²), logarithm of the height, roll and pitch (radians²), prior and
    /// likelihood taken together, the place following each.
    pub variances: [f64; 4],
}

impl Axis {
    const ALL: [Self; 4] = [Self::Heading, Self::LogHeight, Self::Roll, Self::Pitch];

    /// The first step.
    fn step(self) -> f64 {
        match self {
            Self::Heading | Self::LogHeight => 0.5 * SweepGrid::full().step(),
            Self::Roll | Self::Pitch => TILT,
        }
    }

    /// Whether the prior holds it.
    fn is_held(self, prior: &PosePrior) -> bool {
        match self {
            Self::Heading => prior.heading.held().is_some(),
            Self::LogHeight => prior.holds_height(),
            Self::Roll | Self::Pitch => false,
        }
    }

    fn moved(self, look: &FrameLook<'_>, at: &MapPose, by: f64) -> MapPose {
        let mut at = *at;
        let attitude = &mut at.pose.attitude;
        match self {
            Self::Heading => attitude.yaw = wrap_pi(attitude.yaw + by),
            Self::Roll => attitude.roll += by,
            Self::Pitch => attitude.pitch += by,
            Self::LogHeight => {
                let height = look.ground_down - at.pose.position_in_world.z;
                at.pose.position_in_world.z = look.ground_down - height * by.exp();
            }
        }
        at
    }
}

/// The top of what the sweep weighed: near enough for patches to be looked for.
pub fn climb(look: &FrameLook<'_>, prior: &PosePrior, guess: &PoseGuess) -> Option<Summit> {
    let level = SummitLevel::new(look, prior, guess, &guess.at, &WEIGHED)?;
    level.climb(&guess.at, &WEIGHED)
}

/// The top by edges around that of [`climb`], and how sharp it is: the place of a frame of another date than the map.
pub fn place_by_edges(
    look: &FrameLook<'_>,
    prior: &PosePrior,
    guess: &PoseGuess,
    begun: &Summit,
) -> Option<Climbed> {
    let level = SummitLevel::new(look, prior, guess, &begun.at, &EDGES)?;
    let top = level.climb(&begun.at, &EDGES)?;
    let variances = Axis::ALL.map(|axis| level.variance(axis, &top));
    Some(Climbed { top, variances })
}

/// The map around a guess at one ground sample distance.
struct SummitLevel<'a> {
    look: &'a FrameLook<'a>,
    prior: &'a PosePrior,
    evidence: &'a Evidence,
    ground: GroundPicture,
    search: ChannelSearch,
    /// Metres.
    gsd: f64,
    texture: Texture,
}

impl<'a> SummitLevel<'a> {
    fn new(
        look: &'a FrameLook<'a>,
        prior: &'a PosePrior,
        guess: &'a PoseGuess,
        start: &MapPose,
        stage: &ClimbStage,
    ) -> Option<Self> {
        let footprint = look.footprint(start)?;
        let (texture, gsd) = (
            stage.texture,
            stage.finer * SweepGrid::full().gsd(&footprint),
        );
        let across = footprint.width().max(footprint.height());
        // At any heading and height of the first round, which are the farthest.
        let around = footprint.grown(MARGIN * gsd + 0.1 * across);
        let ground = GroundPicture::of_map(look.map, &around, gsd, texture, 0);
        let search = ChannelSearch::new(&ground.channels, &ground.covered);
        Some(Self {
            look,
            prior,
            evidence: &guess.evidence,
            ground,
            search,
            gsd,
            texture,
        })
    }

    /// The top above a pose.
    fn climb(&self, start: &MapPose, stage: &ClimbStage) -> Option<Summit> {
        let mut top = self.summit(start)?;
        let mut share = stage.share;
        for _ in 0..stage.rounds {
            top = self.round(share, top);
            share *= 0.5;
        }
        Some(top)
    }

    /// The best place of a pose.
    fn summit(&self, at: &MapPose) -> Option<Summit> {
        let (template, (left, top)) =
            frame_template(self.look, at, &self.ground.window, self.texture)?;
        let surface = self.search.correlate(&template)?;
        let (peak, sample) = peak_near(&surface.score, left, top)?;
        let share = f64::from(surface.share_at(sample));
        let (east, north) = (peak.x - left as f64, top as f64 - peak.y);
        let mut at = *at;
        at.pose.position_in_world.x += north * self.gsd;
        at.pose.position_in_world.y += east * self.gsd;
        let attitude = at.pose.attitude;
        let height = self.look.ground_down - at.pose.position_in_world.z;
        let tilt =
            (attitude.roll - self.prior.roll).powi(2) + (attitude.pitch - self.prior.pitch).powi(2);
        let log_prior = self.prior.log_density(height, attitude.yaw)
            - 0.5 * tilt / self.prior.apparent_tilt_deviation().powi(2);
        Some(Summit {
            at,
            score: peak.value,
            log_weight: self.evidence.log_likelihood(peak.value, share) + log_prior,
            // Rows run south and columns east.
            curvature: self.evidence.slope(peak.value, share) / (self.gsd * self.gsd)
                * Matrix2::new(
                    peak.hessian[(1, 1)],
                    -peak.hessian[(0, 1)],
                    -peak.hessian[(0, 1)],
                    peak.hessian[(0, 0)],
                ),
        })
    }

    /// Variance along an axis by the curvature of the logarithm at the top.
    fn variance(&self, axis: Axis, top: &Summit) -> f64 {
        let step = 0.25 * axis.step();
        let fall = |by: f64| {
            let beside = self.summit(&axis.moved(self.look, &top.at, by))?;
            Some(top.log_weight - beside.log_weight)
        };
        let falls = fall(step).zip(fall(-step));
        let curvature = falls.map_or(0.0, |(a, b)| (a + b) / (step * step));
        // Never known worse than to the first step, within which the summit was found.
        1.0 / curvature.max(axis.step().powi(-2))
    }

    /// The best of `best`, of what lies a step of `share` to each side of it along every axis, and of where the parabolas
    /// through these are highest together.
    fn round(&self, share: f64, best: Summit) -> Summit {
        let mut together = best.at;
        let mut tried = vec![best];
        let free = Axis::ALL
            .into_iter()
            .filter(|axis| !axis.is_held(self.prior));
        for axis in free {
            let step = share * axis.step();
            let at = |by: f64| self.summit(&axis.moved(self.look, &best.at, by));
            let (less, more) = (at(-step), at(step));
            let value =
                |side: &Option<Summit>| side.map_or(best.log_weight - 1.0, |s| s.log_weight);
            let between = vertex(value(&less), best.log_weight, value(&more));
            together = axis.moved(self.look, &together, between * step);
            tried.extend(less.into_iter().chain(more));
        }
        tried.extend(self.summit(&together));
        tried
            .into_iter()
            .max_by(|a, b| a.log_weight.total_cmp(&b.log_weight))
            .unwrap_or(best)
    }
}

impl Climbed {
    /// The pose with its covariance: that of the place in the middle of the picture, and what place and tilt
    /// of the camera have in common around it.
    pub fn fit(&self, look: &FrameLook<'_>, prior: &PosePrior) -> Option<PoseFit> {
        let at = self.top.at;
        let centre = differences(|step| Some(look.centre(&moved(&at, step))?.to_vector()))?;
        let place = (-self.top.curvature)
            .try_inverse()
            .filter(|c| c.determinant() > 0.0)?;
        let height = look.ground_down - at.pose.position_in_world.z;
        let [heading, log_height, roll, pitch] = self.variances;
        let shape = prior.shape_deviation.powi(2);
        let others = [
            log_height * height * height,
            roll,
            pitch,
            heading,
            shape,
            shape,
        ];
        // The middle of the picture stays where it is seen: the camera moves with what changes that.
        let mut jacobian = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::identity();
        jacobian
            .fixed_view_mut::<2, 6>(0, 2)
            .copy_from(&-centre.fixed_columns::<6>(2));
        let mut own = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
        own.fixed_view_mut::<2, 2>(0, 0).copy_from(&place);
        for (index, variance) in others.into_iter().enumerate() {
            own[(index + 2, index + 2)] = variance;
        }
        let pixels_per_metre = look.camera.focal / height;
        Some(PoseFit {
            at,
            covariance: jacobian * own * jacobian.transpose(),
            deviation: (0.5 * place.trace()).sqrt() * pixels_per_metre,
        })
    }
}

/// The highest place of a surface no farther than the margin from a column and a row, and the index of its sample: what is
/// higher farther away is another summit.
fn peak_near(surface: &Gray, column: usize, row: usize) -> Option<(Peak, usize)> {
    let margin = MARGIN as usize;
    let (left, top) = (column.saturating_sub(margin), row.saturating_sub(margin));
    let width = (column + margin + 1)
        .min(surface.width())
        .checked_sub(left)?;
    let height = (row + margin + 1).min(surface.height()).checked_sub(top)?;
    let mut peak = highest_peak(&surface.crop(left, top, width, height)?)?;
    peak.x += left as f64;
    peak.y += top as f64;
    let (column, row) = peak.sample;
    let sample = (left + column, top + row);
    peak.sample = sample;
    Some((peak, sample.1 * surface.width() + sample.0))
}

/// Place of the maximum of the parabola through three values at -1, 0 and 1, within these.
fn vertex(less: f64, here: f64, more: f64) -> f64 {
    let curvature = less - 2.0 * here + more;
    if curvature < 0.0 {
        (0.5 * (less - more) / curvature).clamp(-1.0, 1.0)
    } else if less > more {
        -1.0
    } else {
        1.0
    }
}
