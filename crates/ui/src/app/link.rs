//! Links to the view and the demo's state, given and followed.

use super::App;
use crate::documents::link::{BEFORE_LINK_KEY, LINK_KEY, Link};
use crate::documents::{Documents, SESSION_KEY, Session};
use crate::host::Host;
use pilotage_jobs::{FlightSource, MapSource};

impl App {
    /// Copies a link to what is shown.
    pub(super) fn copy_link(&mut self, host: &mut dyn Host) {
        let now = host.now();
        let FlightSource::Simulated(simulation) = &self.documents.flight_source else {
            let text = "A link carries the view and the built-in flights only. Save the mission as a \
                        file to pass on what you have opened.";
            self.toasts
                .note(now, "Opened files do not fit into a link", text);
            return;
        };
        let camera = &self.views.map.camera;
        let link = Link {
            simulation: simulation.clone(),
            workspace: self.view.workspace,
            center: camera.center,
            scale: camera.metres_per_point,
            up: camera.up,
            time: self.playback.time,
        };
        host.copy_link(&link.encode());
        let text = if self.documents.mission_edited {
            "It carries the view and the built-in flight, not your edits: save the mission as a file \
             to pass them on."
        } else {
            "Whoever opens it sees this view of the built-in flight."
        };
        self.toasts.note(now, "Link copied", text);
    }

    /// The session of the link that the page was opened with; the one before it is kept aside if
    /// there is work in it.
    pub(super) fn follow_link(&mut self, host: &mut dyn Host) {
        let fragment = host.recall(LINK_KEY);
        let fragment = fragment.and_then(|bytes| String::from_utf8(bytes).ok());
        let Some(link) = fragment.and_then(|text| Link::decode(&text)) else {
            return;
        };
        let own = self.documents.session();
        let is_work = own.mission.is_some() || matches!(own.flight, FlightSource::Files(_));
        if is_work {
            host.store(BEFORE_LINK_KEY, &own.encode());
            // Files opened from now on must not take the place of those that are kept.
            if let FlightSource::Files(set) = &own.flight {
                self.jobs.count_batches(set);
            }
            if let MapSource::Files(set) = &own.map {
                self.jobs.count_batches(set);
            }
            self.jobs.before_link = Some(own);
            let text = "It is kept aside: “Open what was open before the link”, among all commands \
                        (Ctrl+K), brings it back.";
            self.toasts.note(
                host.now(),
                "A link was opened instead of your own work",
                text,
            );
        }
        self.documents = Documents::new(&Session {
            flight: FlightSource::Simulated(link.simulation.clone()),
            ..Session::demo()
        });
        self.view.workspace = link.workspace;
        self.jobs.link = Some(link);
    }

    /// Looks at the flight as the link says, once the flight is there.
    pub(super) fn look_by_link(&mut self) {
        let Some(link) = self.jobs.link.take() else {
            return;
        };
        let map = &mut self.views.map;
        map.stay();
        map.camera.center = link.center;
        map.camera.metres_per_point = link.scale;
        map.camera.up = link.up;
        self.playback.playing = false;
        self.playback.seek(link.time, self.documents.span());
    }

    /// Goes back to what was open before a link was followed.
    pub(super) fn open_before_link(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        let kept = self.jobs.before_link.take();
        let kept = kept.or_else(|| Session::decode(&host.recall(BEFORE_LINK_KEY)?));
        let Some(session) = kept else {
            let text = "No link was opened over work of yours.";
            self.toasts.note(host.now(), "Nothing was kept aside", text);
            return;
        };
        self.stop_flying(host);
        self.documents = Documents::new(&session);
        self.restore_files(host);
        self.describe_map(host);
        host.store(SESSION_KEY, &session.encode());
        host.forget(BEFORE_LINK_KEY);
        self.fly_session(egui, host);
    }
}
