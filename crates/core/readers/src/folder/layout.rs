//! The contents of flight.json; docs/formats.md explains every member.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::clock::TimeFormat;
use pilotage_flight::{CameraFile, OriginFile};

/// Version of the layout that is written.
pub(crate) const VERSION: u32 = 1;

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FlightFile {
    pub pilotage_flight: u32,
    pub name: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// Folder of all other files, relative to flight.json.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub data: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub origin: Option<OriginFile>,
    #[serde(default)]
    pub ground_down_m: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<CameraFile>,
    /// Date and time of second 0 for times with a date.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_origin: Option<String>,
    pub start: StartFile,
    #[serde(default)]
    pub channels: Vec<ChannelFile>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<FramesFile>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truth: Option<TruthFile>,
}

impl FlightFile {
    /// The file of each channel and its times.
    pub fn times_of_channels(&self) -> impl Iterator<Item = (&String, &TimeColumn)> {
        self.channels.iter().map(|map| (&map.file, &map.time))
    }

    /// The file of the frames and their times.
    pub fn times_of_frames(&self) -> impl Iterator<Item = (&String, &TimeColumn)> {
        self.frames.iter().map(|map| (&map.file, &map.time))
    }
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StartFile {
    /// Seconds; the first frame's time if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub north_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub east_m: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub latitude_deg: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub longitude_deg: Option<f64>,
    pub standard_deviation_m: f64,
}

/// Reading of a column of times.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimeColumn {
    pub column: String,
    #[serde(default)]
    pub format: TimeFormat,
    /// Added to every time, seconds.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub offset_s: f64,
}

/// Reading of a column of values: (cell · scale + offset) in `unit`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ValueColumn {
    pub column: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub scale: f64,
    #[serde(default, skip_serializing_if = "is_zero")]
    pub offset: f64,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChannelFile {
    /// A channel's name, or `gps` for latitude and longitude, or `gps_velocity` for speed and course.
    pub name: String,
    pub file: String,
    pub time: TimeColumn,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<ValueColumn>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub latitude: Option<ValueColumn>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub longitude: Option<ValueColumn>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<ValueColumn>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub course: Option<ValueColumn>,
}

impl ChannelFile {
    /// The columns with values that are stated.
    pub fn value_columns(&self) -> impl Iterator<Item = &ValueColumn> {
        let all = [
            &self.value,
            &self.latitude,
            &self.longitude,
            &self.speed,
            &self.course,
        ];
        all.into_iter().flatten()
    }
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FramesFile {
    pub file: String,
    /// Column with the names of the pictures.
    pub name: String,
    pub time: TimeColumn,
    /// Folder of the pictures.
    #[serde(default)]
    pub directory: String,
    /// Clockwise turn of the stored picture by name, degrees.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub stored_turn_deg: BTreeMap<String, f64>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TruthFile {
    /// Series of the true state.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub states: Option<TruthStatesFile>,
    /// True place of each frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frames: Option<TruthFramesFile>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TruthStatesFile {
    pub file: String,
    pub time: TimeColumn,
    pub position: PositionColumns,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attitude: Option<AttitudeColumns>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wind: Option<WindColumns>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TruthFramesFile {
    pub file: String,
    /// Column with the names of the pictures.
    pub name: String,
    pub position: PositionColumns,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub attitude: Option<AttitudeColumns>,
}

/// A position in one of three ways, and its height.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct PositionColumns {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub north: Option<ValueColumn>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub east: Option<ValueColumn>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub latitude: Option<ValueColumn>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub longitude: Option<ValueColumn>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map_pixel: Option<MapPixelColumns>,
    /// Down coordinate in the world frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub down: Option<ValueColumn>,
    /// Height above the ground plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub height: Option<ValueColumn>,
}

/// A place given as pixel of a map picture.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MapPixelColumns {
    pub x: ValueColumn,
    pub y: ValueColumn,
    /// World file or fitted similarity of the map picture.
    pub georeference: String,
    #[serde(default)]
    pub pixel_centres: PixelCentres,
}

/// Coordinates of the centre of the top-left pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum PixelCentres {
    /// At (½, ½).
    #[default]
    HalfIntegers,
    /// At (0, 0), as in OpenCV.
    Integers,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AttitudeColumns {
    pub roll: ValueColumn,
    pub pitch: ValueColumn,
    pub yaw: ValueColumn,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindColumns {
    pub north: ValueColumn,
    pub east: ValueColumn,
}

fn one() -> f64 {
    1.0
}

#[allow(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference; where pointers are short the lint is silent"
)]
fn is_one(value: &f64) -> bool {
    *value == 1.0
}

#[allow(
    clippy::trivially_copy_pass_by_ref,
    reason = "serde asks for a reference; where pointers are short the lint is silent"
)]
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
