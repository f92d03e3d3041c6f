//! Routes and landmarks from and to the files of other programs.

use std::fmt::Write as _;

use pilotage_core::text::capitalised;

use super::App;
use super::pending_jobs::Exporting;
use crate::command::{Command, Workspace};
use crate::documents::Brought;
use crate::host::Host;
use crate::plan::PlanTab;
use pilotage_jobs::{ExportOrder, ImportedFile, Job, JobEvent, JobId};

/// Most notes that are shown of a file; the others are counted.
const MOST_NOTES: usize = 6;

fn counted(count: usize, one: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(format!("1 {one}")),
        n => Some(format!("{n} {one}s")),
    }
}

/// Notes as sentences.
pub(super) fn sentences(notes: &[String]) -> String {
    let mut text = String::new();
    for note in notes.iter().take(MOST_NOTES) {
        let note = note.trim_end_matches('.');
        if !note.is_empty() {
            text.push_str(&capitalised(note));
            text.push_str(". ");
        }
    }
    if let Some(more) = notes.len().checked_sub(MOST_NOTES).filter(|n| *n > 0) {
        // Writing into a string cannot fail.
        let _ = write!(text, "And {more} more.");
    }
    text.trim_end().to_owned()
}

impl App {
    /// Adds what files of other programs brought to the mission, as one step, and says what was
    /// assumed, kept aside or left out.
    pub(super) fn add_imports(&mut self, now: f64, files: Vec<ImportedFile>) {
        if files.is_empty() {
            return;
        }
        let routes: usize = files.iter().map(|f| f.routes.len()).sum();
        let landmarks: usize = files.iter().map(|f| f.landmarks.len()).sum();
        let no_fly: usize = files.iter().map(|f| f.no_fly.len()).sum();
        let what: Vec<String> = counted(routes, "route")
            .into_iter()
            .chain(counted(landmarks, "landmark"))
            .chain(counted(no_fly, "no-fly area"))
            .collect();
        let names: Vec<String> = files
            .iter()
            .map(|f| format!("{} ({})", f.name, f.format))
            .collect();
        let several = files.len() > 1;
        let notes: Vec<String> = files
            .iter()
            .flat_map(|f| {
                let name = f.name.clone();
                let of = move |note: &String| {
                    if several {
                        format!("{name}: {note}")
                    } else {
                        note.clone()
                    }
                };
                f.notes.iter().map(of)
            })
            .collect();
        let added = self
            .documents
            .add_all(files.into_iter().map(Brought::from).collect());
        self.show_workspace(Workspace::Plan);
        let planner = &mut self.views.planner;
        planner.drawing = false;
        planner.fitted = false;
        planner.way_point = None;
        planner.tab = match (added.routes.is_empty(), added.landmarks.is_empty()) {
            (false, _) => PlanTab::Route,
            (true, false) => PlanTab::Landmarks,
            (true, true) => PlanTab::Ground,
        };
        self.documents.route = added.routes.first().copied().or(self.documents.route);
        self.jobs.document_changed = true;
        if !added.landmarks.is_empty() {
            self.run_is_stale(now);
        }
        let title = format!("Added {} from {}", what.join(" and "), names.join(", "));
        self.toasts.note(now, title, sentences(&notes));
    }

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

/// A name as it can stand in a file's name.
pub(super) fn stem(name: &str) -> String {
    let allowed = |c: char| {
        if c.is_alphanumeric() || c == '-' {
            c
        } else {
            '-'
        }
    };
    let stem: String = name.chars().map(allowed).collect();
    if stem.is_empty() {
        "pilotage".to_owned()
    } else {
        stem
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_become_sentences_and_many_are_counted() {
        let notes: Vec<String> = (0..8).map(|i| format!("note {i}")).collect();
        let text = sentences(&notes);
        assert!(text.starts_with("Note 0. Note 1. "), "{text}");
        assert!(text.ends_with("Note 5. And 2 more."), "{text}");
        assert_eq!(sentences(&[]), "");
    }
}
