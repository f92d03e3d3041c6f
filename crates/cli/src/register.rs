//! `pilotage register`: photos laid on a map.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pilotage_core::filter::probability_words;
use pilotage_core::flight::photo::{PhotoLook, PhotoRow, PhotoRows, PhotoSearch, RegisteredPhoto};
use pilotage_core::frames::{GroundPoint, LocalFrame};
use pilotage_core::imagery::Imagery;
use pilotage_core::raster::encode_png;
use pilotage_core::registration::{RegistrationMethod, overlay};
use pilotage_core::text::distinct_names;
use pilotage_jobs::{JobEvent, PhotoReport, PhotosOrder, decode_photo};
use serde::Serialize;

use crate::CommandResult;
use crate::files::{DirectoryFiles, write_whole};
use crate::maps::{MAP_CACHE, open_map};
use crate::notes::told;
use crate::photo_search::{KnownOfPhotos, SearchRanges, TablesBesidePhotos, photo_file};
use crate::workers::{self, Lent};

/// Key of the photos among the files of workers.
const PHOTOS: &str = "photos";
/// Pixels across the picture of `--overlay`.
const ACROSS: usize = 1200;

/// Arguments of `pilotage register`: photos, and the map to lay them on.
#[derive(clap::Args)]
pub struct Arguments {
    /// Map with its georeference in it or beside it.
    map: PathBuf,
    /// Photos (JPEG, TIFF or PNG) of a camera that looks down.
    #[arg(required = true, value_name = "PHOTO")]
    photos: Vec<PathBuf>,
    /// A photo of which no place is known is looked for on the whole map.
    #[command(flatten)]
    known: KnownOfPhotos,
    /// Range of the search to each side of the place, metres.
    #[arg(long, value_name = "METRES", default_value_t = PhotoSearch::default().within)]
    within: f64,
    /// Range of the search around the height, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 100.0 * PhotoSearch::default().height_within)]
    height_within: f64,
    /// Range of the search to each side of the heading, degrees; 180 is all around. Compasses of small drones
    /// are 30 off.
    #[arg(long, value_name = "DEGREES", default_value_t = PhotoSearch::default().heading_within.to_degrees())]
    heading_within: f64,
    /// Folder for a picture of each photo that was laid, in a chequerboard with the map.
    #[arg(long, value_name = "FOLDER")]
    overlay: Option<PathBuf>,
    /// Answer as JSON.
    #[arg(long)]
    json: bool,
}

/// Result of a photo.
#[derive(Serialize)]
struct PhotoResult {
    photo: String,
    /// Its file, as it was named.
    file: String,
    seconds: f64,
    /// Assumptions, and their sources.
    assumed: Vec<String>,
    #[serde(flatten)]
    laid: Option<RegisteredPhotoRow>,
    /// Why it was not laid.
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<String>,
    /// Of the likeliest place.
    probability: f64,
}

/// Place at which a photo was laid.
#[derive(Serialize)]
struct RegisteredPhotoRow {
    /// Ground in the middle of the picture, degrees.
    centre_lat_lon: Option<[f64; 2]>,
    /// The same in metres north and east of the map's origin, with its covariance, m².
    centre_north_east_m: [f64; 2],
    centre_covariance_m2: [[f64; 2]; 2],
    /// Place below the camera, degrees, and metres north, east.
    camera_lat_lon: Option<[f64; 2]>,
    camera_north_east_m: [f64; 2],
    camera_deviation_m: [f64; 2],
    height_m: f64,
    height_deviation_m: f64,
    heading_deg: f64,
    heading_deviation_deg: f64,
    roll_deg: f64,
    pitch_deg: f64,
    /// Quarter turns apart, the picture was stored so.
    stored_turn_deg: f64,
    /// "patches" or "whole frame".
    believed_by: &'static str,
    /// Patches that agree, of those that could be found.
    patches: [usize; 2],
    log10_doubt: f64,
}

/// The map and where it lies.
struct PlacedMap {
    map: Arc<dyn Imagery>,
    world: Option<LocalFrame>,
}

/// Lays every photo.
pub fn run(arguments: &Arguments) -> CommandResult {
    let search = arguments.known.search(&SearchRanges {
        metres: arguments.within,
        height_percent: arguments.height_within,
        heading_degrees: arguments.heading_within,
    })?;
    let map = open_map(&arguments.map, None, MAP_CACHE)?;
    let ground = PlacedMap {
        world: map.frame,
        map: told(map),
    };
    let (mut orders, mut rows) = (Vec::new(), Vec::new());
    let mut tables = TablesBesidePhotos::default();
    for path in &arguments.photos {
        // What is not there at all is said before the work begins.
        photo_file(path)?;
        let name = path.to_string_lossy().into_owned();
        let row = tables.row(path);
        rows.push(row);
        orders.push(PhotosOrder {
            key: PHOTOS.to_owned(),
            rows: Some(PhotoRows(
                row.map(|row| (name.clone(), row)).into_iter().collect(),
            )),
            names: vec![name],
            map: Lent::map_of_file(),
            origin: ground.world.map(|world| world.origin),
            ground: ground.map.bounds(),
            search,
        });
    }
    let lent = Lent::default()
        .with_map(Lent::map_of_file(), Arc::clone(&ground.map))
        .with_files(PHOTOS, Arc::new(DirectoryFiles::anywhere()));
    let overlays = match &arguments.overlay {
        Some(folder) => overlays(folder, &arguments.photos, &arguments.map)?,
        None => Vec::new(),
    };
    let mut answers = Vec::new();
    workers::run(orders, &lent, &mut |number, event| {
        match event {
            JobEvent::Failed(why) => return Err(why),
            JobEvent::PhotoRegistered(report) => {
                let path = &arguments.photos[number];
                if let (Ok(laid), Some(target)) = (&report.answer.laid, overlays.get(number)) {
                    let row = rows[number].as_ref();
                    draw(target, (path, row), &search, &ground, laid).map_err(|e| e.to_string())?;
                }
                let answer = answer(path, *report, &ground);
                if !arguments.json {
                    print(&answer);
                }
                answers.push(answer);
            }
            _ => {}
        }
        Ok(())
    })?;
    if arguments.json {
        println!("{}", serde_json::to_string_pretty(&answers)?);
    } else if answers.len() > 1 {
        let laid = answers.iter().filter(|a| a.laid.is_some()).count();
        println!("{laid} of {} photos were laid", answers.len());
    }
    Ok(())
}

impl PlacedMap {
    fn lat_lon(&self, ground: GroundPoint) -> Option<[f64; 2]> {
        let at = self.world.as_ref()?.geodetic_from_ground(&ground);
        Some([at.latitude.to_degrees(), at.longitude.to_degrees()])
    }
}

/// Files for the pictures of photos in a folder, which is made if missing: one for each, and none that is itself a photo or
/// the map.
fn overlays(folder: &Path, photos: &[PathBuf], map: &Path) -> Result<Vec<PathBuf>, String> {
    let told = |e: std::io::Error| format!("{}: {e}", folder.display());
    std::fs::create_dir_all(folder).map_err(told)?;
    let folder = folder.canonicalize().map_err(told)?;
    let stem = |path: &Path| {
        let stem = path.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    };
    let is_here = |path: &&PathBuf| path.parent() == Some(folder.as_path());
    let read = photos.iter().map(PathBuf::as_path).chain([map]);
    let read: Vec<PathBuf> = read.filter_map(|path| path.canonicalize().ok()).collect();
    let taken = read.iter().filter(is_here).map(|path| stem(path));
    let pictures = photos.iter().map(|path| format!("{}.overlay", stem(path)));
    let names = distinct_names(pictures, taken);
    Ok((names.into_iter())
        .map(|name| folder.join(format!("{name}.png")))
        .collect())
}

/// Writes the picture of a photo that was laid, in a chequerboard with the map; a row of a table may tell its place.
fn draw(
    target: &Path,
    (path, row): (&Path, Option<&PhotoRow>),
    search: &PhotoSearch,
    ground: &PlacedMap,
    laid: &RegisteredPhoto,
) -> CommandResult {
    let (file, bounds) = (photo_file(path)?, ground.map.bounds());
    let world = ground.world.as_ref();
    let photo = PhotoLook::read(&file, decode_photo, row, search, world, &bounds)?;
    let look = photo.over(ground.map.as_ref());
    if let Some(picture) = overlay(&look, &laid.at, laid.stored_turn, ACROSS) {
        write_whole(target, encode_png(&picture)?)?;
    }
    Ok(())
}

fn answer(path: &Path, report: PhotoReport, ground: &PlacedMap) -> PhotoResult {
    let name = path.file_name().unwrap_or_default();
    let said = report.answer;
    PhotoResult {
        photo: name.to_string_lossy().into_owned(),
        file: path.to_string_lossy().into_owned(),
        seconds: 1e-3 * report.computed,
        assumed: said.assumed,
        probability: said.probability,
        refused: said.laid.as_ref().err().cloned(),
        laid: said.laid.ok().map(|photo| laid(ground, &photo)),
    }
}

fn laid(ground: &PlacedMap, photo: &RegisteredPhoto) -> RegisteredPhotoRow {
    let below = photo.below();
    let attitude = photo.camera.attitude;
    let covariance = photo.centre_covariance;
    RegisteredPhotoRow {
        centre_lat_lon: ground.lat_lon(photo.centre),
        centre_north_east_m: [photo.centre.north, photo.centre.east],
        centre_covariance_m2: [
            [covariance[(0, 0)], covariance[(0, 1)]],
            [covariance[(1, 0)], covariance[(1, 1)]],
        ],
        camera_lat_lon: ground.lat_lon(below),
        camera_north_east_m: [below.north, below.east],
        camera_deviation_m: [photo.camera_deviation(0), photo.camera_deviation(1)],
        height_m: photo.height(),
        height_deviation_m: photo.camera_deviation(2),
        heading_deg: attitude.yaw.to_degrees().rem_euclid(360.0),
        heading_deviation_deg: photo.camera_deviation(5).to_degrees(),
        roll_deg: attitude.roll.to_degrees(),
        pitch_deg: attitude.pitch.to_degrees(),
        stored_turn_deg: photo.stored_turn.to_degrees(),
        believed_by: match photo.laid_by {
            RegistrationMethod::Patches => "patches",
            RegistrationMethod::WholeFrame => "whole frame",
        },
        patches: photo.patches,
        log10_doubt: photo.log_doubt,
    }
}

fn print(answer: &PhotoResult) {
    println!(
        "{} ({:.2} s): {}",
        answer.file,
        answer.seconds,
        answer.assumed.join("; ")
    );
    let Some(laid) = &answer.laid else {
        let cause = answer.refused.as_deref().unwrap_or_default();
        println!("  not laid: {cause}");
        return;
    };
    let place = |at: &Option<[f64; 2]>, metres: [f64; 2]| match at {
        Some([latitude, longitude]) => format!("{latitude:.6}, {longitude:.6}"),
        None => format!("{:.1} m north, {:.1} m east", metres[0], metres[1]),
    };
    let covariance = laid.centre_covariance_m2;
    println!(
        "  middle of the picture {} ± {:.1} m; camera above {}; {:.1} ± {:.1} m high; heading {:.1} ± {:.1}°",
        place(&laid.centre_lat_lon, laid.centre_north_east_m),
        (0.5 * (covariance[0][0] + covariance[1][1])).sqrt(),
        place(&laid.camera_lat_lon, laid.camera_north_east_m),
        laid.height_m,
        laid.height_deviation_m,
        laid.heading_deg,
        laid.heading_deviation_deg,
    );
    println!(
        "  by {} ({} of {} patches agree), {} by the whole frame",
        laid.believed_by,
        laid.patches[0],
        laid.patches[1],
        probability_words(answer.probability)
    );
}
