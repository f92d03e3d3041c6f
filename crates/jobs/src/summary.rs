//! A flight navigated to its end and summed up.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use pilotage_core::flight::Flight;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{KnownGround, Navigator, NavigatorSettings, summarize};

use super::flights::OpenFlight;
use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::passage::Passage;
use super::{Advance, FlightSource, JobEvent, MapSource, RunningJob, WorkerState};

/// Flight of which nothing but its summary is wanted: no pictures are taken in which nothing may lie. Event
/// `Figures` with a [`pilotage_core::navigator::Summary`].
#[derive(Clone)]
pub struct SummaryOrder {
    /// The flight.
    pub flight: FlightSource,
    /// The map.
    pub map: MapSource,
    /// Landmarks and settings.
    pub mission: Mission,
    /// Settings that know the true noise, for the bound of the error; none, no bound.
    pub true_noise: Option<NavigatorSettings>,
}

/// A flight under way.
struct SumUpFlight {
    order: SummaryOrder,
    flying: Option<Flying>,
}

struct Flying {
    open: Rc<RefCell<OpenFlight>>,
    flight: Arc<Flight>,
    passage: Passage,
}

impl RunningJob for SumUpFlight {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let SummaryOrder { mission, .. } = &self.order;
        let Some(Flying {
            open,
            flight,
            passage,
        }) = &mut self.flying
        else {
            let map = worker.map(&self.order.map)?;
            let open = worker.flight(&self.order.flight)?;
            let flight = mission.flown(&open.borrow().flight);
            let navigator = Navigator::new(
                flight.clone(),
                &KnownGround::of(mission, map),
                &mission.navigator,
            );
            let navigator = navigator.map_err(|cause| cause.to_string())?;
            self.flying = Some(Flying {
                open,
                flight,
                passage: Passage::new(navigator.sparing()),
            });
            return Ok(Advance::More);
        };
        let more = passage.advance(&mut open.borrow_mut().frames, clock)?;
        emit(JobEvent::Progress(passage.progress(), "Flying".to_owned()));
        if more {
            return Ok(Advance::More);
        }
        let flight = flight.clone();
        if let Some(flying) = self.flying.take() {
            let run = flying.passage.into_run();
            let summary = summarize(&flight, &run, self.order.true_noise.as_ref());
            emit(JobEvent::of_figures(&summary)?);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for SummaryOrder {
    const URGENCY: Urgency = Urgency::Flight;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(Some(&self.flight), Some(&self.map))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(SumUpFlight {
            order: self,
            flying: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::navigator::Summary;
    use pilotage_core::simulate::{Scenario, SensorSpec};

    use super::*;
    use crate::SimulationOptions;
    use crate::running::{figures, finished};

    fn order() -> SummaryOrder {
        let scenario = Scenario::named("distinct-400ft-calm").unwrap();
        let mut mission = scenario.mission();
        // Dead reckoning alone is quick.
        mission.landmarks.clear();
        SummaryOrder {
            flight: FlightSource::Simulated(SimulationOptions {
                scenario: scenario.name.to_owned(),
                seed: 3,
                other_day: true,
                wind: None,
                height: None,
            }),
            map: MapSource::world("countryside"),
            mission,
            true_noise: Some(scenario.navigator(&SensorSpec::default())),
        }
    }

    #[test]
    fn a_flight_is_summed_up_against_its_truth_and_the_bound_of_what_was_possible() {
        let summary: Summary = figures(order());
        assert!(summary.frames > 100 && summary.frames_with_update == 0);
        let (error, bound) = (summary.position_error_m, summary.position_bound_m);
        assert!(error.unwrap().rms > 1.0 && bound.unwrap().rms > 1.0);
        let mut without = order();
        without.true_noise = None;
        assert_eq!(figures::<Summary>(without).position_bound_m, None);
    }

    #[test]
    fn a_flight_that_is_not_there_is_refused() {
        let mut order = order();
        order.flight = FlightSource::Files("gone".to_owned());
        let refused = finished(order);
        assert!(matches!(&refused[..], [JobEvent::Failed(why)] if why.contains("open them again")));
    }
}
