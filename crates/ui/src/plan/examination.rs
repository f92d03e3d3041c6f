//! Landmarks compared with the map around them: when, by which job, and what was found.

use pilotage_core::frames::GroundRect;
use pilotage_jobs::{Distinctness, JobId, MapSource};

use crate::documents::Documents;
use crate::short_map::ShortMap;
use crate::views::Examined;

/// Comparison of landmarks with the map around them, the selected one each time.
#[derive(Debug, Default)]
pub struct Examination {
    /// Job under way, and its landmark.
    pub job: Option<(JobId, u32)>,
    /// The landmark that was selected last, and its box.
    pub seen: Option<(u32, GroundRect)>,
    /// When to begin, milliseconds of the host's clock.
    pub at: Option<f64>,
    /// Map of what was found.
    map: Option<MapSource>,
    /// Distinctness by landmark; true only while the box is the same.
    found: ShortMap<u32, Distinctness>,
    /// The landmark that could not be examined, and why.
    in_vain: Option<(u32, String)>,
}

impl Examination {
    /// Takes note of a job that begins, over `map`; what was found over another one is of no use.
    pub fn begin(&mut self, job: JobId, landmark: u32, map: &MapSource) {
        if self.map.as_ref() != Some(map) {
            self.found.clear();
            self.map = Some(map.clone());
        }
        self.job = Some((job, landmark));
    }

    /// Takes the distinctness of a landmark, or why it has none.
    pub fn take(&mut self, landmark: u32, found: Result<Distinctness, String>) {
        match found {
            Ok(found) => {
                self.found.insert(landmark, found);
            }
            Err(why) => self.in_vain = Some((landmark, why)),
        }
    }

    /// Has a landmark that could not be examined tried again.
    pub fn try_again(&mut self) {
        self.in_vain = None;
    }

    /// Forgets what was found.
    pub fn forget(&mut self) {
        self.found.clear();
        self.in_vain = None;
    }

    /// Distinctness of a landmark on the map that is shown, while its box is still the one that was examined.
    pub fn distinctness(&self, id: u32, documents: &Documents) -> Option<&Distinctness> {
        if self.map.as_ref() != Some(&documents.map.source) {
            return None;
        }
        let bounds = documents.mission.landmark(id)?.bounds;
        self.found.get(&id).filter(|d| d.bounds == bounds)
    }

    /// Why a landmark could not be examined.
    pub fn trouble(&self, id: u32) -> Option<&str> {
        let of_it = self.in_vain.as_ref().filter(|(of, _)| *of == id);
        of_it.map(|(_, why)| why.as_str())
    }

    /// All that is known of a landmark.
    pub fn of(&self, id: u32, documents: &Documents) -> Examined<'_> {
        Examined {
            found: self.distinctness(id, documents),
            trouble: self.trouble(id),
        }
    }
}
