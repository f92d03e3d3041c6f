//! Landmarks proposed for a route, as a job: the very proposal of the command line.

use pilotage_core::plan::{Candidate, Proposal, ProposalQuestion, Suggestion};

use super::running::slice;
use super::{Advance, JobEvent, RunningJob, Share, SuggestOrder, Workshop};

/// Seed of the days: the same plan always has the same proposals.
const SEED: u64 = 1;

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

    fn begin(&self, workshop: &mut Workshop) -> Result<Proposal, String> {
        let mut question = question(workshop, self.order.clone())?;
        question.days = workshop.proposal_days(&self.order.map, SEED)?;
        let proposal = Proposal::new(question);
        let proposal = proposal.ok_or("the camera does not look down at the ground")?;
        Ok(proposal.part(self.share.part, self.share.of))
    }
}

/// Landmarks chosen among the places that passed in all shares.
pub fn choose(
    workshop: &mut Workshop,
    order: SuggestOrder,
    found: Vec<Candidate>,
) -> Result<Vec<Suggestion>, String> {
    let count = order.count;
    Ok(question(workshop, order)?.chosen_of(found, count))
}

/// Question of the proposal, still without other days.
fn question(workshop: &mut Workshop, order: SuggestOrder) -> Result<ProposalQuestion, String> {
    Ok(ProposalQuestion {
        map: workshop.cached_map(&order.map)?,
        days: Vec::new(),
        view: order.view,
        way_points: order.way_points,
        speed: order.speed,
        ground_down: order.ground_down,
        navigator: order.navigator,
        side: None,
        taken: order.taken,
    })
}

impl RunningJob for Suggest {
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(proposal) = &mut self.proposal else {
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            self.proposal = Some(self.begin(workshop)?);
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
