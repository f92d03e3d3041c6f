//! Poses that a view may have: crossings that were seen, laid on crossings of the map.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use pilotage_base::frames::{GroundPoint, wrap_pi};

use super::field::bin;
use super::index::RoadIndex;
use super::junctions::ArmMask;
use super::pairs::{APART, CrossingPair};
use super::prepared::PreparedView;
use super::settings::LostSettings;
use super::view::{ViewCrossing, ViewPoint, ViewPose};
use crate::course::heading;

/// Standard deviation of the place of a crossing that was seen, metres.
const SEEN: f64 = 5.0;
/// Distances are looked for within so many standard deviations.
const WITHIN: f64 = 2.2;
/// Distance from a road within which a point counts in the first look, metres.
const NEAR: f32 = 9.0;
/// The same for each metre from the crossing where one crossing alone gave the heading.
const NEAR_PER_METRE: f32 = 0.03;
/// Points after which a place is given up, with the share that has to be near a road by then.
const GIVE_UP: [(usize, f32); 2] = [(10, 0.3), (20, 0.38)];
/// Share of the points of the first look that have to be near a road.
const LEAST: f32 = 0.42;
/// Most pairs of the map, or of a part of it, that are tried before the commoner pairs of the view are left out.
const MOST_TRIED: usize = 120_000;
/// Most pairs of the map, or of a part of it without the ground around, that are compared before less sure crossings are left out.
const MOST_COMPARED: usize = 12_000_000;
/// Pairs that were seen up to which crossings by themselves are tried as well.
const FEW_PAIRS: usize = 8;
/// Most crossings that are tried by themselves.
const ALONE: usize = 6;
/// Cells within which hypotheses are one: metres and radians.
const SAME: (f64, f64) = (8.0, 0.03);

/// Pair of crossings that were seen, by their numbers: pairs of the map that are like it, each with whether it is so the
/// other way round.
type SeenPair = (Vec<(CrossingPair, bool)>, [usize; 2]);

/// Hypotheses by the cell of their pose, with the share of points near a road.
#[derive(Default)]
pub(super) struct Hypotheses {
    cells: BTreeMap<(i32, i32, i32), (f32, ViewPose)>,
    /// Metres beside the places that are sought at which poses are looked at.
    margin: f64,
    /// Number of poses that were looked at.
    pub tried: usize,
    /// Number of poses of commoner pairs that were not.
    pub left: usize,
}

impl Hypotheses {
    /// Every pose that lays what was seen on crossings of the map and most points near roads.
    pub fn of(
        view: &PreparedView,
        index: &RoadIndex,
        settings: &LostSettings,
        margin: f64,
    ) -> Self {
        let mut own = Self {
            margin,
            ..Self::default()
        };
        let seen = own.by_pairs(view, index, settings);
        if seen < FEW_PAIRS {
            for crossing in view.crossings.iter().take(ALONE) {
                own.by_crossing(crossing, view, index, settings);
            }
        }
        own
    }

    /// The best `most`, the best first.
    pub fn best(self, most: usize) -> Vec<ViewPose> {
        let mut all: Vec<_> = self.cells.into_values().collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        all.truncate(most);
        all.into_iter().map(|(_, pose)| pose).collect()
    }

    fn by_pairs(
        &mut self,
        view: &PreparedView,
        index: &RoadIndex,
        settings: &LostSettings,
    ) -> usize {
        let crossings = &view.crossings;
        let mut pairs: Vec<SeenPair> = Vec::new();
        let mut compared = 0;
        let most_compared = (MOST_COMPARED as f64 * index.share) as usize;
        // Pairs of the surest crossings first.
        for (j, second) in crossings.iter().enumerate() {
            if compared > most_compared {
                break;
            }
            for (i, first) in crossings.iter().enumerate().take(j) {
                let distance = (second.place - first.place).norm();
                if !(APART.0..APART.1).contains(&distance) {
                    continue;
                }
                let base = heading(first.place.into(), second.place.into());
                let arms = [first, second].map(|c| ArmMask::of(&c.directions, base));
                let spread = WITHIN * (settings.scale * distance).hypot(1.4 * SEEN);
                let range = (distance - spread, distance + spread);
                let mut found = Vec::new();
                compared += index.pairs.visit(range, arms, |pair, is_reversed| {
                    found.push((*pair, is_reversed));
                });
                pairs.push((found, [i, j]));
            }
        }
        // Rare ones first.
        pairs.sort_by_key(|(found, seen)| (found.len(), *seen));
        let count = pairs.len();
        for (found, [i, j]) in pairs {
            let is_left = self.tried > MOST_TRIED;
            let seen = [&crossings[i], &crossings[j]];
            for (pair, is_reversed) in found {
                let known = if is_reversed {
                    [pair.second, pair.first]
                } else {
                    [pair.first, pair.second]
                };
                let known = known.map(|k| index.junctions[k as usize].place);
                let pose = pose_of_pair(seen, known, settings);
                if is_left {
                    self.left += usize::from(self.is_sought(&pose, index, settings));
                } else {
                    self.look(pose, None, view, index, settings);
                }
            }
        }
        count
    }

    fn by_crossing(
        &mut self,
        seen: &ViewCrossing,
        view: &PreparedView,
        index: &RoadIndex,
        settings: &LostSettings,
    ) {
        let own = ArmMask::of(&seen.directions, 0.0);
        let least = own.0.count_ones().min(3);
        for junction in &index.junctions {
            let known = ArmMask::of(&junction.arms, 0.0).widened();
            let mut turns: Vec<f64> = Vec::new();
            for arm in &junction.arms {
                for direction in &seen.directions {
                    let turn = wrap_pi(arm - direction);
                    let bins = (turn.rem_euclid(TAU) / TAU * 36.0).round() as u32;
                    if known.common(own.turned(bins)) < least {
                        continue;
                    }
                    let turn = mean_turn(&seen.directions, &junction.arms, turn);
                    if turns.iter().all(|known| wrap_pi(turn - known).abs() > 0.1) {
                        turns.push(turn);
                    }
                }
            }
            for turn in turns {
                let mut pose = ViewPose {
                    place: GroundPoint::default(),
                    turn,
                    scale: 1.0,
                };
                let off = pose.on_map(seen.place).to_vector();
                pose.place = GroundPoint::from(junction.place.to_vector() - off);
                self.look(pose, Some(seen), view, index, settings);
            }
        }
    }

    /// Whether a pose is one that is asked for.
    fn is_sought(&self, pose: &ViewPose, index: &RoadIndex, settings: &LostSettings) -> bool {
        wrap_pi(pose.turn - settings.turn).abs() <= settings.within_turn
            && index.is_sought(&pose.place, self.margin)
    }

    /// Looks at a pose, and keeps it if most points lie near roads.
    fn look(
        &mut self,
        pose: ViewPose,
        about: Option<&ViewCrossing>,
        view: &PreparedView,
        index: &RoadIndex,
        settings: &LostSettings,
    ) {
        if !self.is_sought(&pose, index, settings) {
            return;
        }
        self.tried += 1;
        let near = |point: &ViewPoint| {
            let tolerance = about.map_or(NEAR, |about| {
                NEAR + NEAR_PER_METRE * (point.place - about.place).norm() as f32
            });
            let at = pose.on_map(point.place);
            index.field.rough(at, bin(point.direction + pose.turn)) <= tolerance
        };
        let points = view.first_look();
        let mut hits = 0.0_f32;
        for (count, point) in points.iter().enumerate() {
            hits += f32::from(u8::from(near(point)));
            let gives_up =
                |(after, share): &(usize, f32)| count + 1 == *after && hits < share * *after as f32;
            if GIVE_UP.iter().any(gives_up) {
                return;
            }
        }
        let share = hits / points.len().max(1) as f32;
        if share < LEAST {
            return;
        }
        let cell = |value: f64, size: f64| (value / size).round() as i32;
        let key = (
            cell(pose.place.north, SAME.0),
            cell(pose.place.east, SAME.0),
            cell(pose.turn, SAME.1),
        );
        let kept = self.cells.entry(key).or_insert((share, pose));
        if share > kept.0 {
            *kept = (share, pose);
        }
    }
}

/// Pose that lays a pair that was seen on one of the map.
fn pose_of_pair(
    seen: [&ViewCrossing; 2],
    known: [GroundPoint; 2],
    settings: &LostSettings,
) -> ViewPose {
    let way = seen[1].place - seen[0].place;
    let turn =
        wrap_pi(heading(known[0], known[1]) - heading(seen[0].place.into(), seen[1].place.into()));
    // The distance tells the scale as well as the places of the crossings allow.
    let (distance, of_scale) = (way.norm(), settings.scale * way.norm());
    let told = of_scale.powi(2) / (of_scale.powi(2) + 2.0 * SEEN.powi(2));
    let mut pose = ViewPose {
        place: GroundPoint::default(),
        turn,
        scale: 1.0 + told * (known[0].distance(&known[1]) / distance - 1.0),
    };
    let middle = 0.5 * (seen[0].place + seen[1].place);
    let known = 0.5 * (known[0].to_vector() + known[1].to_vector());
    pose.place = GroundPoint::from(known - pose.on_map(middle).to_vector());
    pose
}

/// Mean turn from arms that were seen to the nearest known ones, about a first one.
fn mean_turn(seen: &[f64], known: &[f64], turn: f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for direction in seen {
        let off = known.iter().map(|arm| wrap_pi(arm - direction - turn));
        let nearest = off.min_by(|a, b| a.abs().total_cmp(&b.abs()));
        if let Some(off) = nearest.filter(|off| off.abs() < 0.3) {
            sum += off;
            count += 1.0;
        }
    }
    wrap_pi(turn + sum / f64::max(count, 1.0))
}
