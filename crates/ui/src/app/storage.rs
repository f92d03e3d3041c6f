//! Opened files in the browser's storage, and the work still to be done there.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::documents::kept::{address_key, encode_list, file_key, list_key};
use crate::host::{Host, OpenedFile};
use crate::short_map::ShortMap;
use pilotage_jobs::FileContent;

/// Bytes stored in one frame, after which the rest waits for the next.
const PER_FRAME: usize = 2 << 20;

/// Delay before a refused document is stored again, milliseconds.
pub(super) const TRY_AGAIN_AFTER: f64 = 8_000.0;

/// Number of times that files that were refused are stored again.
const MOST_RETRIES: u8 = 2;

/// Single thing to do with the storage.
#[derive(Debug)]
enum Deed {
    Store(String, FileContent),
    Forget(String),
}

/// A set of opened files that is stored, or about to be.
#[derive(Debug)]
struct Set {
    files: Vec<OpenedFile>,
    /// Number of files of the set in the storage.
    count: usize,
    /// Number of times that the set was stored again.
    retries: u8,
}

/// Opened files in the storage, and the work still to be done there.
#[derive(Debug, Default)]
pub struct Keeping {
    waiting: VecDeque<Deed>,
    sets: BTreeMap<String, Set>,
    /// Sets that were refused, and when to store them again, milliseconds.
    refused: ShortMap<String, f64>,
}

impl Keeping {
    /// Whether everything is done.
    pub fn is_done(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Stores a set of files.
    pub fn keep(&mut self, set: &str, files: Vec<OpenedFile>) {
        self.knows(set, files.len(), files);
        self.store(set);
    }

    /// Counts a set as stored.
    pub fn knows(&mut self, set: &str, count: usize, files: Vec<OpenedFile>) {
        let retries = 0;
        let it = Set {
            files,
            count,
            retries,
        };
        self.sets.insert(set.to_owned(), it);
    }

    /// The files of a set, unless there were too many to be stored.
    pub fn files(&self, set: &str) -> Option<Vec<OpenedFile>> {
        let files = &self.sets.get(set)?.files;
        (!files.is_empty()).then(|| files.clone())
    }

    fn store(&mut self, set: &str) {
        let Some(Set { files, .. }) = self.sets.get(set) else {
            return;
        };
        let stores = files.iter().enumerate();
        let stores = stores.map(|(n, f)| Deed::Store(file_key(set, n), f.content.clone()));
        self.waiting.extend(stores);
        let paths: Vec<String> = files.iter().map(|f| f.path.clone()).collect();
        let list = FileContent::from(encode_list(&paths));
        self.waiting.push_back(Deed::Store(list_key(set), list));
    }

    /// Takes note of what the browser refused to store; the first file of every set among it.
    pub fn refuse(&mut self, keys: &[String], now: f64) -> Vec<&str> {
        let mut names = Vec::new();
        for (set, it) in &mut self.sets {
            let ending = format!(" of {set}");
            if keys.iter().any(|key| key.ends_with(&ending)) {
                names.extend(it.files.first().map(|f| f.path.as_str()));
                if it.retries < MOST_RETRIES {
                    it.retries += 1;
                    self.refused.insert(set.clone(), now + TRY_AGAIN_AFTER);
                }
            }
        }
        names
    }

    /// Stores again what was refused a while ago.
    pub fn retry(&mut self, now: f64) {
        let due = self.refused.iter().filter(|(_, at)| **at <= now);
        let due: Vec<String> = due.map(|(set, _)| set.clone()).collect();
        for set in due {
            self.refused.remove(&set);
            self.store(&set);
        }
    }

    /// Forgets every set but these.
    pub fn forget_others(&mut self, used: &BTreeSet<String>) {
        let waiting = &mut self.waiting;
        self.sets.retain(|set, it| {
            let kept = used.contains(set);
            if !kept {
                waiting.push_back(Deed::Forget(list_key(set)));
                for key in (0..it.count).map(|n| file_key(set, n)) {
                    waiting.push_back(Deed::Forget(address_key(&key)));
                    waiting.push_back(Deed::Forget(key));
                }
            }
            kept
        });
    }

    /// Does a frame's share.
    pub fn work(&mut self, host: &mut dyn Host) {
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
