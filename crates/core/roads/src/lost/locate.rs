//! Places that a view may show, with their probabilities.

use pilotage_base::frames::wrap_pi;

use super::evidence::RoadEvidence;
use super::hypotheses::Hypotheses;
use super::index::RoadIndex;
use super::prepared::PreparedView;
use super::refine::{fix, misfit, settle};
use super::settings::LostSettings;
use super::view::{RoadView, ViewPose};
use super::weights::log_odds;

/// Hypotheses that are settled by the field of distances.
const SETTLED: usize = 1200;
/// Settled ones that are fixed on the centre lines and weighed.
const FIXED: usize = 80;
/// Poses nearer than this are one place: metres and radians.
const SAME: (f64, f64) = (25.0, 0.1);
/// Places that are kept.
const KEPT: usize = 24;
/// Fewest points that tell anything.
const FEWEST: usize = 16;

/// Pose with the logarithm of its odds, and what they come from.
pub(super) type Weighed = (f64, ViewPose, RoadEvidence);

/// Place that a view may show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LostPlace {
    /// Pose of the view there.
    pub pose: ViewPose,
    /// Probability that it is this place.
    pub probability: f64,
    /// Points of the view and of the map that agree there.
    pub evidence: RoadEvidence,
}

/// Places that a view may show, and the probability of none of them.
#[derive(Clone, Debug, PartialEq)]
pub struct LostBelief {
    /// Places, the likeliest first.
    pub places: Vec<LostPlace>,
    /// Probability that it is none of them: elsewhere on the map, or not on the map.
    pub elsewhere: f64,
    /// Number of poses that were looked at.
    pub tried: usize,
}

impl LostBelief {
    /// The likeliest place, if its probability is at least `least`.
    pub fn place(&self, least: f64) -> Option<&LostPlace> {
        self.places.first().filter(|p| p.probability >= least)
    }

    /// Belief over poses with the logarithms of their odds against `elsewhere`.
    pub(super) fn of(weighed: Vec<Weighed>, tried: usize) -> Self {
        // The odds of elsewhere are 1, the largest of all is subtracted from every logarithm.
        let largest = weighed.iter().map(|w| w.0).fold(0.0, f64::max);
        let total: f64 =
            weighed.iter().map(|w| (w.0 - largest).exp()).sum::<f64>() + (-largest).exp();
        let places = weighed.into_iter().map(|(odds, pose, evidence)| LostPlace {
            pose,
            probability: (odds - largest).exp() / total,
            evidence,
        });
        let mut places: Vec<LostPlace> = places.collect();
        places.sort_by(|a, b| b.probability.total_cmp(&a.probability));
        Self {
            places,
            elsewhere: (-largest).exp() / total,
            tried,
        }
    }
}

/// The likeliest of several weighed poses, at most `most`, none of them at the place of a likelier one.
pub(super) fn distinct(mut weighed: Vec<Weighed>, most: usize) -> Vec<Weighed> {
    weighed.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut kept: Vec<Weighed> = Vec::new();
    for place in weighed {
        if kept.len() < most && kept.iter().all(|own| !is_same(&own.1, &place.1)) {
            kept.push(place);
        }
    }
    kept
}

/// Whether two poses are the same place.
pub(super) fn is_same(a: &ViewPose, b: &ViewPose) -> bool {
    a.place.distance(&b.place) < SAME.0 && wrap_pi(a.turn - b.turn).abs() < SAME.1
}

impl RoadIndex {
    /// The places of the map that a view may show.
    pub fn locate(&self, view: &RoadView, settings: &LostSettings) -> LostBelief {
        let prepared = PreparedView::new(view);
        let (poses, tried) = self.candidates(&prepared, settings);
        let weighed = poses.into_iter().map(|pose| {
            let evidence = RoadEvidence::of(&pose, view, &prepared, self);
            (log_odds(&evidence, self.area, settings), pose, evidence)
        });
        LostBelief::of(distinct(weighed.collect(), KEPT), tried)
    }

    /// Poses at which the view fits well, each as well as it can, and the number of those that were looked at.
    pub(super) fn candidates(
        &self,
        view: &PreparedView,
        settings: &LostSettings,
    ) -> (Vec<ViewPose>, usize) {
        if view.points.len() < FEWEST {
            return (Vec::new(), 0);
        }
        let hypotheses = Hypotheses::of(view, self, settings);
        let tried = hypotheses.tried;
        let mut settled: Vec<(f64, ViewPose)> = Vec::new();
        let looked = view.second_look();
        for pose in hypotheses.best(SETTLED) {
            let pose = settle(pose, looked, self, settings.scale);
            settled.push((misfit(&pose, looked, self), pose));
        }
        settled.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut distinct: Vec<ViewPose> = Vec::new();
        for (_, pose) in settled {
            if distinct.iter().all(|other| !is_same(other, &pose)) {
                distinct.push(pose);
                if distinct.len() == FIXED {
                    break;
                }
            }
        }
        let fixed = distinct
            .into_iter()
            .map(|pose| fix(pose, view, self, settings.scale));
        (fixed.collect(), tried)
    }
}
