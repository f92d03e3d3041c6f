//! A feature with a job: it has a worker say hello.

use egui::Ui;
use pilotage_jobs::{EchoOrder, Job, JobEvent, JobId};
use serde_json::Value;

use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::shell::catalog::{CommandGroup, entry};

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: "hello",
    tab: "Hello",
    place: FeaturePlace::Sheet,
    commands: || vec![entry(CommandGroup::View, "Say hello", vec![], say_hello())],
};

/// The one command.
#[derive(Debug, PartialEq)]
struct SayHello;

fn say_hello() -> Command {
    Command::Feature(FeatureCommand::new(INFO.id, SayHello))
}

/// Words of the worker.
#[derive(Debug, Default)]
pub struct Hello {
    /// The job, while it is under way.
    job: Option<JobId>,
    /// Its words, once they came.
    words: Option<String>,
}

impl Hello {
    /// Takes an event of the job; false if it is of another one, or of a kind that is not awaited.
    fn take(&mut self, job: JobId, event: JobEvent) -> bool {
        if self.job != Some(job) {
            return false;
        }
        if event.is_last() {
            self.job = None;
        }
        match event {
            JobEvent::Remark(words) => self.words = Some(words),
            JobEvent::Failed(why) => self.words = Some(why),
            JobEvent::Progress(..) | JobEvent::Finished | JobEvent::Cancelled => {}
            _ => return false,
        }
        true
    }
}

impl Feature for Hello {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        if command.action::<SayHello>().is_none() {
            return false;
        }
        context.show();
        self.stop(context);
        let flight = &context.documents.mission.name;
        let order = EchoOrder(format!("Hello from {flight}"));
        self.job = Some(context.start(Job::Echo(order)));
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, _documents: &Documents) {
        ui.label(self.words.as_deref().unwrap_or("Nobody said hello yet."));
        if ui.button("Say hello").clicked() {
            context.commands.push(say_hello());
        }
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, _context: &mut FeatureContext<'_>) -> bool {
        self.take(job, event)
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let job = self.job.take();
        job.map(|job| context.cancel(job)).is_some()
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        self.words = None;
    }

    fn state(&self, _documents: &Documents) -> Value {
        self.words.clone().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hello_is_said_by_the_worker_that_was_asked() {
        let mut hello = Hello {
            job: Some(7),
            words: None,
        };
        let said = || JobEvent::Remark("Hello".to_owned());
        assert!(!hello.take(8, said()));
        assert_eq!(hello.words, None);
        assert!(hello.take(7, said()));
        assert_eq!(hello.words.as_deref(), Some("Hello"));
        assert!(!hello.take(7, JobEvent::Places(Vec::new())));
        assert!(hello.take(7, JobEvent::Finished));
        assert!(!hello.take(7, said()));
    }
}
