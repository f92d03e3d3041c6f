//! Files for other programs, made by workers and saved once they are there.

use pilotage_jobs::{ExportOrder, Job, JobEvent, JobId};

use crate::host::Host;
use crate::shell::{Toasts, sentences};

/// A file for another program, in words for people.
#[derive(Debug)]
pub struct ExportedFile {
    /// Its content.
    pub what: &'static str,
    /// Name of its format.
    pub format: &'static str,
    /// Its name.
    pub name: String,
}

/// Files for other programs that are being made.
#[derive(Debug, Default)]
pub struct Exports(Vec<(JobId, ExportedFile)>);

impl Exports {
    /// Has a file made.
    pub fn make(&mut self, file: ExportedFile, order: ExportOrder, host: &mut dyn Host) {
        let job = host.start(Job::Export(Box::new(order)));
        self.0.push((job, file));
    }

    /// Takes what a worker says of a file; whether `id` was about one.
    pub fn receive(
        &mut self,
        id: JobId,
        event: &JobEvent,
        host: &mut dyn Host,
        toasts: &mut Toasts,
    ) -> bool {
        let Some(place) = self.0.iter().position(|(job, _)| *job == id) else {
            return false;
        };
        let now = host.now();
        let ExportedFile { what, format, name } = &self.0[place].1;
        match event {
            JobEvent::Exported { bytes, notes } => {
                host.save_file(name, bytes);
                let title = format!("{what} exported as {format}: {name}");
                toasts.note(now, title, sentences(notes));
            }
            JobEvent::Failed(why) => {
                let title = format!("{what} not exported as {format}");
                toasts.trouble(now, title, sentences(std::slice::from_ref(why)));
            }
            _ => {}
        }
        if event.is_last() {
            self.0.remove(place);
        }
        true
    }
}
