//! Places that a view may show, with their probabilities.

use std::collections::BTreeMap;

use pilotage_base::frames::wrap_pi;
use serde::{Deserialize, Serialize};

use super::evidence::RoadEvidence;
use super::hypotheses::Hypotheses;
use super::index::RoadIndex;
use super::prepared::PreparedView;
use super::reach::RoadViewError;
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
/// Distance by which a pose is moved at most to where it fits best, metres.
const MOVED: f64 = 50.0;
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

/// Places that views may show in a part of a map, to be weighed with those of the others.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LostShare {
    pub(super) places: Vec<Weighed>,
    pub(super) tried: usize,
    pub(super) left: usize,
}

/// Poses at which a view fits well.
pub(super) struct Candidates {
    pub poses: Vec<ViewPose>,
    /// Number of poses that were looked at, and of those that were not.
    pub tried: usize,
    pub left: usize,
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
    /// Number of poses that pairs of crossings tell as well and that were not looked at, since rarer pairs told enough.
    pub left: usize,
}

impl LostBelief {
    /// Belief over the places of all parts of a map, each once.
    pub fn of_parts(parts: Vec<LostShare>) -> Self {
        let mut all = LostShare::default();
        for part in parts {
            all.places.extend(part.places);
            all.tried += part.tried;
            all.left += part.left;
        }
        Self::of(distinct(all.places, usize::MAX), all.tried, all.left)
    }

    /// The likeliest place, if its probability is at least `least`.
    pub fn place(&self, least: f64) -> Option<&LostPlace> {
        self.places.first().filter(|p| p.probability >= least)
    }

    /// Belief over poses with the logarithms of their odds against `elsewhere`.
    fn of(weighed: Vec<Weighed>, tried: usize, left: usize) -> Self {
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
            left,
        }
    }
}

/// The likeliest of several weighed poses, at most `most`, none of them at the place of a likelier one.
pub(super) fn distinct(mut weighed: Vec<Weighed>, most: usize) -> Vec<Weighed> {
    weighed.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut kept: Vec<Weighed> = Vec::new();
    let cell = |value: f64| (value / SAME.0).floor() as i64;
    let mut cells: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for place in weighed {
        if kept.len() >= most {
            break;
        }
        let at = (cell(place.1.place.north), cell(place.1.place.east));
        let around = (at.0 - 1..=at.0 + 1).flat_map(|n| (at.1 - 1..=at.1 + 1).map(move |e| (n, e)));
        let mut near = around.filter_map(|cell| cells.get(&cell)).flatten();
        if near.all(|number| !is_same(&kept[*number].1, &place.1)) {
            cells.entry(at).or_default().push(kept.len());
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
    pub fn locate(
        &self,
        view: &RoadView,
        settings: &LostSettings,
    ) -> Result<LostBelief, RoadViewError> {
        let share = self.places(view, settings)?;
        Ok(LostBelief::of_parts(vec![share]))
    }

    /// The places of this part of a map that a view may show, to be weighed with those of the other parts.
    pub fn places(
        &self,
        view: &RoadView,
        settings: &LostSettings,
    ) -> Result<LostShare, RoadViewError> {
        let prepared = PreparedView::new(view.checked()?);
        let found = self.candidates(&prepared, settings, 0.0);
        // Poses that were moved over an edge are found in both parts, and are one's.
        let sought = found
            .poses
            .into_iter()
            .filter(|pose| self.is_sought(&pose.place, 0.0));
        let weighed = sought.map(|pose| {
            let evidence = RoadEvidence::of(&pose, view, &prepared, self);
            (log_odds(&evidence, self.area, settings), pose, evidence)
        });
        Ok(LostShare {
            places: distinct(weighed.collect(), KEPT),
            tried: found.tried,
            left: found.left,
        })
    }

    /// Poses at most `margin` metres beside what is sought at which the view fits well, each as well as it can, some of them a
    /// little beyond.
    pub(super) fn candidates(
        &self,
        view: &PreparedView,
        settings: &LostSettings,
        margin: f64,
    ) -> Candidates {
        if view.points.len() < FEWEST {
            return Candidates {
                poses: Vec::new(),
                tried: 0,
                left: 0,
            };
        }
        let hypotheses = Hypotheses::of(view, self, settings, margin + MOVED);
        let (tried, left) = (hypotheses.tried, hypotheses.left);
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
        Candidates {
            poses: fixed.collect(),
            tried,
            left,
        }
    }
}
