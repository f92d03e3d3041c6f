//! Photos laid on a map one after the other, in a worker.

use std::sync::Arc;

use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::photo::{PhotoAnswer, PhotoLook, PhotoSearch};
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::imagery::{Blank, Imagery};
use pilotage_core::registration::{Draped, drape};

use super::order::{Order, Reads, Urgency, WorkerRole};
use super::photo_picture::decode_photo;
use super::running::once;
use super::{
    Advance, DrapeOrder, JobEvent, MapSource, PhotoReport, PhotosOrder, RunningJob, WorkerState,
};

/// Pixels along the longer side of a photo that is shown on the map.
const SHOWN: usize = 900;

/// Photos being laid: events `Progress` and `PhotoRegistered`.
struct LayPhotos {
    order: PhotosOrder,
    map: Option<Arc<dyn Imagery>>,
    /// Number of the next photo.
    next: usize,
    /// That photo, once it is read.
    read: Option<PhotoLook>,
}

impl LayPhotos {
    /// Nothing done yet.
    fn new(order: PhotosOrder) -> Self {
        Self {
            order,
            map: None,
            next: 0,
            read: None,
        }
    }

    fn tell(
        &mut self,
        answer: PhotoAnswer,
        computed: f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Advance {
        let number = self.next;
        emit(JobEvent::PhotoRegistered(Box::new(PhotoReport {
            number,
            answer,
            computed,
        })));
        self.next += 1;
        if self.next < self.order.names.len() {
            return Advance::More;
        }
        emit(JobEvent::Finished);
        Advance::Done
    }
}

impl RunningJob for LayPhotos {
    fn advance(
        &mut self,
        worker: &mut WorkerState,
        clock: &dyn Fn() -> f64,
        emit: &mut dyn FnMut(JobEvent),
    ) -> Result<Advance, String> {
        let order = &self.order;
        let Some(name) = order.names.get(self.next) else {
            emit(JobEvent::Finished);
            return Ok(Advance::Done);
        };
        let map = match &self.map {
            Some(map) => Arc::clone(map),
            None => worker.cached_map(&order.map)?,
        };
        self.map = Some(Arc::clone(&map));
        if let Some(photo) = self.read.take() {
            let begun = clock();
            let answer = photo.lay(map.as_ref());
            return Ok(self.tell(answer, clock() - begun, emit));
        }
        let count = order.names.len();
        let share = self.next as f32 / count as f32;
        let words = format!("Laying photo {} of {count}", self.next + 1);
        emit(JobEvent::Progress(share, words));
        let files = worker.files(&order.key)?;
        let world = order.origin.map(LocalFrame::new);
        let source = files.source(name);
        let read = source
            .ok_or_else(|| format!("{name}: it is gone"))
            .and_then(|source| {
                PhotoLook::read(
                    source.as_ref(),
                    decode_photo,
                    &order.search,
                    world.as_ref(),
                    &order.ground,
                )
            });
        match read {
            Ok(photo) => {
                self.read = Some(photo);
                Ok(Advance::More)
            }
            Err(why) => {
                let answer = PhotoAnswer {
                    assumed: Vec::new(),
                    probability: 0.0,
                    laid: Err(why),
                };
                Ok(self.tell(answer, 0.0, emit))
            }
        }
    }
}

/// A laid photo on the map in its own colours.
pub fn draped(files: &dyn FileSet, order: &DrapeOrder) -> Result<Draped, String> {
    let name = &order.name;
    let source = files.source(name);
    let source = source.ok_or_else(|| format!("{name}: it is gone"))?;
    let nowhere = GroundRect::centered(GroundPoint::default(), 1.0, 1.0);
    // It was laid: where it was looked for does not matter any more.
    let search = PhotoSearch {
        at: None,
        ..order.search
    };
    let photo = PhotoLook::read(source.as_ref(), decode_photo, &search, None, &nowhere)?;
    let laid = &order.laid;
    let look = photo.over(&Blank);
    let draped = drape(&look, &laid.at, laid.stored_turn, &photo.picture, SHOWN);
    draped.ok_or_else(|| format!("{name}: it shows the horizon"))
}

impl Order for PhotosOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        let map = self.map.key();
        std::iter::once(self.key.as_str()).chain(map).collect()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        Some((&self.map, Reads::Areas(vec![self.ground])))
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        Box::new(LayPhotos::new(self))
    }
}

impl Order for DrapeOrder {
    const URGENCY: Urgency = Urgency::Asked;

    fn role(&self) -> WorkerRole {
        WorkerRole::Questions
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| {
            let files = worker.files(&self.key)?;
            emit(JobEvent::PhotoDraped(Box::new(draped(
                files.as_ref(),
                &self,
            )?)));
            Ok(())
        })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::photo::PhotoSearch;
    use pilotage_core::frames::{GroundPoint, GroundRect};

    use crate::{DescribeMapOrder, FlightSource, FlyOrder, Job, MapSource, PhotosOrder};

    #[test]
    fn photos_being_laid_keep_neither_their_flight_nor_the_map_waiting() {
        let lay = Job::LayPhotos(Box::new(PhotosOrder {
            key: "drop".to_owned(),
            names: vec!["a.jpg".to_owned()],
            map: MapSource::Files("map".to_owned()),
            origin: None,
            ground: GroundRect::centered(GroundPoint::default(), 100.0, 100.0),
            search: PhotoSearch::default(),
        }));
        let fly = Job::Fly(FlyOrder {
            flight: FlightSource::Files("drop".to_owned()),
            map: MapSource::Files("map".to_owned()),
            mission: None,
        });
        let describe = Job::DescribeMap(DescribeMapOrder(MapSource::Files("map".to_owned())));
        assert_ne!(lay.role(), fly.role());
        assert_ne!(lay.role(), describe.role());
        assert_eq!(lay.files(), ["drop", "map"]);
    }
}
