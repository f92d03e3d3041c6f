//! Flights of studies opened by themselves, as any other flight.

use std::sync::Arc;

use pilotage_core::mission::Mission;

use super::flights::{KeptFrames, OpenFlight};
use super::{StudiedFlight, WorkerState};

/// Flies a flight of a study once more. Its mission is that of the scenario, with the navigator of the study.
pub fn open(worker: &mut WorkerState, studied: &StudiedFlight) -> Result<OpenFlight, String> {
    let scenario = worker.scenario(&studied.flight.settings.scenario)?;
    let prepared = studied.flight.prepare();
    let prepared = prepared.ok_or("the flight cannot begin")?;
    let mut flight = Arc::unwrap_or_clone(prepared.flight);
    for frame in &mut flight.frames {
        // There is no picture that it could name.
        frame.name.clear();
    }
    Ok(OpenFlight {
        utc_at_zero: None,
        frames: KeptFrames::stated(&flight, prepared.stated),
        flight: Arc::new(flight),
        mission: Some(Mission {
            navigator: prepared.settings,
            ..Mission::clone(&scenario)
        }),
    })
}
