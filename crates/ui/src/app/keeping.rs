//! Opened files put into the browser's storage and thrown away again, a little in every frame.

use std::collections::BTreeSet;

use super::App;
use super::storage::TRY_AGAIN_AFTER;
use crate::command::Workspace;
use crate::documents::kept::{MOST_KEPT, MOST_LENT_KEPT, recall_files};
use crate::documents::{Documents, OpenedTerrain, Session, planned_ground};
use crate::host::{Host, OpenedFile};
use pilotage_jobs::{FileContent, FlightSource, Job, MapSource, ProvideOrder};

/// Keys of the opened files that a session names.
fn file_sets<'a>(flight: &'a FlightSource, map: &'a MapSource) -> BTreeSet<&'a str> {
    let flight = flight.key();
    flight.into_iter().chain(map.key()).collect()
}

impl App {
    /// Keeps files that were opened for the next visit, if they are not too many.
    pub(super) fn keep_files(
        &mut self,
        host: &dyn Host,
        set: &str,
        name: &str,
        files: &[OpenedFile],
    ) {
        let is_lent = |f: &&OpenedFile| matches!(f.content, FileContent::Lent { .. });
        let length = |f: &OpenedFile| f.content.length();
        let total: u64 = files.iter().map(length).sum();
        let lent: u64 = files.iter().filter(is_lent).map(length).sum();
        if total - lent <= MOST_KEPT && lent <= MOST_LENT_KEPT {
            self.keeping.keep(set, files.to_vec());
            return;
        }
        let text = format!(
            "They are {} MB, and the browser keeps at most {} MB of files and {} MB of large ones. \
             Save the mission before you leave, and open the files again next time.",
            total >> 20,
            MOST_KEPT >> 20,
            MOST_LENT_KEPT >> 20
        );
        let title = format!("{name} will be gone when the page is closed");
        self.toasts.note(host.now(), title, text);
    }

    /// Stores and forgets what is due.
    pub(super) fn tend_files(&mut self, context: &egui::Context, host: &mut dyn Host) {
        let now = host.now();
        let refused = host.failed_stores();
        if !refused.is_empty() {
            let files = self.keeping.refuse(&refused, now).join(", ");
            let lost = if files.is_empty() {
                "Your last edit may be missing at the next visit: save the mission as a file to be \
                 sure of it."
                    .to_owned()
            } else {
                format!("There is no room for {files}: open it again at the next visit.")
            };
            let text = format!("Its storage for this page is full or switched off. {lost}");
            let title = "The browser could not keep everything";
            self.toasts.trouble(now, title, text);
            // What was stored before is still there; what is open now is tried again.
            self.stored_session.clear();
            self.document_changed = true;
            self.dirty_since = Some(now + TRY_AGAIN_AFTER);
        }
        self.keeping.retry(now);
        if !self.keeping.is_done() {
            self.keeping.work(host);
            context.request_repaint();
        }
    }

    /// Forgets files that neither the document nor a flight about to begin needs.
    pub(super) fn forget_unused_files(&mut self) {
        if self.openings.keys().next().is_none() {
            let used = self.used_files();
            self.keeping.forget_others(&used);
        }
    }

    /// Has the workers let go of what was open before.
    pub(super) fn let_go_of_files(&self, host: &mut dyn Host) {
        let mut used = self.used_files();
        used.extend(self.openings.keys().map(str::to_owned));
        host.let_go(&used);
    }

    /// Keys of the files that the document and a flight about to begin need.
    fn used_files(&self) -> BTreeSet<String> {
        let documents = &self.documents;
        let mut used = file_sets(&documents.flight_source, &documents.map_source);
        used.extend(documents.terrain.key());
        if let Some(fly) = &self.fly_work.job {
            used.extend(file_sets(&fly.flight, &fly.map));
        }
        let features = self.views.features.iter();
        used.extend(features.flat_map(|it| it.used_files()));
        used.into_iter().map(str::to_owned).collect()
    }

    /// Gives the workers the files of the earlier visit; the keys of those that are gone.
    pub(super) fn restore_files(&mut self, host: &mut dyn Host) -> BTreeSet<String> {
        let session = self.documents.session();
        let mut sets = file_sets(&session.flight, &session.map);
        sets.extend(self.documents.terrain.key());
        let sets: Vec<String> = sets.into_iter().map(str::to_owned).collect();
        let mut gone = BTreeSet::new();
        for key in sets {
            self.openings.count_on(&key);
            match recall_files(host, &key) {
                Ok(files) => {
                    let of = |(path, content): &(String, FileContent)| OpenedFile {
                        path: path.clone(),
                        content: content.clone(),
                    };
                    let known = files.iter().map(of).collect();
                    self.keeping.knows(&key, files.len(), known);
                    host.start(Job::Provide(ProvideOrder { key, files }));
                }
                Err(count) => {
                    self.keeping.knows(&key, count, Vec::new());
                    gone.insert(key);
                }
            }
        }
        if !gone.is_empty() {
            self.do_without(host, &gone);
        }
        gone
    }

    /// Goes on without sets of files that the browser did not keep: the mission stays, and only
    /// what was made from them goes.
    fn do_without(&mut self, host: &mut dyn Host, gone: &BTreeSet<String>) {
        let documents = &mut self.documents;
        let is_gone = |key: Option<&str>| key.is_some_and(|key| gone.contains(key));
        let mut parts = Vec::new();
        if is_gone(documents.flight_source.key()) {
            parts.push("the flight");
            documents.flight_source = FlightSource::Nothing;
            documents.log = None;
        }
        if is_gone(documents.map_source.key()) {
            parts.push("the map");
            match &documents.flight_source {
                FlightSource::Simulated(options) => documents.map_source = options.map(),
                FlightSource::Files(key) => documents.map_source = MapSource::Files(key.clone()),
                // The plan keeps the name of its map: nothing else lies there.
                FlightSource::Rehearsed(_) | FlightSource::Nothing => {}
            }
        }
        if is_gone(documents.terrain.key()) {
            parts.push("the elevation model");
            documents.terrain = OpenedTerrain::default();
        }
        let planned = documents.flight_source == FlightSource::Nothing;
        let text = if planned && !documents.mission_edited {
            *documents = Documents::new(&Session::demo());
            "Open them again; meanwhile, this is the demo."
        } else {
            "Your mission is here. Open them again to go on where you were."
        };
        if let Some(ground) = planned_ground(&self.documents.mission).filter(|_| planned) {
            self.show_workspace(Workspace::Plan);
            self.views.map.fit(ground);
        }
        let title = "Files of your last visit are not here";
        let text = format!("The browser did not keep {}. {text}", parts.join(", "));
        self.toasts.trouble(host.now(), title, text);
    }
}
