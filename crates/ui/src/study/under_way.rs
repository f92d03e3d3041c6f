//! A study that is flown in the workers: shards given out, numbers taken in.

use std::ops::Range;

use pilotage_jobs::{
    Job, JobEvent, JobId, StudiedFlight, StudyEnoughOrder, StudyFlightsOrder, WorkerRole,
};
use pilotage_study::{StudyDesign, StudyPlan};

use super::stop_asked::StopAsked;
use crate::feature::FeatureContext;

/// Flights of a shard: about a tenth of a second of work.
const SHARD: u64 = 4;
/// Shards that each worker has before it: while one comes back it flies the other.
const AHEAD: usize = 2;

/// Shard that a worker has.
#[derive(Debug)]
struct StudyShard {
    job: JobId,
    runs: Range<u64>,
    share: usize,
}

/// Study that was begun.
pub struct StudyUnderWay {
    design: StudyDesign,
    /// Numbers of all kinds by run; none of a run that was not flown.
    numbers: Vec<Vec<Option<f64>>>,
    flown: u64,
    next: u64,
    shards: Vec<StudyShard>,
    /// When it was begun, milliseconds of the host's clock.
    begun: f64,
    /// When its last numbers came.
    latest: f64,
    trouble: Option<String>,
    rule: StopAsked,
}

impl StudyUnderWay {
    /// Begins the study of a plan.
    pub fn begin(plan: StudyPlan, context: &mut FeatureContext<'_>) -> Self {
        let runs = plan.runs();
        let now = context.host.now();
        let mut study = Self {
            design: StudyDesign::new(plan),
            numbers: vec![Vec::new(); runs as usize],
            flown: 0,
            next: 0,
            shards: Vec::new(),
            begun: now,
            latest: now,
            trouble: None,
            rule: StopAsked::default(),
        };
        for share in (0..WorkerRole::ALL.len())
            .cycle()
            .take(AHEAD * WorkerRole::ALL.len())
        {
            study.give(share, context);
        }
        study
    }

    /// Gives the next shard to the worker of a share, if there is one.
    fn give(&mut self, share: usize, context: &mut FeatureContext<'_>) {
        let runs = self.next..(self.next + SHARD).min(self.plan().runs());
        if runs.is_empty() || self.trouble.is_some() {
            return;
        }
        let flights = runs.clone().map(|run| Ok(self.design.run(run)?.flight()));
        let flights: Result<Vec<_>, pilotage_study::StudyError> = flights.collect();
        match flights {
            Ok(flights) => {
                let order = StudyFlightsOrder { flights, share };
                let job = context.start(Job::StudyFlights(order));
                self.next = runs.end;
                self.shards.push(StudyShard { job, runs, share });
            }
            Err(why) => self.trouble = Some(why.to_string()),
        }
    }

    /// Takes what a worker says; false if it is about something else.
    pub fn receive(
        &mut self,
        id: JobId,
        event: &JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        if let Some(answer) = self.rule.receive(id, event) {
            match answer {
                Ok(Some(draws)) => self.end_after(draws, context),
                Ok(None) => self.ask_rule(context),
                Err(why) => self.trouble = Some(why),
            }
            return true;
        }
        let Some(at) = self.shards.iter().position(|shard| shard.job == id) else {
            return false;
        };
        match event {
            JobEvent::Figures(_) => match event.read_figures::<Vec<Vec<Option<f64>>>>() {
                Ok(numbers) => {
                    let runs = self.shards[at].runs.clone();
                    for (run, numbers) in runs.zip(numbers) {
                        self.numbers[run as usize] = numbers;
                        self.flown += 1;
                    }
                    self.latest = context.host.now();
                    self.ask_rule(context);
                }
                Err(why) => self.trouble = Some(why),
            },
            JobEvent::Failed(why) => self.trouble = Some(why.clone()),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if event.is_last() {
            let share = self.shards.remove(at).share;
            self.give(share, context);
        }
        if self.trouble.is_some() {
            self.stop(context);
        }
        true
    }

    /// Stops; what was flown stays. Whether anything was under way.
    pub fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let is_under_way = self.is_under_way();
        for shard in self.shards.drain(..) {
            context.cancel(shard.job);
        }
        self.rule.forget(context);
        is_under_way
    }

    /// Asks the plan's rule to stop about the draws that are whole, from the first on.
    fn ask_rule(&mut self, context: &mut FeatureContext<'_>) {
        let whole = self
            .numbers
            .iter()
            .take_while(|numbers| !numbers.is_empty());
        let draws = whole.count() as u64 / self.plan().cells();
        if let Some(draws) = self.rule.due(self.design.plan(), draws) {
            let flights = (draws * self.plan().cells()) as usize;
            let order = StudyEnoughOrder {
                plan: self.plan().clone().into(),
                numbers: self.numbers[..flights].to_vec(),
            };
            self.rule
                .asked(context.start(Job::StudyEnough(order)), draws);
        }
    }

    /// Ends after so many draws, which are enough by the plan's rule; what was flown beyond is left out, as everywhere.
    fn end_after(&mut self, draws: u64, context: &mut FeatureContext<'_>) {
        self.stop(context);
        let flights = draws * self.plan().cells();
        for numbers in &mut self.numbers[flights as usize..] {
            numbers.clear();
        }
        self.flown = flights;
    }

    /// The plan.
    pub fn plan(&self) -> &StudyPlan {
        self.design.plan()
    }

    /// The design.
    pub fn design(&self) -> &StudyDesign {
        &self.design
    }

    /// Whether flights are under way.
    pub fn is_under_way(&self) -> bool {
        !self.shards.is_empty() || self.rule.is_under_way()
    }

    /// Flights that were flown.
    pub fn flown(&self) -> u64 {
        self.flown
    }

    /// Share that is flown, 0 to 1.
    pub fn progress(&self) -> f32 {
        self.flown as f32 / self.plan().runs().max(1) as f32
    }

    /// Time per flight so far, milliseconds of all workers together.
    pub fn pace(&self) -> Option<f64> {
        (self.flown > 0).then(|| (self.latest - self.begun) / self.flown as f64)
    }

    /// Time that is left, milliseconds.
    pub fn left(&self) -> Option<f64> {
        Some(self.pace()? * (self.plan().runs() - self.flown) as f64)
    }

    /// Draws after which it was enough by the plan's rule, and less than the plan has.
    pub fn stopped_by_rule(&self) -> Option<u64> {
        let draws = self.rule.enough()?;
        (draws < self.plan().draws).then_some(draws)
    }

    /// Why it could not go on.
    pub fn trouble(&self) -> Option<&str> {
        self.trouble.as_deref()
    }

    /// Runs that were flown, each with its numbers of all kinds.
    pub fn rows(&self) -> impl Iterator<Item = (u64, &[Option<f64>])> {
        let rows = (0..).zip(self.numbers.iter().map(Vec::as_slice));
        rows.filter(|(_, numbers)| !numbers.is_empty())
    }

    /// A run by itself, to be flown once more.
    pub fn flight(&self, run: u64) -> Option<StudiedFlight> {
        Some(StudiedFlight {
            study: self.plan().name.clone(),
            run,
            flight: self.design.run(run).ok()?.flight(),
        })
    }
}
