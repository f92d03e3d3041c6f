//! The picture that is being put on the ground: its jobs, its files, and what becomes of it.

use pilotage_core::exchange::Format;
use pilotage_core::imagery::georeferencer::{TransformFit, TransformKind};
use pilotage_core::raster::Raster;
use pilotage_jobs::{
    DescribeMapOrder, Job, JobEvent, JobId, PresumedSystem, ReadControlPoints,
    ReadControlPointsOrder, ReadPlacesOrder, TileOrder, Unplaced,
};

use super::canvas::PictureCanvas;
use super::{Georeferencer, NamedPlace};
use crate::command::Workspace;
use crate::documents::kept::provide;
use crate::feature::{FeatureContext, OpenedSet};
use crate::host::OpenedFile;
use crate::map::{TILES_AT_A_TIME, TileKey};
use crate::shell::counted;
use pilotage_core::flight::files::has_ending;

/// Side of the largest map that is shown whole beside a picture, metres.
const LARGEST_SHOWN: f64 = 20_000.0;

/// Title of what is told of tiles that cannot be had.
const PART_EMPTY: &str = "A part of the picture stays empty";

/// Georeferencer, with a picture while it is open.
#[derive(Default)]
pub struct GeoreferencerFeature {
    pub(super) picture: Option<Georeferencer>,
    /// Files that the picture is among.
    files: Option<OpenedSet>,
    /// Tiles asked for of the picture.
    tiles: Vec<(JobId, TileKey)>,
    /// The question what the picture is.
    describe: Option<JobId>,
    /// Control points being read.
    points: Option<JobId>,
    /// Named places being read, and the files out of which.
    places: Option<(JobId, Vec<OpenedFile>)>,
    /// Paths of files that hold no places and are opened as anything else.
    without_places: Vec<String>,
    /// Whether it has the name of one that was left, and its size is to tell whether it is that.
    awaits_size: bool,
    /// Pictures with points that were left: once one of that name and size is opened again, it has those.
    left: Vec<Georeferencer>,
}

impl GeoreferencerFeature {
    /// Opens a picture that does not say where it lies.
    pub(super) fn begin(
        &mut self,
        set: &OpenedSet,
        unplaced: Unplaced,
        context: &mut FeatureContext<'_>,
    ) {
        self.close(context);
        let origin = context.documents.world_origin();
        let picture = Georeferencer::new(&set.key, &unplaced.name, origin);
        let order = DescribeMapOrder(picture.bare());
        self.describe = Some(context.start(Job::DescribeMap(order)));
        self.files = Some(set.clone());
        let has_points = unplaced.points.is_some();
        let may_be_left = |left: &Georeferencer| left.name == picture.name;
        if let Some(file) = unplaced.points {
            self.ask_for_points(set, file, picture.presumed_system(), context);
        } else if self.left.iter().any(may_be_left) {
            self.awaits_size = true;
        } else {
            say_unplaced(&picture.name, context);
        }
        self.picture = Some(picture);
        context.playback.playing = false;
        let map = context.documents.map.info.as_ref().map(|m| m.bounds);
        if let Some(ground) = map.filter(|r| r.width().max(r.height()) < LARGEST_SHOWN) {
            context.map.fit(ground);
        }
        if !has_points {
            self.show_points(context);
        }
    }

    /// Gives the picture, whose size is known now, the points that it had when it was left. Others have its name, as those
    /// of another folder: only one of the same size is taken for it.
    fn take_up_left(&mut self, context: &mut FeatureContext<'_>) {
        let Some(picture) = &mut self.picture else {
            return;
        };
        if !std::mem::take(&mut self.awaits_size) || picture.has_begun() {
            return;
        }
        let before = self.left.iter().position(|left| left.looks_like(picture));
        let Some(before) = before.map(|at| self.left.swap_remove(at)) else {
            return say_unplaced(&picture.name, context);
        };
        let title = format!("{} has its points of before", picture.name);
        let text = "It has the name and the size of a picture that was left. Undo takes them away.";
        context.note(&title, text);
        picture.take_up(before);
        self.show_points(context);
    }

    /// Asks for the control points in a file; `otherwise` is their system where the file names none.
    fn ask_for_points(
        &mut self,
        set: &OpenedSet,
        file: String,
        otherwise: Option<PresumedSystem>,
        context: &mut FeatureContext<'_>,
    ) {
        let key = set.key.clone();
        let order = ReadControlPointsOrder {
            key,
            file,
            otherwise,
        };
        let asked = context.start(Job::ReadControlPoints(order));
        if let Some(before) = self.points.replace(asked) {
            context.cancel(before);
        }
    }

    /// Takes the control points of a file.
    fn take_points(&mut self, read: ReadControlPoints, context: &mut FeatureContext<'_>) {
        let Some(picture) = &mut self.picture else {
            return;
        };
        let title = format!(
            "Read {} from {}",
            counted(read.points.len(), "point", "points"),
            read.file
        );
        let mut text = read.notes;
        if !picture.points.is_empty() {
            text.push("Undo brings the points before back.".to_owned());
        }
        picture.take_points(read.points, read.plane);
        context.note(&title, text.join(" "));
        self.show_points(context);
    }

    /// Shows all points on the map.
    fn show_points(&self, context: &mut FeatureContext<'_>) {
        if let Some(ground) = self.picture.as_ref().and_then(Georeferencer::ground) {
            context.map.fit(ground);
        }
        context.map.follow = false;
    }

    /// Leaves the picture; its points are there again when it is opened again.
    pub(super) fn close(&mut self, context: &mut FeatureContext<'_>) {
        let Self {
            picture,
            tiles,
            describe,
            places,
            points,
            mut left,
            ..
        } = std::mem::take(self);
        if let Some(mut picture) = picture.filter(|picture| !picture.points.is_empty()) {
            picture.canvas = PictureCanvas::default();
            left.retain(|other| !other.looks_like(&picture));
            left.push(picture);
        }
        self.left = left;
        let tiles = tiles.into_iter().map(|(id, _)| id);
        let places = places.map(|(id, _)| id);
        for id in tiles.chain(describe).chain(places).chain(points) {
            context.cancel(id);
        }
    }

    /// Takes points and places out of files; false if they hold something else.
    pub(super) fn load(&mut self, set: &OpenedSet, context: &mut FeatureContext<'_>) -> bool {
        let Some(picture) = &mut self.picture else {
            return false;
        };
        if let [file] = set.files.as_slice()
            && has_ending(&file.path, &["points"])
        {
            provide(context.host, &set.key, &set.files);
            let system = picture.presumed_system();
            self.ask_for_points(set, file.path.clone(), system, context);
            return true;
        }
        let paths = set.files.iter().map(|file| &file.path);
        let is_known = paths.eq(&std::mem::take(&mut self.without_places));
        let mut files = set.files.iter();
        let has_places =
            !is_known && files.all(|file| Format::is_extension_of_formats_alone(&file.path));
        if has_places {
            provide(context.host, &set.key, &set.files);
            let key = set.key.clone();
            let id = context.start(Job::ReadPlaces(ReadPlacesOrder { key }));
            if let Some((before, _)) = self.places.replace((id, set.files.clone())) {
                context.cancel(before);
            }
        }
        has_places
    }

    /// Whether it waits for a job.
    pub(super) fn waits_for(&self, id: JobId) -> bool {
        let tiles = self.tiles.iter().map(|(job, _)| job);
        let places = self.places.iter().map(|(job, _)| job);
        let mut jobs = tiles
            .chain(&self.describe)
            .chain(places)
            .chain(&self.points);
        jobs.any(|job| *job == id)
    }

    /// Takes what a worker says; whether anything of that kind is awaited.
    pub(super) fn take(
        &mut self,
        id: JobId,
        event: JobEvent,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let Some(picture) = &mut self.picture else {
            return false;
        };
        match event {
            JobEvent::Tile { window, pixels, .. } => {
                // A coarse view that is not whole is as good as it gets: what is missing is read
                // when looked at from near.
                let tiles = &mut picture.canvas.tiles;
                tiles.insert(context.egui, &window, &pixels, true);
            }
            JobEvent::MapInfo(info) => {
                picture.describe(&info);
                self.take_up_left(context);
                context.egui.request_repaint();
            }
            JobEvent::ControlPoints(read) => self.take_points(*read, context),
            JobEvent::Places(places) if places.is_empty() => self.open_without_places(context),
            JobEvent::Places(places) => {
                let title = match places.len() {
                    1 => "1 place to choose from".to_owned(),
                    count => format!("{count} places to choose from"),
                };
                let place = |(name, at)| NamedPlace { name, at };
                picture.places = places.into_iter().map(place).collect();
                context.note(&title, "They stand beside the picture.");
            }
            JobEvent::Failed(why) if self.describe == Some(id) => {
                let title = format!("{} cannot be shown", picture.name);
                context.trouble(&title, format!("{why} Everything open stays as it was."));
                self.close(context);
            }
            JobEvent::Failed(why) if self.points == Some(id) => {
                let title = "The points were not read".to_owned();
                context.trouble(&title, format!("{why}. The points stay as they were."));
            }
            JobEvent::Failed(_) if self.places.as_ref().is_some_and(|(job, _)| *job == id) => {
                self.open_without_places(context);
            }
            JobEvent::Remark(why) => context.trouble(PART_EMPTY, format!("{why}.")),
            JobEvent::Failed(why) => {
                context.trouble(PART_EMPTY, why);
                let place = self.tiles.iter().position(|(job, _)| *job == id);
                if let Some((_, key)) = place.map(|place| self.tiles.swap_remove(place)) {
                    let empty = Raster::filled(0, 0, [0; 4]);
                    let tiles = &mut picture.canvas.tiles;
                    tiles.insert(context.egui, &key.window(), &empty, true);
                }
            }
            JobEvent::Finished | JobEvent::Cancelled => {
                self.tiles.retain(|(job, _)| *job != id);
                self.describe = self.describe.filter(|job| *job != id);
                self.places.take_if(|(job, _)| *job == id);
                self.points = self.points.filter(|job| *job != id);
            }
            JobEvent::Progress(..) => {}
            _ => return false,
        }
        true
    }

    /// Has files in which no places were found opened as anything else, such as a table of a flight; whoever opens files
    /// also tells what is wrong with those that are nothing.
    fn open_without_places(&mut self, context: &mut FeatureContext<'_>) {
        if let Some((job, files)) = self.places.take() {
            context.wait_no_more(job);
            self.without_places = files.iter().map(|file| file.path.clone()).collect();
            context.open(files);
        }
    }

    /// Asks for the picture's pixels that are in sight.
    pub(super) fn ask_for_tiles(&mut self, context: &mut FeatureContext<'_>) {
        let Some(picture) = &mut self.picture else {
            return;
        };
        picture.know_world(context.documents.world_origin());
        let room = TILES_AT_A_TIME.saturating_sub(self.tiles.len());
        let is_asked = |key: &TileKey| self.tiles.iter().any(|(_, asked)| asked == key);
        let wanted = picture.canvas.tiles.wanted().iter();
        let next = wanted.filter(|key| !is_asked(key)).take(room).copied();
        for key in next.collect::<Vec<_>>() {
            let id = context.start(Job::Tile(TileOrder {
                map: picture.bare(),
                window: key.window(),
            }));
            self.tiles.push((id, key));
        }
    }

    /// Saves the points as QGIS writes them.
    pub(super) fn save_points(&self, context: &mut FeatureContext<'_>) {
        let Some(picture) = &self.picture else {
            return;
        };
        let name = picture.file_beside("points");
        let text = picture.points_file();
        context.host.save_file(&name, text.as_bytes());
        context.note("Points saved", name);
    }

    /// Saves the world file and the .prj beside it.
    pub(super) fn save_world_file(&self, context: &mut FeatureContext<'_>) {
        let Some(picture) = &self.picture else {
            return;
        };
        let fitted = picture.fitted().as_ref().ok();
        let world_file = fitted.and_then(TransformFit::world_file);
        if let (Some(file), Some(system)) = (world_file, picture.system) {
            let name = picture.world_file_name();
            context.host.save_file(&name, file.to_string().as_bytes());
            let system_file = picture.file_beside("prj");
            let words = system.well_known_text();
            context.host.save_file(&system_file, words.as_bytes());
            let text = format!("{name} and {system_file} belong beside the picture.");
            context.note("World file saved", text);
        }
    }

    /// Shows the picture as the map, where the fit puts it.
    pub(super) fn use_as_map(&mut self, context: &mut FeatureContext<'_>) {
        let Some(picture) = &self.picture else {
            return;
        };
        let Some(source) = picture.placed() else {
            return;
        };
        let name = picture.file_beside("");
        let text = if picture.kind == TransformKind::Projective {
            "No world file can hold this transform. Open the picture again to save its points."
        } else {
            "Open the picture again to save its points, or its world file to have its place elsewhere too."
        };
        if let Some(files) = self.files.take() {
            context.keep(files);
        }
        self.close(context);
        let world = context.documents.world_origin();
        if let Some(origin) = source.origin().filter(|at| world != Some(*at)) {
            context.stop_flying();
            *context.selection = None;
            (context.documents).begin_world(origin, name.trim_end_matches('.'));
            context.view.workspace = Workspace::Plan;
        }
        context.map.fits_when_known = true;
        context.change_map(source);
        context.document_changed();
        context.note("The picture is the map now", text);
    }
}

/// Says what is to be done about a picture without points.
fn say_unplaced(name: &str, context: &mut FeatureContext<'_>) {
    let text = "Click places that you know in the picture and on the map. Its world file beside it would do as well.";
    let title = format!("{name} does not say where it lies");
    context.note(&title, text);
}
