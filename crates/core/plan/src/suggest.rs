//! Landmarks that a map offers: every place is rehearsed, and the set that serves a route best is chosen.

use pilotage_base::sorting::sort;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::candidate::LandmarkCandidate;
use super::cover::MomentCover;
use super::footprints::Footprints;
use super::survival::GroundLooks;
use pilotage_base::frames::{GroundPoint, GroundRect, Pose};
use pilotage_mission::settings::{NavigatorSettings, VehicleChoice};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Imagery;
use pilotage_vision::landmark::{Landmark, RehearsalFit, TemplateFeatures, rehearse};

/// Days after which a place that failed on all of them is given up.
const FIRST_DAYS: usize = 2;
/// Probability on one day below which a place failed on it.
const FAILED: f64 = 0.03;
/// Rounds in which every chosen landmark may be exchanged for a better one.
const ROUNDS: usize = 8;
/// Error of a fix, metres: with dead reckoning as uncertain, it has faded.
const FIX: f64 = 2.0;
/// Certainty of a fix that counts as next to none.
const NEXT_TO_NONE: f64 = 0.1;
/// Seconds over which a fix fades: the error of dead reckoning has then grown to about a fix's own.
const FADING: f64 = 8.0;

/// Rehearses the places of a map, one a call, so that the caller can show progress and stop.
pub struct Ranking {
    map: Arc<dyn Imagery>,
    days: Vec<Arc<dyn Imagery>>,
    radius: f64,
    features: TemplateFeatures,
    places: Vec<GroundRect>,
    next: usize,
    found: Vec<LandmarkCandidate>,
}

impl Ranking {
    /// Boxes of `side` metres all over `region`, half a side apart, to be rehearsed on `days` within
    /// `radius` metres around them.
    pub fn new(
        map: Arc<dyn Imagery>,
        days: &[Arc<dyn Imagery>],
        region: &GroundRect,
        side: f64,
        radius: f64,
    ) -> Self {
        let step = 0.5 * side;
        let count = |length: f64| ((length - side) / step).floor().max(-1.0) as i64 + 1;
        let mut places = Vec::new();
        for row in 0..count(region.height()) {
            for column in 0..count(region.width()) {
                let middle = GroundPoint::new(
                    region.north - 0.5 * side - step * row as f64,
                    region.west + 0.5 * side + step * column as f64,
                );
                places.push(GroundRect::centered(middle, side, side));
            }
        }
        Self {
            map,
            days: days.to_vec(),
            radius,
            features: TemplateFeatures::default(),
            places,
            next: 0,
            found: Vec::new(),
        }
    }

    /// As a detector of these features will look for them.
    #[must_use]
    pub fn by(self, features: TemplateFeatures) -> Self {
        Self { features, ..self }
    }

    /// Only the places that a camera can see whole from `frames`.
    #[must_use]
    pub fn seen_from(
        mut self,
        camera: &CameraModel,
        frames: &[(f64, Pose)],
        ground_down: f64,
    ) -> Self {
        let footprints = Footprints::new(camera, frames, ground_down);
        self.places
            .retain(|bounds| (0..frames.len()).any(|f| footprints.hold(f, bounds)));
        self
    }

    /// Only one of `of` parts that lie one below the other, as many places in each.
    #[must_use]
    pub fn part(mut self, part: usize, of: usize) -> Self {
        let end = |part: usize| self.places.len() * part / of;
        self.places = self.places[end(part)..end(part + 1)].to_vec();
        self
    }

    /// Places done, and places in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.next, self.places.len())
    }

    /// Rehearses the next place; false when all are done.
    pub fn advance(&mut self) -> bool {
        let Some(bounds) = self.places.get(self.next).copied() else {
            return false;
        };
        self.next += 1;
        let candidate = match self.features {
            TemplateFeatures::Brightness => self.rehearsed(&bounds),
            TemplateFeatures::Orientation => self.lasting(&bounds),
        };
        self.found
            .extend(candidate.filter(|c| c.probability >= FAILED));
        true
    }

    /// Rehearsal of a place on a day; `None` if it serves on none.
    fn on_day(&self, day: &dyn Imagery, bounds: &GroundRect) -> Option<RehearsalFit> {
        rehearse(self.map.as_ref(), day, bounds, self.radius, self.features)
    }

    /// A place as its rehearsals go.
    fn rehearsed(&self, bounds: &GroundRect) -> Option<LandmarkCandidate> {
        let mut worst: Option<LandmarkCandidate> = None;
        let (mut sum, mut best) = (0.0, 0.0_f64);
        for (done, day) in self.days.iter().enumerate() {
            if done == FIRST_DAYS && best < FAILED {
                return None;
            }
            let candidate = LandmarkCandidate::of(*bounds, &self.on_day(day.as_ref(), bounds)?);
            sum += candidate.probability;
            best = best.max(candidate.probability);
            if worst.is_none_or(|w| candidate.probability < w.probability) {
                worst = Some(candidate);
            }
        }
        let mean = sum / self.days.len().max(1) as f64;
        worst.map(|worst| LandmarkCandidate {
            probability: mean,
            range: [mean; 2],
            ..worst
        })
    }

    /// A place as maps of other dates have it that look like it.
    fn lasting(&self, bounds: &GroundRect) -> Option<LandmarkCandidate> {
        let days = self.days.iter();
        let days: Option<Vec<RehearsalFit>> =
            days.map(|d| self.on_day(d.as_ref(), bounds)).collect();
        let days = days?;
        let worst = days.iter().min_by(|a, b| a.score.total_cmp(&b.score))?;
        let survival = GroundLooks::of(self.map.as_ref(), bounds).survival(&days);
        Some(LandmarkCandidate {
            probability: survival.probability,
            range: survival.range,
            ..LandmarkCandidate::of(*bounds, worst)
        })
    }

    /// The places that passed so far, in the order in which they were rehearsed.
    pub fn found(self) -> Vec<LandmarkCandidate> {
        self.found
    }

    /// The same, the most certain first.
    pub fn ranked(self) -> Vec<LandmarkCandidate> {
        most_certain_first(self.found)
    }
}

/// Places by their probability; those of the same one stay in their order.
pub fn most_certain_first(mut found: Vec<LandmarkCandidate>) -> Vec<LandmarkCandidate> {
    sort(&mut found, &|a, b| {
        b.probability().total_cmp(&a.probability())
    });
    found
}

/// A proposed landmark and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Suggestion {
    /// The box and its rehearsal.
    pub candidate: LandmarkCandidate,
    /// Seconds of the flight in which it is in the picture.
    pub in_view: f64,
    /// Seconds of the flight that it newly keeps from dead reckoning.
    pub gained: f64,
    /// The reason in words.
    pub reason: String,
}

impl Suggestion {
    /// The landmark that it becomes, with the reason in its notes.
    pub fn landmark(&self, id: u32) -> Landmark {
        let name = format!("Suggestion {id}");
        let mut landmark = Landmark::new(id, name, self.candidate.bounds);
        landmark.set_notes(&self.reason);
        landmark
    }
}

/// Seconds over which a fix fades for an aircraft with these settings: until the error of dead reckoning
/// has grown to about a fix's own.
pub fn fading(settings: &NavigatorSettings) -> f64 {
    match settings.vehicle {
        // Nothing is known of the way: it grows with the root of the time.
        VehicleChoice::RandomWalk => (FIX / settings.process.position_alone())
            .powi(2)
            .min(FADING),
        _ => FADING,
    }
}

/// Chooses at most `count` of `candidates` for a flight whose camera is at `frames` (time in seconds,
/// pose), with fixes that fade over eight seconds.
pub fn choose(
    candidates: &[LandmarkCandidate],
    camera: &CameraModel,
    frames: &[(f64, Pose)],
    ground_down: f64,
    count: usize,
) -> Vec<Suggestion> {
    choose_lasting(candidates, camera, frames, ground_down, FADING, count)
}

/// Chooses at most `count` of `candidates` for a flight whose camera is at `frames` (time in seconds,
/// pose), with fixes that fade over `fading` seconds, zero included.
///
/// Each second of the flight is worth a measure of the probability of having a fix, where a landmark in
/// view u seconds ago still counts as `p exp(-u / τ)`, and any of several serves: `1 - Π (1 - pᵢ)`. The
/// measure is steepest where there is next to none, so that the weakest stretch is served first. That is
/// monotone and submodular: taking the landmark of the greatest gain, again and again, comes to within
/// 1 - 1/e of the best set (Nemhauser, Wolsey and Fisher 1978). Then each is exchanged for a better one
/// until none is found.
pub fn choose_lasting(
    candidates: &[LandmarkCandidate],
    camera: &CameraModel,
    frames: &[(f64, Pose)],
    ground_down: f64,
    fading: f64,
    count: usize,
) -> Vec<Suggestion> {
    let cover = MomentCover::new(candidates, camera, frames, ground_down, fading);
    let clear = |i: usize, others: &[usize]| {
        // Boxes that share ground would only be found and missed together.
        let bounds = candidates[i].bounds;
        others
            .iter()
            .all(|o| !candidates[*o].bounds.overlaps(&bounds))
    };
    let best = |others: &[usize]| {
        let missed = cover.missed(others);
        (0..candidates.len())
            .filter(|i| clear(*i, others))
            .map(|i| (cover.gain(i, &missed, &measure), i))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(gain, _)| *gain > 1e-3)
    };
    let mut chosen: Vec<usize> = Vec::new();
    while chosen.len() < count
        && let Some((_, i)) = best(&chosen)
    {
        chosen.push(i);
    }
    for _ in 0..ROUNDS {
        let before = chosen.clone();
        for slot in 0..chosen.len() {
            let old = chosen.remove(slot);
            let missed = cover.missed(&chosen);
            let kept = cover.gain(old, &missed, &measure);
            let new = best(&chosen).filter(|(gain, _)| *gain > kept + 1e-9);
            chosen.insert(slot, new.map_or(old, |(_, i)| i));
        }
        if chosen == before {
            break;
        }
    }
    let mut missed = cover.missed(&[]);
    let mut suggestions = Vec::new();
    while !chosen.is_empty() {
        let at = (0..chosen.len())
            .max_by(|a, b| {
                let gain = |slot: usize| cover.gain(chosen[slot], &missed, &measure);
                gain(*a).total_cmp(&gain(*b))
            })
            .unwrap_or(0);
        let i = chosen.remove(at);
        let gained = cover.gain(i, &missed, &|missed| 1.0 - missed);
        cover.take(i, &mut missed);
        let in_view = cover.in_view[i];
        suggestions.push(Suggestion {
            candidate: candidates[i],
            in_view,
            gained,
            reason: reason(&candidates[i], in_view, gained),
        });
    }
    suggestions
}

/// Worth of a moment of the flight that is without a fix with probability `missed`.
fn measure(missed: f64) -> f64 {
    (1.0 + (1.0 - missed) / NEXT_TO_NONE).ln()
}

fn reason(candidate: &LandmarkCandidate, in_view: f64, gained: f64) -> String {
    let middle = candidate.bounds.center();
    let to = candidate.rival_place;
    let distance = middle.distance(&to);
    let percent = |p: f64| (100.0 * p).round();
    let [low, high] = candidate.range;
    let found = if low < high {
        format!(
            "found in {} % of pictures of another date ({} to {} %)",
            percent(candidate.probability),
            percent(low),
            percent(high)
        )
    } else {
        format!(
            "found in {} % of pictures as rehearsed",
            percent(candidate.probability)
        )
    };
    format!(
        "in view for {in_view:.0} s, keeps {gained:.0} s from dead reckoning; {found}; scores {:.2} on its worst \
         day, the strongest look-alike {distance:.0} m away {:.2}",
        candidate.score, candidate.rival
    )
}

#[cfg(test)]
#[path = "suggest_tests.rs"]
mod tests;
