//! A flight by several estimators and vehicle models, judged in one table.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::Run;
use pilotage_core::plan::StatedFrames;
use pilotage_core::study::{Contender, ContenderTally, EstimatorComparison};

use super::flights::OpenFlight;
use super::order::{Order, Reads, Urgency, VariantOrder, WorkerRole, around, keys_of};
use super::passage::Passage;
use super::{Advance, ContestOrder, JobEvent, MapSource, RunningJob, WorkerState};

/// Event that tells what was tallied.
type Judged = fn(&[ContenderTally]) -> Result<JobEvent, String>;

/// A contest under way: events `Progress`, a `Remark` on each contender that had to stop, and at the end what
/// `judged` makes of the tallies.
pub struct Contest {
    order: ContestOrder,
    judged: Judged,
    ground: Option<ContestGround>,
    /// The contender under way, with frames of its own where it is stated how landmarks are found.
    flying: Option<(Passage, Option<StatedFrames>)>,
    tallies: Vec<ContenderTally>,
}

/// Flight and map that all contenders share.
struct ContestGround {
    open: Rc<RefCell<OpenFlight>>,
    mission: Mission,
    flight: Arc<Flight>,
    map: Arc<dyn Imagery>,
}

impl Contest {
    /// Nothing flown yet.
    fn new(order: ContestOrder, judged: Judged) -> Self {
        Self {
            order,
            judged,
            ground: None,
            flying: None,
            tallies: Vec::new(),
        }
    }

    fn contender(&self) -> Option<Contender> {
        self.order.contenders.get(self.tallies.len()).copied()
    }

    /// Steps for about a slice; whether the contender is still flying.
    fn fly(
        &mut self,
        ground: &ContestGround,
        contender: Contender,
        clock: &dyn Fn() -> f64,
    ) -> Result<bool, String> {
        let frames = &mut ground.open.borrow_mut().frames;
        let (passage, stated) = match &mut self.flying {
            Some(flying) => flying,
            empty => {
                let mission = &ground.mission;
                let settings = contender.settings(&mission.navigator, self.order.seed);
                let map = Arc::clone(&ground.map);
                let (navigator, stated) =
                    frames.navigator(&ground.flight, mission, map, &settings)?;
                empty.insert((Passage::new(navigator.sparing()), stated))
            }
        };
        match stated {
            Some(stated) => passage.advance(stated, clock),
            None => passage.advance(frames, clock),
        }
    }

    /// Tally of a contender's run: one that cannot go on, or be smoothed, is counted and told, for the others fly all the
    /// same.
    fn tally(
        &self,
        contender: Contender,
        flight: &Flight,
        run: Result<Option<Run>, String>,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> ContenderTally {
        let mut tally = ContenderTally::new(contender, self.order.smooth);
        let label = contender.estimator.label();
        match run {
            Ok(run) => {
                let added = run.map_or(Ok(()), |run| tally.add(flight, &run, clock));
                if let Err(cause) = added {
                    let words = format!("{label} was flown, but cannot be smoothed: {cause}");
                    emit(JobEvent::Remark(words));
                }
            }
            Err(cause) => {
                emit(JobEvent::Remark(format!("{label}: {cause}")));
                tally.fail();
            }
        }
        tally
    }

    fn progress(&self, contender: Contender) -> JobEvent {
        let flown = self.flying.as_ref().map_or(0.0, |(it, _)| it.progress());
        let share = (self.tallies.len() as f32 + flown) / self.order.contenders.len() as f32;
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
            let own = open.borrow().mission.clone();
            let own = own.filter(|_| self.order.flight.has_own_mission());
            let mission = own.unwrap_or_else(|| self.order.mission.clone());
            let flight = mission.flown(&open.borrow().flight);
            self.ground = Some(ContestGround {
                open,
                mission,
                flight,
                map,
            });
            return Ok(Advance::More);
        };
        let Some(contender) = self.contender() else {
            emit((self.judged)(&self.tallies)?);
            emit(JobEvent::Finished);
            return Ok(Advance::Done);
        };
        let outcome = self.fly(&ground, contender, clock);
        emit(self.progress(contender));
        if !matches!(outcome, Ok(true)) {
            let flown = self.flying.take();
            let run = outcome.map(|_| flown.map(|(passage, _)| passage.into_run()));
            let tally = self.tally(contender, &ground.flight, run, clock, emit);
            self.tallies.push(tally);
        }
        self.ground = Some(ground);
        Ok(Advance::More)
    }
}

impl Order for ContestOrder {
    const URGENCY: Urgency = Urgency::Flight;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let landmarks = self.mission.landmarks.iter();
        let areas = landmarks.map(|landmark| around(&landmark.bounds)).collect();
        Some((&self.map, Reads::Areas(areas)))
    }

    /// Its event is `ContestJudged`.
    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Contest::new(self, |tallies| {
            Ok(JobEvent::ContestJudged(Box::new(EstimatorComparison::of(
                tallies,
            ))))
        }))
    }
}

impl ContestOrder {
    /// The contest over one of several flights: event `Figures` with the tallies ([`ContenderTally`]) of its contenders, to
    /// be merged with those of the other flights.
    pub fn tallied(self) -> VariantOrder<Self> {
        VariantOrder::new(self, |order| {
            Box::new(Contest::new(order, |tallies| {
                JobEvent::of_figures(&tallies)
            }))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::InlineWorkers;
    use super::super::{FlightSource, Job, MapSource, SimulationOptions};
    use super::*;
    use pilotage_core::navigator::EstimatorChoice;
    use pilotage_core::simulate::{Overrides, Scenario};

    #[test]
    fn every_estimator_flies_the_same_flight_and_is_judged_by_the_same_truth() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mut mission = scenario.mission();
        // Dead reckoning alone is quick, and all of them do it alike.
        mission.landmarks.clear();
        let flight = FlightSource::Simulated(SimulationOptions {
            scenario: scenario.name.to_owned(),
            seed: 1,
            other_day: false,
            wind: None,
            height: None,
        });
        let order = ContestOrder::of_all(flight, MapSource::world("countryside"), mission);
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

    #[test]
    fn contests_over_two_flights_are_merged_and_one_that_cannot_fly_is_counted_and_named() {
        use crate::running::{figures, finished};
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mut mission = scenario.mission();
        mission.landmarks.clear();
        let vehicle = mission.navigator.vehicle;
        let order = |seed, alpha| {
            let flight = FlightSource::Simulated(SimulationOptions {
                scenario: scenario.name.to_owned(),
                seed,
                other_day: true,
                wind: None,
                height: None,
            });
            let mut mission = mission.clone();
            mission.navigator.alpha = alpha;
            ContestOrder {
                contenders: Contender::all(&[EstimatorChoice::Unscented], &[vehicle]),
                smooth: false,
                seed,
                ..ContestOrder::of_all(flight, MapSource::world("countryside"), mission)
            }
            .tallied()
        };
        let mut tallies: Vec<ContenderTally> = figures(order(1, 1.0));
        let of_second: Vec<ContenderTally> = figures(order(2, 1.0));
        let rms = |tallies: &[ContenderTally]| {
            let rows = EstimatorComparison::of(tallies).rows;
            (
                rows.len(),
                rows[0].flights,
                rows[0].position_error_m.unwrap().rms,
            )
        };
        let (one, other) = (rms(&tallies), rms(&of_second));
        tallies[0].merge(of_second[0].clone());
        let both = rms(&tallies);
        assert_eq!((both.0, both.1), (1, 2));
        assert!(both.2 > one.2.min(other.2) && both.2 < one.2.max(other.2));
        // No sigma points can be drawn with an alpha that is no number.
        let refused = finished(order(1, f64::NAN));
        let named = |event: &JobEvent| matches!(event, JobEvent::Remark(why) if why.len() > 10);
        assert!(refused.iter().any(named), "{refused:?}");
        let tallies: Vec<ContenderTally> = figures(order(1, f64::NAN));
        assert_eq!(EstimatorComparison::of(&tallies).rows[0].failed, 1);
    }

    #[test]
    fn one_that_cannot_be_smoothed_is_counted_and_named() {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let flight = FlightSource::Simulated(SimulationOptions {
            scenario: scenario.name.to_owned(),
            seed: 1,
            other_day: false,
            wind: None,
            height: None,
        });
        let map = MapSource::world("countryside");
        let order = ContestOrder::of_all(flight, map, scenario.mission());
        let contender = order.contenders[0];
        let mut run = Run {
            name: "flown".to_owned(),
            settings: scenario.mission().navigator,
            landmarks: Vec::new(),
            state_names: Vec::new(),
            steps: Vec::new(),
        };
        // No sigma points can be drawn with an alpha that is no number.
        run.settings.alpha = f64::NAN;
        let contest = Contest::new(order, |_| Err("nobody asks".to_owned()));
        let flown = scenario.plan(&Overrides::default()).simulate(1).unwrap();
        let mut told = Vec::new();
        let mut emit = |event| told.push(event);
        let tally = contest.tally(contender, &flown, Ok(Some(run)), &|| 0.0, &mut emit);
        let named = |event: &JobEvent| matches!(event, JobEvent::Remark(why) if why.contains("cannot be smoothed"));
        assert!(matches!(&told[..], [event] if named(event)), "{told:?}");
        let counted = tally.rows();
        let counted: Vec<(usize, usize)> = counted
            .iter()
            .map(|row| (row.flights, row.failed))
            .collect();
        assert_eq!(counted, [(1, 0), (0, 1)]);
    }
}
