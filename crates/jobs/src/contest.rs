//! The flight that is open by every estimator, judged in one table.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::imagery::Imagery;
use pilotage_core::navigator::{EstimatorChoice, Navigator, Run};
use pilotage_core::study::{Comparison, Contender, Tally};

use super::flights::OpenFlight;
use super::order::{Order, Reads, Role, Urgency, around, keys_of};
use super::running::SLICE;
use super::{Advance, ContestOrder, JobEvent, MapSource, RunningJob, WorkerState};

/// Seed of what an estimator draws.
const SEED: u64 = 1;

/// A contest under way: events `Progress`, at the end `ContestJudged`.
pub struct Contest {
    order: ContestOrder,
    ground: Option<Ground>,
    contenders: Vec<Contender>,
    flying: Option<(Navigator, Run)>,
    tallies: Vec<Tally>,
}

/// Flight and map that all contenders share.
struct Ground {
    open: Rc<RefCell<OpenFlight>>,
    flight: Arc<Flight>,
    map: Arc<dyn Imagery>,
}

impl Contest {
    /// Nothing flown yet.
    pub fn new(order: ContestOrder) -> Self {
        let vehicle = order.mission.navigator.vehicle;
        Self {
            contenders: Contender::all(&EstimatorChoice::ALL, &[vehicle]),
            order,
            ground: None,
            flying: None,
            tallies: Vec::new(),
        }
    }

    fn contender(&self) -> Option<Contender> {
        self.contenders.get(self.tallies.len()).copied()
    }

    /// Steps for about a slice; whether the contender is still flying.
    fn fly(&mut self, ground: &Ground, clock: &dyn Fn() -> f64) -> Result<bool, String> {
        let Some((navigator, run)) = &mut self.flying else {
            return Ok(false);
        };
        let begun = clock();
        let mut open = ground.open.borrow_mut();
        while clock() - begun < SLICE {
            match navigator.advance(&mut open.frames, clock) {
                Some(step) => run.steps.push(step.map_err(|cause| cause.to_string())?),
                None => return Ok(false),
            }
        }
        Ok(true)
    }

    fn begin(&mut self, ground: &Ground, contender: Contender) -> Result<(), String> {
        let mission = &self.order.mission;
        let settings = contender.settings(&mission.navigator, SEED);
        let (flight, map) = (ground.flight.clone(), ground.map.clone());
        let navigator = Navigator::new(flight, &mission.landmarks, map, &settings);
        let navigator = navigator.map_err(|cause| cause.to_string())?.sparing();
        let run = navigator.run_head();
        self.flying = Some((navigator, run));
        Ok(())
    }

    fn progress(&self, contender: Contender) -> JobEvent {
        let (done, all) = self.flying.as_ref().map_or((0, 1), |f| f.0.progress());
        let flown = self.tallies.len() as f32 + done as f32 / all.max(1) as f32;
        let share = flown / self.contenders.len() as f32;
        JobEvent::Progress(share, contender.estimator.label().to_owned())
    }
}

impl RunningJob for Contest {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(ground) = self.ground.take() else {
            let map = worker.map(&self.order.map)?;
            let open = worker.flight(&self.order.flight)?;
            let flight = self.order.mission.flown(&open.borrow().flight);
            self.ground = Some(Ground { open, flight, map });
            return Ok(Advance::More);
        };
        let Some(contender) = self.contender() else {
            emit(JobEvent::ContestJudged(Box::new(Comparison::of(
                &self.tallies,
            ))));
            emit(JobEvent::Finished);
            return Ok(Advance::Done);
        };
        if self.flying.is_none() {
            self.begin(&ground, contender)?;
        }
        let outcome = self.fly(&ground, clock);
        emit(self.progress(contender));
        if !matches!(outcome, Ok(true)) {
            // One that cannot go on is counted; the others fly all the same.
            let mut tally = Tally::new(contender, true);
            match self.flying.take().filter(|_| outcome.is_ok()) {
                Some((_, run)) => tally
                    .add(&ground.flight, &run, clock)
                    .map_err(|cause| cause.to_string())?,
                None => tally.fail(),
            }
            self.tallies.push(tally);
        }
        self.ground = Some(ground);
        Ok(Advance::More)
    }
}

impl Order for ContestOrder {
    const URGENCY: Urgency = Urgency::Flight;

    fn role(&self) -> Role {
        Role::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let landmarks = self.mission.landmarks.iter();
        let areas = landmarks.map(|landmark| around(&landmark.bounds)).collect();
        Some((&self.map, Reads::Areas(areas)))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Contest::new(self))
    }
}

#[cfg(test)]
mod tests {
    use super::super::InlineWorkers;
    use super::super::{FlightSource, Job, MapSource, SimulationOptions};
    use super::*;
    use pilotage_core::simulate::Scenario;

    #[test]
    fn every_estimator_flies_the_same_flight_and_is_judged_by_the_same_truth() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mut mission = scenario.mission();
        // Dead reckoning alone is quick, and all of them do it alike.
        mission.landmarks.clear();
        let order = ContestOrder {
            flight: FlightSource::Simulated(SimulationOptions {
                scenario: scenario.name.to_owned(),
                seed: 1,
                other_day: false,
                wind: None,
                height: None,
            }),
            map: MapSource::world("countryside"),
            mission,
        };
        let mut host = InlineWorkers::new();
        host.start(Job::Contest(Box::new(order)));
        let mut judged = None;
        while host.busy() && judged.is_none() {
            for (_, event) in host.events() {
                match event {
                    JobEvent::ContestJudged(found) => judged = Some(found),
                    JobEvent::Failed(why) => panic!("{why}"),
                    _ => {}
                }
            }
        }
        let rows = judged.expect("a table").rows;
        assert_eq!(
            rows.len(),
            2 * EstimatorChoice::ALL.len(),
            "each smoothed, too"
        );
        let rms: Vec<f64> = rows
            .iter()
            .map(|r| r.position_error_m.unwrap().rms)
            .collect();
        assert!((rms[0] / rms[2] - 1.0).abs() < 0.01, "UKF and EKF: {rms:?}");
        assert!(
            (rms[0] / rms[4] - 1.0).abs() < 0.3,
            "and particles: {rms:?}"
        );
        assert!(rows.iter().all(|row| row.failed == 0 && row.flights == 1));
    }
}
