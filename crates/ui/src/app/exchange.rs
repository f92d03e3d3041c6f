//! Routes and landmarks to the files of other programs.

use super::App;
use crate::command::Command;
use crate::exports::ExportedFile;
use crate::host::{Host, stem};
use pilotage_jobs::ExportOrder;

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
        let file = ExportedFile {
            what,
            format: format.name(),
            name,
        };
        self.exports.make(file, order, host);
    }
}
