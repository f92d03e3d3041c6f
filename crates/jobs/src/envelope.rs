//! From which heights and with which tilts a landmark is found, a look after the other.

use pilotage_core::plan::EnvelopeSurvey;

use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole};
use super::running::slice;
use super::{Advance, AssessmentOrder, JobEvent, MapSource, RunningJob, WorkerState};

/// Milliseconds between two looks at what is known so far.
const EVERY: f64 = 400.0;

/// An envelope being filled.
pub struct SurveyEnvelope {
    order: AssessmentOrder,
    survey: Option<EnvelopeSurvey>,
    told: f64,
}

impl SurveyEnvelope {
    /// Nothing looked at yet.
    pub fn new(order: AssessmentOrder) -> Self {
        Self {
            order,
            survey: None,
            told: 0.0,
        }
    }
}

impl RunningJob for SurveyEnvelope {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some(survey) = &mut self.survey else {
            let words = "Laying out the ground of other days".to_owned();
            emit(JobEvent::Progress(0.0, words));
            let days = worker.envelope_days(&self.order.map, self.order.seed)?;
            let assessor = self.order.assessor(worker, &days)?;
            self.survey = Some(EnvelopeSurvey::usual(assessor));
            return Ok(Advance::More);
        };
        let more = slice(clock, || survey.advance());
        let (done, of) = survey.progress();
        let share = done as f32 / of.max(1) as f32;
        emit(JobEvent::Progress(share, format!("Look {done} of {of}")));
        if !more || clock() - self.told > EVERY {
            self.told = clock();
            emit(JobEvent::Envelope(Box::new(survey.envelope().clone())));
        }
        if more {
            return Ok(Advance::More);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// Survey of the heights and tilts from which a landmark is found: events `Envelope`, each knowing more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EnvelopeOrder(pub Box<AssessmentOrder>);

impl Order for EnvelopeOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        self.0.files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        self.0.reads()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(SurveyEnvelope::new(*self.0))
    }
}
