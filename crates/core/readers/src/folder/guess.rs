//! A folder without flight.json whose table has the columns of a camera drone.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::clock::TimeFormat;
use super::layout::{
    ChannelFile, FlightFile, FramesFile, MapPixelColumns, PixelCentres, PositionColumns, StartFile,
    TimeColumn, TruthFile, TruthFramesFile, VERSION, ValueColumn,
};
use super::table::CsvTable;
use crate::cells::Dimension;
use pilotage_base::files::{FileSet, find, folder_of};
use pilotage_base::frames::wrap_pi;
use pilotage_base::georeference::Georeference;
use pilotage_base::text::by_count;
use pilotage_flight::{CameraFile, OriginFile};
use pilotage_raster::camera::{CameraModel, UNSTATED_MOUNT_DEVIATION};
use pilotage_raster::raster::decode_picture;

/// Columns without which nothing is guessed.
const NEEDED: [&str; 6] = ["file", "timestamp", "lat", "lon", "rel_alt_m", "gimbal_yaw"];

/// Focal length of the small drones' wide lens over the picture's width (79.6° across).
const FOCAL_PER_WIDTH: f64 = 0.6;

/// A layout for the only table of a camera drone among the files, its folder, and what was assumed.
pub(super) fn guess(files: &Arc<dyn FileSet>) -> Option<(FlightFile, String, Vec<String>)> {
    let mut tables = files.names();
    tables.retain(|name| name.to_ascii_lowercase().ends_with(".csv"));
    let mut fitting = tables.into_iter().filter_map(|name| {
        let table = CsvTable::parse(&name, &files.read(&name)?).ok()?;
        let fits = NEEDED.iter().all(|column| table.has(column)) && table.len() > 0;
        fits.then_some((name, table))
    });
    let (name, table) = fitting.next()?;
    if fitting.next().is_some() {
        return None;
    }
    let base = folder_of(&name).to_owned();
    let file = name.rsplit('/').next().unwrap_or(&name).to_owned();
    let pictures = table.texts("file").ok()?;
    let (directory, width, height) = first_picture(files, &base, pictures.first()?)?;
    let mut notes = vec![format!(
        "there is no flight.json: the columns of {file} were taken for those of a camera drone that \
         looks straight down"
    )];
    notes.push(format!(
        "the camera is assumed to see {:.0}° across; state it in a flight.json if you know better",
        2.0 * (0.5 / FOCAL_PER_WIDTH).atan().to_degrees()
    ));
    let georeference = georeference(files, &base);
    let origin = match &georeference {
        Some((_, origin)) => *origin,
        None => OriginFile {
            latitude_deg: first_number(&table, "lat")?,
            longitude_deg: first_number(&table, "lon")?,
            height_m: 0.0,
        },
    };
    let stored_turn_deg = stored_turns(&table);
    if !stored_turn_deg.is_empty() {
        notes.push(format!(
            "{} {} heading",
            stored_turn_deg.len(),
            by_count(
                stored_turn_deg.len(),
                "picture is turned by 180° against its",
                "pictures are turned by 180° against their"
            )
        ));
    }
    let map_pixels = ["sift_ortho_px", "sift_ortho_py"];
    let truth = georeference
        .filter(|_| map_pixels.iter().all(|column| table.has(column)))
        .map(|(georeference, _)| truth(&file, georeference));
    let mount_deviation = if table.has("gimbal_pitch") {
        0.0
    } else {
        UNSTATED_MOUNT_DEVIATION
    };
    let camera = CameraModel {
        mount_deviation,
        ..CameraModel::of_focal(width, height, FOCAL_PER_WIDTH * width as f64)
    };
    let layout = FlightFile {
        pilotage_flight: VERSION,
        name: base.rsplit('/').next().unwrap_or("Flight").to_owned(),
        description: None,
        data: None,
        origin: Some(origin),
        ground_down_m: 0.0,
        camera: Some(CameraFile::of(&camera)),
        time_origin: None,
        start: StartFile {
            time_s: None,
            north_m: None,
            east_m: None,
            latitude_deg: None,
            longitude_deg: None,
            standard_deviation_m: 3.0,
        },
        channels: channels(&table, &file),
        frames: Some(FramesFile {
            file,
            name: "file".to_owned(),
            time: time(),
            directory,
            stored_turn_deg,
        }),
        truth,
    };
    Some((layout, base, notes))
}

fn time() -> TimeColumn {
    TimeColumn {
        column: "timestamp".to_owned(),
        format: TimeFormat::Camera,
        offset_s: 0.0,
    }
}

fn column(name: &str, unit: &str, offset: f64) -> ValueColumn {
    ValueColumn {
        column: name.to_owned(),
        unit: Some(unit.to_owned()),
        scale: 1.0,
        offset,
    }
}

fn channels(table: &CsvTable, file: &str) -> Vec<ChannelFile> {
    let channel = |name: &str, value: Option<ValueColumn>| ChannelFile {
        name: name.to_owned(),
        file: file.to_owned(),
        time: time(),
        value,
        ..ChannelFile::default()
    };
    let measured = [
        ("heading", "gimbal_yaw", "deg", 0.0),
        // The gimbal counts from the horizon, the camera from straight down.
        ("pitch", "gimbal_pitch", "deg", 90.0),
        ("roll", "gimbal_roll", "deg", 0.0),
        ("height_above_ground", "rel_alt_m", "m", 0.0),
    ];
    let mut channels: Vec<ChannelFile> = measured
        .into_iter()
        .filter(|(_, name, ..)| table.has(name))
        .map(|(channel_name, name, unit, offset)| {
            channel(channel_name, Some(column(name, unit, offset)))
        })
        .collect();
    channels.push(ChannelFile {
        latitude: Some(column("lat", "deg", 0.0)),
        longitude: Some(column("lon", "deg", 0.0)),
        ..channel("gps", None)
    });
    channels
}

fn truth(file: &str, georeference: String) -> TruthFile {
    TruthFile {
        states: None,
        frames: Some(TruthFramesFile {
            file: file.to_owned(),
            name: "file".to_owned(),
            position: PositionColumns {
                map_pixel: Some(MapPixelColumns {
                    x: column("sift_ortho_px", "px", 0.0),
                    y: column("sift_ortho_py", "px", 0.0),
                    georeference,
                    pixel_centres: PixelCentres::Integers,
                }),
                height: Some(column("rel_alt_m", "m", 0.0)),
                ..PositionColumns::default()
            },
            attitude: None,
        }),
    }
}

/// Folder of the pictures, and the width and height of the first.
fn first_picture(
    files: &Arc<dyn FileSet>,
    base: &str,
    name: &str,
) -> Option<(String, usize, usize)> {
    let (path, bytes) = find(files.as_ref(), &[base], name).ok()?;
    let picture = decode_picture(&bytes).ok()?;
    let folder = folder_of(&path);
    let directory = folder.strip_prefix(base).unwrap_or(folder);
    Some((
        directory.trim_start_matches('/').to_owned(),
        picture.width(),
        picture.height(),
    ))
}

/// The only fitted similarity in the folder: its file name and its origin.
fn georeference(files: &Arc<dyn FileSet>, base: &str) -> Option<(String, OriginFile)> {
    let mut found = files.names().into_iter().filter_map(|name| {
        let json = folder_of(&name) == base && name.to_ascii_lowercase().ends_with(".json");
        let text = String::from_utf8(json.then(|| files.read(&name))??).ok()?;
        let Georeference::Similarity(similarity) = Georeference::from_json(&text).ok()? else {
            return None;
        };
        let origin = OriginFile {
            latitude_deg: similarity.origin_lat,
            longitude_deg: similarity.origin_lon,
            height_m: 0.0,
        };
        Some((name.rsplit('/').next()?.to_owned(), origin))
    });
    let first = found.next()?;
    found.next().is_none().then_some(first)
}

fn first_number(table: &CsvTable, name: &str) -> Option<f64> {
    table.texts(name).ok()?.first()?.parse().ok()
}

/// Pictures whose rotation on the map is nearer to the opposite of the gimbal's yaw.
fn stored_turns(table: &CsvTable) -> BTreeMap<String, f64> {
    let angle = |name: &str| table.values(&column(name, "deg", 0.0), Dimension::Angle);
    let (Ok(names), Ok(yaw), Ok(rotation)) = (
        table.texts("file"),
        angle("gimbal_yaw"),
        angle("sift_rot_deg"),
    ) else {
        return BTreeMap::new();
    };
    names
        .into_iter()
        .zip(yaw.into_iter().zip(rotation))
        .filter_map(|(name, (yaw, rotation))| {
            let difference = wrap_pi(yaw? - rotation?).abs();
            (difference > std::f64::consts::FRAC_PI_2).then(|| (name.to_owned(), 180.0))
        })
        .collect()
}
