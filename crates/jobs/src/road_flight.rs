//! A flight by the roads of its mission, judged across and along them beside dead reckoning.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use nalgebra::Vector2;
use pilotage_core::filter::Consistency;
use pilotage_core::flight::Flight;
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Estimate, KnownGround, Navigator, Run};
use pilotage_core::roads::{RoadJoining, RoadMap};
use serde::{Deserialize, Serialize};

use super::flights::OpenFlight;
use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::passage::Passage;
use super::{Advance, FlightSource, JobEvent, MapSource, RunningJob, WorkerState};

/// Distance from a road beyond which nothing is said about it, metres.
const BESIDE_ROAD: f64 = 100.0;

/// Flight with a truth that is navigated by the aids of a mission, whose roads it has, and by dead reckoning alone:
/// event `Figures` with a [`RoadFlight`] and the [`Consistency`] of the looks at roads.
#[derive(Clone)]
pub struct RoadFlightOrder {
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// Roads and settings.
    pub mission: Mission,
}

/// Figures of a flight by roads.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RoadFlight {
    /// Root mean square of the error across the nearest road, metres.
    pub across_m: f64,
    /// The same after the first third of the flight.
    pub across_later_m: f64,
    /// Root mean square of the error along the nearest road, metres.
    pub along_m: f64,
    /// Error across by dead reckoning, metres.
    pub reckoned_across_m: f64,
    /// Error along by dead reckoning, metres.
    pub reckoned_along_m: f64,
    /// Least ratio of the standard deviation along the road to that of dead reckoning.
    pub along_sigma_ratio: f64,
    /// Looks that corrected.
    pub corrected: usize,
    /// Looks that were refused.
    pub refused: usize,
    /// Sum of the NIS of all looks.
    pub nis_sum: f64,
    /// Sum of their degrees of freedom.
    pub nis_degrees: usize,
    /// Mean squared error across over its variance.
    pub nees_across: f64,
}

/// Such a flight under way.
struct FlyByRoads {
    order: RoadFlightOrder,
    stage: Stage,
}

enum Stage {
    Asked,
    /// By roads, with what comes next.
    Aided(Ground, Passage),
    /// By dead reckoning, beside the run by roads.
    Reckoned(Ground, Passage, Box<Run>),
}

/// Flight and map of both runs.
struct Ground {
    open: Rc<RefCell<OpenFlight>>,
    flight: Arc<Flight>,
    known: KnownGround,
}

impl Ground {
    fn begin(&self, mission: &Mission, is_aided: bool) -> Result<Passage, String> {
        let mut settings = mission.navigator.clone();
        if !is_aided {
            settings.aids.clear();
        }
        let navigator = Navigator::new(self.flight.clone(), &self.known, &settings);
        let navigator = navigator.map_err(|cause| cause.to_string())?;
        // Without roads nobody looks at the pictures.
        Ok(Passage::new(navigator.sparing()))
    }
}

impl RunningJob for FlyByRoads {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let mission = &self.order.mission;
        let stage = std::mem::replace(&mut self.stage, Stage::Asked);
        self.stage = match stage {
            Stage::Asked => {
                let map = worker.map(&self.order.map)?;
                let open = worker.flight(&self.order.flight)?;
                let flight = mission.flown(&open.borrow().flight);
                let known = KnownGround::of(mission, map);
                let ground = Ground {
                    open,
                    flight,
                    known,
                };
                let passage = ground.begin(mission, true)?;
                Stage::Aided(ground, passage)
            }
            Stage::Aided(ground, mut passage) => {
                if passage.advance(&mut ground.open.borrow_mut().frames, clock)? {
                    let done = 0.5 * passage.progress();
                    emit(JobEvent::Progress(done, "By roads".to_owned()));
                    Stage::Aided(ground, passage)
                } else {
                    let reckoned = ground.begin(mission, false)?;
                    Stage::Reckoned(ground, reckoned, Box::new(passage.into_run()))
                }
            }
            Stage::Reckoned(ground, mut passage, aided) => {
                if passage.advance(&mut ground.open.borrow_mut().frames, clock)? {
                    let done = 0.5 + 0.5 * passage.progress();
                    emit(JobEvent::Progress(done, "By dead reckoning".to_owned()));
                    Stage::Reckoned(ground, passage, aided)
                } else {
                    let truth = ground.flight.truth.as_ref();
                    let truth = truth.ok_or("the flight has no truth")?;
                    let true_place = |time: f64| {
                        let place = truth.position(time)?;
                        Some(GroundPoint::new(place.x, place.y))
                    };
                    let roads = RoadMap::new(mission.roads.to_vec(), RoadJoining::SHARED_POINTS);
                    let runs = (aided.as_ref(), &passage.into_run());
                    emit(JobEvent::of_figures(&judged(&roads, true_place, runs))?);
                    emit(JobEvent::Finished);
                    return Ok(Advance::Done);
                }
            }
        };
        Ok(Advance::More)
    }
}

impl Order for RoadFlightOrder {
    const URGENCY: Urgency = Urgency::Flight;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), Some(&self.map))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(FlyByRoads {
            order: self,
            stage: Stage::Asked,
        })
    }
}

/// Figures of a flight by roads beside the same by dead reckoning.
fn judged(
    roads: &RoadMap,
    true_place: impl Fn(f64) -> Option<GroundPoint>,
    (aided, reckoned): (&Run, &Run),
) -> (RoadFlight, Consistency) {
    let mut nis = Consistency::default();
    let mut row = RoadFlight {
        along_sigma_ratio: f64::INFINITY,
        ..RoadFlight::default()
    };
    let (mut count, mut later) = (0, 0);
    let steps = aided.steps.len();
    for (index, (step, other)) in aided.steps.iter().zip(&reckoned.steps).enumerate() {
        for update in step.updates.iter().filter(|update| update.aid == "roads") {
            nis.push(update.nis, update.degrees_of_freedom);
            row.nis_sum += update.nis;
            row.nis_degrees += update.degrees_of_freedom;
            *(if update.gain.is_some() {
                &mut row.corrected
            } else {
                &mut row.refused
            }) += 1;
        }
        let Some(truth) = true_place(step.time) else {
            continue;
        };
        let Some(near) = roads.nearest(truth, BESIDE_ROAD) else {
            continue;
        };
        let (sin, cos) = near.heading.sin_cos();
        let (ahead, right) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let error = |place: GroundPoint| place.to_vector() - truth.to_vector();
        let (own, theirs) = (error(step.after.position()), error(other.after.position()));
        let variance = |axis: Vector2<f64>, estimate: &Estimate| {
            axis.dot(&(estimate.position_covariance() * axis))
        };
        count += 1;
        row.across_m += right.dot(&own).powi(2);
        row.along_m += ahead.dot(&own).powi(2);
        row.reckoned_across_m += right.dot(&theirs).powi(2);
        row.reckoned_along_m += ahead.dot(&theirs).powi(2);
        row.nees_across += right.dot(&own).powi(2) / variance(right, &step.after);
        let ratio = (variance(ahead, &step.after) / variance(ahead, &other.after)).sqrt();
        row.along_sigma_ratio = row.along_sigma_ratio.min(ratio);
        if 3 * index > steps {
            later += 1;
            row.across_later_m += right.dot(&own).powi(2);
        }
    }
    let all = f64::from(count.max(1));
    row.nees_across /= all;
    row.across_later_m = (row.across_later_m / f64::from(later.max(1))).sqrt();
    for sum in [
        &mut row.across_m,
        &mut row.along_m,
        &mut row.reckoned_across_m,
        &mut row.reckoned_along_m,
    ] {
        *sum = (*sum / all).sqrt();
    }
    (row, nis)
}

#[cfg(test)]
mod tests {
    use pilotage_core::simulate::Scenario;

    use super::*;
    use crate::SimulationOptions;
    use crate::running::figures;

    #[test]
    fn without_aids_both_runs_are_the_same_and_no_road_was_looked_at() {
        let scenario = Scenario::named("roads-400ft").unwrap();
        let mut mission = scenario.mission();
        mission.navigator.aids.clear();
        let order = RoadFlightOrder {
            flight: FlightSource::Simulated(SimulationOptions {
                scenario: scenario.name.to_owned(),
                ..SimulationOptions::demo()
            }),
            map: MapSource::world("countryside"),
            mission,
        };
        let (row, nis): (RoadFlight, Consistency) = figures(order);
        assert!(row.across_m > 0.1 && row.along_m > 0.1, "{row:?}");
        assert_eq!(row.across_m, row.reckoned_across_m);
        assert_eq!(row.along_m, row.reckoned_along_m);
        assert_eq!(
            (row.along_sigma_ratio, row.corrected, row.refused),
            (1.0, 0, 0)
        );
        assert_eq!(nis, Consistency::default());
    }
}
