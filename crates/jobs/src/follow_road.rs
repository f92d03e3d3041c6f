//! A road drawn with help: from the last point to the next along the road in the map's picture.

use pilotage_core::frames::GroundPoint;
use pilotage_core::road::{NotFollowed, RoadFollowing, RoadOnGround};
use pilotage_core::roads::thinned;
use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, keys_of};
use super::running::slice;
use super::{Advance, JobEvent, MapSource, RunningJob, WorkerState};

/// Farthest that a line lies off the middle of its road for having few points, metres.
const TOLERANCE: f64 = 0.5;
/// Longest stretch without a sight of the road that nobody is told of, metres: a crown over it, or a truck on it.
const UNTOLD: f64 = 25.0;
/// Share of the work before the ground is looked at to its end.
const LOOKS: f32 = 0.9;

/// Road to be followed from a place to another: events `Progress`, and `Figures` with a [`FollowedRoad`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FollowRoadOrder {
    /// The map.
    pub map: MapSource,
    /// The places, in the frame of the map.
    pub ends: [GroundPoint; 2],
    /// Freedom of each of them to be moved into the middle of the road on which it lies.
    pub is_free: [bool; 2],
}

/// Road that was followed, or the straight line in its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FollowedRoad {
    /// Places from the one end to the other.
    pub course: Vec<GroundPoint>,
    /// Width of the road, metres, where one is seen.
    pub width: Option<f64>,
    /// Sentence about why the line is straight, or where no road was seen, if there is anything to say.
    pub told: Option<String>,
}

impl FollowedRoad {
    /// The straight line, and why there is no other.
    pub fn straight(ends: [GroundPoint; 2], why: &str) -> Self {
        Self {
            course: ends.to_vec(),
            width: None,
            told: Some(format!("The line is straight there: {why}.")),
        }
    }

    fn of(road: &RoadOnGround) -> Self {
        let told = (road.gap > UNTOLD).then(|| {
            format!(
                "The line is straight for {:.0} m of it, where no road is seen.",
                road.gap
            )
        });
        Self {
            course: thinned(&road.course, TOLERANCE),
            width: road.width,
            told,
        }
    }
}

/// The road being followed.
struct FollowRoad {
    order: FollowRoadOrder,
    under_way: Option<RoadFollowing>,
}

impl FollowRoad {
    fn answer(&self, road: Result<RoadOnGround, NotFollowed>) -> FollowedRoad {
        let straight = |why: NotFollowed| FollowedRoad::straight(self.order.ends, &why.to_string());
        road.map_or_else(straight, |road| FollowedRoad::of(&road))
    }
}

impl RunningJob for FollowRoad {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let begun = match self.under_way.take() {
            Some(following) => Ok(following),
            None => RoadFollowing::new(worker.map(&self.order.map)?, self.order.ends),
        };
        let road = match begun {
            Err(why) => Err(why),
            Ok(mut following) => {
                let more = slice(clock, || following.advance());
                let (done, all) = following.progress();
                if more {
                    let share = LOOKS * done as f32 / all.max(1) as f32;
                    emit(JobEvent::Progress(share, "Following the road".to_owned()));
                    self.under_way = Some(following);
                    return Ok(Advance::More);
                }
                following.road(self.order.is_free)
            }
        };
        for problem in worker.new_problems(&self.order.map) {
            emit(JobEvent::Remark(problem));
        }
        emit(JobEvent::of_figures(&self.answer(road))?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for FollowRoadOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let window = RoadFollowing::window(self.ends);
        Some((&self.map, Reads::Windows(vec![window])))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(FollowRoad {
            order: self,
            under_way: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::roads::{course_length, place_along, place_near};
    use pilotage_core::simulate::Scenario;

    use super::super::running::{figures, finished};
    use super::*;

    fn order(ends: [GroundPoint; 2]) -> FollowRoadOrder {
        FollowRoadOrder {
            map: MapSource::world("countryside"),
            ends,
            is_free: [true, true],
        }
    }

    #[test]
    fn roads_of_the_generated_country_are_followed_within_their_width() {
        const LEG: f64 = 160.0;
        let map = Scenario::map().road_map();
        let long = map
            .lines()
            .iter()
            .filter(|line| course_length(&line.course) > 1.5 * LEG);
        let (mut followed, mut all, mut offs) = (0, 0, Vec::new());
        for line in long.take(8) {
            let middle = 0.5 * course_length(&line.course);
            let at = |along| place_along(&line.course, along).map(|place| place.point);
            let ends =
                [middle - 0.5 * LEG, middle + 0.5 * LEG].map(|along| at(along).expect("on it"));
            let road: FollowedRoad = figures(order(ends));
            all += 1;
            let Some(width) = road.width else {
                println!("{:?}: {:?}", line.class, road.told);
                continue;
            };
            followed += 1;
            println!("{:?} of {:.1} m: {width:.1} m", line.class, line.width);
            for step in 0..=40 {
                let along = f64::from(step) / 40.0 * course_length(&road.course);
                let place = place_along(&road.course, along).expect("two points").point;
                let off = place_near(&line.course, place)
                    .expect("a line")
                    .point
                    .distance(&place);
                assert!(
                    off < line.width,
                    "{:?}: {off} m off a road of {} m",
                    place,
                    line.width
                );
                offs.push(off);
            }
        }
        offs.sort_unstable_by(f64::total_cmp);
        println!(
            "{followed} of {all} followed; median {:.2} m off",
            offs[offs.len() / 2]
        );
        assert!(all >= 4 && 4 * followed >= 3 * all, "{followed} of {all}");
        assert!(offs[offs.len() / 2] < 1.0);
    }

    #[test]
    fn a_leg_without_a_road_is_straight_and_says_why_and_one_without_a_map_fails() {
        let ends = [GroundPoint::new(0.0, 0.0), GroundPoint::new(2000.0, 0.0)];
        let road: FollowedRoad = figures(order(ends));
        assert_eq!((road.course, road.width), (ends.to_vec(), None));
        let told = road.told.expect("a sentence");
        assert_eq!(
            told,
            "The line is straight there: the places are 2000 m apart, and a road is followed for 1000 m at most; put a point in between."
        );
        let of_nothing = FollowRoadOrder {
            map: MapSource::Nothing,
            ..order([ends[0], GroundPoint::new(50.0, 0.0)])
        };
        let told = figures::<FollowedRoad>(of_nothing)
            .told
            .expect("a sentence");
        assert!(told.starts_with("The line is straight there: "), "{told}");
        let lost = FollowRoadOrder {
            map: MapSource::world("moon"),
            ..order(ends)
        };
        assert!(matches!(finished(lost).last(), Some(JobEvent::Failed(_))));
    }
}
