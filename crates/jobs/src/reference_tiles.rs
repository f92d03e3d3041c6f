//! Tiles of a map looked at for generic landmarks, beside others who look at the rest.

use std::ops::Range;

use pilotage_core::ground_class::CoverNetwork;
use pilotage_core::reference::seeing::ReferenceMapping;

use super::order::{Order, Urgency, WorkerRole, keys_of};
use super::running::slice;
use super::{Advance, JobEvent, MapSource, RunningJob, WorkerState};

/// Tiles of a map to be looked at: event `Figures` with their landmarks
/// (`Vec<`[`GenericLandmark`](pilotage_core::reference::GenericLandmark)`>`). Those of all tiles, one part after the other,
/// are those of the whole map.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceTilesOrder {
    /// The map.
    pub map: MapSource,
    /// Tiles, of [`ReferenceMapping::tiles`].
    pub tiles: Range<usize>,
}

/// The tiles under way.
struct SomeTiles {
    order: ReferenceTilesOrder,
    mapping: Option<ReferenceMapping>,
}

impl RunningJob for SomeTiles {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let mut mapping = match self.mapping.take() {
            Some(mapping) => mapping,
            None => ReferenceMapping::of(worker.map(&self.order.map)?, CoverNetwork::usual())
                .part(self.order.tiles.clone()),
        };
        if slice(clock, || mapping.advance()) {
            self.mapping = Some(mapping);
            return Ok(Advance::More);
        }
        emit(JobEvent::of_figures(&mapping.into_landmarks())?);
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for ReferenceTilesOrder {
    const URGENCY: Urgency = Urgency::Slow;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(SomeTiles {
            order: self,
            mapping: None,
        })
    }
}
