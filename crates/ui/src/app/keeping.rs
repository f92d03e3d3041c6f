//! Opened files put into the browser's storage and thrown away again, a little in every frame.

use std::collections::BTreeSet;

use pilotage_core::frames::GroundRect;

use super::fly_work::FlyWork;
use super::openings::Openings;
use super::storage::Keeping;
use crate::documents::kept::{MOST_KEPT, MOST_LENT_KEPT, provide, recall_files};
use crate::documents::{Documents, OpenedTerrain, Session};
use crate::feature::{Feature, OpenedSet};
use crate::host::{Host, OpenedFile};
use crate::shell::Toasts;
use pilotage_jobs::{FileContent, FlightSource, MapSource};

/// Keys of the opened files that a session names.
fn file_sets<'a>(flight: &'a FlightSource, map: &'a MapSource) -> BTreeSet<&'a str> {
    let flight = flight.key();
    flight.into_iter().chain(map.key()).collect()
}

impl Keeping {
    /// Keeps files that were opened for the next visit, if they are not too many.
    pub fn keep_few(&mut self, set: &OpenedSet, toasts: &mut Toasts, host: &dyn Host) {
        let is_lent = |f: &&OpenedFile| matches!(f.content, FileContent::Lent { .. });
        let length = |f: &OpenedFile| f.content.length();
        let total: u64 = set.files.iter().map(length).sum();
        let lent: u64 = set.files.iter().filter(is_lent).map(length).sum();
        if total - lent <= MOST_KEPT && lent <= MOST_LENT_KEPT {
            self.keep(&set.key, set.files.clone());
            return;
        }
        let text = format!(
            "They are {} MB, and the browser keeps at most {} MB of files and {} MB of large ones. \
             Save the mission before you leave, and open the files again next time.",
            total >> 20,
            MOST_KEPT >> 20,
            MOST_LENT_KEPT >> 20
        );
        let title = format!("{} will be gone when the page is closed", set.name);
        toasts.note(host.now(), title, text);
    }

    /// Stores and forgets what is due; whether the browser refused to store something.
    pub fn tend(
        &mut self,
        context: &egui::Context,
        toasts: &mut Toasts,
        host: &mut dyn Host,
    ) -> bool {
        let now = host.now();
        let refused = host.failed_stores();
        if !refused.is_empty() {
            let files = self.refuse(&refused, now).join(", ");
            let lost = if files.is_empty() {
                "Your last edit may be missing at the next visit: save the mission as a file to be \
                 sure of it."
                    .to_owned()
            } else {
                format!("There is no room for {files}: open it again at the next visit.")
            };
            let text =
                format!("Its storage for this page is full, emptied or switched off. {lost}");
            let title = "The browser could not keep everything";
            toasts.trouble(now, title, text);
        }
        self.retry(now);
        if !self.is_done() {
            self.work(host);
            context.request_repaint();
        }
        !refused.is_empty()
    }

    /// Gives the workers the files of this visit or an earlier one; the keys of those that are gone.
    pub fn restore(
        &mut self,
        documents: &Documents,
        openings: &mut Openings,
        host: &mut dyn Host,
    ) -> BTreeSet<String> {
        let mut sets = file_sets(&documents.flight.source, &documents.map.source);
        sets.extend(documents.map.terrain.key());
        let sets: Vec<String> = sets.into_iter().map(str::to_owned).collect();
        let mut gone = BTreeSet::new();
        for key in sets {
            openings.count_on(&key);
            // Those that were opened at this visit are here, and the host tells of others once.
            if let Some(files) = self.files(&key) {
                provide(host, &key, &files);
                continue;
            }
            match recall_files(host, &key) {
                Ok(files) => {
                    let of = |(path, content)| OpenedFile { path, content };
                    let files: Vec<_> = files.into_iter().map(of).collect();
                    provide(host, &key, &files);
                    self.knows(&key, files.len(), files);
                }
                Err(count) => {
                    self.knows(&key, count, Vec::new());
                    gone.insert(key);
                }
            }
        }
        gone
    }
}

/// Keys of the files that the documents, a flight about to begin and features need; steps of the run are explained with
/// the map over which it was flown.
pub fn used_files(
    documents: &Documents,
    fly_work: &FlyWork,
    features: &[Box<dyn Feature>],
) -> BTreeSet<String> {
    let mut used = file_sets(&documents.flight.source, &documents.map.source);
    used.extend(documents.map.terrain.key());
    used.extend(documents.run.over.as_ref().and_then(MapSource::key));
    if let Some(fly) = &fly_work.job {
        used.extend(file_sets(&fly.flight, &fly.map));
    }
    used.extend(features.iter().flat_map(|it| it.used_files()));
    used.into_iter().map(str::to_owned).collect()
}

/// Goes on without sets of files that the browser did not keep: the mission stays, and only
/// what was made from them goes. Returns the ground of the plan, where nothing else is left to be looked at.
pub fn do_without(
    gone: &BTreeSet<String>,
    documents: &mut Documents,
    toasts: &mut Toasts,
    host: &dyn Host,
) -> Option<GroundRect> {
    let is_gone = |key: Option<&str>| key.is_some_and(|key| gone.contains(key));
    let mut parts = Vec::new();
    if is_gone(documents.flight.source.key()) {
        parts.push("the flight");
        documents.flight.source = FlightSource::Nothing;
        documents.flight.log = None;
    }
    if is_gone(documents.map.source.key()) {
        parts.push("the map");
        match &documents.flight.source {
            FlightSource::Simulated(options) => documents.map.source = options.map(),
            FlightSource::Files(key) => documents.map.source = MapSource::Files(key.clone()),
            // The plan keeps the name of its map: nothing else lies there.
            FlightSource::Rehearsed(_) | FlightSource::Studied(_) | FlightSource::Nothing => {}
        }
    }
    if is_gone(documents.map.terrain.key()) {
        parts.push("the elevation model");
        documents.map.terrain = OpenedTerrain::default();
    }
    let planned = documents.flight.source == FlightSource::Nothing;
    let text = if planned && !documents.mission.is_edited {
        *documents = Documents::new(&Session::demo());
        "Open them again; meanwhile, this is the demo."
    } else {
        "Your mission is here. Open them again to go on where you were."
    };
    let title = "Files of your last visit are not here";
    let text = format!("The browser did not keep {}. {text}", parts.join(", "));
    toasts.trouble(host.now(), title, text);
    documents.mission.planned_ground().filter(|_| planned)
}
