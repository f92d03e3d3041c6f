//! The heights of an area, taken from an elevation model in the worker for use on the page.

use pilotage_core::frames::{GroundRect, LocalFrame};
use pilotage_core::imagery::terrain::{Dem, HeightGrid};
use pilotage_core::mission::{Mission, open_dem};

use super::order::{Order, Urgency, WorkerRole};
use super::running::SLICE;
use super::{Advance, HeightsOrder, JobEvent, RunningJob, WorkerState, opening};

/// Margin around the ground of interest in which heights are taken, metres.
const AROUND: f64 = 2_000.0;
/// Farthest from each other that ground of interest may lie, metres; of a larger map only the plan gets heights.
const REACH: f64 = 60_000.0;
/// Rows between two looks at the clock.
const ROWS: usize = 4;

impl HeightsOrder {
    /// Most posts along a side of what is taken.
    pub const MOST_POSTS: usize = 640;

    /// Ground whose heights are of interest: that of a map and of what is planned on it; `None` where both are missing or
    /// reach too far.
    pub fn of_interest(map: Option<GroundRect>, mission: &Mission) -> Option<GroundRect> {
        let near = |r: &GroundRect| r.width().max(r.height()) <= REACH;
        let map = map.filter(near);
        let plan = mission.planned_ground().filter(near);
        let area = match (map, plan) {
            (Some(a), Some(b)) => Some(a.union(&b)).filter(near).or(Some(b)),
            (a, b) => a.or(b),
        };
        area.map(|area| area.grown(AROUND))
    }
}

/// Heights being taken.
pub struct TakeHeights {
    order: HeightsOrder,
    under_way: Option<(Dem, HeightGrid)>,
}

impl TakeHeights {
    /// Nothing taken yet.
    pub fn new(order: HeightsOrder) -> Self {
        Self {
            order,
            under_way: None,
        }
    }

    fn begin(
        &self,
        worker: &WorkerState,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<(Dem, HeightGrid), String> {
        let files = worker.files(&self.order.key)?;
        let frame = Some(LocalFrame::new(self.order.origin));
        let dem = if let Some(name) = &self.order.file {
            let dem = open_dem(files.as_ref(), name, frame, None);
            let dem = dem.map_err(|cause| cause.to_string())?;
            // Of others they were told when the files were looked through.
            dem.notes()
                .into_iter()
                .for_each(|note| emit(JobEvent::Remark(note)));
            dem
        } else {
            let dem = opening::terrain(files.as_ref(), frame)?;
            dem.ok_or("there is no elevation model among the files")?
        };
        let grid = dem.grid(self.order.area, HeightsOrder::MOST_POSTS);
        Ok((dem, grid))
    }
}

impl RunningJob for TakeHeights {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        if self.under_way.is_none() {
            self.under_way = Some(self.begin(worker, emit)?);
        }
        let Some((dem, grid)) = &mut self.under_way else {
            return Ok(Advance::Done);
        };
        let begun = clock();
        while !grid.take_rows(dem, ROWS) {
            if clock() - begun > SLICE {
                let part = grid.rows_taken() as f32 / grid.rows() as f32;
                emit(JobEvent::Progress(part, "Reading heights".to_owned()));
                return Ok(Advance::More);
            }
        }
        if let Some(problem) = dem.problem() {
            return Err(format!(
                "{problem}. Ground that cannot be read may be too high: none of its heights are used"
            ));
        }
        emit(JobEvent::Heights(Box::new(grid.clone())));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for HeightsOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(TakeHeights::new(self))
    }
}
