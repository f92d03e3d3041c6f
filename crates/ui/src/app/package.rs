//! The mission file: saved with what goes with it.

use std::collections::BTreeMap;

use pilotage_core::flight::FLIGHT_FILE;
use pilotage_core::mission::package::{MissionPackage, write_package};

use super::App;
use super::desk::Opening;
use crate::host::Host;
use crate::jobs::{BESIDE, Beside, EncodedPicture, FlightSource, has_ending};

impl App {
    /// Offers the mission as a file, with the pictures of its map.
    pub(super) fn save_mission(&mut self, host: &mut dyn Host) {
        let now = host.now();
        let documents = &self.documents;
        let beside = Beside {
            simulation: match &documents.flight_source {
                FlightSource::Simulated(options) => Some(options.clone()),
                FlightSource::Files(_) | FlightSource::Nothing => None,
            },
            bookmarks: documents.bookmarks.clone(),
        };
        let beside = serde_json::to_string(&beside).unwrap_or_else(|_| "null".to_owned());
        let package = MissionPackage {
            mission: documents.mission.clone(),
            settings: BTreeMap::from([(BESIDE.to_owned(), beside)]),
            files: self.desk.map_files.clone(),
        };
        match write_package(&package) {
            Ok(bytes) => {
                let name = format!("{}.pilotage.zip", self.file_stem());
                host.save_file(&name, &bytes);
                let text = if self.map_is_missing() {
                    format!("{name}. The map's own files are not in it: keep them beside it.")
                } else {
                    name
                };
                self.toasts.note(now, "Mission saved", text);
            }
            Err(error) => {
                let title = "The mission was not saved";
                self.toasts.trouble(now, title, error.to_string());
            }
        }
    }

    /// Whether the map comes from files that a mission file would not have.
    fn map_is_missing(&self) -> bool {
        let from_files = matches!(self.documents.map_source, crate::jobs::MapSource::Files(_));
        from_files && self.desk.map_files.is_empty()
    }

    /// Keeps at hand what a mission file over this map needs: its pictures and what lies beside them.
    pub(super) fn remember_map_files(
        &mut self,
        opening: &Opening,
        packed: Vec<(String, EncodedPicture)>,
    ) {
        let is_flight = opening.files.iter().any(|f| f.path.ends_with(FLIGHT_FILE));
        let files = opening
            .files
            .iter()
            .filter(|f| !has_ending(&f.path, &["zip"]));
        let whole: Option<Vec<_>> = files
            .map(|f| {
                let name = f.path.rsplit('/').next().unwrap_or(&f.path);
                Some((name.to_owned(), f.content.bytes()?.to_vec()))
            })
            .collect();
        // Files too large to be held stay beside the mission.
        let files = whole.unwrap_or_default().into_iter();
        // A flight's own pictures are no part of a mission.
        let packed = packed.into_iter().map(|(name, picture)| (name, picture.0));
        self.desk.map_files = if is_flight {
            Vec::new()
        } else {
            files.chain(packed).collect()
        };
    }

    /// Opens what was open beside a mission when it was saved.
    pub(super) fn open_beside(&mut self, host: &mut dyn Host, beside: Option<Beside>) {
        let Some(beside) = beside else { return };
        if let Some(simulation) = beside.simulation {
            let flight = FlightSource::Simulated(simulation);
            if flight != self.documents.flight_source {
                let map = self.documents.map_source.clone();
                let mission = self.documents.mission.clone();
                self.fly_new(host, flight, map, Some(mission));
            }
        }
        self.documents.bookmarks = beside.bookmarks;
    }
}
