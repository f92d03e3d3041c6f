//! Photos laid on the map that is open.

use pilotage_core::flight::Flight;
use pilotage_core::flight::log::LogFormat;
use pilotage_core::frames::{GroundPoint, GroundRect, LocalFrame};
use pilotage_core::registration::Draped;

use super::{App, SideTab};
use crate::command::Workspace;
use crate::documents::with_origin;
use crate::host::Host;
use crate::photos::{PhotosCommand, Sought};
use pilotage_jobs::{FlightSource, Job, JobEvent, JobId, MapInfo, MapSource};

/// Longest side of the ground all over which photos without a place are searched, metres; of larger maps it is what is
/// shown of them.
const LARGEST_SEARCHED: f64 = 1_500.0;
/// Share of its outline that is shown around a photo.
const AROUND: f64 = 0.2;
/// Largest distance from the map at which a flight of photos that is laid on it may begin, metres.
const BESIDE: f64 = 100.0;

impl App {
    /// Does what was asked about photos on the map.
    pub(super) fn photos(&mut self, command: PhotosCommand, host: &mut dyn Host) {
        match command {
            PhotosCommand::Show => {
                self.show_photos();
                self.seek_photos_of_flight();
            }
            PhotosCommand::Close if self.documents.log.is_some() => {
                self.side_tab = SideTab::Feature(crate::log::ID);
            }
            PhotosCommand::Close => self.side_tab = self.views.usual_tab(),
            PhotosCommand::Lay => {
                self.seek_on_open_map();
                self.lay_photos(host);
            }
            PhotosCommand::Stop => {
                self.stop_laying(host);
            }
            PhotosCommand::Search(search) => self.documents.photos.search = *search,
            PhotosCommand::AroundView => {
                let origin = self.documents.world_origin();
                let center = self.views.map.camera.center;
                let place = origin.map(|o| LocalFrame::new(o).geodetic_from_ground(&center));
                self.documents.photos.search.at = place;
            }
            PhotosCommand::Choose(number) => self.choose_photo(host, number),
            PhotosCommand::Display(shown) => {
                self.documents.photos.shown = shown;
                self.drape_photo(host);
            }
        }
    }

    fn show_photos(&mut self) {
        self.view.workspace = Workspace::Replay;
        self.view.side_open = true;
        self.dialogs.settings = false;
        self.side_tab = SideTab::Photos;
        self.playback.playing = false;
    }

    /// Whether the sheet of photos is what people look at.
    pub(super) fn shows_photos(&self) -> bool {
        self.side_tab == SideTab::Photos && self.view.workspace == Workspace::Replay
    }

    /// The photos of the flight that is open, if nothing else is to be laid and it is one of photos.
    fn seek_photos_of_flight(&mut self) {
        let documents = &self.documents;
        let format = documents.log.as_ref().and_then(|log| log.format);
        let is_of_photos = format == Some(LogFormat::Photos);
        let (FlightSource::Files(key), Some(flight)) =
            (&documents.flight_source, &documents.flight)
        else {
            return;
        };
        let is_wanted = is_of_photos && documents.has_real_map();
        if !is_wanted || documents.photos.sought.is_some() {
            return;
        }
        let names = flight.frames.iter().map(|frame| frame.name.clone());
        let (key, names) = (key.clone(), names.collect());
        let map = documents.map_source.clone();
        if let Some(ground) = self.ground_searched(documents.map.as_ref()) {
            let origin = documents.world_origin();
            self.documents.photos.seek(Sought {
                key,
                names,
                map,
                origin,
                ground,
            });
        }
    }

    /// Has the photos sought on the map that is open now: another one may have been opened since.
    fn seek_on_open_map(&mut self) {
        let documents = &self.documents;
        let map = documents.map.as_ref().filter(|_| documents.has_real_map());
        let ground = self.ground_searched(map);
        let (map, origin) = (documents.map_source.clone(), documents.world_origin());
        if let (Some(ground), Some(sought)) = (ground, &mut self.documents.photos.sought) {
            (sought.map, sought.origin, sought.ground) = (map, origin, ground);
        }
    }

    /// Ground over which photos of which no place is known are searched.
    fn ground_searched(&self, map: Option<&MapInfo>) -> Option<GroundRect> {
        let bounds = map?.bounds;
        if bounds.width().max(bounds.height()) <= LARGEST_SEARCHED {
            return Some(bounds);
        }
        let (rect, view) = (self.views.map.rect()?, self.views.map.screen_from_world()?);
        let seen = view.visible(rect);
        let middle = seen.center();
        let largest = GroundRect::centered(middle, LARGEST_SEARCHED, LARGEST_SEARCHED);
        let part = [seen, bounds]
            .into_iter()
            .fold(largest, |part, other| GroundRect {
                north: part.north.min(other.north),
                south: part.south.max(other.south),
                west: part.west.max(other.west),
                east: part.east.min(other.east),
            });
        (part.north > part.south && part.east > part.west).then_some(part)
    }

    /// Photos were opened over the map that is open: they are laid on it.
    pub(super) fn take_photos(&mut self, host: &mut dyn Host, key: String, names: Vec<String>) {
        let documents = &self.documents;
        let map = documents.map.as_ref();
        let ground = self.ground_searched(map.filter(|_| documents.has_real_map()));
        let (Some(ground), Some(origin)) = (ground, documents.world_origin()) else {
            let name = names.first().map_or("", String::as_str);
            let title = "There is no map to lay the pictures on";
            let text = format!(
                "{name} does not say where it lies. Open a georeferenced map of its ground first, or drop it \
                 together with its world file (.jgw, .pgw, .wld) or a georeference in JSON."
            );
            self.toasts.trouble(host.now(), title, text);
            return;
        };
        let sought = Sought {
            key,
            names,
            map: documents.map_source.clone(),
            origin: Some(origin),
            ground,
        };
        self.stop_laying(host);
        self.documents.photos.seek(sought);
        self.show_photos();
        self.lay_photos(host);
    }

    /// A flight of photos was opened over `map`: they are laid on it, if it shows where they begin. What is known of
    /// that map is `info`, in the world of the flight if it came with it.
    pub(super) fn take_photo_flight(
        &mut self,
        host: &mut dyn Host,
        key: String,
        names: Vec<String>,
        flight: &Flight,
        map: MapSource,
        info: Option<&MapInfo>,
    ) {
        let Some(world) = flight.frame_on_globe.filter(|_| map != MapSource::Nothing) else {
            return;
        };
        let (bounds, of_map) = match (info, &self.documents.map) {
            (Some(info), _) => (info.bounds, Some(world)),
            (None, Some(open)) => {
                let origin = self.documents.map_source.origin().or(open.origin);
                (open.bounds, origin.map(LocalFrame::new))
            }
            (None, None) => return,
        };
        let Some(of_map) = of_map else { return };
        let moved = |place: GroundPoint, from: &LocalFrame, to: &LocalFrame| {
            to.ground_from_geodetic(&from.geodetic_from_ground(&place))
        };
        let start = moved(flight.start.position, &world, &of_map);
        if !bounds.grown(BESIDE).contains(&start) {
            return;
        }
        let corners = [
            GroundPoint::new(bounds.south, bounds.west),
            GroundPoint::new(bounds.north, bounds.east),
        ];
        let ground = GroundRect::around(corners.map(|corner| moved(corner, &of_map, &world)));
        let Some(ground) = ground else { return };
        self.stop_laying(host);
        self.documents.photos.seek(Sought {
            key,
            names,
            map: with_origin(map, Some(world)),
            origin: Some(world.origin),
            ground,
        });
        self.show_photos();
        self.lay_photos(host);
    }

    fn lay_photos(&mut self, host: &mut dyn Host) {
        self.stop_laying(host);
        if let Some(order) = self.documents.photos.begin() {
            self.jobs.laying = Some(host.start(Job::LayPhotos(Box::new(order))));
        }
    }

    fn choose_photo(&mut self, host: &mut dyn Host, number: usize) {
        self.documents.photos.chosen = Some(number);
        self.fit_to_photo();
        self.drape_photo(host);
    }

    /// Shows the ground of the chosen photo, while photos are looked at; whether it lies anywhere.
    pub(super) fn fit_to_photo(&mut self) -> bool {
        let photos = &self.documents.photos;
        let chosen = photos.chosen.filter(|_| self.shows_photos());
        let laid = chosen.and_then(|number| photos.laid(number));
        let ground = laid.and_then(|laid| GroundRect::around(laid.outline.iter().copied()));
        let Some(ground) = ground else { return false };
        let longer = ground.width().max(ground.height());
        self.views.map.fit(ground.grown(AROUND * longer));
        true
    }

    /// Has the chosen photo shown on the map, if it is not yet.
    fn drape_photo(&mut self, host: &mut dyn Host) {
        let Some(order) = self.documents.photos.drape_order() else {
            return;
        };
        if let Some((job, _)) = self.jobs.draping.take() {
            host.cancel(job);
        }
        let number = self.documents.photos.chosen.unwrap_or_default();
        let job = host.start(Job::DrapePhoto(Box::new(order)));
        self.jobs.draping = Some((job, number));
    }

    /// Stops laying photos; whether some were being laid. Those that were laid stay.
    pub(super) fn stop_laying(&mut self, host: &mut dyn Host) -> bool {
        let job = self.jobs.laying.take();
        if let Some(job) = job {
            host.cancel(job);
            self.documents.photos.at_work = None;
        }
        job.is_some()
    }

    /// Takes what a worker says of photos; whether `id` was about them.
    pub(super) fn photos_event(
        &mut self,
        host: &mut dyn Host,
        id: JobId,
        event: &JobEvent,
    ) -> bool {
        if let Some((_, number)) = self.jobs.draping.filter(|(job, _)| *job == id) {
            match event {
                JobEvent::PhotoDraped(draped) => {
                    self.documents.photos.drape(number, Draped::clone(draped));
                }
                JobEvent::Failed(why) => {
                    let title = "The photo cannot be shown on the map";
                    self.toasts.trouble(host.now(), title, why.clone());
                }
                _ => {}
            }
            if event.is_last() {
                self.jobs.draping = None;
            }
            return true;
        }
        if self.jobs.laying != Some(id) {
            return false;
        }
        let photos = &mut self.documents.photos;
        match event {
            JobEvent::Progress(share, words) => photos.at_work = Some((*share, words.clone())),
            JobEvent::PhotoRegistered(report) => {
                let number = report.number;
                photos.take((**report).clone());
                if photos.chosen.is_none() && photos.laid(number).is_some() {
                    self.choose_photo(host, number);
                }
            }
            JobEvent::Failed(why) => photos.trouble = Some(why.clone()),
            _ => {}
        }
        if event.is_last() {
            self.documents.photos.at_work = None;
            self.jobs.laying = None;
        }
        true
    }
}
