//! A map made into a table of generic landmarks, tile by tile.

use pilotage_core::ground_class::CoverNetwork;
use pilotage_core::reference::seeing::ReferenceMapping;
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::running::slice;
use super::{Advance, JobEvent, MapSource, RunningJob, WorkerState};

/// Map to be made into a table: events `Progress`, and `Figures` with the bytes of the table
/// ([`pilotage_core::reference::ReferenceTable::from_bytes`]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceMapOrder(pub MapSource);

/// The mapping under way.
struct MapIntoTable {
    map: MapSource,
    mapping: Option<ReferenceMapping>,
}

impl RunningJob for MapIntoTable {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let mut mapping = match self.mapping.take() {
            Some(mapping) => mapping,
            None => ReferenceMapping::of(worker.map(&self.map)?, CoverNetwork::usual()),
        };
        let more = slice(clock, || mapping.advance());
        let (done, all) = mapping.progress();
        let share = done as f32 / all.max(1) as f32;
        emit(JobEvent::Progress(share, format!("{done} of {all} tiles")));
        if more {
            self.mapping = Some(mapping);
            return Ok(Advance::More);
        }
        emit(JobEvent::of_figures(&mapping.into_table().to_bytes())?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for ReferenceMapOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.0))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(MapIntoTable {
            map: self.0,
            mapping: None,
        })
    }
}
