//! Looks at boxes anywhere on a map, which tell what a landmark is worth that nobody tested.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::Landmark;
use pilotage_core::mission::Mission;
use pilotage_core::plan::{UntestedDetection, ViewResult, random_boxes, shows_ground};
use pilotage_core::sorting::sort;
use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, around};
use super::running::slice;
use super::{Advance, AssessmentOrder, JobEvent, MapSource, RunningJob, WorkerState};

/// Boxes being looked at.
struct LookAtBoxes {
    order: UntestedOrder,
    boxes: Vec<GroundRect>,
    looks: Vec<Vec<ViewResult>>,
}

/// Whether a map shows ground in the middle and at the corners of a box.
fn is_whole(map: &dyn Imagery, bounds: &GroundRect) -> bool {
    let mut places = bounds.corners().into_iter().chain([bounds.center()]);
    places.all(|place| shows_ground(map, place))
}

impl LookAtBoxes {
    /// Looks at the next box on a day of its own; not at one of which the map does not show all.
    fn look(&mut self, worker: &mut WorkerState) -> Result<(), String> {
        let index = self.looks.len();
        let bounds = self.boxes[index];
        let order = &self.order.like;
        if !is_whole(worker.cached_map(&order.map)?.as_ref(), &bounds) {
            self.looks.push(Vec::new());
            return Ok(());
        }
        let days = worker.rehearsal_days(&order.map, order.seed)?;
        let of_box = AssessmentOrder {
            landmark: Landmark::new(order.landmark.id, "a box", bounds),
            seed: order.seed + index as u64,
            ..order.as_ref().clone()
        };
        let day = index % days.len().max(1);
        let mut assessor = of_box.assessor(worker, &days[day..=day])?;
        for _ in 0..UntestedDetection::LOOKS {
            assessor.look();
        }
        self.looks.push(assessor.views().to_vec());
        Ok(())
    }
}

impl RunningJob for LookAtBoxes {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let all = self.boxes.len();
        let mut outcome = Ok(());
        let more = slice(clock, || {
            if self.looks.len() < all && outcome.is_ok() {
                outcome = self.look(worker);
            }
            self.looks.len() < all && outcome.is_ok()
        });
        outcome?;
        let done = self.looks.len();
        let share = done as f32 / all.max(1) as f32;
        emit(JobEvent::Progress(share, format!("Box {done} of {all}")));
        if more {
            return Ok(Advance::More);
        }
        let found = UntestedDetection::of(&self.looks)
            .ok_or("too few boxes of this map fit into a picture and show ground")?;
        emit(JobEvent::Untested(Box::new(found)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// Distance around what is planned in which boxes are drawn, metres.
const REACH: f64 = 500.0;

/// Question what a landmark that nobody tested is worth on a map: event `Untested`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UntestedOrder {
    /// Circumstances of a landmark of the usual size; it is not looked at itself.
    pub like: Box<AssessmentOrder>,
    /// Ground on which boxes are drawn.
    pub within: GroundRect,
}

impl UntestedOrder {
    /// Question about the part of `map` (the ground that has pixels) around some places; about all of it without one.
    /// `like` states the circumstances, and by its landmark the usual size.
    pub fn around(
        like: AssessmentOrder,
        map: &GroundRect,
        places: impl IntoIterator<Item = GroundPoint>,
    ) -> Self {
        let near = GroundRect::around(places).map(|area| area.grown(REACH));
        let within = near.and_then(|area| area.intersection(map));
        Self {
            like: Box::new(like),
            within: within.unwrap_or(*map),
        }
    }

    /// Question about the part of `map` around the landmarks of a mission and the places of a route.
    pub fn of(
        mission: &Mission,
        like: AssessmentOrder,
        map: &GroundRect,
        route: Vec<GroundPoint>,
    ) -> Self {
        let landmarks = mission.landmarks.iter().map(|it| it.bounds.center());
        Self::around(like, map, landmarks.chain(route))
    }

    /// Usual side of the boxes that people draw in a mission: the middle one of those of its landmarks, metres; `None`
    /// without any.
    pub fn usual_side(mission: &Mission) -> Option<f64> {
        let bounds = mission.landmarks.iter().map(|it| it.bounds);
        let mut sides: Vec<f64> = bounds.map(|b| (b.width() * b.height()).sqrt()).collect();
        sort(&mut sides, &|a, b| a.total_cmp(b));
        sides.get(sides.len() / 2).copied()
    }

    /// A box of that side, metres, wherever it lies.
    pub fn usual_box(side: f64) -> Landmark {
        let bounds = GroundRect::centered(GroundPoint::default(), side, side);
        Landmark::new(0, "a box", bounds)
    }

    fn boxes(&self) -> Vec<GroundRect> {
        let bounds = &self.like.landmark.bounds;
        let side = (bounds.width() * bounds.height()).sqrt();
        random_boxes(&self.within, side, UntestedDetection::BOXES, self.like.seed)
    }
}

impl Order for UntestedOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        self.like.files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let areas = self.boxes().iter().map(around).collect();
        Some((&self.like.map, Reads::Areas(areas)))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(LookAtBoxes {
            boxes: self.boxes(),
            order: self,
            looks: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::running::finished;
    use pilotage_core::simulate::Scenario;

    fn order(map: MapSource, within: GroundRect) -> UntestedOrder {
        UntestedOrder::around(like(map), &within, [])
    }

    fn like(map: MapSource) -> AssessmentOrder {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let middle = GroundRect::centered(GroundPoint::new(0.0, 0.0), 30.0, 30.0);
        AssessmentOrder {
            map,
            landmark: Landmark::new(1, "a usual one", middle),
            camera: Scenario::camera(),
            height: scenario.height,
            navigator: scenario.mission().navigator,
            ground_down: 0.0,
            seed: AssessmentOrder::SEED,
        }
    }

    fn said(order: UntestedOrder) -> Result<UntestedDetection, String> {
        let events = finished(order).into_iter();
        let mut told = events.filter_map(|event| match event {
            JobEvent::Untested(found) => Some(Ok(*found)),
            JobEvent::Failed(why) => Some(Err(why)),
            _ => None,
        });
        told.next().unwrap()
    }

    /// Looks at each box that is measured fully, each on a day of its own.
    const LOOKS: usize = 4;

    #[test]
    fn boxes_at_random_are_found_as_often_as_others_that_are_measured_fully() {
        let middle = GroundPoint::new(0.0, 0.0);
        let within = GroundRect::centered(middle, 1200.0, 1200.0);
        let order = order(MapSource::world("countryside"), within);
        let like = order.like.clone();
        let stated = said(order).unwrap();
        assert_eq!(stated.boxes, UntestedDetection::BOXES);
        let mut worker = WorkerState::new(crate::Abilities::WHOLE.opens);
        let days = worker.rehearsal_days(&like.map, 77).unwrap();
        let others = random_boxes(&within, 30.0, 12, 5).into_iter();
        let measured = others.map(|bounds| {
            let of_box = AssessmentOrder {
                landmark: Landmark::new(1, "another", bounds),
                ..like.as_ref().clone()
            };
            let mut assessor = of_box.assessor(&mut worker, &days).unwrap();
            for _ in 0..LOOKS {
                assessor.look();
            }
            assessor.expected().unwrap().probability()
        });
        let all: Vec<f64> = measured.collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let square = |p: &f64| (p - mean) * (p - mean);
        let variance = all.iter().map(square).sum::<f64>() / (all.len() - 1) as f64;
        // Both are means over boxes: of 24 with two looks, of 12 with four, one a day.
        let n = stated.boxes as f64;
        let deviation = (variance * (1.0 / n + 1.0 / all.len() as f64)
            + mean * (1.0 - mean) / (2.0 * n))
            .sqrt();
        let off = stated.expected.probability() - mean;
        println!(
            "stated {:.3}, measured {mean:.3}, one sigma {deviation:.3}",
            off + mean
        );
        assert!(
            off.abs() < 2.6 * deviation,
            "{off:.3}, one sigma is {deviation:.3}"
        );
        assert!(
            mean < 0.6,
            "boxes at random are found in {mean:.2} of looks"
        );
    }

    #[test]
    fn boxes_are_drawn_around_the_plan_and_on_the_map() {
        let map = GroundRect::centered(GroundPoint::new(0.0, 0.0), 3000.0, 3000.0);
        let like = || like(MapSource::world("countryside"));
        let corner = GroundPoint::new(1400.0, 1400.0);
        let near = UntestedOrder::around(like(), &map, [corner]).within;
        assert_eq!((near.south, near.north), (900.0, 1500.0));
        assert_eq!((near.west, near.east), (900.0, 1500.0));
        let elsewhere = GroundPoint::new(9000.0, 0.0);
        let of_all = UntestedOrder::around(like(), &map, [elsewhere]).within;
        assert_eq!((of_all.south, of_all.east), (-1500.0, 1500.0));
    }

    #[test]
    fn a_map_too_small_for_boxes_says_nothing() {
        let within = GroundRect::centered(GroundPoint::new(0.0, 0.0), 20.0, 20.0);
        let why = said(order(MapSource::world("countryside"), within)).unwrap_err();
        assert!(why.contains("too few boxes"), "{why}");
    }
}
