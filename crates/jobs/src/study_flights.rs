//! A piece of a study in the page: flights by themselves, for the worker reads no plans.

use pilotage_core::landmark::Landmark;
use pilotage_study::StudyFlight;
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::{Advance, JobEvent, RunningJob, WorkerState};

/// Order of some flights of a study. Event `Figures` with the numbers of all kinds of each flight
/// (`Vec<Vec<Option<f64>>>`, [`StudyFlight::numbers`]), in the order of the flights.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyFlightsOrder {
    /// The flights.
    pub flights: Vec<StudyFlight>,
    /// Number of the share, by which the workers take turns.
    pub share: usize,
}

/// Flights under way.
struct Flown {
    order: StudyFlightsOrder,
    /// Scenario whose landmarks these are.
    landmarks: Option<(String, Vec<Landmark>)>,
    numbers: Vec<Vec<Option<f64>>>,
}

impl RunningJob for Flown {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        _: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(flight) = self.order.flights.get(self.numbers.len()) else {
            emit(JobEvent::of_figures(&self.numbers)?);
            emit(JobEvent::Finished);
            return Ok(Advance::Done);
        };
        let Some(scenario) = flight.of_scenario() else {
            self.numbers.push(flight.numbers(&[]));
            return Ok(Advance::More);
        };
        match &self.landmarks {
            Some((of, landmarks)) if of == scenario => {
                self.numbers.push(flight.numbers(landmarks));
            }
            _ => {
                let landmarks = worker.scenario(scenario)?.landmarks.clone();
                self.landmarks = Some((scenario.to_owned(), landmarks));
            }
        }
        Ok(Advance::More)
    }
}

impl Order for StudyFlightsOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::ALL[self.share % WorkerRole::ALL.len()]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Flown {
            order: self,
            landmarks: None,
            numbers: Vec::new(),
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::Flight;
    use pilotage_core::navigator::{EstimatorChoice, Run, StepReport, UpdateReport};
    use pilotage_core::study::{Contender, ContenderTally, EstimatorComparison};
    use pilotage_study::{MeasureKind, Study, StudyPlan, numbers_of};

    use super::*;
    use crate::running::{figures, finished};
    use crate::{ContestOrder, FlightSource, FlyOrder, MapSource, StudiedFlight};

    /// Two process models, one with a late camera among the faults, an aid and a walking error.
    const PLAN: &str = r#"
        name = "test"
        question = "?"
        seed = 3
        draws = 2
        fixed = { seconds = 20, step = 0.2, fault-from = 5, walk-roll = 0.2, wind-scatter = 1, aids = "gps-velocity" }
        cross.fault = ["none", "camera-late"]
        cross.vehicle = ["airplane-wind", "airplane-full"]
        draw.wind-speed = { uniform = [0, 8] }
        measure = [{ of = "error-rms" }, { of = "error-max", name = "near", at_most = 5 }, { of = "inside-95" }]
    "#;

    fn study() -> Study {
        Study::new(StudyPlan::read(PLAN).unwrap()).unwrap()
    }

    fn flight(study: &Study, run: u64) -> StudyFlight {
        study.design().run(run).unwrap().flight()
    }

    /// A flight of a study opened as any other: as it was measured, and the run.
    fn opened(run: u64, flight: StudyFlight) -> (Flight, Run) {
        let studied = StudiedFlight {
            study: "test".to_owned(),
            run,
            flight,
        };
        // Over the wire and out of the browser's storage it is the same.
        let flight = FlightSource::Studied(Box::new(studied));
        let stored = serde_json::to_string(&flight).unwrap();
        let restored: FlightSource = serde_json::from_str(&stored).unwrap();
        assert_eq!(restored, flight);
        let sent = postcard::to_stdvec(&restored).unwrap();
        let order = FlyOrder {
            flight: postcard::from_bytes(&sent).unwrap(),
            map: MapSource::world("countryside"),
            mission: None,
        };
        let (mut run, mut flown) = (None, None);
        for event in finished(order) {
            match event {
                JobEvent::Flight(flight) => flown = Some(*flight),
                JobEvent::RunStarted(head) => run = Some(*head),
                JobEvent::Steps(mut steps) => run.as_mut().unwrap().steps.append(&mut steps),
                JobEvent::FrameTaken { .. } => panic!("there are no pictures"),
                JobEvent::Failed(why) => panic!("{why}"),
                _ => {}
            }
        }
        (flown.unwrap(), run.unwrap())
    }

    #[test]
    fn flights_by_themselves_have_the_numbers_that_the_terminal_finds() {
        let study = study();
        let numbers: Vec<Vec<Option<f64>>> = figures(StudyFlightsOrder {
            flights: (2..5).map(|run| flight(&study, run)).collect(),
            share: 0,
        });
        for (run, numbers) in (2..5).zip(&numbers) {
            let row = study.fly(run).unwrap();
            let measures = &study.design().plan().measure;
            let measured = measures.iter().map(|m| m.among(numbers));
            assert_eq!(measured.collect::<Vec<_>>(), row.measured);
        }
        assert_ne!(numbers[0], numbers[1]);
    }

    #[test]
    fn a_run_that_is_opened_in_replay_is_that_of_the_study_to_the_bit() {
        let study = study();
        for run in 0..4 {
            let numbers: Vec<Vec<Option<f64>>> = figures(StudyFlightsOrder {
                flights: vec![flight(&study, run)],
                share: 1,
            });
            let (flown, opened) = opened(run, flight(&study, run));
            assert_eq!(numbers_of(&flown, &opened), numbers[0], "run {run}");
            let end = MeasureKind::ErrorEnd.among(&numbers[0]).unwrap();
            let last = opened.steps.last().unwrap();
            let truth = flown.truth.unwrap().position(last.time).unwrap();
            let estimate = last.after.position();
            let off = (estimate.north - truth.x).hypot(estimate.east - truth.y);
            assert!((off - end).abs() < 1e-9);
        }
    }

    #[test]
    fn estimators_that_fly_a_run_of_a_study_find_what_the_study_states_that_is_found() {
        let study = study();
        let numbers: Vec<Vec<Option<f64>>> = figures(StudyFlightsOrder {
            flights: vec![flight(&study, 0)],
            share: 0,
        });
        let (_, run) = opened(0, flight(&study, 0));
        let mut worker = crate::WorkerState::new(crate::Abilities::WHOLE.opens);
        let studied = FlightSource::Studied(Box::new(StudiedFlight {
            study: "test".to_owned(),
            run: 0,
            flight: flight(&study, 0),
        }));
        let mission = worker.flight(&studied).unwrap().borrow().mission.clone();
        let vehicle = mission.as_ref().unwrap().navigator.vehicle;
        let order = ContestOrder {
            contenders: Contender::all(&[EstimatorChoice::Unscented], &[vehicle]),
            smooth: false,
            ..ContestOrder::of_all(studied, MapSource::world("countryside"), mission.unwrap())
        };
        let tallies: Vec<ContenderTally> = figures(order.tallied());
        let row = EstimatorComparison::of(&tallies).rows.remove(0);
        let expected = MeasureKind::ErrorRms.among(&numbers[0]).unwrap();
        let rms = row.position_error_m.unwrap().rms;
        assert!((rms - expected).abs() < 1e-9, "{rms} and {expected} m");
        let is_found = |step: &StepReport| step.updates.iter().any(UpdateReport::is_accepted);
        assert!(
            run.steps.iter().any(is_found),
            "there was something to be found"
        );
    }
}
