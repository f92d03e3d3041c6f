//! Flying and navigating, streamed.

use pilotage_core::mission::Mission;

use super::{Advance, FlightSource, JobEvent, MapSource, RunningJob, Workshop};

/// A flight under way.
pub struct Fly {
    _flight: FlightSource,
    map: MapSource,
    _mission: Option<Mission>,
}

impl Fly {
    /// A flight to be flown.
    pub fn new(flight: FlightSource, map: MapSource, mission: Option<Mission>) -> Self {
        Self {
            _flight: flight,
            map,
            _mission: mission,
        }
    }
}

impl RunningJob for Fly {
    fn advance(
        &mut self,
        workshop: &mut Workshop,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Advance {
        if let Err(cause) = workshop.map(&self.map) {
            emit(JobEvent::Failed(cause));
        }
        Advance::Done
    }
}
