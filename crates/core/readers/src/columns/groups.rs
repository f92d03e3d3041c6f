//! Columns that belong together: three along axes, four of a quaternion, told by what their names have in common.

use pilotage_flight::ChannelName;

use super::header::NameParts;
use super::names::is_otherwise;
use super::{ColumnRole, QuaternionPart};
use crate::cells::Dimension;

/// Words that say nothing of what a column measures.
const FILLERS: [&str; 22] = [
    "field",
    "data",
    "value",
    "values",
    "val",
    "measured",
    "measurement",
    "meas",
    "msg",
    "pose",
    "twist",
    "vector",
    "body",
    "raw",
    "filtered",
    "sensor",
    "avg",
    "imu",
    "est",
    "estimated",
    "state",
    "mavros",
];

/// Quantity that three columns along axes (or four of a quaternion) measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GroupQuantity {
    Acceleration,
    Rate,
    Velocity,
    Position,
    Euler,
    Wind,
    Quaternion,
    /// Something that is of no use, such as a magnetic field.
    Other,
}

use GroupQuantity::{Acceleration, Euler, Other, Position, Quaternion, Rate, Velocity, Wind};

/// Words that say it.
const WORDS: [(GroupQuantity, &[&str]); 8] = [
    (
        Other,
        &[
            "mag",
            "magnetometer",
            "field strength",
            "b",
            "magn",
            "force",
            "moment",
            "torque",
            "color",
        ],
    ),
    (Wind, &["wind", "windspeed"]),
    (
        Quaternion,
        &[
            "q",
            "quat",
            "quaternion",
            "orientation",
            "att q",
            "attitude q",
            "attitude",
            "att",
            "quaternions",
        ],
    ),
    (
        Acceleration,
        &[
            "acc",
            "accel",
            "acceleration",
            "accelerometer",
            "accelerations",
            "linear acceleration",
            "specific force",
            "a",
            "f",
            "fb",
            "sf",
        ],
    ),
    (
        Rate,
        &[
            "gyr",
            "gyro",
            "gyros",
            "gyroscope",
            "angular velocity",
            "angular rate",
            "angular",
            "rate",
            "rates",
            "omega",
            "w",
            "wb",
            "body rate",
            "rotation rate",
            "ang vel",
        ],
    ),
    (
        Euler,
        &[
            "euler",
            "rpy",
            "attitude",
            "att",
            "angles",
            "euler angles",
            "orientation",
            "angle",
        ],
    ),
    (
        Velocity,
        &[
            "vel",
            "velocity",
            "v",
            "v rs r",
            "linear",
            "linear velocity",
            "lin vel",
            "speed",
            "velocities",
        ],
    ),
    (
        Position,
        &[
            "pos",
            "position",
            "p",
            "p rs r",
            "xyz",
            "local position",
            "translation",
            "coordinates",
            "ned",
        ],
    ),
];

impl GroupQuantity {
    /// Roles of a position's columns as ROS has them: east, north, up.
    pub const POSITION_OF_ROS: [Option<(ColumnRole, f64)>; 3] = [
        Some((ColumnRole::Channel(ChannelName::GpsEast), 1.0)),
        Some((ColumnRole::Channel(ChannelName::GpsNorth), 1.0)),
        Some((ColumnRole::Channel(ChannelName::GpsHeight), 1.0)),
    ];

    /// Roles of the columns along the first, second and third axis, and the sign of their values, before anything is
    /// known of the axes: forward, right, down, or north, east, down.
    pub fn roles(self) -> [Option<(ColumnRole, f64)>; 3] {
        use ChannelName as Name;
        let all = |names: [Name; 3]| names.map(|name| Some((ColumnRole::Channel(name), 1.0)));
        match self {
            Acceleration => all([
                Name::AccelerationForward,
                Name::AccelerationRight,
                Name::AccelerationDown,
            ]),
            Rate => all([Name::RollRate, Name::PitchRate, Name::YawRate]),
            Velocity => all([
                Name::GpsVelocityNorth,
                Name::GpsVelocityEast,
                Name::GpsVelocityDown,
            ]),
            Euler => all([Name::Roll, Name::Pitch, Name::Heading]),
            Wind => {
                let [north, east, _] = all([Name::WindNorth, Name::WindEast, Name::WindEast]);
                [north, east, None]
            }
            Position => [
                Some((ColumnRole::Channel(Name::GpsNorth), 1.0)),
                Some((ColumnRole::Channel(Name::GpsEast), 1.0)),
                Some((ColumnRole::Channel(Name::GpsHeight), -1.0)),
            ],
            Quaternion | Other => [None; 3],
        }
    }

    /// Kind that words name; of several the kind whose words stand last.
    fn of(words: &[String], count: usize) -> Option<Self> {
        let found = |(kind, names): &(Self, &[&str])| {
            if (*kind == Quaternion) != (count == 4)
                && *kind != Other
                && (count == 4 || *kind == Quaternion)
            {
                return None;
            }
            let places = names.iter().filter_map(|name| {
                let count = name.split(' ').count();
                let place = words
                    .windows(count)
                    .rposition(|window| window.join(" ") == **name)?;
                (name.len() > 2 || words.len() == count).then_some((place + count, count))
            });
            places.max().map(|place| (place, *kind))
        };
        // Of equals the first.
        let all = WORDS.iter().filter_map(found);
        let best = all.fold(
            None,
            |best: Option<((usize, usize), Self)>, found| match best {
                Some(best) if best.0 >= found.0 => Some(best),
                _ => Some(found),
            },
        );
        best.map(|(_, kind)| kind)
    }
}

/// Columns along the axes of one thing.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColumnGroup {
    /// Quantity that the columns measure, as far as names tell.
    pub kind: Option<GroupQuantity>,
    /// Three columns, or four of a quaternion in the order of their names.
    pub columns: Vec<usize>,
    /// Of a quaternion: whether names say which part is which, the real one first in `columns` then.
    pub is_told: bool,
}

/// Words of a name without those that say nothing of what is measured.
pub(super) fn telling(words: &[String]) -> Vec<String> {
    let tells = |word: &&String| !FILLERS.contains(&word.as_str());
    words.iter().filter(tells).cloned().collect()
}

/// Last words of a file's name, of which a column without a telling name has its meaning: at most three.
pub(super) fn context(file: &str) -> Vec<String> {
    let name = file.rsplit('/').next().unwrap_or(file);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let words: Vec<&str> = stem.rsplit('-').next().map_or_else(Vec::new, |last| {
        last.split(|c: char| !c.is_alphanumeric()).collect()
    });
    let mut words: Vec<String> = words.iter().map(|word| word.to_lowercase()).collect();
    words.retain(|word| !word.is_empty() && !word.bytes().all(|b| b.is_ascii_digit()));
    if words.len() > 3 {
        words.drain(..words.len() - 3);
    }
    words
}

/// Words that names have in common, and the axes' letters with their columns.
type Stem = (Vec<String>, Vec<(char, usize)>);

/// The groups among columns of those names, of which `is_numeric` says that they hold numbers.
pub(super) fn groups(file: &str, names: &[NameParts], is_numeric: &[bool]) -> Vec<ColumnGroup> {
    let file_words = context(file);
    let mut stems: Vec<Stem> = Vec::new();
    for (index, parts) in names.iter().enumerate() {
        // Columns that are only counted are no axes of anything.
        let is_name =
            |(stem, letter): &(Vec<String>, char)| !(stem.is_empty() && letter.is_ascii_digit());
        let component = parts.component().filter(|_| is_numeric[index]);
        let Some((stem, letter)) = component.filter(is_name) else {
            continue;
        };
        match stems.iter_mut().find(|(known, _)| *known == stem) {
            Some((_, columns)) => columns.push((letter, index)),
            None => stems.push((stem, vec![(letter, index)])),
        }
    }
    let group = |(stem, columns): Stem| {
        if is_otherwise(&stem) || is_otherwise(&file_words) {
            return None;
        }
        let letters: String = columns.iter().map(|(letter, _)| *letter).collect();
        let told = telling(&stem);
        let kind = |count| {
            let by_name = GroupQuantity::of(&told, count);
            let by_file = || GroupQuantity::of(&file_words, count);
            match by_name {
                // A velocity in a file of winds is the wind.
                Some(Velocity) if by_file() == Some(Wind) => Some(Wind),
                Some(kind) => Some(kind),
                None if told.is_empty() => by_file(),
                None => None,
            }
        };
        let at = |wanted: &str| -> Option<Vec<usize>> {
            let column = |letter| columns.iter().find(|(l, _)| *l == letter).map(|(_, c)| *c);
            wanted.chars().map(column).collect()
        };
        let four = match letters.len() {
            4 => ["wxyz", "0123", "1234"]
                .iter()
                .find_map(|w| Some((*w, at(w)?))),
            _ => None,
        };
        if let Some((wanted, columns)) = four {
            return Some(ColumnGroup {
                // Parts that are only counted may be the cells of a battery.
                kind: kind(4).or((wanted == "wxyz").then_some(Quaternion)),
                columns,
                is_told: wanted == "wxyz",
            });
        }
        let three = ["xyz", "012", "123"].iter().find_map(|wanted| at(wanted));
        let columns = three.filter(|_| letters.len() == 3)?;
        Some(ColumnGroup {
            kind: kind(3),
            columns,
            is_told: false,
        })
    };
    let mut found: Vec<ColumnGroup> = stems.into_iter().filter_map(group).collect();
    let is_posed = found.iter().any(|g| g.kind == Some(Quaternion));
    for group in found.iter_mut().filter(|g| is_posed && g.kind.is_none()) {
        // A translation beside a rotation, as trajectories have them.
        let stem = names[group.columns[0]].component().map(|(stem, _)| stem);
        group.kind = stem.is_some_and(|stem| stem == ["t"]).then_some(Position);
    }
    // What is stated in metres is no turn rate, whatever it agrees with.
    let is_length = |at: &usize| names[*at].unit(Dimension::Length).is_some();
    found.retain(|g| g.kind.is_some() || !g.columns.iter().all(is_length));
    found
}

/// The roles of a quaternion's parts, the real one first.
pub(super) fn quaternion_roles(is_ros: bool) -> [ColumnRole; 4] {
    QuaternionPart::ALL.map(|part| {
        if is_ros {
            ColumnRole::RosQuaternion(part)
        } else {
            ColumnRole::Quaternion(part)
        }
    })
}
