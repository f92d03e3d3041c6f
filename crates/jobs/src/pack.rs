//! The mission file with the files of its map, as a job: the workers have them.

use std::collections::BTreeMap;

use pilotage_core::flight::files::folder_of;
use pilotage_core::imagery::Georeference;
use pilotage_core::mission::package::{MissionPackage, write_package};
use pilotage_core::mission::{MapOptions, belongs_to, place_files};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::running::once;
use super::{BESIDE, JobEvent, MapSource, PackOrder, RunningJob, WorkerState, opening};

/// Most bytes of a map that a mission file takes with it: the page holds them more than once while
/// it saves.
const MOST_PACKED: u64 = 64 << 20;

/// Files by name, or why they cannot go with the mission and where to have them.
type Files = Result<Vec<(String, Vec<u8>)>, String>;

/// The mission file, and what of its map is not in it.
pub fn pack(worker: &WorkerState, order: &PackOrder) -> Result<(Vec<u8>, Option<String>), String> {
    let files = map_files(worker, &order.map);
    let lacks = files.as_ref().err().cloned();
    let beside = serde_json::to_string(&order.beside).map_err(|e| e.to_string())?;
    let package = MissionPackage {
        mission: order.mission.clone(),
        settings: BTreeMap::from([(BESIDE.to_owned(), beside)]),
        files: files.unwrap_or_default(),
    };
    let bytes = write_package(&package).map_err(|e| e.to_string())?;
    Ok((bytes, lacks))
}

/// The files that a map is made from: its own and what belongs beside it.
fn map_files(worker: &WorkerState, map: &MapSource) -> Files {
    let (key, stated) = match map {
        MapSource::World(_) | MapSource::Nothing => return Ok(Vec::new()),
        MapSource::Web(web) => {
            let name = &web.template.name;
            return Err(format!(
                "Its map comes from {name}: open that again over it."
            ));
        }
        MapSource::Picture {
            key, name, place, ..
        } => (key, Some((name.clone(), *place))),
        MapSource::Files(key) | MapSource::Placed { key, .. } => (key, None),
    };
    let lost = |why: String| format!("Its map cannot be read ({why}).");
    let pool = worker.files(key).map_err(lost)?;
    let (name, place): (String, Option<Georeference>) = if let Some((name, place)) = stated {
        (name, Some(place))
    } else {
        let open = opening::map(pool.as_ref(), &MapOptions::default()).map_err(lost)?;
        let open = open.ok_or_else(|| lost("there is none among the files".to_owned()))?;
        (open.0, None)
    };
    let mut names = pool.names();
    names.retain(|other| {
        let beside = place.is_none() && belongs_to(other, &name);
        folder_of(other) == folder_of(&name) && (*other == name || beside)
    });
    let mut files = Vec::new();
    let mut room = MOST_PACKED;
    for path in names {
        let own = path.rsplit('/').next().unwrap_or_default().to_owned();
        let length = pool.source(&path).map_or(0, |source| source.length());
        let Some(rest) = room.checked_sub(length) else {
            let megabytes = length >> 20;
            return Err(format!(
                "{own} has {megabytes} MB, too many to go with it: keep it beside the mission and \
                 open both together."
            ));
        };
        room = rest;
        let bytes = pool.read(&path);
        let bytes = bytes.ok_or_else(|| lost(format!("{path} is not here any more")))?;
        files.push((own, bytes));
    }
    let own = name.rsplit('/').next().unwrap_or_default();
    files.extend(place.iter().flat_map(|place| place_files(own, place)));
    Ok(files)
}

impl Order for PackOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let (bytes, lacks) = pack(worker, &self)?;
            emit(JobEvent::Packed { bytes, lacks });
            Ok(())
        })
    }
}

#[cfg(test)]
#[path = "pack_tests.rs"]
mod tests;
