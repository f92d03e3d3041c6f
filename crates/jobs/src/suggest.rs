//! Landmarks proposed for a route, as a job: the very proposal of the command line.

use pilotage_core::frames::GroundRect;
use pilotage_core::plan::{LandmarkCandidate, Proposal, ProposalQuestion, Suggestion};

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, keys_of};
use super::running::{once, slice};
use super::share::Shareable;
use super::{Advance, JobEvent, MapSource, RunningJob, Share, SuggestOrder, WorkerState};

/// Places being rehearsed.
pub struct Suggest {
    order: SuggestOrder,
    share: Share,
    proposal: Option<Proposal>,
}

impl Suggest {
    /// Nothing rehearsed yet.
    pub fn new(order: SuggestOrder, share: Share) -> Self {
        Self {
            order,
            share,
            proposal: None,
        }
    }

    fn begin(&self, worker: &mut WorkerState) -> Result<Proposal, String> {
        let mut question = question(worker, self.order.clone())?;
        question.days = worker.proposal_days(&self.order.map, self.order.seed)?;
        let proposal = Proposal::new(question);
        let proposal = proposal.ok_or("the camera does not look down at the ground")?;
        Ok(proposal.part(self.share.part, self.share.of))
    }
}

/// Landmarks chosen among the places that passed in all shares.
pub fn choose(
    worker: &mut WorkerState,
    order: SuggestOrder,
    found: Vec<LandmarkCandidate>,
) -> Result<Vec<Suggestion>, String> {
    let count = order.count;
    Ok(question(worker, order)?.chosen_of(found, count))
}

/// Question of the proposal, still without other days.
fn question(worker: &mut WorkerState, order: SuggestOrder) -> Result<ProposalQuestion, String> {
    Ok(ProposalQuestion {
        map: worker.cached_map(&order.map)?,
        days: Vec::new(),
        view: order.view,
        way_points: order.way_points,
        speed: order.speed,
        ground_down: order.ground_down,
        navigator: order.navigator,
        side: order.side,
        taken: order.taken,
    })
}

impl RunningJob for Suggest {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(proposal) = &mut self.proposal else {
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.proposal = Some(self.begin(worker)?);
            return Ok(Advance::More);
        };
        let more = slice(clock, || proposal.advance());
        let (done, of) = proposal.progress();
        let share = done as f32 / of.max(1) as f32;
        emit(JobEvent::Progress(
            share,
            format!("Rehearsing place {done} of {of}"),
        ));
        if more {
            return Ok(Advance::More);
        }
        if let Some(proposal) = self.proposal.take() {
            emit(if self.share == Share::WHOLE {
                JobEvent::Suggestions(proposal.chosen(self.order.count))
            } else {
                JobEvent::Candidates(self.share.part, proposal.found())
            });
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for SuggestOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let across = self.view.across().unwrap_or(0.0);
        let along = GroundRect::around(self.way_points.iter().copied());
        let areas = along.map(|area| area.grown(across)).into_iter().collect();
        Some((&self.map, Reads::Areas(areas)))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        self.begin_share(Share::WHOLE)
    }
}

impl Shareable for SuggestOrder {
    /// Its events are `Candidates`.
    fn begin_share(self, share: Share) -> Box<dyn RunningJob> {
        Box::new(Suggest::new(self, share))
    }
}

/// Proposal of all places that passed: event `Suggestions`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ProposeOrder(pub Box<SuggestOrder>, pub Vec<LandmarkCandidate>);

impl Order for ProposeOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        self.0.files()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            emit(JobEvent::Suggestions(choose(worker, *self.0, self.1)?));
            Ok(())
        })
    }
}
