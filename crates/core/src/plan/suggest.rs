//! Landmarks that a map offers: every place is rehearsed, and the set that serves a route best is chosen.

use std::sync::Arc;

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use crate::camera::CameraModel;
use crate::frames::{Attitude, GroundPoint, GroundRect, Pose};
use crate::imagery::Imagery;
use crate::landmark::{Rehearsal, rehearse};

/// Greatest ratio of a rival's score to the landmark's, as the detector has it.
const AMBIGUITY: f64 = 0.85;
/// Margin at which a landmark is as likely found as not, and the width of that change: from the boxes
/// of the built-in scenarios, whose detections are known.
const EVEN_MARGIN: f64 = 0.03;
/// See [`EVEN_MARGIN`].
const MARGIN_WIDTH: f64 = 0.04;
/// Least score with which the detector accepts.
const LEAST_SCORE: f64 = 0.45;
/// What a rehearsal can promise at best: relief, another camera and a real day are not in it.
const REHEARSAL: f64 = 0.6;
/// Certainty of a fix that counts as next to none.
const NEXT_TO_NONE: f64 = 0.1;
/// Seconds over which a fix fades: the error of dead reckoning has then grown to about a fix's own.
const FADING: f64 = 8.0;

/// A box of the map and how it did on its worst rehearsal day.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Candidate {
    /// The box.
    pub bounds: GroundRect,
    /// Score at its own place, 0 to 1.
    pub score: f64,
    /// Score of its strongest rival.
    pub rival: f64,
    /// Where the rival is.
    pub rival_place: GroundPoint,
    /// What it has in hand before it is refused as ambiguous.
    pub margin: f64,
    /// How far it seemed to move on another day, metres.
    pub drift: f64,
}

impl Candidate {
    fn of(bounds: GroundRect, r: &Rehearsal) -> Self {
        Self {
            bounds,
            score: r.score,
            rival: r.rival,
            rival_place: r.rival_place,
            margin: r.margin(AMBIGUITY),
            drift: r.drift,
        }
    }

    /// Probability of being found in a picture, as far as a rehearsal can tell.
    pub fn probability(&self) -> f64 {
        let rise = |x: f64| 1.0 / (1.0 + (-x).exp());
        REHEARSAL
            * rise((self.margin - EVEN_MARGIN) / MARGIN_WIDTH)
            * rise((self.score - LEAST_SCORE) / MARGIN_WIDTH)
    }
}

/// Rehearses the places of a map, one a call, so that the caller can show progress and stop.
pub struct Ranking<'a> {
    map: Arc<dyn Imagery>,
    days: &'a [Arc<dyn Imagery>],
    radius: f64,
    places: Vec<GroundRect>,
    next: usize,
    found: Vec<Candidate>,
}

impl<'a> Ranking<'a> {
    /// Boxes of `side` metres all over `region`, half a side apart, to be rehearsed on `days` within
    /// `radius` metres around them.
    pub fn new(
        map: Arc<dyn Imagery>,
        days: &'a [Arc<dyn Imagery>],
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
            days,
            radius,
            places,
            next: 0,
            found: Vec::new(),
        }
    }

    /// Only the places that a camera can see whole from `frames`.
    #[must_use]
    pub fn seen_from(
        mut self,
        camera: &CameraModel,
        frames: &[(f64, Pose)],
        ground_down: f64,
    ) -> Self {
        self.places.retain(|bounds| {
            frames
                .iter()
                .any(|(_, pose)| holds(camera, pose, bounds, ground_down))
        });
        self
    }

    /// Places done, and places in all.
    pub fn progress(&self) -> (usize, usize) {
        (self.next, self.places.len())
    }

    /// Rehearses the next place; false when all are done.
    pub fn advance(&mut self) -> bool {
        let Some(bounds) = self.places.get(self.next) else {
            return false;
        };
        self.next += 1;
        let mut worst: Option<Candidate> = None;
        for day in self.days {
            let Some(rehearsal) = rehearse(self.map.as_ref(), day.as_ref(), bounds, self.radius)
            else {
                return true;
            };
            let candidate = Candidate::of(*bounds, &rehearsal);
            // A place that fails on one day need not be tried on the others.
            if candidate.probability() < 0.03 {
                return true;
            }
            if worst.is_none_or(|w| candidate.probability() < w.probability()) {
                worst = Some(candidate);
            }
        }
        self.found.extend(worst);
        true
    }

    /// The places that passed so far, the most certain first.
    pub fn ranked(mut self) -> Vec<Candidate> {
        self.found
            .sort_by(|a, b| b.probability().total_cmp(&a.probability()));
        self.found
    }
}

/// A proposed landmark and why.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Suggestion {
    /// The box and its rehearsal.
    pub candidate: Candidate,
    /// Seconds of the flight in which it is in the picture.
    pub in_view: f64,
    /// Seconds of the flight that it newly keeps from dead reckoning.
    pub gained: f64,
    /// The reason in words.
    pub reason: String,
}

/// Chooses at most `count` of `candidates` for a flight whose camera is at `frames` (time in seconds,
/// pose).
///
/// Each second of the flight is worth the probability of having a fix, where a landmark in view u
/// seconds ago still counts as `p exp(-u / τ)`, and any of several serves: `1 - Π (1 - pᵢ)`. That is
/// monotone and submodular, so that taking the landmark of the greatest gain, again and again, comes to
/// within 1 - 1/e of the best set (Nemhauser, Wolsey and Fisher 1978); the weakest stretch is where the
/// most is to be gained.
pub fn choose(
    candidates: &[Candidate],
    camera: &CameraModel,
    frames: &[(f64, Pose)],
    ground_down: f64,
    count: usize,
) -> Vec<Suggestion> {
    let worth: Vec<Vec<f64>> = candidates
        .iter()
        .map(|c| certainty(c, camera, frames, ground_down))
        .collect();
    let times: Vec<f64> = frames.iter().map(|(t, _)| *t).collect();
    let lasting = |i: usize| {
        let next = times.get(i + 1).copied();
        next.map_or(0.0, |n| n - times[i])
    };
    let mut covered = vec![0.0_f64; frames.len()];
    let mut chosen: Vec<Suggestion> = Vec::new();
    let mut left: Vec<usize> = (0..candidates.len()).collect();
    while chosen.len() < count {
        // What taking a landmark adds to a measure of the certainty of each moment.
        let gain = |i: usize, measure: &dyn Fn(f64) -> f64| -> f64 {
            let gains = worth[i].iter().zip(&covered).enumerate();
            let gains = gains.filter(|(_, (w, _))| **w > 0.0);
            gains
                .map(|(f, (w, c))| (measure(c + w * (1.0 - c)) - measure(*c)) * lasting(f))
                .sum()
        };
        let best = left
            .iter()
            .map(|i| (gain(*i, &|c| (1.0 + c / NEXT_TO_NONE).ln()), *i))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, index)) = best.filter(|(gain, _)| *gain > 1e-3) else {
            break;
        };
        let gained = gain(index, &|c| c);
        for (c, w) in covered.iter_mut().zip(&worth[index]) {
            *c += w * (1.0 - *c);
        }
        let candidate = candidates[index];
        // Boxes that share ground with it would only be found and missed together with it.
        left.retain(|i| !candidates[*i].bounds.overlaps(&candidate.bounds));
        let held: Vec<f64> = frames
            .iter()
            .enumerate()
            .filter(|(_, (_, pose))| holds(camera, pose, &candidate.bounds, ground_down))
            .map(|(i, _)| lasting(i))
            .collect();
        let in_view: f64 = held.iter().sum();
        chosen.push(Suggestion {
            candidate,
            in_view,
            gained,
            reason: reason(&candidate, in_view, gained),
        });
    }
    chosen
}

fn reason(candidate: &Candidate, in_view: f64, gained: f64) -> String {
    let middle = candidate.bounds.center();
    let to = candidate.rival_place;
    let distance = middle.distance(&to);
    format!(
        "in view for {in_view:.0} s, keeps {gained:.0} s from dead reckoning; scores {:.2} on its worst \
         rehearsal day, the strongest look-alike {distance:.0} m away {:.2}",
        candidate.score, candidate.rival
    )
}

/// For every frame the certainty of the position if this landmark alone were used.
fn certainty(
    candidate: &Candidate,
    camera: &CameraModel,
    frames: &[(f64, Pose)],
    ground_down: f64,
) -> Vec<f64> {
    let p = candidate.probability();
    let mut last: Option<f64> = None;
    frames
        .iter()
        .map(|(time, pose)| {
            if holds(camera, pose, &candidate.bounds, ground_down) {
                last = Some(*time);
            }
            last.map_or(0.0, |seen| p * (-(time - seen) / FADING).exp())
        })
        .collect()
}

/// Whether the whole box lies in the picture, with a twentieth of the picture to spare.
fn holds(camera: &CameraModel, pose: &Pose, bounds: &GroundRect, ground_down: f64) -> bool {
    camera.holds(pose, bounds, ground_down, 0.05 * camera.height as f64)
}

/// Level poses at `height` metres over a path, two a second at `speed` m/s: where the camera will be as
/// far as a line on the map tells.
pub fn poses_over(
    path: &[GroundPoint],
    height: f64,
    speed: f64,
    ground_down: f64,
) -> Vec<(f64, Pose)> {
    let mut poses = Vec::new();
    let mut travelled = 0.0;
    let mut due = 0.0;
    let step = 0.5 * speed.max(0.1);
    for leg in path.windows(2) {
        let way = leg[1].to_vector() - leg[0].to_vector();
        let length = way.norm();
        if length < 1e-9 {
            continue;
        }
        let course = way.y.atan2(way.x);
        while due <= travelled + length {
            let at = leg[0].to_vector() + way * ((due - travelled) / length);
            let pose = Pose {
                position_in_world: Point3::new(at.x, at.y, ground_down - height),
                attitude: Attitude::level(course),
            };
            poses.push((due / speed.max(0.1), pose));
            due += step;
        }
        travelled += length;
    }
    poses
}

/// Level poses at `height` metres, `step` metres apart all over `region`, so far apart in time that no
/// fix lasts from one to the next: for a map over which nobody knows the route yet.
pub fn poses_all_over(
    region: &GroundRect,
    height: f64,
    step: f64,
    ground_down: f64,
) -> Vec<(f64, Pose)> {
    let count = |length: f64| (length / step.max(0.1)).floor().max(0.0) as usize + 1;
    let mut poses = Vec::new();
    for row in 0..count(region.height()) {
        for column in 0..count(region.width()) {
            let north = region.south + step * row as f64;
            let east = region.west + step * column as f64;
            let pose = Pose {
                position_in_world: Point3::new(north, east, ground_down - height),
                attitude: Attitude::level(0.0),
            };
            poses.push((1e3 * poses.len() as f64, pose));
        }
    }
    poses
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(north: f64, east: f64, margin: f64) -> Candidate {
        let place = GroundPoint::new(north, east);
        Candidate {
            bounds: GroundRect::centered(place, 30.0, 30.0),
            score: 0.8,
            rival: 0.3,
            rival_place: GroundPoint::new(north + 40.0, east),
            margin,
            drift: 0.1,
        }
    }

    #[test]
    fn a_second_landmark_is_chosen_where_the_route_has_none_and_not_beside_the_first() {
        let path = [GroundPoint::new(0.0, 0.0), GroundPoint::new(1200.0, 0.0)];
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let frames = poses_over(&path, 120.0, 20.0, 0.0);
        let offered = [
            candidate(200.0, 0.0, 0.4),
            candidate(240.0, 0.0, 0.39),
            candidate(800.0, 10.0, 0.2),
            candidate(500.0, 900.0, 0.5),
        ];
        let chosen = choose(&offered, &camera, &frames, 0.0, 4);
        let middles: Vec<f64> = chosen
            .iter()
            .map(|s| s.candidate.bounds.center().north)
            .collect();
        assert_eq!(middles[..2], [200.0, 800.0], "{chosen:#?}");
        assert!(!middles.contains(&500.0), "it is never in view");
        assert!(chosen[0].in_view > 2.0 && chosen[0].gained > chosen[1].gained - 1e-9);
    }

    #[test]
    fn poses_lie_on_the_path_half_a_second_apart_across_its_corners() {
        let path = [(0.0, 0.0), (95.0, 0.0), (95.0, 100.0)].map(|(n, e)| GroundPoint::new(n, e));
        let poses = poses_over(&path, 100.0, 20.0, 0.0);
        assert_eq!(poses.len(), 20);
        assert!(
            poses
                .windows(2)
                .all(|p| (p[1].0 - p[0].0 - 0.5).abs() < 1e-9)
        );
        let last = poses[19].1;
        assert!((last.position_in_world.y - 95.0).abs() < 1e-9, "{last:?}");
    }
}
