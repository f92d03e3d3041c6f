//! Field of the probability of a fix, as a job: the field streams in while it is computed.

use pilotage_core::plan::{FieldBuilder, FixSource, Localizability, OfferedField};

use super::order::{Order, Reads, Urgency, WorkerRole, keys_of};
use super::running::slice;
use super::{Advance, FieldFrom, FieldOrder, JobEvent, MapSource, RunningJob, WorkerState};

/// Cells along the longer side of the map at most.
const MOST_CELLS: f64 = 260.0;
/// Milliseconds between two looks at what is known so far.
const EVERY: f64 = 400.0;
/// Why nothing can be seen.
pub(super) const LOOKS_AWAY: &str = "the camera does not look down at the ground";

impl FieldOrder {
    /// Side of a cell, metres: a ninth of the picture, but no more cells than can be seen.
    pub fn step(&self) -> f64 {
        let longer = self.region.width().max(self.region.height());
        let across = self.view.across().unwrap_or(self.view.height);
        (across / 9.0).max(longer / MOST_CELLS)
    }

    /// A field of what the map offers, to be computed.
    pub(super) fn offered(
        &self,
        (search_sigmas, days): (f64, usize),
        worker: &mut WorkerState,
    ) -> Result<OfferedField, String> {
        let across = self.view.across().ok_or(LOOKS_AWAY)?;
        let days = worker.other_days(&self.map, days)?;
        let map = worker.cached_map(&self.map)?;
        Ok(OfferedField::new(
            map,
            days,
            self.view.clone(),
            &self.region,
            (across / 3.0, self.step()),
            search_sigmas,
        ))
    }

    /// A field of the landmarks at once.
    pub fn of_landmarks(&self, sources: Vec<FixSource>, step: f64) -> Localizability {
        let mut builder = FieldBuilder::new(self.view.clone(), &self.region, step, sources);
        while builder.advance() {}
        builder.into_field()
    }
}

enum FieldWork {
    Waiting,
    Landmarks(Box<FieldBuilder>),
    Map(Box<OfferedField>),
}

/// A field being computed.
pub struct ComputeField {
    order: FieldOrder,
    work: FieldWork,
    told: f64,
}

impl ComputeField {
    /// Nothing computed yet.
    pub fn new(order: FieldOrder) -> Self {
        Self {
            order,
            work: FieldWork::Waiting,
            told: 0.0,
        }
    }

    fn begin(&self, worker: &mut WorkerState) -> Result<FieldWork, String> {
        let order = &self.order;
        match &order.from {
            _ if order.view.across().is_none() => Err(LOOKS_AWAY.to_owned()),
            FieldFrom::Landmarks(sources) => Ok(FieldWork::Landmarks(Box::new(FieldBuilder::new(
                order.view.clone(),
                &order.region,
                order.step(),
                sources.clone(),
            )))),
            FieldFrom::Map {
                search_sigmas,
                days,
            } => {
                let offered = order.offered((*search_sigmas, *days), worker)?;
                Ok(FieldWork::Map(Box::new(offered)))
            }
        }
    }
}

impl RunningJob for ComputeField {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let more = match &mut self.work {
            FieldWork::Waiting => {
                let words = "Laying out the ground of other days".to_owned();
                emit(JobEvent::Progress(0.0, words));
                self.told = clock();
                self.work = self.begin(worker)?;
                return Ok(Advance::More);
            }
            FieldWork::Landmarks(builder) => slice(clock, || builder.advance()),
            FieldWork::Map(offered) => slice(clock, || offered.advance()),
        };
        let (done, of, what, field) = match &self.work {
            FieldWork::Landmarks(builder) => {
                let (done, of) = builder.progress();
                (done, of, "Row", builder.field())
            }
            FieldWork::Map(offered) => {
                let (done, of) = offered.progress();
                (done, of, "Place", offered.field())
            }
            FieldWork::Waiting => return Ok(Advance::More),
        };
        let share = done as f32 / of.max(1) as f32;
        emit(JobEvent::Progress(share, format!("{what} {done} of {of}")));
        if !more || clock() - self.told > EVERY {
            self.told = clock();
            emit(JobEvent::Field(Box::new(field.clone())));
        }
        if more {
            return Ok(Advance::More);
        }
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for FieldOrder {
    const URGENCY: Urgency = Urgency::Flight;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        let from_map = matches!(self.from, FieldFrom::Map { .. });
        let areas = from_map.then_some(self.region).into_iter().collect();
        Some((&self.map, Reads::Areas(areas)))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(ComputeField::new(self))
    }
}
