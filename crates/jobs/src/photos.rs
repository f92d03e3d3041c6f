//! Photos laid on a map one after the other, in a worker.

use std::sync::Arc;

use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::photo::{PhotoAnswer, PhotoLook, PhotoRows, PhotoSearch};
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::imagery::{Blank, Imagery};
use pilotage_core::registration::{Draped, drape};

use super::order::{Order, Reads, Urgency, WorkerRole};
use super::photo_picture::decode_photo;
use super::photo_places::places_of_photos;
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
    /// Places of photos in tables beside them, once they are known.
    rows: Option<PhotoRows>,
}

impl LayPhotos {
    /// Nothing done yet.
    fn new(mut order: PhotosOrder) -> Self {
        Self {
            rows: order.rows.take(),
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
        let rows = (self.rows).get_or_insert_with(|| places_of_photos(files.as_ref()).rows);
        let source = files.source(name);
        let read = source
            .ok_or_else(|| format!("{name}: it is gone"))
            .and_then(|source| {
                PhotoLook::read(
                    source.as_ref(),
                    decode_photo,
                    rows.0.get(name),
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

/// A photo among files, read for what it shows: its place does not count, and with that not the ground around.
pub(super) fn look_anywhere(
    files: &dyn FileSet,
    name: &str,
    search: &PhotoSearch,
) -> Result<PhotoLook, String> {
    let source = files.source(name);
    let source = source.ok_or_else(|| format!("{name}: it is gone"))?;
    let nowhere = GroundRect::centered(GroundPoint::default(), 1.0, 1.0);
    let search = PhotoSearch {
        at: None,
        ..*search
    };
    PhotoLook::read(source.as_ref(), decode_photo, None, &search, None, &nowhere)
}

/// A laid photo on the map in its own colours.
pub fn draped(files: &dyn FileSet, order: &DrapeOrder) -> Result<Draped, String> {
    let name = &order.name;
    // It was laid: where it was looked for does not matter any more.
    let photo = look_anywhere(files, name, &order.search)?;
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
    use pilotage_core::flight::photo::{PhotoAnswer, PhotoSearch};
    use pilotage_core::frames::{Geodetic, GroundPoint, GroundRect, LocalFrame};
    use pilotage_core::raster::{Picture, encode_png};

    use crate::{
        DescribeMapOrder, FlightSource, FlyOrder, InlineWorkers, Job, JobEvent, MapSource,
        PhotosOrder, ProvideOrder,
    };

    #[test]
    fn photos_being_laid_keep_neither_their_flight_nor_the_map_waiting() {
        let lay = Job::LayPhotos(Box::new(PhotosOrder {
            key: "drop".to_owned(),
            names: vec!["a.jpg".to_owned()],
            map: MapSource::Files("map".to_owned()),
            origin: None,
            ground: GroundRect::centered(GroundPoint::default(), 100.0, 100.0),
            search: PhotoSearch::default(),
            rows: None,
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

    /// Grey blocks of six pixels, no two areas alike.
    fn ground(x: usize, y: usize) -> [u8; 3] {
        let block = (x / 6 * 7919 + y / 6 * 104_729) as u64;
        let mixed = (block ^ (block >> 7)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        [(mixed >> 56) as u8; 3]
    }

    /// The answer for a photo that says nothing, over a map of half a metre a pixel, beside a table that places it at so many
    /// metres south and east of the map's corner.
    fn laid_by_table(south: f64, east: f64) -> PhotoAnswer {
        let seen = |left: usize, top: usize| move |x: usize, y: usize| ground(left + x, top + y);
        let map = encode_png(&Picture::from_fn(400, 300, seen(0, 0))).expect("a map");
        let photo = encode_png(&Picture::from_fn(160, 120, seen(60, 60))).expect("a photo");
        let origin = Geodetic::from_degrees(47.0, 8.0, 0.0);
        let corner = LocalFrame::new(origin);
        let place = corner.geodetic_from_ground(&GroundPoint::new(-south, east));
        let (latitude, longitude) = (place.latitude.to_degrees(), place.longitude.to_degrees());
        let table = format!("EPSG:4326\nP.png {longitude:.9} {latitude:.9} 520\n");
        let files = vec![
            ("P.png".to_owned(), photo.into()),
            ("geo.txt".to_owned(), table.into_bytes().into()),
            ("map.png".to_owned(), map.into()),
            (
                "map.pgw".to_owned(),
                b"0.5\n0\n0\n-0.5\n0.25\n-0.25\n".to_vec().into(),
            ),
        ];
        let key = "drop".to_owned();
        let mut workers = InlineWorkers::new();
        workers.start(Job::Provide(ProvideOrder {
            key: key.clone(),
            files,
        }));
        workers.start(Job::LayPhotos(Box::new(PhotosOrder {
            map: MapSource::Files(key.clone()),
            key,
            names: vec!["P.png".to_owned()],
            origin: Some(origin),
            ground: GroundRect::centered(GroundPoint::new(-75.0, 100.0), 200.0, 150.0),
            search: PhotoSearch {
                within: 8.0,
                height: Some(150.0),
                heading: Some(0.0),
                focal: Some(300.0),
                ..PhotoSearch::default()
            },
            rows: None,
        })));
        let mut answer = None;
        while workers.busy() {
            for (_, event) in workers.events() {
                match event {
                    JobEvent::PhotoRegistered(report) => answer = Some(report.answer),
                    JobEvent::Failed(why) => panic!("{why}"),
                    _ => {}
                }
            }
        }
        answer.expect("an answer")
    }

    #[test]
    fn a_photo_that_says_nothing_is_looked_for_where_the_table_beside_it_says() {
        let right = laid_by_table(63.0, 67.0);
        let assumed = right.assumed.join("; ");
        assert!(assumed.contains("as the table beside it says"), "{assumed}");
        let laid = right.laid.expect("it is laid");
        let off = (laid.centre.north + 60.0).hypot(laid.centre.east - 70.0);
        assert!(off < 1.0, "{:?}", laid.centre);
        let wrong = laid_by_table(100.0, 130.0);
        assert!(wrong.laid.is_err(), "{wrong:?}");
    }
}
