//! Flights of studies opened by themselves, as any other flight.

use std::sync::Arc;

use pilotage_core::mission::Mission;

use super::flights::{KeptFrames, OpenFlight};
use super::{StudiedFlight, WorkerState};

/// Flies a flight of a study once more. Its mission is that of the scenario or of the plan, with the
/// navigator of the study.
pub fn open(worker: &mut WorkerState, studied: &StudiedFlight) -> Result<OpenFlight, String> {
    let prepared = studied.flight.prepare();
    let prepared = prepared.ok_or("the flight cannot begin")?;
    let mut flight = Arc::unwrap_or_clone(prepared.flight);
    for frame in &mut flight.frames {
        // There is no picture that it could name.
        frame.name.clear();
    }
    let navigator = prepared.settings;
    let mission = match (&prepared.mission, studied.flight.of_scenario()) {
        (None, Some(scenario)) => Mission {
            navigator,
            ..Mission::clone(&*worker.scenario(scenario)?)
        },
        (Some(own), _) => own.mission(navigator),
        (None, None) => return Err("the flight has no mission".to_owned()),
    };
    Ok(OpenFlight {
        utc_at_zero: None,
        frames: KeptFrames::stated(&flight, prepared.stated),
        flight: Arc::new(flight),
        mission: Some(mission),
    })
}
