//! Landmarks proposed for a flight: every place that its camera sees is rehearsed, and the set that
//! serves it best is chosen.

use std::sync::Arc;

use super::candidate::LandmarkCandidate;
use super::field::FieldView;
use super::poses::{poses_all_over, poses_over};
use super::suggest::{Ranking, Suggestion, choose_lasting, fading, most_certain_first};
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::imagery::{CachedImagery, Imagery};
use pilotage_simulate::other_days::OtherDays;

/// Memory for tiles of one day, megabytes: several rows of places, one below the other.
const CACHE_MEGABYTES: usize = 8;

/// Question to which landmarks are proposed.
pub struct ProposalQuestion {
    /// The map.
    pub map: Arc<dyn Imagery>,
    /// The same ground on other days.
    pub days: Vec<Arc<dyn Imagery>>,
    /// View of the ground, with the uncertainty of the position.
    pub view: FieldView,
    /// Way-points of the flight; without any it may go anywhere over the map.
    pub way_points: Vec<GroundPoint>,
    /// Speed over the ground, m/s.
    pub speed: f64,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Settings of the navigation.
    pub navigator: NavigatorSettings,
    /// Side of the boxes, metres; a third of the picture's shorter side on the ground if `None`.
    pub side: Option<f64>,
    /// Boxes of landmarks that are there already: none is proposed over them.
    pub taken: Vec<GroundRect>,
}

/// Rehearses the places, one a call, so that the caller can show progress and stop.
pub struct Proposal {
    question: ProposalQuestion,
    frames: Vec<(f64, Pose)>,
    ranking: Ranking,
    side: f64,
}

impl Proposal {
    /// Days on which places are rehearsed: with three, what is proposed depends on which they are.
    pub const DAYS: u64 = 8;
    /// Standard deviation of the position that is assumed, per axis, metres.
    pub const POSITION: f64 = 10.0;

    /// Usual side of a box, metres: a third of the picture's shorter side on the ground; `None` if the camera does not
    /// see the ground.
    pub fn usual_side(view: &FieldView) -> Option<f64> {
        Some(view.across()? / 3.0)
    }

    /// Those days, drawn by `seed`.
    pub fn days(others: &dyn OtherDays, seed: u64) -> Vec<Arc<dyn Imagery>> {
        let kept = |day| {
            let drawn = others.drawn(seed.wrapping_mul(1000) + day);
            Arc::new(CachedImagery::new(drawn, CACHE_MEGABYTES)) as Arc<dyn Imagery>
        };
        (0..Self::DAYS).map(kept).collect()
    }

    /// Prepares to rehearse; `None` if the camera does not see the ground.
    pub fn new(question: ProposalQuestion) -> Option<Self> {
        let q = &question;
        let side = q.side.or_else(|| Self::usual_side(&q.view))?;
        let radius = q.view.searched(q.navigator.detector.search_sigmas, side);
        let region = q.map.bounds();
        let ranking = Ranking::new(Arc::clone(&q.map), &q.days, &region, side, radius)
            .by(q.navigator.detector.features);
        let frames = q.frames();
        let ranking = if q.way_points.is_empty() {
            ranking
        } else {
            ranking.seen_from(&q.view.camera, &frames, q.ground_down)
        };
        Some(Self {
            question,
            frames,
            ranking,
            side,
        })
    }

    /// Only one of `of` parts of the places, to be rehearsed beside the others.
    #[must_use]
    pub fn part(mut self, part: usize, of: usize) -> Self {
        self.ranking = self.ranking.part(part, of);
        self
    }

    /// Side of the boxes, metres.
    pub fn side(&self) -> f64 {
        self.side
    }

    /// Places done, and places in all.
    pub fn progress(&self) -> (usize, usize) {
        self.ranking.progress()
    }

    /// Rehearses the next place; false when all are done.
    pub fn advance(&mut self) -> bool {
        self.ranking.advance()
    }

    /// The places that passed, the most certain first.
    pub fn ranked(self) -> Vec<LandmarkCandidate> {
        self.ranking.ranked()
    }

    /// The places that passed, in the order in which they were rehearsed.
    pub fn found(self) -> Vec<LandmarkCandidate> {
        self.ranking.found()
    }

    /// At most `count` of them that serve the flight best, the one that gains most first.
    pub fn chosen(self, count: usize) -> Vec<Suggestion> {
        let found = self.ranking.found();
        self.question.choose(&self.frames, found, count)
    }
}

impl ProposalQuestion {
    /// Poses of the camera on the flight (time in seconds, pose), or all over the map.
    fn frames(&self) -> Vec<(f64, Pose)> {
        let (height, camera) = (self.view.height, &self.view.camera);
        if self.way_points.is_empty() {
            let step = 0.5 * height * camera.height as f64 / camera.focal;
            poses_all_over(self.map.as_ref(), height, step, self.ground_down)
        } else {
            poses_over(&self.way_points, height, self.speed, self.ground_down)
        }
    }

    /// Suggestions as by [`Proposal::chosen`], for places that were found in parts, one part after the other.
    pub fn chosen_of(&self, found: Vec<LandmarkCandidate>, count: usize) -> Vec<Suggestion> {
        self.choose(&self.frames(), found, count)
    }

    fn choose(
        &self,
        frames: &[(f64, Pose)],
        found: Vec<LandmarkCandidate>,
        count: usize,
    ) -> Vec<Suggestion> {
        let mut ranked = most_certain_first(found);
        ranked.retain(|c| self.taken.iter().all(|t| !t.overlaps(&c.bounds)));
        let lasting = fading(&self.navigator);
        let camera = &self.view.camera;
        choose_lasting(&ranked, camera, frames, self.ground_down, lasting, count)
    }
}
