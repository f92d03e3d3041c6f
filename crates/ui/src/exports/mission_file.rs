//! The mission file: saved with what goes with it.

use pilotage_jobs::{Beside, Job, JobEvent, JobId, PackOrder};

use crate::feature::FeatureContext;
use crate::host::stem;

/// The mission file being made.
#[derive(Debug)]
struct Packing {
    job: JobId,
    name: String,
    /// Edits of the mission that it holds.
    edits: u64,
}

/// The mission file being made, if one is.
#[derive(Debug, Default)]
pub(super) struct MissionFile(Option<Packing>);

impl MissionFile {
    /// Has the mission made into a file, with the pictures of its map and what other features save beside it; in the place
    /// of the one being made, if one is.
    pub(super) fn make(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let mut beside = Beside {
            simulation: documents.flight.source.simulation().cloned(),
            bookmarks: documents.flight.bookmarks.clone(),
            ..Beside::default()
        };
        for feature in context.others() {
            feature.put_beside(&mut beside, documents);
        }
        let order = PackOrder {
            mission: documents.mission.clone(),
            beside,
            map: documents.map.source.clone(),
        };
        let name = format!("{}.pilotage.zip", stem(&documents.mission.name));
        let edits = documents.mission.history.edits();
        let job = context.start(Job::Pack(Box::new(order)));
        if let Some(before) = self.0.replace(Packing { job, name, edits }) {
            context.cancel(before.job);
        }
    }

    /// Whether it is being made.
    pub(super) fn is_made(&self) -> bool {
        self.0.is_some()
    }

    /// Gives it up; its job.
    pub(super) fn stop(&mut self) -> Option<JobId> {
        self.0.take().map(|packing| packing.job)
    }

    /// Takes what the worker says of the file; false if it is about something else.
    pub(super) fn take(
        &mut self,
        job: JobId,
        event: JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let Some(Packing { name, edits, .. }) = self.0.as_ref().filter(|it| it.job == job) else {
            return false;
        };
        let is_last = event.is_last();
        match event {
            JobEvent::Packed { bytes, lacks } => {
                context.host.save_file(name, &bytes);
                context.documents.mission.history.mark_saved(*edits);
                if let Some(lacks) = lacks {
                    let text = format!("{name} is saved. {lacks}");
                    context.trouble("The mission file has no map in it", text);
                } else {
                    context.note("Mission saved", name.clone());
                }
            }
            JobEvent::Failed(why) => context.trouble("The mission was not saved", why),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        if is_last {
            self.0 = None;
        }
        true
    }
}
