//! A map made into a table of generic landmarks, tile by tile.

use pilotage_core::ground_class::CoverNetwork;
use pilotage_core::reference::seeing::ReferenceMapping;
use serde::{Deserialize, Serialize};

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::running::slice;
use super::share::Shareable;
use super::{Advance, JobEvent, MapSource, RunningJob, Share, WorkerState};

/// Map to be made into a table: events `Progress`, and `Figures` with the bytes of the table
/// ([`pilotage_core::reference::ReferenceTable::from_bytes`]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReferenceMapOrder(pub MapSource);

/// The mapping under way.
struct MapIntoTable {
    map: MapSource,
    /// Share of the tiles that is looked at beside the others, if not all are.
    share: Option<Share>,
    mapping: Option<ReferenceMapping>,
}

impl RunningJob for MapIntoTable {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let mut mapping = if let Some(mapping) = self.mapping.take() {
            mapping
        } else {
            let whole = ReferenceMapping::of(worker.map(&self.map)?, CoverNetwork::usual());
            match self.share {
                Some(share) => whole.part(share.part, share.of),
                None => whole,
            }
        };
        let more = slice(clock, || mapping.advance());
        let (done, all) = mapping.progress();
        let share = done as f32 / all.max(1) as f32;
        emit(JobEvent::Progress(share, format!("{done} of {all} tiles")));
        if more {
            self.mapping = Some(mapping);
            return Ok(Advance::More);
        }
        emit(match self.share {
            Some(_) => JobEvent::of_figures(&mapping.into_landmarks())?,
            None => JobEvent::of_figures(&mapping.into_table().to_bytes())?,
        });
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
            share: None,
            mapping: None,
        })
    }
}

impl Shareable for ReferenceMapOrder {
    /// Its `Figures` are the landmarks of its tiles
    /// (`Vec<`[`GenericLandmark`](pilotage_core::reference::GenericLandmark)`>`): those of all shares, one after the other,
    /// are those of the whole map.
    fn begin_share(self, share: Share) -> Box<dyn RunningJob> {
        Box::new(MapIntoTable {
            map: self.0,
            share: Some(share),
            mapping: None,
        })
    }
}
