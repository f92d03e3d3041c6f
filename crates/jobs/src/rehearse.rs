//! A planned flight flown in a simulation, beside what was predicted of it.

use std::sync::Arc;

use pilotage_core::flight::{Flight, FrameSource};
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::landmark::{ChosenDetector, Detector, Landmark};
use pilotage_core::navigator::Navigator;
use pilotage_core::plan::{PlanComparison, RoutePrediction, as_stated, compare};
use pilotage_core::simulate::{FlightDay, FlightPlan, SimulatedFrames};
use serde::{Deserialize, Serialize};

use super::flights::{KeptFrames, OpenFlight};
use super::order::{Order, Reads, Urgency, WorkerRole, around, keys_of};
use super::passage::Passage;
use super::{
    Advance, JobEvent, MapSource, PredictionOrder, RehearsedFlight, RunningJob, WorkerState,
};

/// Seed of the day of the first flight, which was not rehearsed; that of another follows from its own.
const FIRST_DAY: u64 = 770_001;
/// Memory for tiles of one day, megabytes.
const CACHE: usize = 256;

/// Flight of a plan over its map, beside its prediction. It has a wind and a day of its own, drawn by `seed` from what
/// was predicted for: a prediction is a statement about all of them. Event `Figures` with a [`Rehearsed`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RehearseOrder {
    /// The plan.
    pub plan: PredictionOrder,
    /// Prediction of it.
    pub prediction: RoutePrediction,
    /// The map.
    pub map: MapSource,
    /// Whether there are no pictures: landmarks are found as often and as well as the plan expects.
    pub as_stated: bool,
    /// Seed of wind, day and sensors.
    pub seed: u64,
}

/// The flight of a plan with the sensors of a seed.
fn simulated(plan: &FlightPlan, seed: u64) -> Result<Flight, String> {
    let flight = plan.simulate(seed);
    flight.ok_or_else(|| "the route needs two way-points in different places".to_owned())
}

/// Pictures of what the camera sees of a flight with the sensors of a seed.
fn seen(flight: &Flight, ground: Arc<dyn Imagery>, day: FlightDay, seed: u64) -> SimulatedFrames {
    SimulatedFrames::new(flight, day, seed).over(Arc::new(CachedImagery::new(ground, CACHE)))
}

/// The map on the day of a seed.
fn other_day(
    worker: &mut WorkerState,
    map: &MapSource,
    seed: u64,
) -> Result<Arc<dyn Imagery>, String> {
    Ok(worker.others(map)?.drawn(FIRST_DAY + seed))
}

/// Flies a planned route over its map as it looks on another day; pictures are taken when they are asked for.
pub fn open(worker: &mut WorkerState, rehearsed: &RehearsedFlight) -> Result<OpenFlight, String> {
    fly_planned(worker, rehearsed, FlightDay::Other)
}

/// Flies a planned route on a day: that of its map or another one; pictures are taken when they are asked for.
///
/// # Errors
/// In words, where the map cannot be read or the route has no way to fly.
pub fn fly_planned(
    worker: &mut WorkerState,
    rehearsed: &RehearsedFlight,
    day: FlightDay,
) -> Result<OpenFlight, String> {
    let plan = FlightPlan {
        name: rehearsed.name.clone(),
        frame_on_globe: LocalFrame::new(rehearsed.origin),
        ..rehearsed.path.plan()
    };
    let seed = rehearsed.seed;
    let plan = plan.in_wind_of(seed, rehearsed.wind_deviation);
    let ground = match day {
        FlightDay::Same => worker.map(&rehearsed.map)?,
        FlightDay::Other | FlightDay::LateWinter | FlightDay::EarlySpring => {
            other_day(worker, &rehearsed.map, seed)?
        }
    };
    let flight = simulated(&plan, seed)?;
    let frames = seen(&flight, ground, day, seed);
    Ok(OpenFlight {
        utc_at_zero: None,
        frames: KeptFrames::rendered(&flight, Box::new(frames)),
        flight: Arc::new(flight),
        mission: None,
    })
}

/// Outcome of a flight of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rehearsed {
    /// Every frame beside the plan.
    pub frames: Vec<PlanComparison>,
    /// Frames that corrected the estimate.
    pub corrected: usize,
}

/// A flight under way.
struct Rehearse {
    order: RehearseOrder,
    flying: Option<Flying>,
}

/// The flight, what it sees, and how far it is.
type Flying = (Arc<Flight>, Box<dyn FrameSource>, Passage);

impl Rehearse {
    fn begin(&self, worker: &mut WorkerState) -> Result<Flying, String> {
        let order = &self.order;
        let (plan, seed, settings) = (order.plan.path.plan(), order.seed, &order.plan.navigator);
        let flight = simulated(&plan.in_wind_of(seed, settings.start.wind), seed)?;
        let landmarks = order.plan.landmarks.iter();
        let landmarks: Vec<Landmark> = landmarks.map(|(landmark, _)| landmark.clone()).collect();
        let (detector, frames): (Box<dyn Detector>, Box<dyn FrameSource>) = if order.as_stated {
            let stated = as_stated(&flight, &order.plan.planned_landmarks(), seed);
            let (detector, frames) = stated.ok_or("there is no truth")?;
            (Box::new(detector), Box::new(frames))
        } else {
            let ground = other_day(worker, &order.map, seed)?;
            let frames = seen(&flight, ground, FlightDay::Other, seed);
            let map = worker.map(&order.map)?;
            let detector = ChosenDetector::new(map, settings.detector, &landmarks);
            (Box::new(detector), Box::new(frames))
        };
        let flight = Arc::new(flight);
        let navigator = Navigator::with_detector(flight.clone(), &landmarks, detector, settings);
        let navigator = navigator.map_err(|cause| cause.to_string())?;
        Ok((flight, frames, Passage::new(navigator.sparing())))
    }
}

impl RunningJob for Rehearse {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some((_, frames, passage)) = &mut self.flying else {
            self.flying = Some(self.begin(worker)?);
            return Ok(Advance::More);
        };
        let more = passage.advance(frames.as_mut(), clock)?;
        emit(JobEvent::Progress(passage.progress(), "Flying".to_owned()));
        if more {
            return Ok(Advance::More);
        }
        if let Some((flight, _, passage)) = self.flying.take() {
            let run = passage.into_run();
            emit(JobEvent::of_figures(&Rehearsed {
                frames: compare(&flight, &run, &self.order.prediction),
                corrected: run.steps.iter().filter(|step| step.corrected()).count(),
            })?);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for RehearseOrder {
    const URGENCY: Urgency = Urgency::Slow;

    /// Flights of one plan are shared by two workers.
    fn role(&self) -> WorkerRole {
        WorkerRole::ALL[(self.seed % 2) as usize]
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let landmarks = self.plan.landmarks.iter();
        let mut areas: Vec<_> = landmarks.map(|(it, _)| around(&it.bounds)).collect();
        if !self.as_stated {
            areas.extend(self.plan.path.ground());
        }
        Some((&self.map, Reads::Areas(areas)))
    }

    fn is_small(&self) -> bool {
        self.map.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Rehearse {
            order: self,
            flying: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::frames::GroundPoint;
    use pilotage_core::plan::{DetectionStatistics, Verification};
    use pilotage_core::simulate::Scenario;

    use super::*;
    use crate::running::{figures, finished};
    use crate::{FlightSource, FlyOrder, PlannedPath};

    fn order(seed: u64) -> RehearseOrder {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mission = scenario.mission();
        let plan = PredictionOrder {
            path: PlannedPath::level(
                vec![GroundPoint::new(0.0, 0.0), GroundPoint::new(0.0, 500.0)],
                scenario.height,
                Scenario::camera(),
            ),
            navigator: mission.navigator,
            // Nothing is expected of them, so that nothing is found.
            landmarks: mission
                .landmarks
                .into_iter()
                .map(|landmark| (landmark, DetectionStatistics::default()))
                .collect(),
            worlds: 8,
            seed: PredictionOrder::SEED,
            limit: f64::INFINITY,
        };
        RehearseOrder {
            prediction: plan.predict().unwrap(),
            plan,
            map: MapSource::world("countryside"),
            as_stated: true,
            seed,
        }
    }

    #[test]
    fn a_plan_without_fixes_is_flown_in_other_winds_within_what_was_predicted() {
        let flights: Vec<Rehearsed> = (1..13).map(|seed| figures(order(seed))).collect();
        assert!(flights.iter().all(|flight| flight.corrected == 0));
        assert!(flights.iter().all(|flight| flight.frames.len() > 20));
        let frames: Vec<_> = flights.into_iter().map(|flight| flight.frames).collect();
        let all = Verification::of(&frames);
        assert!(all.inside_ellipse > 0.8, "{all:?}");
        let ratio = all.rms_m / all.predicted_rms_m;
        assert!((0.6..1.5).contains(&ratio), "{all:?}");
    }

    #[test]
    fn a_route_of_one_way_point_is_refused() {
        let mut order = order(1);
        order.plan.path.way_points.truncate(1);
        let refused = finished(order);
        let last = refused.last();
        assert!(matches!(last, Some(JobEvent::Failed(why)) if why.contains("two way-points")));
    }

    #[test]
    fn the_flight_that_is_watched_is_the_one_that_was_rehearsed() {
        let mut order = order(3);
        order.as_stated = false;
        order.plan.path.way_points[1] = GroundPoint::new(0.0, 260.0);
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let watched = FlyOrder {
            flight: FlightSource::Rehearsed(Box::new(RehearsedFlight {
                name: "Route".to_owned(),
                origin: pilotage_core::simulate::world_origin(),
                path: order.plan.path.clone(),
                wind_deviation: order.plan.navigator.start.wind,
                map: order.map.clone(),
                seed: order.seed,
            })),
            map: order.map.clone(),
            mission: Some(scenario.mission()),
        };
        let prediction = order.prediction.clone();
        let rehearsed: Rehearsed = figures(order);
        let (mut run, mut flown) = (None, None);
        for event in finished(watched) {
            match event {
                JobEvent::Flight(flight) => flown = Some(flight),
                JobEvent::RunStarted(head) => run = Some(*head),
                JobEvent::Steps(mut steps) => run.as_mut().unwrap().steps.append(&mut steps),
                JobEvent::Failed(why) => panic!("{why}"),
                _ => {}
            }
        }
        let (run, flown) = (run.unwrap(), flown.unwrap());
        assert_eq!(compare(&flown, &run, &prediction), rehearsed.frames);
        assert!(rehearsed.frames.len() > 20);
    }
}
