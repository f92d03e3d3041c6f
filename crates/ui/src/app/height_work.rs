//! Heights of the ground, taken from an elevation model where they are of interest.

use pilotage_jobs::{HeightsOrder, Job, JobEvent, JobId, TerrainInfo};

use crate::documents::{Documents, OpenedTerrain, TERRAIN_KEY};
use crate::host::Host;
use crate::job_owners::JobOwner;
use crate::shell::Toasts;

/// Heights being taken.
#[derive(Debug, Default)]
pub struct HeightWork(Option<JobId>);

impl HeightWork {
    /// Takes an event of its job; false if it waits for no such job, or nothing of that kind of it.
    pub fn take(
        &mut self,
        (id, event): (JobId, JobEvent),
        documents: &mut Documents,
        toasts: &mut Toasts,
        host: &dyn Host,
    ) -> bool {
        if self.0 != Some(id) {
            return false;
        }
        let now = host.now();
        match event {
            JobEvent::Heights(grid) => {
                if grid.extremes().is_none() {
                    let title = "The elevation model covers nothing of what is open";
                    let text = "Its area lies elsewhere. The heights are used as soon as a map or a \
                        plan there is open.";
                    toasts.note(now, title, text);
                }
                documents.map.terrain.take(*grid);
            }
            JobEvent::Failed(why) => {
                self.0 = None;
                toasts.trouble(now, "The heights cannot be read", why);
            }
            JobEvent::Finished | JobEvent::Cancelled => self.0 = None,
            // Nobody is shown how far it is.
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    /// Uses another elevation model.
    pub fn use_model(
        &mut self,
        key: &str,
        info: &TerrainInfo,
        documents: &mut Documents,
        toasts: &mut Toasts,
        host: &mut dyn Host,
    ) {
        if let Some(job) = self.0.take() {
            host.leave(job);
        }
        documents.map.terrain = OpenedTerrain::of_files(key);
        host.store(TERRAIN_KEY, key.as_bytes());
        let text = format!(
            "Posts {:.0} m apart, heights above {}.",
            info.spacing,
            info.datum.name()
        );
        toasts.note(host.now(), format!("Heights come from {}", info.name), text);
    }

    /// Asks for the heights of the ground that is of interest, where they are not at hand.
    pub fn ask(&mut self, documents: &mut Documents, host: &mut dyn Host) {
        let key = documents.map.terrain.key().map(str::to_owned);
        let (None, Some(key)) = (self.0, key) else {
            return;
        };
        let Some(origin) = documents.world_origin() else {
            return;
        };
        let map = documents.map.info.as_ref().map(|m| m.bounds);
        let Some(area) = HeightsOrder::of_interest(map, &documents.mission) else {
            return;
        };
        if documents.map.terrain.wants(origin, &area) {
            let order = HeightsOrder {
                key,
                origin,
                area,
                file: None,
            };
            self.0 = Some(host.start(JobOwner::Heights, Job::TakeHeights(Box::new(order))));
        }
    }
}
