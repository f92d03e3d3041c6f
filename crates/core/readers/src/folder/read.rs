//! Reading a flight folder.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::Vector2;

use super::channels::read_channel;
use super::error::FolderError;
use super::files::{FLIGHT_FILE, FolderFiles, contents};
use super::guess::guess;
use super::layout::{
    AttitudeColumns, FlightFile, FramesFile, StartFile, TimeColumn, TruthFile, VERSION, ValueColumn,
};
use super::log::FlightTables;
use super::pictures::FolderFrames;
use super::position::Positions;
use super::table::CsvTable;
use super::time_unit;
use crate::cells::Dimension;
use crate::cells::Moment;
use crate::cells::date_and_time;
use crate::log::{Log, LogFormat};
use pilotage_base::files::{FileSet, Unresolved, find, folder_of, joined};
use pilotage_base::frames::{Attitude, GroundPoint, LocalFrame};
use pilotage_base::text::capitalised;
use pilotage_flight::{
    Channel, ChannelName, Flight, Frame, FrameTruth, StartFix, Truth, TruthState,
};
use pilotage_raster::camera::CameraModel;

/// Flight read from a folder.
pub struct FlightFolder {
    /// The flight.
    pub flight: Flight,
    /// Its pictures, decoded when they are asked for.
    pub frames: FolderFrames,
    /// Notes about all that was skipped, in words.
    pub notes: Vec<String>,
    pub(crate) told: FlightOrigin,
}

/// Source that a flight was read from.
pub(crate) enum FlightOrigin {
    /// Tables, and what is said of their columns.
    Tables(Box<FlightTables>),
    /// Source that is a log already.
    Log(Box<Log>),
}

impl FlightFolder {
    /// Takes the universal time at second 0, seconds since 1970, that tables tell beside their clock.
    pub(crate) fn date(&mut self, utc: Option<f64>) {
        if let FlightOrigin::Tables(tables) = &mut self.told {
            tables.dated = utc;
        }
    }

    /// Source of the flight as a log: every column, used or not, and the roles of the flight's series in it.
    pub fn log(&self) -> Log {
        let mut log = match &self.told {
            FlightOrigin::Tables(tables) => tables.log(&self.flight),
            FlightOrigin::Log(log) => Log::clone(log),
        };
        for note in &self.notes {
            log.report.remark(sentence(note));
        }
        log
    }

    /// Universal time at its zero, seconds since 1970, where that is known.
    pub fn utc_at_zero(&self) -> Option<f64> {
        match &self.told {
            FlightOrigin::Tables(tables) => tables.utc_at_zero(),
            FlightOrigin::Log(log) => log.utc_at_zero,
        }
    }

    /// Whether photos alone tell of it.
    pub fn is_of_photos(&self) -> bool {
        matches!(&self.told, FlightOrigin::Log(log) if log.format == LogFormat::Photos)
    }
}

/// A note as a sentence.
fn sentence(note: &str) -> String {
    let end = if note.ends_with(['.', '?']) { "" } else { "." };
    format!("{}{end}", capitalised(note))
}

/// Reads the flight that a set of files holds: the only flight.json among them and what it refers to.
///
/// Without one, a table with the columns of a camera drone is read as it is, and the notes tell what
/// was assumed.
pub fn read_flight(files: Arc<dyn FileSet>) -> Result<FlightFolder, FolderError> {
    let (path, bytes) = match find(files.as_ref(), &[""], FLIGHT_FILE) {
        Ok(found) => found,
        Err(Unresolved::Missing) => {
            let (layout, base, assumed) = guess(&files).ok_or(FolderError::NoFlightFile)?;
            let mut folder = read_layout(files, &layout, base)?;
            folder.notes.splice(0..0, assumed);
            return Ok(folder);
        }
        Err(Unresolved::Ambiguous(first, second)) => {
            return Err(FolderError::Ambiguous {
                file: FLIGHT_FILE.to_owned(),
                first,
                second,
            });
        }
    };
    let layout: FlightFile =
        serde_json::from_slice(&bytes).map_err(|e| FolderError::json(&path, &e))?;
    let base = folder_of(&path).to_owned();
    read_layout(files, &layout, base)
}

/// Reads a flight whose layout is known, of tables that are read already.
pub(crate) fn read_tables(
    files: Arc<dyn FileSet>,
    layout: &FlightFile,
    tables: BTreeMap<String, Arc<CsvTable>>,
) -> Result<FlightFolder, FolderError> {
    read_with(files, layout, String::new(), tables)
}

/// Reads a flight whose layout is known.
pub(super) fn read_layout(
    files: Arc<dyn FileSet>,
    layout: &FlightFile,
    base: String,
) -> Result<FlightFolder, FolderError> {
    read_with(files, layout, base, BTreeMap::new())
}

fn read_with(
    files: Arc<dyn FileSet>,
    layout: &FlightFile,
    base: String,
    tables: BTreeMap<String, Arc<CsvTable>>,
) -> Result<FlightFolder, FolderError> {
    if layout.pilotage_flight != VERSION {
        return Err(contents(
            "pilotage_flight",
            format!(
                "version {} is not known; this program reads version {VERSION}",
                layout.pilotage_flight
            ),
        ));
    }
    let data = layout.data.as_deref().map(|data| joined(&base, data));
    let mut folder = FolderFiles {
        files: Arc::clone(&files),
        folders: data.into_iter().chain([base]).collect(),
        tables,
        notes: Vec::new(),
    };
    let mut layout = layout.clone();
    if folder.tables.is_empty() {
        time_unit::settle(&mut folder, &mut layout);
    }
    let layout = &layout;
    let frame_on_globe = layout
        .origin
        .map(|origin| origin.geodetic().map(LocalFrame::new))
        .transpose()
        .map_err(|cause| contents("origin", cause))?;
    let camera = match &layout.camera {
        Some(camera) => camera.camera().map_err(|cause| contents("camera", cause))?,
        None if layout.frames.is_none() => no_camera(),
        None => return Err(contents("camera", "frames need a camera that took them")),
    };
    let positions = Positions {
        frame: frame_on_globe,
        ground_down: layout.ground_down_m,
    };
    let time_origin = time_origin(&mut folder, layout)?;

    let frames = match &layout.frames {
        Some(map) => read_frames(&mut folder, map, time_origin)?,
        None => Vec::new(),
    };
    let mut channels = Vec::new();
    for (i, map) in layout.channels.iter().enumerate() {
        read_channel(&mut folder, map, i, time_origin, &positions, &mut channels)?;
    }
    let truth = layout
        .truth
        .as_ref()
        .map(|map| read_truth(&mut folder, map, time_origin, &frames, &positions))
        .transpose()?;
    let start = read_start(&layout.start, &channels, &frames, &positions)?;
    let pictures = FolderFrames::new(
        files,
        folder.folders.clone(),
        layout.frames.as_ref().map_or("", |f| f.directory.as_str()),
        frames.iter().map(|f| f.name.clone()).collect(),
    );
    Ok(FlightFolder {
        flight: Flight {
            name: layout.name.clone(),
            frame_on_globe,
            camera,
            ground_down: layout.ground_down_m,
            channels,
            frames,
            start,
            truth,
        },
        frames: pictures,
        told: FlightOrigin::Tables(Box::new(FlightTables {
            layout: layout.clone(),
            by_file: folder.tables,
            time_origin,
            dated: None,
        })),
        notes: folder.notes,
    })
}

/// Camera of a flight without pictures.
fn no_camera() -> CameraModel {
    CameraModel::pinhole(640, 480, 60.0_f64.to_radians())
}

/// Second 0 of times with a date: as stated, or the first frame, or the first sample.
fn time_origin(
    folder: &mut FolderFiles,
    layout: &FlightFile,
) -> Result<Option<(i64, f64)>, FolderError> {
    if let Some(text) = &layout.time_origin {
        return match date_and_time(text) {
            Some(Moment::Absolute(whole, fraction)) => Ok(Some((whole, fraction))),
            _ => Err(contents(
                "time_origin",
                "write a date and time such as 2016-06-23T16:31:59Z",
            )),
        };
    }
    for (file, time) in layout.times_of_frames().chain(layout.times_of_channels()) {
        if time.format.is_absolute() {
            let table = folder.table(file, FLIGHT_FILE)?;
            if let Some(Moment::Absolute(whole, fraction)) = table.moments(time)?.first() {
                return Ok(Some((*whole, *fraction)));
            }
        }
    }
    Ok(None)
}

fn read_frames(
    folder: &mut FolderFiles,
    map: &FramesFile,
    origin: Option<(i64, f64)>,
) -> Result<Vec<Frame>, FolderError> {
    let table = folder.table(&map.file, "frames")?;
    let times = table.times(&map.time, origin)?;
    let names = table.texts(&map.name)?;
    for name in map.stored_turn_deg.keys() {
        if !names.contains(&name.as_str()) {
            return Err(contents(
                "frames.stored_turn_deg",
                format!("there is no frame \"{name}\""),
            ));
        }
    }
    names
        .iter()
        .zip(times)
        .enumerate()
        .map(|(row, (name, time))| {
            if name.is_empty() {
                return Err(table.cell_error(row, &map.name, "the name of the picture is missing"));
            }
            let turn = map.stored_turn_deg.get(*name).copied().unwrap_or(0.0);
            Ok(Frame {
                time,
                name: (*name).to_owned(),
                stored_turn: turn.to_radians(),
            })
        })
        .collect()
}

/// Roll, pitch and yaw of every row; `None` where one is empty.
fn attitudes(
    table: &CsvTable,
    map: Option<&AttitudeColumns>,
) -> Result<Vec<Option<Attitude>>, FolderError> {
    let Some(map) = map else {
        return Ok(vec![None; table.len()]);
    };
    let angle = |column: &ValueColumn| table.values(column, Dimension::Angle);
    let (roll, pitch, yaw) = (angle(&map.roll)?, angle(&map.pitch)?, angle(&map.yaw)?);
    Ok((0..table.len())
        .map(|i| {
            Some(Attitude {
                roll: roll[i]?,
                pitch: pitch[i]?,
                yaw: yaw[i]?,
            })
        })
        .collect())
}

fn read_truth(
    folder: &mut FolderFiles,
    map: &TruthFile,
    origin: Option<(i64, f64)>,
    frames: &[Frame],
    positions: &Positions,
) -> Result<Truth, FolderError> {
    let mut truth = Truth::default();
    if let Some(map) = &map.frames {
        let table = folder.table(&map.file, "truth.frames")?;
        let places = positions.read(folder, &table, &map.position, "truth.frames.position")?;
        let attitudes = attitudes(&table, map.attitude.as_ref())?;
        let names = table.texts(&map.name)?;
        let rows: BTreeMap<&str, usize> = names.iter().enumerate().map(|(i, n)| (*n, i)).collect();
        for frame in frames {
            let place = rows
                .get(frame.name.as_str())
                .and_then(|row| Some((*row, places[*row]?)));
            let Some((row, position)) = place else {
                folder.notes.push(format!(
                    "truth of the frames left out: {} has none",
                    frame.name
                ));
                truth.frames.clear();
                break;
            };
            truth.frames.push(FrameTruth {
                position,
                camera_attitude: attitudes[row],
            });
        }
    }
    if let Some(map) = &map.states {
        let table = folder.table(&map.file, "truth.states")?;
        let times = truth_times(&table, &map.time, origin)?;
        let places = positions.read(folder, &table, &map.position, "truth.states.position")?;
        let attitudes = attitudes(&table, map.attitude.as_ref())?;
        let winds: Vec<Option<Vector2<f64>>> = match &map.wind {
            None => vec![None; table.len()],
            Some(map) => {
                let north = table.values(&map.north, Dimension::Speed)?;
                let east = table.values(&map.east, Dimension::Speed)?;
                north
                    .into_iter()
                    .zip(east)
                    .map(|(n, e)| Some(Vector2::new(n?, e?)))
                    .collect()
            }
        };
        truth.states = (0..table.len())
            .filter_map(|i| {
                Some(TruthState {
                    time: times[i],
                    position: places[i]?,
                    attitude: attitudes[i],
                    wind: winds[i],
                })
            })
            .collect();
    } else {
        truth.states = frames
            .iter()
            .zip(&truth.frames)
            .map(|(frame, place)| TruthState {
                time: frame.time,
                position: place.position,
                attitude: None,
                wind: None,
            })
            .collect();
    }
    Ok(truth)
}

/// Times of the true states, which must grow, because positions are interpolated between them.
fn truth_times(
    table: &CsvTable,
    map: &TimeColumn,
    origin: Option<(i64, f64)>,
) -> Result<Vec<f64>, FolderError> {
    let times = table.times(map, origin)?;
    match times.windows(2).position(|w| w[1] <= w[0]) {
        Some(row) => Err(table.cell_error(row + 1, &map.column, "the time stands still")),
        None => Ok(times),
    }
}

fn read_start(
    map: &StartFile,
    channels: &[Channel],
    frames: &[Frame],
    positions: &Positions,
) -> Result<StartFix, FolderError> {
    let place = "start";
    if !(map.standard_deviation_m > 0.0 && map.standard_deviation_m.is_finite()) {
        return Err(contents(place, "standard_deviation_m must be positive"));
    }
    let first_sample = channels.iter().find_map(|c| c.times.first().copied());
    let time = map
        .time_s
        .or_else(|| frames.first().map(|f| f.time))
        .or(first_sample)
        .ok_or_else(|| contents(place, "there is neither a time_s nor any frame or sample"))?;
    let position = match (map.north_m, map.east_m, map.latitude_deg, map.longitude_deg) {
        (Some(north), Some(east), None, None) => GroundPoint::new(north, east),
        (None, None, Some(latitude), Some(longitude)) => positions
            .geodetic(latitude.to_radians(), longitude.to_radians())
            .map_err(|cause| contents(place, cause))?,
        (None, None, None, None) => {
            let value = |name: ChannelName| {
                channels
                    .iter()
                    .find(|c| c.name == name)
                    .and_then(|c| c.interpolated(time))
            };
            value(ChannelName::GpsNorth)
                .zip(value(ChannelName::GpsEast))
                .map(|(north, east)| GroundPoint::new(north, east))
                .ok_or_else(|| contents(place, "without a position there must be a gps channel"))?
        }
        _ => {
            return Err(contents(
                place,
                "state north_m and east_m, or latitude_deg and longitude_deg, or neither to take gps",
            ));
        }
    };
    Ok(StartFix {
        time,
        position,
        standard_deviation: map.standard_deviation_m,
    })
}
