//! A series of a log, sent piece by piece.

use std::rc::Rc;

use pilotage_core::flight::expression::TimedSamples;

use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole};
use super::running::slice;
use super::{Advance, JobEvent, LogSeries, RunningJob, SeriesName, WorkerState};

/// Samples sent at a time: what the page takes over in a small part of a frame.
const PIECE: usize = 1 << 17;
/// A series that is being sent: events `LogSeries`.
pub struct SendSeries {
    key: String,
    file: String,
    series: SeriesName,
    /// The samples, and the base that every piece takes off.
    samples: Option<(Rc<TimedSamples>, f64)>,
    sent: usize,
}

impl SendSeries {
    /// Nothing sent yet.
    pub fn new(key: String, file: String, series: SeriesName) -> Self {
        Self {
            key,
            file,
            series,
            samples: None,
            sent: 0,
        }
    }
}

impl RunningJob for SendSeries {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let Some((samples, base)) = &self.samples else {
            match worker.samples(&self.key, &self.file, &self.series)? {
                Ok(samples) => {
                    let base = LogSeries::base_of(&samples);
                    self.samples = Some((samples, base));
                }
                Err(why) => {
                    let lacking = LogSeries::lacking(&self.series, why);
                    emit(JobEvent::LogSeries(Box::new(lacking)));
                    emit(JobEvent::Finished);
                    return Ok(Advance::Done);
                }
            }
            return Ok(Advance::More);
        };
        let is_more = slice(clock, || {
            let piece = LogSeries::piece(&self.series, samples, *base, self.sent, PIECE);
            emit(JobEvent::LogSeries(Box::new(piece)));
            self.sent += PIECE;
            self.sent < samples.times.len()
        });
        if is_more {
            return Ok(Advance::More);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

/// Series of a log that is being read or was: events `LogSeries`, each with some of its samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeriesOrder {
    /// Key of the files.
    pub key: String,
    /// Name of the log among them.
    pub file: String,
    /// Name of the series.
    pub series: SeriesName,
}

impl Order for SeriesOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(SendSeries::new(self.key, self.file, self.series))
    }
}
