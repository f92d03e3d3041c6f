//! A camera put in time and place beside its log, in a worker.

use pilotage_core::calibration::CameraSearch;

use super::order::{Order, Urgency, WorkerRole};
use super::running::slice;
use super::{Advance, CalibrationOrder, JobEvent, RunningJob, WorkerState};

/// An estimate under way: events `Progress`, at the end `CameraCalibrated`.
pub struct Calibrate {
    order: CalibrationOrder,
    search: Option<CameraSearch>,
}

impl Calibrate {
    /// Nothing done yet.
    pub fn new(order: CalibrationOrder) -> Self {
        Self {
            order,
            search: None,
        }
    }
}

impl RunningJob for Calibrate {
    fn advance(
        &mut self,
        _worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let CalibrationOrder { evidence, believed } = &self.order;
        let search = match &mut self.search {
            Some(search) => search,
            empty => {
                let search = CameraSearch::new(evidence, believed);
                empty.insert(search.map_err(|cause| cause.to_string())?)
            }
        };
        let more = slice(clock, || search.advance(evidence));
        let words = "Trying time offsets".to_owned();
        emit(JobEvent::Progress(search.progress() as f32, words));
        if more {
            return Ok(Advance::More);
        }
        let found = search.finish(evidence);
        let found = found.map_err(|cause| cause.to_string())?;
        emit(JobEvent::CameraCalibrated(Box::new(found)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for CalibrationOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Calibrate::new(self))
    }
}
