//! The mission file: saved with what goes with it.

use super::App;
use crate::host::Host;
use pilotage_jobs::{Beside, FlightSource, Job, JobEvent, PackOrder};

impl App {
    /// Has the mission made into a file, with the pictures of its map.
    pub(super) fn save_mission(&mut self, host: &mut dyn Host) {
        let documents = &self.documents;
        let mut beside = Beside {
            simulation: documents.flight_source.simulation().cloned(),
            bookmarks: documents.bookmarks.clone(),
            ..Beside::default()
        };
        for feature in &self.views.features {
            feature.put_beside(&mut beside, documents);
        }
        let order = PackOrder {
            mission: documents.mission.clone(),
            beside,
            map: documents.map_source.clone(),
        };
        let name = format!("{}.pilotage.zip", self.file_stem());
        let id = host.start(Job::Pack(Box::new(order)));
        self.jobs.packing = Some((id, name));
    }

    /// Takes what the worker says of the mission file.
    pub(super) fn pack_event(&mut self, host: &mut dyn Host, event: JobEvent) {
        let Some((_, name)) = &self.jobs.packing else {
            return;
        };
        let now = host.now();
        match event {
            JobEvent::Packed { bytes, lacks } => {
                host.save_file(name, &bytes);
                match lacks {
                    Some(lacks) => {
                        let text = format!("{name} is saved. {lacks}");
                        let title = "The mission file has no map in it";
                        self.toasts.trouble(now, title, text);
                    }
                    None => self.toasts.note(now, "Mission saved", name.clone()),
                }
            }
            JobEvent::Failed(why) => {
                self.jobs.packing = None;
                self.toasts.trouble(now, "The mission was not saved", why);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.jobs.packing = None,
            _ => {}
        }
    }

    /// Opens what was open beside a mission when it was saved.
    pub(super) fn open_beside(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        beside: Option<Beside>,
    ) {
        let Some(mut beside) = beside else { return };
        for feature in &mut self.views.features {
            feature.take_beside(&mut beside);
        }
        if let Some(simulation) = beside.simulation {
            let flight = FlightSource::Simulated(simulation);
            if flight != self.documents.flight_source {
                let map = self.documents.map_source.clone();
                let mission = self.documents.mission.clone();
                self.fly_new(egui, host, flight, map, Some(mission));
            }
        }
        self.documents.bookmarks = beside.bookmarks;
    }
}
