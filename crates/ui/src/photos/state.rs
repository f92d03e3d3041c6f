//! State of photos on the map.

use pilotage_core::flight::photo::{PhotoSearch, RegisteredPhoto};
use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_core::registration::Draped;
use pilotage_jobs::{DrapeOrder, MapSource, PhotoReport, PhotosOrder};

use super::draped::DrapedPhoto;
use crate::documents::is_same_map;

/// Appearance of the chosen photo over the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PhotoAppearance {
    /// In every other square of a chequerboard: roads and roofs run on where it lies right.
    Squares,
    /// All of it, with this opacity, 0 to 1.
    Whole(f32),
    /// Its outline alone.
    Outline,
}

/// Photos, and the map on which they are to be laid.
#[derive(Clone, Debug, PartialEq)]
pub struct Sought {
    /// Key of the files that they are among.
    pub key: String,
    /// Their names.
    pub names: Vec<String>,
    /// The map.
    pub map: MapSource,
    /// Origin of its world frame, if it has a place on the globe.
    pub origin: Option<Geodetic>,
    /// Ground over which a photo is searched of which no place is known.
    pub ground: GroundRect,
}

/// Limits of a search and deviation of the map, without what is known better of some photos than they tell.
fn limits(search: PhotoSearch) -> PhotoSearch {
    PhotoSearch {
        at: None,
        height: None,
        heading: None,
        ahead: None,
        focal: None,
        ..search
    }
}

/// Photos on the map, until others are opened.
pub struct PhotosState {
    /// Photos to be laid, and their map.
    pub sought: Option<Sought>,
    /// Search by which they are to be laid.
    pub search: PhotoSearch,
    /// Search by which they were laid last.
    pub searched: Option<PhotoSearch>,
    /// Result of each photo.
    pub reports: Vec<Option<PhotoReport>>,
    /// The one that is looked at.
    pub chosen: Option<usize>,
    /// Appearance of the chosen photo over the map.
    pub shown: PhotoAppearance,
    /// Computation under way: share done, and words.
    pub at_work: Option<(f32, String)>,
    /// Why it came to nothing.
    pub trouble: Option<String>,
    draped: Option<(usize, DrapedPhoto)>,
}

impl Default for PhotosState {
    fn default() -> Self {
        Self {
            sought: None,
            search: PhotoSearch::default(),
            searched: None,
            reports: Vec::new(),
            chosen: None,
            shown: PhotoAppearance::Squares,
            at_work: None,
            trouble: None,
            draped: None,
        }
    }
}

impl PhotosState {
    /// Takes others to be laid. What is known better of those before them does not count for them.
    pub fn seek(&mut self, sought: Sought) {
        self.forget();
        if self.sought.is_some() {
            self.search = limits(self.search);
        }
        self.reports = vec![None; sought.names.len()];
        self.sought = Some(sought);
    }

    /// Leaves them; how far is searched stays.
    pub fn leave(&mut self) {
        let search = limits(self.search);
        *self = Self {
            search,
            ..Self::default()
        };
    }

    /// Forgets what came of them.
    pub fn forget(&mut self) {
        self.reports.fill(None);
        (self.searched, self.chosen, self.trouble) = (None, None, None);
        (self.at_work, self.draped) = (None, None);
    }

    /// Begins to lay all of them; the order, if there are any.
    pub fn begin(&mut self) -> Option<PhotosOrder> {
        let sought = self.sought.clone().filter(|s| !s.names.is_empty())?;
        self.forget();
        self.searched = Some(self.search);
        self.at_work = Some((0.0, "Laying photos".to_owned()));
        Some(PhotosOrder {
            key: sought.key,
            names: sought.names,
            map: sought.map,
            origin: sought.origin,
            ground: sought.ground,
            search: self.search,
            rows: None,
        })
    }

    /// Takes what came of one.
    pub fn take(&mut self, report: PhotoReport) {
        if let Some(place) = self.reports.get_mut(report.number) {
            *place = Some(report);
        }
    }

    /// Place of photo `number`, if it was laid.
    pub fn laid(&self, number: usize) -> Option<&RegisteredPhoto> {
        let report = self.reports.get(number)?.as_ref()?;
        report.answer.laid.as_ref().ok()
    }

    /// Photos that were laid, and those of which it is known whether they were.
    pub fn counts(&self) -> (usize, usize) {
        let laid = (0..self.reports.len()).filter(|n| self.laid(*n).is_some());
        (laid.count(), self.reports.iter().flatten().count())
    }

    /// Mean time that one of them was looked for, seconds.
    pub fn mean_seconds(&self) -> Option<f64> {
        let reports = self.reports.iter().flatten();
        let times: Vec<f64> = reports.map(|r| r.computed).filter(|t| *t > 0.0).collect();
        (!times.is_empty()).then(|| 1e-3 * times.iter().sum::<f64>() / times.len() as f64)
    }

    /// Name of photo `number` without its folders.
    pub fn name(&self, number: usize) -> &str {
        let names = self.sought.as_ref().map_or(&[][..], |s| &s.names);
        let name = names.get(number).map_or("", String::as_str);
        name.rsplit('/').next().unwrap_or(name)
    }

    /// Number of the chosen photo and the order that shows it on the map, unless that is known already or it is not shown.
    pub fn drape_order(&self) -> Option<(usize, DrapeOrder)> {
        let number = self.chosen?;
        let is_known = self.draped.as_ref().is_some_and(|(of, _)| *of == number);
        if is_known || self.shown == PhotoAppearance::Outline {
            return None;
        }
        let sought = self.sought.as_ref()?;
        let order = DrapeOrder {
            key: sought.key.clone(),
            name: sought.names.get(number)?.clone(),
            search: self.searched?,
            laid: self.laid(number)?.clone(),
        };
        Some((number, order))
    }

    /// Takes the chosen photo as it lies on the map.
    pub fn drape(&mut self, number: usize, draped: &Draped, egui: &egui::Context) {
        self.draped = Some((number, DrapedPhoto::new(draped, egui)));
    }

    /// The chosen photo as it lies on the map, if that is there.
    pub fn draped(&self) -> Option<&DrapedPhoto> {
        let (number, draped) = self.draped.as_ref()?;
        (Some(*number) == self.chosen).then_some(draped)
    }

    /// Whether they were laid on another map than `map`.
    pub fn are_of_another_map(&self, map: &MapSource) -> bool {
        let laid = self.sought.as_ref().filter(|_| self.searched.is_some());
        laid.is_some_and(|sought| !is_same_map(&sought.map, map))
    }

    /// Whether they lie in the world around `origin`.
    pub fn lie_in(&self, origin: Option<Geodetic>) -> bool {
        self.sought.as_ref().is_some_and(|s| s.origin == origin)
    }
}
