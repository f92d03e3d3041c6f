//! The road that is being drawn, leg by leg: straight ones, and others that follow the road in the map's picture, as a
//! worker finds it.

use pilotage_core::frames::GroundPoint;
use pilotage_core::roads::course_length;
use pilotage_jobs::{FollowRoadOrder, FollowedRoad, Job, JobEvent, JobId};

use super::geometry::is_on_road;
use crate::feature::FeatureContext;

/// Time after which people are told how far the work is, milliseconds.
const LONG: f64 = 500.0;

/// Way in which a leg leads to the next click.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LegKind {
    /// In a straight line.
    #[default]
    Straight,
    /// Along the road in the map's picture.
    Followed,
}

/// Leg of a road, from the end of the one before to its own.
#[derive(Clone, Debug)]
struct RoadLeg {
    /// Points but for the first; only the place that was clicked while the road is looked for.
    points: Vec<GroundPoint>,
    /// Place that was clicked.
    clicked: GroundPoint,
    /// Width of the road, metres, where it is known.
    width: Option<f64>,
    /// Whether the road is still looked for.
    is_awaited: bool,
}

/// Work on the first leg that is awaited.
#[derive(Debug)]
struct LegWork {
    job: JobId,
    leg: usize,
    begun: f64,
    /// Progress, once it takes long.
    share: Option<f32>,
}

/// Road that is being drawn.
#[derive(Debug, Default)]
pub struct RoadDrawing {
    legs: Vec<RoadLeg>,
    work: Option<LegWork>,
    /// Whether it is a road of the mission once no leg is awaited any more.
    pub is_ending: bool,
}

impl RoadDrawing {
    /// All of its points.
    pub fn course(&self) -> Vec<GroundPoint> {
        let points = self.legs.iter().flat_map(|leg| &leg.points);
        points.copied().collect()
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.legs.iter().map(|leg| leg.points.len()).sum()
    }

    /// Ends of its legs, the first of them the first point.
    pub fn ends(&self) -> impl Iterator<Item = GroundPoint> {
        self.legs
            .iter()
            .filter_map(|leg| leg.points.last().copied())
    }

    /// Whether a place is at most `reach` metres from the end, or from the click that made it.
    pub fn ends_at(&self, place: GroundPoint, reach: f64) -> bool {
        self.legs.last().is_some_and(|leg| {
            let ends = leg.points.last().into_iter().chain([&leg.clicked]);
            ends.map(|end| end.distance(&place))
                .any(|distance| distance <= reach)
        })
    }

    /// Whether the road of a leg is still looked for.
    pub fn is_awaited(&self) -> bool {
        self.legs.iter().any(|leg| leg.is_awaited)
    }

    /// Progress of the work, once it takes long.
    pub fn progress(&self) -> Option<f32> {
        self.work.as_ref()?.share
    }

    /// Mean width of the legs, metres to a tenth, where it is known of one.
    pub fn width(&self) -> Option<f64> {
        let known = self.legs.iter().filter_map(|leg| {
            let length = course_length(&leg.points).max(1.0);
            leg.width.map(|width| (length, length * width))
        });
        let (length, sum) = known.fold((0.0, 0.0), |all, leg| (all.0 + leg.0, all.1 + leg.1));
        (length > 0.0).then(|| (10.0 * sum / length).round() / 10.0)
    }

    /// Adds a leg to a place.
    pub fn add(&mut self, place: GroundPoint, kind: LegKind, context: &mut FeatureContext<'_>) {
        self.legs.push(RoadLeg {
            points: vec![place],
            clicked: place,
            width: None,
            is_awaited: kind == LegKind::Followed && !self.legs.is_empty(),
        });
        self.proceed(context);
    }

    /// Takes the last leg back; whether there was one.
    pub fn take_back(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let is_taken = self.legs.pop().is_some();
        let work = self.work.take_if(|work| work.leg >= self.legs.len());
        if let Some(work) = work {
            context.cancel(work.job);
        }
        self.is_ending = false;
        is_taken
    }

    /// Looks for no road any more: legs that are awaited are straight. Whether there was one.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        if let Some(work) = self.work.take() {
            context.cancel(work.job);
        }
        let was_awaited = self.is_awaited();
        for leg in &mut self.legs {
            leg.is_awaited = false;
        }
        was_awaited
    }

    /// Has the road of the first leg that is awaited looked for, unless one is.
    fn proceed(&mut self, context: &mut FeatureContext<'_>) {
        let leg = self.legs.iter().position(|leg| leg.is_awaited);
        let (None, Some(leg)) = (&self.work, leg) else {
            return;
        };
        let (Some(before), Some(own)) = (leg.checked_sub(1), self.legs.get(leg)) else {
            return;
        };
        let from = &self.legs[before];
        let from_end = from.points.last().copied().unwrap_or(from.clicked);
        let roads = &context.documents.mission.roads;
        let order = FollowRoadOrder {
            map: context.documents.map.source.clone(),
            ends: [from_end, own.clicked],
            // The end of a leg stays, and so does a crossing with another road.
            is_free: [
                before == 0 && !is_on_road(roads, from_end),
                !is_on_road(roads, own.clicked),
            ],
        };
        self.work = Some(LegWork {
            job: context.start(Job::FollowRoad(order)),
            leg,
            begun: context.host.now(),
            share: None,
        });
    }

    /// Takes an event of its work; false if it is of another job, or of a kind that nobody waits for.
    pub fn take(&mut self, job: JobId, event: &JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let Some(work) = self.work.as_mut().filter(|work| work.job == job) else {
            return false;
        };
        let leg = work.leg;
        match event {
            JobEvent::Progress(share, _) => {
                let is_long = context.host.now() - work.begun > LONG;
                work.share = is_long.then_some(*share);
            }
            JobEvent::Figures(_) => match event.read_figures() {
                Ok(road) => self.lay(leg, road, context),
                Err(why) => Self::tell(&why, context),
            },
            JobEvent::Failed(why) => Self::tell(why, context),
            JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if event.is_last() {
            self.work = None;
            if let Some(leg) = self.legs.get_mut(leg) {
                leg.is_awaited = false;
            }
            self.proceed(context);
        }
        true
    }

    /// Puts a leg onto the road that was found.
    fn lay(&mut self, leg: usize, road: FollowedRoad, context: &mut FeatureContext<'_>) {
        let [first, rest @ ..] = &road.course[..] else {
            return;
        };
        if let Some(begin) = self.legs[leg - 1].points.last_mut() {
            *begin = *first;
        }
        let own = &mut self.legs[leg];
        own.points = rest.to_vec();
        own.width = road.width;
        if let Some(told) = road.told {
            Self::tell(&told, context);
        }
    }

    fn tell(why: &str, context: &mut FeatureContext<'_>) {
        context.note("Following the road", why);
    }
}
