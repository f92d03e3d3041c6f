//! Routes and landmarks to the files of other programs.

use super::App;
use super::pending_jobs::Exporting;
use crate::command::Command;
use crate::host::{Host, stem};
pub(super) use crate::shell::sentences;
use pilotage_jobs::{ExportOrder, Job, JobEvent, JobId};

impl App {
    /// Has the selected route, or the landmarks, made into a file of another program.
    pub(super) fn export(&mut self, command: &Command, host: &mut dyn Host) {
        let now = host.now();
        let mission = &self.documents.mission;
        let (format, what, name, routes, landmarks) = match command {
            Command::ExportRoute(format) => {
                let Some(route) = self.documents.selected_route() else {
                    let text = "Draw one in the Plan workspace, or open a file with one.";
                    self.toasts.note(now, "No route to export", text);
                    return;
                };
                let name = format!("{}.{}", stem(&route.name), format.extensions()[0]);
                (*format, "Route", name, vec![route.clone()], Vec::new())
            }
            Command::ExportLandmarks(format) => {
                if mission.landmarks.is_empty() {
                    let text = "Draw one on the map, or open a file with some.";
                    self.toasts.note(now, "No landmarks to export", text);
                    return;
                }
                let extension = format.extensions()[0];
                let name = format!("{}-landmarks.{extension}", self.file_stem());
                let landmarks = mission.landmarks.clone();
                (*format, "Landmarks", name, Vec::new(), landmarks)
            }
            _ => return,
        };
        let order = ExportOrder::Places {
            format,
            no_fly: if routes.is_empty() {
                Vec::new()
            } else {
                mission.no_fly.clone()
            },
            routes,
            landmarks,
            origin: mission.origin,
        };
        self.jobs.exporting.push(Exporting {
            id: host.start(Job::Export(Box::new(order))),
            what,
            format: format.name(),
            name,
        });
    }

    /// Takes what the worker says of a file of another program.
    pub(super) fn export_event(&mut self, host: &mut dyn Host, id: JobId, event: JobEvent) {
        let exporting = &mut self.jobs.exporting;
        let Some(place) = exporting.iter().position(|e| e.id == id) else {
            return;
        };
        let now = host.now();
        let Exporting {
            what, format, name, ..
        } = &exporting[place];
        match event {
            JobEvent::Exported { bytes, notes } => {
                host.save_file(name, &bytes);
                let title = format!("{what} exported as {format}: {name}");
                self.toasts.note(now, title, sentences(&notes));
            }
            JobEvent::Failed(why) => {
                let title = format!("{what} not exported as {format}");
                self.toasts.trouble(now, title, sentences(&[why]));
                exporting.remove(place);
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                exporting.remove(place);
            }
            _ => {}
        }
    }
}
