//! Tracks, thinned to what the map's scale can show and kept until the run or the scale changes.

use pilotage_core::flight::Truth;
use pilotage_core::frames::{GroundPoint, GroundRect, wrap_pi};
use pilotage_core::navigator::Run;

use crate::views::DEAD_RECKONING_AFTER;

/// A point of a thinned track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinnedPoint {
    /// Seconds in the flight's time base.
    pub time: f64,
    /// Place of the point.
    pub place: GroundPoint,
    /// Whether anything told the place then or a moment before.
    pub corrected: bool,
}

/// Points per group that is looked at or passed over together.
const GROUP: usize = 32;
/// The same of a rough track.
const ROUGH_GROUP: usize = 8;
/// Powers of two by which a rough track is rougher.
const ROUGHER: i32 = 2;
/// Longest time between two points: along the line between them, time is taken to run evenly.
const LONGEST: f64 = 4.0;
/// The same of a rough track.
const ROUGH_LONGEST: f64 = 60.0;

/// A track thinned to what the map's scale can show, that grows with its source.
///
/// Points on a straight line are left out as they come: from the last point kept, a fan of
/// directions is open in which a line passes every point since at less than the tolerance; the
/// point before the first that lies outside the fan is kept.
#[derive(Clone, Debug, Default)]
pub struct ThinTrack {
    /// A rough one is for what lies far from the time cursor: it goes by in a pixel or two, and does
    /// not tell where landmarks corrected.
    rough: bool,
    generation: u64,
    level: i32,
    used: usize,
    /// Time at which the place was told last, seconds.
    placed: Option<f64>,
    points: Vec<ThinnedPoint>,
    /// The ground under each group of points and the line to the point behind it.
    groups: Vec<GroundRect>,
    last: Option<ThinnedPoint>,
    fan: Option<Fan>,
}

/// Directions from the last point kept, as a middle one and how far to either side of it, radians.
#[derive(Clone, Copy, Debug)]
struct Fan {
    middle: f64,
    left: f64,
    right: f64,
    reach: f64,
}

/// Size of what cannot be seen at this scale, metres, as a power of two.
fn level_of(metres_per_point: f64) -> i32 {
    (metres_per_point * 0.5).log2().floor() as i32
}

impl ThinTrack {
    /// A rough track.
    pub fn rough() -> Self {
        Self {
            rough: true,
            ..Self::default()
        }
    }

    fn group(&self) -> usize {
        if self.rough { ROUGH_GROUP } else { GROUP }
    }

    fn level_for(&self, metres_per_point: f64) -> i32 {
        level_of(metres_per_point) + if self.rough { ROUGHER } else { 0 }
    }

    fn reset(&mut self, generation: u64, level: i32, length: usize) {
        if self.generation != generation || self.level != level || self.used > length {
            *self = Self {
                rough: self.rough,
                generation,
                level,
                ..Self::default()
            };
        }
    }

    fn push(&mut self, point: ThinnedPoint) {
        match (self.points.last().copied(), self.last) {
            (Some(kept), Some(last)) => {
                // A line has the look of its end.
                let alike = self.rough || last == kept || last.corrected == point.corrected;
                let longest = if self.rough { ROUGH_LONGEST } else { LONGEST };
                let brief = point.time - kept.time < longest;
                if !(alike && brief && self.is_straight_on(&kept.place, &point.place)) {
                    self.keep(last);
                    self.is_straight_on(&last.place, &point.place);
                }
            }
            _ => self.keep(point),
        }
        self.last = Some(point);
    }

    fn keep(&mut self, point: ThinnedPoint) {
        let here = GroundRect::centered(point.place, 0.0, 0.0);
        if let Some(group) = self.groups.last_mut() {
            *group = group.union(&here);
        }
        if self.points.len().is_multiple_of(self.group()) {
            self.groups.push(here);
        }
        self.points.push(point);
        self.fan = None;
    }

    /// Whether `place` lies in the fan from `kept`, which it narrows.
    fn is_straight_on(&mut self, kept: &GroundPoint, place: &GroundPoint) -> bool {
        let tolerance = 2.0_f64.powi(self.level);
        let (north, east) = (place.north - kept.north, place.east - kept.east);
        let distance = north.hypot(east);
        if distance <= tolerance {
            return self.fan.is_none_or(|fan| fan.reach <= 2.0 * tolerance);
        }
        let direction = east.atan2(north);
        let width = (tolerance / distance).asin();
        let Some(fan) = &mut self.fan else {
            self.fan = Some(Fan {
                middle: direction,
                left: -width,
                right: width,
                reach: distance,
            });
            return true;
        };
        let turned = wrap_pi(direction - fan.middle);
        if turned < fan.left || turned > fan.right || distance < fan.reach - tolerance {
            return false;
        }
        fan.left = fan.left.max(turned - width);
        fan.right = fan.right.min(turned + width);
        fan.reach = fan.reach.max(distance);
        true
    }

    /// Follows a run; `place` picks the track.
    pub fn follow_run(
        &mut self,
        run: &Run,
        generation: u64,
        metres_per_point: f64,
        place: impl Fn(&pilotage_core::navigator::StepReport) -> GroundPoint,
    ) {
        self.reset(
            generation,
            self.level_for(metres_per_point),
            run.steps.len(),
        );
        for step in &run.steps[self.used..] {
            if step.is_placed() {
                self.placed = Some(step.time);
            }
            let is_known = |at: f64| step.time - at <= DEAD_RECKONING_AFTER;
            self.push(ThinnedPoint {
                time: step.time,
                place: place(step),
                corrected: self.rough || self.placed.is_some_and(is_known),
            });
        }
        self.used = run.steps.len();
    }

    /// Follows the truth of a flight.
    pub fn follow_truth(&mut self, truth: &Truth, generation: u64, metres_per_point: f64) {
        self.reset(
            generation,
            self.level_for(metres_per_point),
            truth.states.len(),
        );
        for state in &truth.states[self.used..] {
            self.push(ThinnedPoint {
                time: state.time,
                place: GroundPoint::new(state.position.x, state.position.y),
                corrected: true,
            });
        }
        self.used = truth.states.len();
    }

    /// Another value whenever the groups are not the earlier ones any more.
    pub fn version(&self) -> (u64, i32) {
        (self.generation, self.level)
    }

    /// The groups of points that may touch `ground`.
    pub fn groups(&self, ground: &GroundRect) -> impl Iterator<Item = PointGroup<'_>> {
        let latest = self.groups.len().wrapping_sub(1);
        self.groups
            .iter()
            .enumerate()
            .filter_map(move |(index, around)| {
                let from = index * self.group();
                let end = (from + self.group() + 1).min(self.points.len());
                let points = &self.points[from..end];
                let last = self.last.filter(|_| index == latest);
                let around = last.map_or(*around, |l| {
                    around.union(&GroundRect::centered(l.place, 0.0, 0.0))
                });
                around.overlaps(ground).then_some(PointGroup {
                    index,
                    points,
                    last,
                })
            })
    }
}

/// Some points of a track in a row, the first one of the next group included.
#[derive(Clone, Copy, Debug)]
pub struct PointGroup<'a> {
    /// Index of the group in the track.
    pub index: usize,
    points: &'a [ThinnedPoint],
    /// The latest point of the track, in its last group.
    last: Option<ThinnedPoint>,
}

impl PointGroup<'_> {
    /// The first point.
    pub fn first(&self) -> &ThinnedPoint {
        &self.points[0]
    }

    /// Side of `now` on which all of the group lies: true for the past, false for the future; `None` while it
    /// still grows or `now` lies within.
    pub fn side(&self, now: f64) -> Option<bool> {
        let complete = self.last.is_none();
        let (first, end) = (self.points.first()?, self.points.last()?);
        if complete && end.time <= now {
            Some(true)
        } else if complete && first.time > now {
            Some(false)
        } else {
            None
        }
    }

    /// Whether it grows no more.
    pub fn is_complete(&self) -> bool {
        self.last.is_none()
    }

    /// All of its points.
    pub fn points(&self) -> &[ThinnedPoint] {
        self.points
    }

    /// Times at which it begins and ends.
    pub fn times(&self) -> (f64, f64) {
        let end = self.last.or(self.points.last().copied());
        let begin = self.first().time;
        (begin, end.map_or(begin, |e| e.time))
    }

    /// The points, with one at `now` put in if that lies between two of them.
    pub fn split_at(&self, now: f64) -> Vec<ThinnedPoint> {
        let mut points: Vec<_> = self.points.iter().copied().chain(self.last).collect();
        let after = points.partition_point(|p| p.time <= now);
        if let Some(before) = after.checked_sub(1).map(|i| points[i])
            && let Some(next) = points.get(after).copied()
        {
            let fraction = (now - before.time) / (next.time - before.time);
            let between = |a: f64, b: f64| a + fraction * (b - a);
            let here = ThinnedPoint {
                time: now,
                place: GroundPoint::new(
                    between(before.place.north, next.place.north),
                    between(before.place.east, next.place.east),
                ),
                corrected: next.corrected,
            };
            points.insert(after, here);
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::views::fixture::{Fixture, reading_of_gps};
    use crate::views::placed_lately;

    /// A bent course at 20 m/s with a sharp turn in the middle, corrected now and then.
    fn course() -> Vec<ThinnedPoint> {
        let along = |i: u32| {
            let t = 0.05 * f64::from(i);
            let (north, east) = if i < 1000 {
                (20.0 * t, 40.0 * (0.1 * t).sin())
            } else {
                (
                    1000.0 - 20.0 * (t - 50.0),
                    40.0 * (0.1 * t).sin() + t - 50.0,
                )
            };
            ThinnedPoint {
                time: t,
                place: GroundPoint::new(north, east),
                corrected: i % 300 < 80,
            }
        };
        (0..2000).map(along).collect()
    }

    fn thinned(course: &[ThinnedPoint], level: i32) -> ThinTrack {
        let mut track = ThinTrack {
            level,
            ..ThinTrack::default()
        };
        for point in course {
            track.push(*point);
        }
        track
    }

    /// All points of a track, without those at which groups meet being there twice.
    fn points(track: &ThinTrack, now: f64) -> Vec<ThinnedPoint> {
        let everywhere = GroundRect::centered(GroundPoint::new(0.0, 0.0), 1e5, 1e5);
        let groups = track.groups(&everywhere);
        let mut points: Vec<_> = groups.flat_map(|g| g.split_at(now)).collect();
        points.dedup();
        points
    }

    #[test]
    fn a_thinned_track_passes_every_point_nearer_than_can_be_seen() {
        let course = course();
        let track = thinned(&course, 0);
        let kept = points(&track, -1.0).len();
        assert!(kept < course.len() / 8, "{kept}");
        for point in &course {
            let there = points(&track, point.time);
            let there = there.iter().rfind(|p| p.time <= point.time + 1e-9);
            let place = there.expect("the track begins with the course").place;
            assert!(place.distance(&point.place) < 2.0, "{point:?} {place:?}");
        }
    }

    #[test]
    fn a_thinned_track_changes_its_look_where_the_course_does() {
        let course = course();
        for pair in points(&thinned(&course, 0), -1.0).windows(2) {
            let middle = 0.5 * (pair[0].time + pair[1].time);
            let at = course.partition_point(|p| p.time < middle);
            assert_eq!(course[at].corrected, pair[1].corrected, "at {middle}");
        }
    }

    /// Points of the track of a run, at a metre per point.
    fn followed(run: &Run) -> Vec<ThinnedPoint> {
        let mut track = ThinTrack::default();
        track.follow_run(run, 1, 1.0, |step| step.after.position());
        points(&track, -1.0)
    }

    #[test]
    fn a_track_is_corrected_where_an_aid_tells_the_place_with_or_without_a_camera() {
        let mut fixture = Fixture::lasting(40.0);
        for (index, step) in fixture.run.steps.iter_mut().enumerate() {
            step.frame = None;
            // A reading a second.
            if index.is_multiple_of(20) {
                step.updates = vec![reading_of_gps(1.0, Some(DMatrix::zeros(4, 2)))];
            }
        }
        let track = followed(&fixture.run);
        assert!(track.len() > 10 && track.iter().all(|point| point.corrected));
        for step in &mut fixture.run.steps {
            step.updates = vec![reading_of_gps(40.0, None)];
        }
        assert!(followed(&fixture.run).iter().all(|point| !point.corrected));
    }

    #[test]
    fn track_and_aircraft_turn_blue_two_seconds_after_the_last_correction() {
        let mut run = Fixture::lasting(10.0).run;
        for step in &mut run.steps {
            step.frame = None;
        }
        run.steps[40].updates = vec![reading_of_gps(1.0, Some(DMatrix::zeros(4, 2)))];
        let told = run.steps[40].time;
        for point in followed(&run) {
            let index = run.index_at(point.time).unwrap();
            assert_eq!(
                point.corrected,
                placed_lately(&run, index).is_some(),
                "{point:?}"
            );
        }
        let at = |after: f64| placed_lately(&run, run.index_at(told + after).unwrap()).is_some();
        assert_eq!([-0.1, 0.0, 1.9, 2.1].map(at), [false, true, true, false]);
    }

    #[test]
    fn only_groups_near_the_ground_in_view_are_drawn() {
        let track = thinned(&course(), -6);
        let view = GroundRect::centered(GroundPoint::new(200.0, 0.0), 50.0, 50.0);
        let near = track.groups(&view).count();
        assert!(near > 0 && near < track.groups.len() / 2, "{near}");
    }

    #[test]
    fn the_group_of_the_time_cursor_is_neither_past_nor_future() {
        let track = thinned(&course(), -6);
        let everywhere = GroundRect::centered(GroundPoint::new(0.0, 0.0), 1e5, 1e5);
        let sides: Vec<_> = track.groups(&everywhere).map(|g| g.side(50.0)).collect();
        assert_eq!(sides.iter().filter(|s| s.is_none()).count(), 2, "{sides:?}");
        assert_eq!((sides[0], sides[sides.len() - 1]), (Some(true), None));
        assert!(sides.contains(&Some(false)));
    }
}
