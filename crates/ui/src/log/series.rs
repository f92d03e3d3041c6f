//! Fields of the log, fetched from its worker where they are plotted.

use pilotage_jobs::{Job, JobEvent, JobId, SeriesName, SeriesOrder};

use super::work::LogFeature;
use crate::feature::FeatureContext;

impl LogFeature {
    /// Whether a job fetches a field.
    pub(super) fn fetches(&self, id: JobId) -> bool {
        self.fetching.iter().any(|(job, _)| *job == id)
    }

    fn end_fetching(&mut self, id: JobId) -> Option<SeriesName> {
        let at = self.fetching.iter().position(|(job, _)| *job == id)?;
        Some(self.fetching.swap_remove(at).1)
    }

    /// Takes what is said of a field that is fetched; whether that is awaited.
    pub(super) fn series_event(&mut self, id: JobId, event: &JobEvent) -> bool {
        match event {
            JobEvent::LogSeries(series) => {
                if let Some(log) = &mut self.log {
                    log.take(series);
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.end_fetching(id);
            }
            // What is read by and by may have it yet.
            JobEvent::Failed(_) if self.reading.is_some() => {
                self.end_fetching(id);
            }
            JobEvent::Failed(_) => {
                let series = self.end_fetching(id);
                if let (Some(log), Some(series)) = (&mut self.log, series) {
                    log.series.remove(&series);
                }
                self.lose();
            }
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    /// Asks for the fields that are plotted and not there.
    pub(super) fn fetch(&mut self, context: &mut FeatureContext<'_>) {
        if std::mem::take(&mut self.is_lost) {
            self.read_again(context);
            return;
        }
        let Some(log) = self.log.as_mut().filter(|log| log.outline.is_some()) else {
            return;
        };
        let fetching = &self.fetching;
        let is_asked = |series: &SeriesName| fetching.iter().any(|(_, asked)| asked == series);
        let wanted = self.plots.fields().into_iter().cloned();
        let missing: Vec<SeriesName> = wanted
            .chain(self.track_field.clone())
            .filter(|series| !log.is_up_to_date(series) && !is_asked(series))
            .collect();
        for series in missing {
            log.look_for(&series);
            let job = context.start(Job::LogSeries(SeriesOrder {
                key: log.key.clone(),
                file: log.file.clone(),
                series: series.clone(),
            }));
            self.fetching.push((job, series));
        }
    }
}
