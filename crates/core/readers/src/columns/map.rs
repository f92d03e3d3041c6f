//! Meanings of the columns of a table.

use serde::{Deserialize, Serialize};

use super::TableShape;
use pilotage_flight::{ChannelName, Quantity};

/// Reason of a column that names pictures.
pub(super) const OF_PICTURES: &str = "its cells are names of pictures";

/// Meaning of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColumnRole {
    /// Nothing that a flight has a place for.
    Nothing,
    /// When the row was measured; one column has to be it.
    Time,
    /// Latitude by satellite navigation.
    Latitude,
    /// Longitude by satellite navigation.
    Longitude,
    /// Speed over ground by satellite navigation.
    SpeedOverGround,
    /// Direction of the way over ground, clockwise from true north.
    Course,
    /// Part that is added to the time, where seconds and parts of them stand in two columns.
    TimeRest,
    /// Part that is added to the degrees of latitude or longitude, where they stand in several columns.
    AngleRest,
    /// Date and time of the row in universal time, where the time is counted from elsewhere.
    Date,
    /// Latitude and longitude in one cell.
    Place,
    /// Strength of the wind.
    WindSpeed,
    /// Direction that the wind comes from, clockwise from true north, as weather reports have it.
    WindFrom,
    /// A part of the quaternion that turns body axes (forward, right, down) into north, east, down.
    Quaternion(QuaternionPart),
    /// A part of the quaternion that turns body axes (forward, left, up) into east, north, up, as ROS has it.
    RosQuaternion(QuaternionPart),
    /// Velocity over ground along an axis of the body, which the attitude turns to north, east and down.
    BodyVelocity(BodyAxis),
    /// A channel of the flight.
    Channel(ChannelName),
}

/// An axis of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyAxis {
    /// Along the nose.
    Forward,
    /// Along the right wing.
    Right,
    /// Out of the belly.
    Down,
}

impl BodyAxis {
    /// All three in their order.
    pub const ALL: [Self; 3] = [Self::Forward, Self::Right, Self::Down];

    /// The channel that takes its values until the attitude turns all three.
    pub(super) fn channel(self) -> ChannelName {
        match self {
            Self::Forward => ChannelName::GpsVelocityNorth,
            Self::Right => ChannelName::GpsVelocityEast,
            Self::Down => ChannelName::GpsVelocityDown,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Forward => "forward",
            Self::Right => "right",
            Self::Down => "down",
        }
    }
}

/// A part of a quaternion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum QuaternionPart {
    /// The real one.
    W,
    /// Along the first axis.
    X,
    /// Along the second axis.
    Y,
    /// Along the third axis.
    Z,
}

impl QuaternionPart {
    /// All four, the real one first.
    pub const ALL: [Self; 4] = [Self::W, Self::X, Self::Y, Self::Z];

    fn letter(self) -> &'static str {
        match self {
            Self::W => "w",
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

impl ColumnRole {
    /// Every role, in the order in which people read them.
    pub fn all() -> impl Iterator<Item = Self> {
        let first = [
            Self::Nothing,
            Self::Time,
            Self::Latitude,
            Self::Longitude,
            Self::SpeedOverGround,
            Self::Course,
            Self::Place,
            Self::TimeRest,
            Self::WindSpeed,
            Self::WindFrom,
        ];
        // People seldom choose these.
        let last = [Self::AngleRest, Self::Date];
        let parts = QuaternionPart::ALL;
        first
            .into_iter()
            .chain(ChannelName::ALL.map(Self::Channel))
            .chain(parts.map(Self::Quaternion))
            .chain(parts.map(Self::RosQuaternion))
            .chain(BodyAxis::ALL.map(Self::BodyVelocity))
            .chain(last)
    }

    /// Whether several columns of a table may have it.
    pub(super) fn may_be_several(self) -> bool {
        matches!(self, Self::Nothing | Self::TimeRest | Self::AngleRest)
    }

    /// Name for people.
    pub fn label(self) -> String {
        match self {
            Self::Nothing => "not used".to_owned(),
            Self::Time => "time".to_owned(),
            Self::Latitude => "latitude".to_owned(),
            Self::Longitude => "longitude".to_owned(),
            Self::SpeedOverGround => "speed over ground".to_owned(),
            Self::Course => "course over ground".to_owned(),
            Self::Place => "latitude and longitude".to_owned(),
            Self::TimeRest => "part of the time".to_owned(),
            Self::AngleRest => "part of the latitude or longitude".to_owned(),
            Self::Date => "date of the row".to_owned(),
            Self::WindSpeed => "wind speed".to_owned(),
            Self::WindFrom => "wind from".to_owned(),
            Self::Quaternion(part) => format!("attitude quaternion {}", part.letter()),
            Self::RosQuaternion(part) => {
                format!("attitude quaternion {}, ROS axes", part.letter())
            }
            Self::BodyVelocity(axis) => {
                format!("velocity over ground, {} in the body's axes", axis.word())
            }
            Self::Channel(name) => name.key().replace('_', " ").replace("gps", "GPS"),
        }
    }

    /// Quantity that the role measures; `None` for times and for nothing.
    pub fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Nothing
            | Self::Time
            | Self::TimeRest
            | Self::AngleRest
            | Self::Date
            | Self::Quaternion(_)
            | Self::RosQuaternion(_) => None,
            Self::Latitude | Self::Longitude | Self::Place | Self::Course | Self::WindFrom => {
                Some(Quantity::Angle)
            }
            Self::SpeedOverGround | Self::WindSpeed | Self::BodyVelocity(_) => {
                Some(Quantity::Speed)
            }
            Self::Channel(name) => Some(name.quantity()),
        }
    }

    /// Units that a column of it may be in, as a [`MappedColumn`] names them.
    pub fn units(self) -> Vec<&'static str> {
        match self {
            Self::Nothing => Vec::new(),
            Self::Time => super::time::UNITS.to_vec(),
            Self::TimeRest => {
                let parts = super::part_units::CALENDAR.map(|(unit, ..)| unit);
                super::time::UNITS.into_iter().chain(parts).collect()
            }
            Self::AngleRest => super::part_units::ANGLE_UNITS.to_vec(),
            Self::Date => vec![super::time::DATE],
            role => {
                let dimension = role.quantity().map(crate::cells::Dimension::from);
                dimension.map_or_else(Vec::new, crate::cells::Dimension::names)
            }
        }
    }

    /// Factor from a value in `unit` to SI and radians; `None` for a role without quantity, and for units that are
    /// none of its own.
    pub fn factor(self, unit: &str) -> Option<f64> {
        let dimension = crate::cells::Dimension::of(self.quantity()?);
        dimension.factor(Some(unit)).ok()
    }
}

/// Another meaning that a column may have.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Alternative {
    /// Role that the column may have.
    pub role: ColumnRole,
    /// The unit that it would have then.
    pub unit: String,
    /// Likelihood of that role, 0 to 1.
    pub confidence: f64,
}

/// Meaning of one column: (cell · scale + offset) in `unit`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MappedColumn {
    /// Name as the table has it, `#1` for the first of a table without names.
    pub name: String,
    /// Role of the column.
    pub role: ColumnRole,
    /// Unit of its values, one of [`ColumnRole::units`]; empty where there is none.
    pub unit: String,
    /// Factor from cells to that unit, before the offset; -1 turns a sign.
    pub scale: f64,
    /// Offset added after scaling, in that unit.
    pub offset: f64,
    /// Likelihood that this is right, 0 to 1. A choice by people is 1.
    pub confidence: f64,
    /// Why it was guessed, in words.
    pub reason: String,
    /// Other roles that the column may have, the likeliest first.
    pub alternatives: Vec<Alternative>,
}

/// Meanings of the columns of a table, to be corrected by people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColumnMap {
    /// Name of the table's file.
    pub file: String,
    /// Shape of the table as text.
    pub shape: TableShape,
    /// Its columns in their order.
    pub columns: Vec<MappedColumn>,
    /// Rows a second where no column is the time; then rows are that far apart.
    pub rows_per_second: Option<f64>,
    /// Unexpected findings about the columns together, in sentences.
    #[serde(default)]
    pub findings: Vec<String>,
    /// Questions to people about all that nothing in the table tells.
    #[serde(default)]
    pub questions: Vec<String>,
}

impl ColumnMap {
    /// The first column of that role.
    pub fn column(&self, role: ColumnRole) -> Option<&MappedColumn> {
        self.columns.iter().find(|column| column.role == role)
    }

    /// Why no flight can be made of it yet, in words; `None` if one can.
    pub fn lacks(&self) -> Option<String> {
        let has = |role| self.column(role).is_some();
        let twice = self.columns.iter().find(|column| {
            let same = self
                .columns
                .iter()
                .filter(|other| other.role == column.role)
                .count();
            !column.role.may_be_several() && same > 1
        });
        if let Some(column) = twice {
            return Some(format!("two columns are {}", column.role.label()));
        }
        let is_rate = |rate: f64| rate.is_finite() && rate > 0.0;
        if !has(ColumnRole::Time) && !self.rows_per_second.is_some_and(is_rate) {
            if self.columns.iter().any(|c| c.reason == OF_PICTURES) {
                return Some(
                    "no column is the time, and its rows are pictures by their names: add the time of each, or open it in Plan or by `pilotage convert`, where its places are landmarks"
                        .to_owned(),
                );
            }
            return Some(
                "no column is the time; say which, or how many rows a second has".to_owned(),
            );
        }
        for (one, other) in [
            (ColumnRole::Latitude, ColumnRole::Longitude),
            (ColumnRole::SpeedOverGround, ColumnRole::Course),
            (ColumnRole::WindSpeed, ColumnRole::WindFrom),
        ] {
            if has(ColumnRole::Course) && one == ColumnRole::SpeedOverGround && !has(one)
                || one != ColumnRole::SpeedOverGround && has(one) != has(other)
            {
                let (has_one, lacks) = if has(one) { (one, other) } else { (other, one) };
                return Some(format!(
                    "{} is of no use without {}",
                    has_one.label(),
                    lacks.label()
                ));
            }
        }
        let body = |axis| has(ColumnRole::BodyVelocity(axis));
        if BodyAxis::ALL.into_iter().any(body)
            && !(body(BodyAxis::Forward) && body(BodyAxis::Right))
        {
            return Some(
                "a velocity in the body's axes is of no use without both that forward and that to the right"
                    .to_owned(),
            );
        }
        let quaternions: [fn(QuaternionPart) -> ColumnRole; 2] =
            [ColumnRole::Quaternion, ColumnRole::RosQuaternion];
        for of in quaternions {
            let count = QuaternionPart::ALL.iter().filter(|p| has(of(**p))).count();
            if count % 4 != 0 {
                return Some(format!(
                    "a quaternion has four parts, and {count} of them are columns"
                ));
            }
        }
        let is_used = |column: &&MappedColumn| {
            !matches!(
                column.role,
                ColumnRole::Nothing
                    | ColumnRole::Time
                    | ColumnRole::TimeRest
                    | ColumnRole::AngleRest
                    | ColumnRole::Date
            )
        };
        if self.columns.iter().find(is_used).is_none() {
            return Some("no column is recognised as part of a flight".to_owned());
        }
        None
    }
}
