//! Opened files put into the browser's storage and thrown away again, a little in every frame.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use pilotage_core::flight::FLIGHT_FILE;

use super::App;
use crate::documents::kept::{
    MOST_KEPT, MOST_LENT_KEPT, address_key, encode_list, file_key, list_key, recall_files,
};
use crate::documents::{Documents, Session};
use crate::host::{Host, OpenedFile};
use crate::jobs::{FileContent, FlightSource, Job, MapSource};

/// Bytes stored in one frame, after which the rest waits for the next.
const PER_FRAME: usize = 2 << 20;

/// How long to wait before a refused document is stored again, milliseconds.
const TRY_AGAIN_AFTER: f64 = 8_000.0;

/// One thing to do with the storage.
#[derive(Debug)]
enum Deed {
    Store(String, FileContent),
    Forget(String),
}

/// What is in the storage of opened files, and what is still to be done there.
#[derive(Debug, Default)]
pub struct Keeping {
    waiting: VecDeque<Deed>,
    /// Number of files of every set that is stored, or about to be.
    sets: BTreeMap<String, usize>,
}

impl Keeping {
    /// Whether everything is done.
    pub fn is_done(&self) -> bool {
        self.waiting.is_empty()
    }

    fn keep(&mut self, set: &str, files: &[OpenedFile]) {
        let stores = files.iter().enumerate();
        let stores = stores.map(|(n, f)| Deed::Store(file_key(set, n), f.content.clone()));
        self.waiting.extend(stores);
        let paths: Vec<String> = files.iter().map(|f| f.path.clone()).collect();
        let list = FileContent::from(encode_list(&paths));
        self.waiting.push_back(Deed::Store(list_key(set), list));
        self.sets.insert(set.to_owned(), files.len());
    }

    /// Forgets every set but these.
    fn forget_others(&mut self, used: &BTreeSet<&str>) {
        let waiting = &mut self.waiting;
        self.sets.retain(|set, count| {
            let kept = used.contains(set.as_str());
            if !kept {
                waiting.push_back(Deed::Forget(list_key(set)));
                for key in (0..*count).map(|n| file_key(set, n)) {
                    waiting.push_back(Deed::Forget(address_key(&key)));
                    waiting.push_back(Deed::Forget(key));
                }
            }
            kept
        });
    }

    /// Does a frame's share.
    fn work(&mut self, host: &mut dyn Host) {
        let mut room = PER_FRAME;
        while let Some(deed) = self.waiting.pop_front() {
            match deed {
                Deed::Store(key, FileContent::Bytes(bytes)) => {
                    host.store(&key, &bytes);
                    room = room.saturating_sub(bytes.len());
                }
                Deed::Store(key, FileContent::Lent { number, .. }) => {
                    host.store_lent(&key, number);
                }
                Deed::Store(key, FileContent::Address(address)) => {
                    host.store(&address_key(&key), address.as_bytes());
                }
                Deed::Forget(key) => host.forget(&key),
            }
            if room == 0 {
                return;
            }
        }
    }
}

/// Keys of the opened files that a session names.
fn file_sets<'a>(flight: &'a FlightSource, map: &'a MapSource) -> BTreeSet<&'a str> {
    let flight = match flight {
        FlightSource::Files(set) => Some(set.as_str()),
        FlightSource::Simulated(_) | FlightSource::Nothing => None,
    };
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
            self.desk.keeping.keep(set, files);
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
        if host.failed_stores() > 0 {
            self.toasts.trouble(
                host.now(),
                "The browser could not keep everything",
                "Its storage for this page is full or switched off. Your last edit may be missing at the next visit: save the mission as a file to be sure of it.",
            );
            // What was stored before is still there; what is open now is tried again.
            self.stored_session.clear();
            self.desk.document_changed = true;
            self.dirty_since = Some(host.now() + TRY_AGAIN_AFTER);
        }
        if !self.desk.keeping.is_done() {
            self.desk.keeping.work(host);
            context.request_repaint();
        }
    }

    /// Forgets files that neither the document nor a flight about to begin needs.
    pub(super) fn forget_unused_files(&mut self) {
        let documents = &self.documents;
        let mut used = file_sets(&documents.flight_source, &documents.map_source);
        used.extend(documents.terrain.key());
        if let Some(fly) = &self.desk.fly {
            used.extend(file_sets(&fly.flight, &fly.map));
        }
        if self.desk.opening.is_empty() {
            self.desk.keeping.forget_others(&used);
        }
    }

    /// Gives the workers the files of the earlier visit; without them the demo opens instead.
    pub(super) fn restore_files(&mut self, host: &mut dyn Host) {
        let session = self.documents.session();
        let mut sets = file_sets(&session.flight, &session.map);
        sets.extend(self.documents.terrain.key());
        let sets: Vec<String> = sets.into_iter().map(str::to_owned).collect();
        for set in &sets {
            let Some(files) = recall_files(host, set) else {
                self.documents = Documents::new(&Session::demo());
                self.toasts.note(
                    host.now(),
                    "The files of your last visit are not here",
                    "The browser did not keep them. Open them again; meanwhile, this is the demo.",
                );
                return;
            };
            self.desk.count_batches(set);
            let is_map = matches!(&session.map, MapSource::Files(of) if of == set);
            if is_map && !files.iter().any(|(path, _)| path.ends_with(FLIGHT_FILE)) {
                let whole = |(path, content): &(String, FileContent)| {
                    Some((path.clone(), content.bytes()?.to_vec()))
                };
                self.desk.map_files = files
                    .iter()
                    .map(whole)
                    .collect::<Option<_>>()
                    .unwrap_or_default();
            }
            self.desk.keeping.sets.insert(set.to_owned(), files.len());
            let key = set.to_owned();
            host.start(Job::Provide { key, files });
        }
    }
}
