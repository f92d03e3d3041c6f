//! Trajectories beside each other: kept, let go of, shown.

use super::{App, SideTab};
use crate::command::Workspace;
use crate::compare::{CompareCommand, CompareScene, TrackId, open_tracks};
use crate::documents::Documents;
use crate::host::Host;

/// Seconds since 1970 at time zero of the flight that is open, where its log says so.
fn utc_at_zero(documents: &Documents) -> Option<f64> {
    documents.log.as_ref()?.outline.as_ref()?.utc_at_zero
}

/// What the view of trajectories is given.
pub(super) fn compare_scene(documents: &Documents) -> CompareScene<'_> {
    CompareScene {
        shelf: &documents.shelf,
        generations: [documents.run_generation, documents.ghost_generation],
        is_complete: documents.run_complete,
        utc_at_zero: utc_at_zero(documents),
    }
}

impl App {
    /// Does what was asked about trajectories.
    pub(super) fn compare(&mut self, command: &CompareCommand, host: &mut dyn Host) {
        let documents = &mut self.documents;
        match *command {
            CompareCommand::Show => {
                self.view.workspace = Workspace::Replay;
                self.view.side_open = true;
                self.dialogs.settings = false;
                self.side_tab = SideTab::Compare;
            }
            CompareCommand::Keep(id) => {
                let utc = utc_at_zero(documents);
                let (flight, run) = (documents.flight.as_ref(), documents.run.as_ref());
                let open = open_tracks(flight, run, documents.ghost.as_ref(), utc);
                let wanted = open.into_iter().find(|(found, _)| *found == id);
                let Some((_, mut track)) = wanted else {
                    let text = "Simulate or open a flight first.";
                    self.toasts.note(host.now(), "Nothing to keep", text);
                    return;
                };
                let of = flight.map_or("the flight", |f| f.name.as_str());
                track.name = match id {
                    TrackId::Truth => format!("{of}, true"),
                    TrackId::Unaided => format!("{of}, dead reckoning"),
                    _ => of.to_owned(),
                };
                let name = documents.shelf.keep(track).to_owned();
                self.toasts.note(host.now(), "Kept for comparison", name);
            }
            CompareCommand::Discard(number) => documents.shelf.discard(number),
            CompareCommand::ToggleShown(number) => documents.shelf.toggle_shown(number),
        }
    }
}
