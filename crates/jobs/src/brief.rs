//! The pictures of a mission brief, as a job.

use pilotage_core::imagery::Imagery;
use pilotage_core::raster::encode_jpeg;

use super::order::{Order, Reads, Urgency, WorkerRole, keys_of};
use super::{
    Advance, BriefOrder, BriefPictures, EncodedPicture, JobEvent, MapSource, RunningJob,
    WorkerState,
};

/// Quality of the pictures, 1 to 100.
const QUALITY: u8 = 85;

/// Pictures being made.
pub struct Brief {
    order: BriefOrder,
    done: Vec<EncodedPicture>,
}

impl Brief {
    /// Nothing made yet.
    pub fn new(order: BriefOrder) -> Self {
        let done = Vec::new();
        Self { order, done }
    }

    /// Makes the next picture; the first is the map. None is left if `None`.
    fn next(&mut self, map: &dyn Imagery) -> Result<Option<f32>, String> {
        let windows = self.order.windows();
        let Some(window) = windows.get(self.done.len()) else {
            return Ok(None);
        };
        let pixels = map.window(window);
        // Paper is white where the map has nothing.
        let opaque = |[r, g, b, a]: [u8; 4]| if a == 0 { [255; 3] } else { [r, g, b] };
        let bytes = encode_jpeg(&pixels.map(opaque), QUALITY).map_err(|e| e.to_string())?;
        self.done.push(EncodedPicture(bytes));
        Ok(Some(self.done.len() as f32 / windows.len() as f32))
    }
}

impl RunningJob for Brief {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        _clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let map = worker.map(&self.order.map)?;
        if let Some(fraction) = self.next(map.as_ref())? {
            emit(JobEvent::Progress(fraction, "Drawing the brief".to_owned()));
            return Ok(Advance::More);
        }
        let mut done = std::mem::take(&mut self.done).into_iter();
        let pictures = BriefPictures {
            map: done.next().unwrap_or_default(),
            thumbnails: done.collect(),
        };
        emit(JobEvent::BriefPictures(Box::new(pictures)));
        emit(JobEvent::Finished);
        Ok(Advance::Done)
    }
}

impl Order for BriefOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        keys_of(None, Some(&self.map))
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        Some((&self.map, Reads::Windows(self.windows())))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(Brief::new(self))
    }
}
