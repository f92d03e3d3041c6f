//! Files that were opened, while workers look at them.

use pilotage_jobs::{Job, JobId, OpenOrder};

use crate::documents::Documents;
use crate::feature::OpenedSet;
use crate::host::{Host, OpenedFile};
use crate::job_owners::JobOwner;
use crate::short_map::ShortMap;

/// Files being looked at.
#[derive(Debug)]
struct Opening {
    /// The files, to be kept if they are of use.
    set: OpenedSet,
    /// Present activity, in words.
    words: String,
}

/// Sets of opened files being looked at.
#[derive(Debug, Default)]
pub struct Openings {
    under_way: ShortMap<JobId, Opening>,
    /// Number of sets opened so far.
    count: usize,
}

impl Openings {
    /// Counts on behind a set of opened files that an earlier visit kept.
    pub fn count_on(&mut self, set: &str) {
        let number = set.rsplit('-').next().and_then(|n| n.parse().ok());
        self.count = self.count.max(number.unwrap_or(0));
    }

    /// Set of files that were opened at once; none without files.
    pub fn set_of(&mut self, files: Vec<OpenedFile>) -> Option<OpenedSet> {
        let name = match files.as_slice() {
            [one] => one.path.clone(),
            [first, rest @ ..] => {
                let folder = first.path.split('/').next().unwrap_or_default();
                format!("{folder} and {} more files", rest.len())
            }
            [] => return None,
        };
        self.count += 1;
        let key = format!("opened-{}", self.count);
        Some(OpenedSet { key, name, files })
    }

    /// Has files looked at, which the workers have.
    pub fn begin(&mut self, set: OpenedSet, documents: &Documents, host: &mut dyn Host) {
        let order = OpenOrder {
            key: set.key.clone(),
            near: documents.world_origin(),
            origin: documents.mission.origin,
        };
        let id = host.start(JobOwner::Openings, Job::Open(order));
        let words = format!("Opening {}", set.name);
        self.under_way.insert(id, Opening { set, words });
    }

    /// Whether a job looks at opened files.
    pub fn is_under_way(&self, id: JobId) -> bool {
        self.under_way.contains_key(&id)
    }

    /// Takes away a job that is over; the files at which it looked.
    pub fn end(&mut self, id: JobId) -> Option<OpenedSet> {
        self.under_way.remove(&id).map(|it| it.set)
    }

    /// Keys of the sets that are looked at.
    pub fn keys(&self) -> impl Iterator<Item = &str> {
        self.under_way.iter().map(|(_, it)| it.set.key.as_str())
    }

    /// Stops looking at files; true if that was under way.
    pub fn stop(&self, host: &mut dyn Host) -> bool {
        let mut jobs = self.under_way.iter().map(|(id, _)| *id).peekable();
        let is_under_way = jobs.peek().is_some();
        for id in jobs {
            host.cancel(id);
        }
        is_under_way
    }

    /// Progress, 0 to 1, and the words of what is looked at first.
    pub fn progress(&self) -> Option<(f32, &str)> {
        let (_, opening) = self.under_way.iter().next()?;
        Some((0.0, opening.words.as_str()))
    }
}
