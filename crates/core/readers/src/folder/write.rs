//! Writing a flight folder.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::clock::TimeFormat;
use super::files::FLIGHT_FILE;
use super::layout::{
    AttitudeColumns, ChannelFile, FlightFile, FramesFile, PositionColumns, StartFile, TimeColumn,
    TruthFile, TruthFramesFile, TruthStatesFile, VERSION, ValueColumn, WindColumns,
};
use pilotage_base::files::FileSink;
use pilotage_base::frames::Attitude;
use pilotage_base::text::in_quotes;
use pilotage_flight::{
    CameraFile, Channel, ChannelName, Flight, FrameError, FrameSource, FrameTruth, OriginFile,
    Quantity, Truth, TruthState,
};

const FRAMES_TABLE: &str = "frames.csv";
const STATES_TABLE: &str = "truth.csv";
const PICTURES: &str = "frames";

/// Why a flight folder cannot be written.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WriteError {
    /// A file cannot be written.
    #[error("{file} cannot be written: {cause}")]
    File {
        /// File.
        file: String,
        /// Error in words.
        cause: String,
    },
    /// A picture cannot be had.
    #[error(transparent)]
    Frame(#[from] FrameError),
}

fn time_column() -> TimeColumn {
    TimeColumn {
        column: "time_s".to_owned(),
        format: TimeFormat::Seconds,
        offset_s: 0.0,
    }
}

fn value_column(column: &str, unit: &str) -> ValueColumn {
    ValueColumn {
        column: column.to_owned(),
        unit: Some(unit.to_owned()),
        scale: 1.0,
        offset: 0.0,
    }
}

/// Column name and unit of a channel.
fn column_of(name: ChannelName) -> (String, &'static str) {
    let (suffix, unit) = match name.quantity() {
        Quantity::Length => ("m", "m"),
        Quantity::Speed => ("mps", "m/s"),
        Quantity::Angle => ("rad", "rad"),
        Quantity::AngularRate => ("radps", "rad/s"),
        Quantity::Acceleration => ("mps2", "m/s2"),
    };
    (format!("{}_{suffix}", name.key()), unit)
}

/// Writes the flight, and its pictures if there are any, so that reading gives it back to the bit.
///
/// Values stand in SI and radians. `progress` hears how many of how many files are done, and stops
/// the writing between two files by returning `false`.
///
/// ```
/// use std::sync::Arc;
/// use pilotage_base::files::{FileSet, MemoryFiles};
/// use pilotage_readers::{read_flight, write_flight};
/// # use pilotage_base::frames::GroundPoint;
/// # use pilotage_flight::{Channel, ChannelName, Flight, StartFix};
/// # use pilotage_raster::camera::CameraModel;
/// # let channel = |name, value: f64| Channel { name, times: vec![0.0, 0.1], values: vec![value, 1.0 / 3.0] };
/// # let flight = Flight {
/// #     name: "two readings".to_owned(),
/// #     frame_on_globe: None,
/// #     camera: CameraModel::pinhole(640, 480, 1.0),
/// #     ground_down: 0.0,
/// #     channels: vec![channel(ChannelName::Airspeed, 18.0), channel(ChannelName::Heading, 0.2)],
/// #     frames: Vec::new(),
/// #     start: StartFix { time: 0.0, position: GroundPoint::new(0.0, 0.0), standard_deviation: 5.0 },
/// #     truth: None,
/// # };
///
/// let mut files = MemoryFiles::default();
/// write_flight(&flight, None, &mut files, &mut |_, _| true)?;
/// assert!(files.read("flight.json").is_some());
/// // To the last bit.
/// assert_eq!(read_flight(Arc::new(files))?.flight, flight);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_flight(
    flight: &Flight,
    mut frames: Option<&mut dyn FrameSource>,
    sink: &mut dyn FileSink,
    progress: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<(), WriteError> {
    let mut put = |name: &str, bytes: &[u8]| {
        sink.write(name, bytes).map_err(|cause| WriteError::File {
            file: name.to_owned(),
            cause,
        })
    };
    let mut channel_files = Vec::new();
    let groups = groups_of_equal_times(&flight.channels);
    for (i, group) in groups.iter().enumerate() {
        let file = if groups.len() == 1 {
            "channels.csv".to_owned()
        } else {
            format!("channels-{}.csv", i + 1)
        };
        put(&file, channel_table(group).as_bytes())?;
        for channel in group {
            let (column, unit) = column_of(channel.name);
            channel_files.push(ChannelFile {
                name: channel.name.key().to_owned(),
                file: file.clone(),
                time: time_column(),
                value: Some(value_column(&column, unit)),
                ..ChannelFile::default()
            });
        }
    }
    let truth = flight.truth.as_ref();
    if !flight.frames.is_empty() {
        put(FRAMES_TABLE, frame_table(flight).as_bytes())?;
    }
    if let Some(truth) = truth {
        put(STATES_TABLE, state_table(&truth.states).as_bytes())?;
    }
    let layout = layout_of(flight, channel_files);
    let text = serde_json::to_string_pretty(&layout).map_err(|e| WriteError::File {
        file: FLIGHT_FILE.to_owned(),
        cause: e.to_string(),
    })?;
    put(FLIGHT_FILE, text.as_bytes())?;
    if let Some(frames) = &mut frames {
        for (i, frame) in flight.frames.iter().enumerate() {
            if !progress(i, flight.frames.len()) {
                return Ok(());
            }
            put(&format!("{PICTURES}/{}", frame.name), &frames.encoded(i)?)?;
        }
    }
    progress(flight.frames.len(), flight.frames.len());
    Ok(())
}

fn groups_of_equal_times(channels: &[Channel]) -> Vec<Vec<&Channel>> {
    let mut groups: Vec<Vec<&Channel>> = Vec::new();
    for channel in channels {
        match groups.iter_mut().find(|g| g[0].times == channel.times) {
            Some(group) => group.push(channel),
            None => groups.push(vec![channel]),
        }
    }
    groups
}

/// Appends cells as a line; Rust prints the shortest number that reads back to the same bits.
fn line<'a>(table: &mut String, cells: impl IntoIterator<Item = &'a dyn std::fmt::Display>) {
    for (i, cell) in cells.into_iter().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        // Writing into a string cannot fail.
        let _ = write!(table, "{comma}{cell}");
    }
    table.push('\n');
}

fn channel_table(group: &[&Channel]) -> String {
    let names: Vec<String> = group.iter().map(|c| column_of(c.name).0).collect();
    let mut table = format!("time_s,{}\n", names.join(","));
    for (i, time) in group[0].times.iter().enumerate() {
        let values = group.iter().map(|c| &c.values[i] as &dyn std::fmt::Display);
        line(&mut table, std::iter::once(time as _).chain(values));
    }
    table
}

/// Three cells, empty where the attitude is not known.
fn attitude_cells(attitude: Option<&Attitude>) -> String {
    attitude.map_or(",,".to_owned(), |a| {
        format!("{},{},{}", a.roll, a.pitch, a.yaw)
    })
}

fn quoted(name: &str) -> String {
    if name.contains([',', '"', ';', '\n', ' ']) {
        in_quotes(name)
    } else {
        name.to_owned()
    }
}

fn frame_table(flight: &Flight) -> String {
    let truth = frame_truth(flight);
    let mut table = "name,time_s".to_owned();
    if truth.is_some() {
        table += ",true_north_m,true_east_m,true_down_m,true_roll_rad,true_pitch_rad,true_yaw_rad";
    }
    table.push('\n');
    for (i, frame) in flight.frames.iter().enumerate() {
        let name = quoted(&frame.name);
        match truth.map(|t| &t[i]) {
            None => line(&mut table, [&name as _, &frame.time as _]),
            Some(t) => {
                let p = t.position;
                let attitude = attitude_cells(t.camera_attitude.as_ref());
                line(
                    &mut table,
                    [
                        &name as _,
                        &frame.time as _,
                        &p.x as _,
                        &p.y as _,
                        &p.z as _,
                        &attitude as _,
                    ],
                );
            }
        }
    }
    table
}

/// The truth of the frames if it is complete.
fn frame_truth(flight: &Flight) -> Option<&[FrameTruth]> {
    let truth = flight.truth.as_ref()?;
    (!truth.frames.is_empty() && truth.frames.len() == flight.frames.len())
        .then_some(truth.frames.as_slice())
}

fn state_table(states: &[TruthState]) -> String {
    let mut table = "time_s,north_m,east_m,down_m,roll_rad,pitch_rad,yaw_rad,wind_north_mps,\
                     wind_east_mps\n"
        .to_owned();
    for state in states {
        let p = state.position;
        let attitude = attitude_cells(state.attitude.as_ref());
        let wind = state
            .wind
            .map_or(",".to_owned(), |w| format!("{},{}", w.x, w.y));
        line(
            &mut table,
            [
                &state.time as _,
                &p.x as _,
                &p.y as _,
                &p.z as _,
                &attitude as _,
                &wind as _,
            ],
        );
    }
    table
}

fn position_columns(prefix: &str) -> PositionColumns {
    PositionColumns {
        north: Some(value_column(&format!("{prefix}north_m"), "m")),
        east: Some(value_column(&format!("{prefix}east_m"), "m")),
        down: Some(value_column(&format!("{prefix}down_m"), "m")),
        ..PositionColumns::default()
    }
}

fn attitude_columns(prefix: &str) -> AttitudeColumns {
    AttitudeColumns {
        roll: value_column(&format!("{prefix}roll_rad"), "rad"),
        pitch: value_column(&format!("{prefix}pitch_rad"), "rad"),
        yaw: value_column(&format!("{prefix}yaw_rad"), "rad"),
    }
}

fn layout_of(flight: &Flight, channels: Vec<ChannelFile>) -> FlightFile {
    let stored_turn_deg: BTreeMap<String, f64> = flight
        .frames
        .iter()
        .filter(|f| f.stored_turn != 0.0)
        .map(|f| (f.name.clone(), f.stored_turn.to_degrees()))
        .collect();
    let truth_of = |truth: &Truth| TruthFile {
        states: (!truth.states.is_empty()).then(|| TruthStatesFile {
            file: STATES_TABLE.to_owned(),
            time: time_column(),
            position: position_columns(""),
            attitude: Some(attitude_columns("")),
            wind: Some(WindColumns {
                north: value_column("wind_north_mps", "m/s"),
                east: value_column("wind_east_mps", "m/s"),
            }),
        }),
        frames: frame_truth(flight).map(|_| TruthFramesFile {
            file: FRAMES_TABLE.to_owned(),
            name: "name".to_owned(),
            position: position_columns("true_"),
            attitude: Some(attitude_columns("true_")),
        }),
    };
    FlightFile {
        pilotage_flight: VERSION,
        name: flight.name.clone(),
        description: None,
        data: None,
        origin: flight.frame_on_globe.map(|f| OriginFile::of(&f.origin)),
        ground_down_m: flight.ground_down,
        camera: Some(CameraFile::of(&flight.camera)),
        time_origin: None,
        start: StartFile {
            time_s: Some(flight.start.time),
            north_m: Some(flight.start.position.north),
            east_m: Some(flight.start.position.east),
            latitude_deg: None,
            longitude_deg: None,
            standard_deviation_m: flight.start.standard_deviation,
        },
        channels,
        frames: (!flight.frames.is_empty()).then(|| FramesFile {
            file: FRAMES_TABLE.to_owned(),
            name: "name".to_owned(),
            time: time_column(),
            directory: PICTURES.to_owned(),
            stored_turn_deg,
        }),
        truth: flight.truth.as_ref().map(truth_of),
    }
}
