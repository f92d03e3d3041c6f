//! The workers' programs: the whole one does every job; the small one does those that flying over the
//! generated ground needs, so that the first flight does not wait for what reads files, plans and trains.
//!
//! A program links what its [`Abilities`] name and nothing else.

mod flying;
mod whole;

use pilotage_core::simulate::{lay_out_small_world, lay_out_world};

use super::worker_state::Opens;
use super::{Job, RunningJob, WorkerState};

/// A program of a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Program {
    /// Flies over the generated ground and shows it; small, and there first.
    Flying,
    /// Does every job.
    Whole,
}

impl Program {
    /// All of them, the smallest first.
    pub const ALL: [Self; 2] = [Self::Flying, Self::Whole];

    /// Its name, as the page's files are called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flying => "flying",
            Self::Whole => "whole",
        }
    }

    /// The smallest program that does a job.
    pub fn of(job: &Job) -> Self {
        if job.is_small() {
            Self::Flying
        } else {
            Self::Whole
        }
    }
}

/// Makes a job ready to advance; one that the program cannot do fails with its first step.
pub type Begin = fn(Job, &mut WorkerState) -> Box<dyn RunningJob>;

/// Abilities of a worker: the jobs that its program begins, and the maps and flights that it opens for them.
#[derive(Clone, Copy)]
pub struct Abilities {
    /// Makes a job ready to advance.
    pub begin: Begin,
    /// Opens maps and flights.
    pub opens: Opens,
}

impl Abilities {
    /// Those of [`Program::Flying`].
    pub const FLYING: Self = Self {
        begin: Job::begin_small,
        opens: Opens {
            map: flying::open_map,
            flight: flying::open_flight,
            world: lay_out_small_world,
        },
    };

    /// Those of [`Program::Whole`].
    pub const WHOLE: Self = Self {
        begin: Job::begin,
        opens: Opens {
            map: whole::open_map,
            flight: whole::open_flight,
            world: lay_out_world,
        },
    };
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use pilotage_core::simulate::{WORLDS, is_small_world};

    use super::super::{
        Advance, DescribeMapOrder, FlightSource, FlyOrder, JobEvent, MapSource, PrepareMapOrder,
        SimulationOptions,
    };
    use super::*;

    /// Events of `job` in the small program until it is over, or why it failed.
    fn said(job: Job) -> Result<Vec<JobEvent>, String> {
        let mut worker = WorkerState::new(Abilities::FLYING.opens);
        let mut running = (Abilities::FLYING.begin)(job, &mut worker);
        let mut events = Vec::new();
        let asked = Cell::new(0.0);
        // Each look at it finds a share of the time used up, so that the flight is told piece by piece.
        let clock = || asked.replace(asked.get() + 10.0);
        for _ in 0..10_000 {
            match running.advance(&mut worker, &clock, &mut |event| events.push(event))? {
                Advance::More => {}
                Advance::Done => return Ok(events),
            }
            // The flight is long; its first steps are enough.
            if events
                .iter()
                .any(|event| matches!(event, JobEvent::Steps(_)))
            {
                return Ok(events);
            }
        }
        Err("it does not end".to_owned())
    }

    #[test]
    fn the_small_program_does_what_it_is_chosen_for_and_refuses_the_rest_in_words() {
        let fly = |flight, map| {
            Job::Fly(FlyOrder {
                flight,
                map,
                mission: None,
            })
        };
        let simulated = |scenario: &str| {
            FlightSource::Simulated(SimulationOptions {
                scenario: scenario.to_owned(),
                seed: 1,
                other_day: false,
                wind: None,
                height: None,
            })
        };
        // One flight of each of its worlds.
        let worlds = WORLDS.iter().filter(|world| is_small_world(world.key()));
        let flights = worlds.map(|world| {
            let name = world.flights()[0].name;
            fly(simulated(name), MapSource::world(world.key()))
        });
        for job in flights.chain([
            Job::DescribeMap(DescribeMapOrder(MapSource::world("countryside"))),
            Job::DescribeMap(DescribeMapOrder(MapSource::Nothing)),
        ]) {
            assert_eq!(Program::of(&job), Program::Flying, "{job:?}");
            let events = said(job.clone());
            assert!(
                events.as_ref().is_ok_and(|it| it.len() > 1),
                "{job:?}: {events:?}"
            );
        }
        let files = || MapSource::Files("drop".to_owned());
        for job in [
            fly(simulated("distinct-400ft-wind"), files()),
            fly(
                FlightSource::Files("drop".to_owned()),
                MapSource::world("countryside"),
            ),
            Job::DescribeMap(DescribeMapOrder(files())),
            Job::PrepareMap(PrepareMapOrder(MapSource::world("countryside"))),
        ] {
            assert_eq!(Program::of(&job), Program::Whole, "{job:?}");
            let why = said(job.clone()).expect_err("the small program has no such ability");
            assert!(why.contains("load the page again"), "{job:?}: {why}");
        }
    }
}
