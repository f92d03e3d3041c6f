//! Answers about a log beside its series: figures and tables of a span of time, from every sample.

use std::rc::Rc;

use pilotage_core::flight::expression::TimedSamples;
use pilotage_core::flight::{SpanStatistics, SpanTable};

use super::order::{Order, Urgency, WorkerRole};
use super::running::slice;
use super::{Advance, JobEvent, LogAnswer, LogOrder, LogQuestion, RunningJob, WorkerState};

/// Rows of a table written at a time.
const ROWS: usize = 4096;

/// A log that is looked through: events `LogAnswer`.
pub struct AnswerLog {
    order: LogOrder,
    /// Series looked at.
    next: usize,
    columns: Vec<(String, Rc<TimedSamples>)>,
    lacks: Vec<String>,
    table: Option<(SpanTable<Rc<TimedSamples>>, String)>,
}

impl AnswerLog {
    /// Nothing found out yet.
    pub fn new(order: LogOrder) -> Self {
        Self {
            order,
            next: 0,
            columns: Vec::new(),
            lacks: Vec::new(),
            table: None,
        }
    }

    /// Looks at the next series; whether there was one.
    fn look(
        &mut self,
        worker: &mut WorkerState,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<bool, String> {
        let LogOrder { key, file, .. } = &self.order;
        let Some((series, name)) = self.order.series.get(self.next) else {
            return Ok(false);
        };
        self.next += 1;
        let samples = worker.samples(key, file, series)?;
        match (self.order.question, samples) {
            (LogQuestion::Statistics, samples) => {
                let span = self.order.span;
                let found = samples.map(|samples| SpanStatistics::of(&samples, span));
                let answer = LogAnswer::Statistics(series.clone(), found);
                emit(JobEvent::LogAnswer(Box::new(answer)));
            }
            (LogQuestion::Table, Ok(samples)) => self.columns.push((name.clone(), samples)),
            (LogQuestion::Table, Err(why)) => self.lacks.push(why),
        }
        Ok(true)
    }

    /// Writes rows for a slice of time; whether there are more.
    fn write(&mut self, clock: &dyn Fn() -> f64, emit: &mut dyn FnMut(JobEvent)) -> bool {
        let (columns, span) = (&mut self.columns, self.order.span);
        let (table, text) = self.table.get_or_insert_with(|| {
            let table = SpanTable::new(std::mem::take(columns), span);
            let heading = table.heading();
            (table, heading)
        });
        if slice(clock, || table.write(ROWS, text)) {
            let words = "Writing the table".to_owned();
            emit(JobEvent::Progress(table.progress(), words));
            return true;
        }
        let answer = LogAnswer::Table {
            text: std::mem::take(text).into_bytes(),
            lacks: std::mem::take(&mut self.lacks),
        };
        emit(JobEvent::LogAnswer(Box::new(answer)));
        false
    }
}

impl RunningJob for AnswerLog {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.look(worker, emit)? {
            return Ok(Advance::More);
        }
        if self.order.question == LogQuestion::Table && self.write(clock, emit) {
            return Ok(Advance::More);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for LogOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(AnswerLog::new(self))
    }
}
