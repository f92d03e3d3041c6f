//! A picture put on the ground: its jobs, its files, and what becomes of it.

use super::App;
use super::work::TILES_AT_A_TIME;
use crate::documents::kept::provide;
use crate::feature::OpenedSet;
use crate::georeference::{GeoreferenceCommand, Georeferencer, NamedPlace};
use crate::host::{Host, OpenedFile};
use pilotage_jobs::{
    DescribeMapOrder, FileContent, Job, JobEvent, JobId, ReadPlacesOrder, TileOrder, Unplaced,
};

/// Endings of files with named places.
const PLACES: [&str; 7] = ["kml", "kmz", "gpx", "geojson", "csv", "plan", "waypoints"];

/// Side of the largest map that is shown whole beside a picture, metres.
const LARGEST_SHOWN: f64 = 20_000.0;

fn has_ending(path: &str, endings: &[&str]) -> bool {
    let ending = path.rsplit('.').next().unwrap_or_default();
    endings.iter().any(|e| ending.eq_ignore_ascii_case(e))
}

impl App {
    /// Opens a picture that does not say where it lies in the georeferencer.
    pub(super) fn begin_georeferencing(
        &mut self,
        host: &mut dyn Host,
        opening: &OpenedSet,
        unplaced: Unplaced,
    ) {
        self.stop_georeferencing(host);
        let origin = self.documents.world_origin();
        let mut georeferencer = Georeferencer::new(&opening.key, &unplaced.name, origin);
        let map = georeferencer.bare();
        self.jobs.describe_picture = Some(host.start(Job::DescribeMap(DescribeMapOrder(map))));
        self.jobs.picture_files = Some((opening.name.clone(), opening.files.clone()));
        let now = host.now();
        if let Some((file, text)) = unplaced.points {
            match georeferencer.load(&text) {
                Ok(count) => {
                    let title = format!("Read {count} points from {file}");
                    self.toasts.note(now, title, String::new());
                }
                Err(why) => {
                    let title = format!("{file} was not read");
                    self.toasts.trouble(now, title, format!("{file}: {why}."));
                }
            }
        } else {
            let text = "Click places that you know in the picture and on the map. Its world file \
                beside it would do as well.";
            let title = format!("{} does not say where it lies", unplaced.name);
            self.toasts.note(now, title, text);
        }
        self.views.georeferencer = Some(georeferencer);
        self.playback.playing = false;
        let map = self.documents.map.as_ref().map(|m| m.bounds);
        if let Some(ground) = map.filter(|r| r.width().max(r.height()) < LARGEST_SHOWN) {
            self.views.map.fit(ground);
        }
        self.show_points();
    }

    /// Shows all points on the map.
    fn show_points(&mut self) {
        let ground = self
            .views
            .georeferencer
            .as_ref()
            .and_then(Georeferencer::ground);
        if let Some(ground) = ground {
            self.views.map.fit(ground);
        }
        self.views.map.follow = false;
    }

    fn stop_georeferencing(&mut self, host: &mut dyn Host) {
        let tiles = self.jobs.picture_tiles.drain().map(|(id, _)| id);
        let others = [self.jobs.describe_picture.take(), self.jobs.places.take()];
        for id in tiles.chain(others.into_iter().flatten()) {
            host.cancel(id);
        }
        self.views.georeferencer = None;
    }

    /// Takes files for the georeferencer, if that is what they are for.
    pub(super) fn open_for_georeferencer(
        &mut self,
        host: &mut dyn Host,
        batch: &[OpenedFile],
    ) -> bool {
        let Some(georeferencer) = &mut self.views.georeferencer else {
            return false;
        };
        let now = host.now();
        if let [file] = batch
            && has_ending(&file.path, &["points"])
            && let FileContent::Bytes(bytes) = &file.content
        {
            match georeferencer.load(&String::from_utf8_lossy(bytes)) {
                Ok(count) => {
                    let title = format!("Read {count} points from {}", file.path);
                    self.toasts
                        .note(now, title, "Undo brings the points before back.");
                    self.show_points();
                }
                Err(why) => {
                    let title = format!("{} was not read", file.path);
                    let text = format!("{}: {why}. The points stay as they were.", file.path);
                    self.toasts.trouble(now, title, text);
                }
            }
            return true;
        }
        if batch.iter().all(|file| has_ending(&file.path, &PLACES)) {
            let key = format!("opened-{}", self.jobs.opened_batches);
            provide(host, &key, batch);
            self.jobs.places = Some(host.start(Job::ReadPlaces(ReadPlacesOrder { key })));
            return true;
        }
        false
    }

    /// Whether a job works for the georeferencer.
    pub(super) fn is_georeferencing(&self, id: JobId) -> bool {
        self.jobs.picture_tiles.contains_key(&id)
            || self.jobs.describe_picture == Some(id)
            || self.jobs.places == Some(id)
    }

    pub(super) fn georeferencing_event(
        &mut self,
        context: &egui::Context,
        host: &mut dyn Host,
        id: JobId,
        event: JobEvent,
    ) {
        let now = host.now();
        let Some(georeferencer) = &mut self.views.georeferencer else {
            return;
        };
        match event {
            JobEvent::Tile { window, pixels, .. } => {
                // A coarse view that is not whole is as good as it gets: what is missing is read
                // when looked at from near.
                let tiles = &mut georeferencer.canvas.tiles;
                tiles.insert(context, &window, &pixels, true);
                self.jobs.picture_tiles.remove(&id);
            }
            JobEvent::MapInfo(info) => {
                georeferencer.describe(&info);
                context.request_repaint();
            }
            JobEvent::Places(places) => {
                let title = match places.len() {
                    1 => "1 place to choose from".to_owned(),
                    count => format!("{count} places to choose from"),
                };
                let place = |(name, at)| NamedPlace { name, at };
                georeferencer.places = places.into_iter().map(place).collect();
                self.toasts
                    .note(now, title, "They stand beside the picture.");
            }
            JobEvent::Failed(why) if self.jobs.describe_picture == Some(id) => {
                let title = format!("{} cannot be shown", georeferencer.name);
                let text = format!("{why} Everything open stays as it was.");
                self.toasts.trouble(now, title, text);
                self.stop_georeferencing(host);
            }
            JobEvent::Failed(why) if self.jobs.places == Some(id) => {
                self.jobs.places = None;
                self.toasts.trouble(now, "No places were read", why);
            }
            JobEvent::Failed(_) => {
                if let Some(key) = self.jobs.picture_tiles.remove(&id) {
                    let empty = pilotage_core::raster::Raster::filled(0, 0, [0; 4]);
                    let tiles = &mut georeferencer.canvas.tiles;
                    tiles.insert(context, &key.window(), &empty, true);
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.jobs.picture_tiles.remove(&id);
                self.jobs.describe_picture = self.jobs.describe_picture.filter(|job| *job != id);
                self.jobs.places = self.jobs.places.filter(|job| *job != id);
            }
            _ => {}
        }
    }

    /// Asks for the picture's pixels that are in sight.
    pub(super) fn ask_for_picture_tiles(&mut self, host: &mut dyn Host) {
        let Some(georeferencer) = &self.views.georeferencer else {
            return;
        };
        let wanted = georeferencer.canvas.tiles.wanted();
        let under_way: Vec<_> = self
            .jobs
            .picture_tiles
            .iter()
            .map(|(_, key)| *key)
            .collect();
        let room = TILES_AT_A_TIME.saturating_sub(under_way.len());
        let next = wanted.iter().filter(|key| !under_way.contains(key));
        for key in next.take(room) {
            let id = host.start(Job::Tile(TileOrder {
                map: georeferencer.bare(),
                window: key.window(),
            }));
            self.jobs.picture_tiles.insert(id, *key);
        }
    }

    /// Carries a command out.
    pub(super) fn georeference(&mut self, command: &GeoreferenceCommand, host: &mut dyn Host) {
        let Some(georeferencer) = &self.views.georeferencer else {
            return;
        };
        let now = host.now();
        match command {
            GeoreferenceCommand::Close => self.stop_georeferencing(host),
            GeoreferenceCommand::Load => host.ask_for_files(),
            GeoreferenceCommand::SavePoints => {
                let name = georeferencer.file_beside("points");
                host.save_file(&name, georeferencer.points_file().as_bytes());
                self.toasts.note(now, "Points saved", name);
            }
            GeoreferenceCommand::SaveWorldFile => {
                let fitted = georeferencer.fitted().as_ref().ok();
                let world_file = fitted
                    .and_then(pilotage_core::imagery::georeferencer::TransformFit::world_file);
                if let (Some(file), Some(system)) = (world_file, georeferencer.system) {
                    let name = georeferencer.world_file_name();
                    host.save_file(&name, file.to_string().as_bytes());
                    let system_file = georeferencer.file_beside("prj");
                    host.save_file(&system_file, system.well_known_text().as_bytes());
                    let text = format!("{name} and {system_file} belong beside the picture.");
                    self.toasts.note(now, "World file saved", text);
                }
            }
            GeoreferenceCommand::UseAsMap => self.use_picture(host),
        }
    }

    fn use_picture(&mut self, host: &mut dyn Host) {
        let Some(georeferencer) = &self.views.georeferencer else {
            return;
        };
        let Some(source) = georeferencer.placed() else {
            return;
        };
        let key = georeferencer.key.clone();
        let name = georeferencer.file_beside("");
        if let Some((name, files)) = self.jobs.picture_files.take() {
            self.keep_files(host, &key, &name, &files);
        }
        self.stop_georeferencing(host);
        if let (None, Some(origin)) = (self.documents.world_origin(), source.origin()) {
            self.documents
                .begin_world(origin, name.trim_end_matches('.'));
        }
        self.jobs.fit_map_when_known = true;
        self.change_map(host, source);
        self.jobs.document_changed = true;
        let text = "Save its world file to have its place elsewhere too.";
        self.toasts
            .note(host.now(), "The picture is the map now", text);
    }
}
