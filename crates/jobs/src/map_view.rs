//! Maps described and shown.

use pilotage_core::imagery::Window;
use serde::{Deserialize, Serialize};

use super::order::{Order, Reads, Urgency, WorkerRole, keys_of};
use super::running::once;
use super::worker_state::describe;
use super::{JobEvent, MapSource, RunningJob, WorkerState};

/// Map to be described: event `MapInfo`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DescribeMapOrder(pub MapSource);

impl Order for DescribeMapOrder {
    const URGENCY: Urgency = Urgency::First;

    fn role(&self) -> WorkerRole {
        WorkerRole::Map
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.0))
    }

    fn is_small(&self) -> bool {
        self.0.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let map = worker.map(&self.0)?;
            let mut info = describe(map.as_ref());
            info.origin = self.0.origin();
            emit(JobEvent::MapInfo(info));
            Ok(())
        })
    }
}

/// Pixels of a map: event `Tile`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TileOrder {
    /// The map.
    pub map: MapSource,
    /// Part of the map, and its scale.
    pub window: Window,
}

impl Order for TileOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Map
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        Some((&self.map, Reads::Windows(vec![self.window])))
    }

    fn is_small(&self) -> bool {
        self.map.is_small()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| send_tile(worker, &self.map, self.window, emit))
    }
}

/// Pixels of a window of a map, and what went wrong with it.
fn send_tile(
    worker: &mut WorkerState,
    map: &MapSource,
    window: Window,
    emit: &mut dyn FnMut(JobEvent),
) -> Result<(), String> {
    let (pixels, whole) = worker.map(map)?.window_so_far(&window);
    emit(JobEvent::Tile {
        window,
        pixels,
        whole,
    });
    for problem in worker.new_problems(map) {
        emit(JobEvent::Remark(problem));
    }
    Ok(())
}
