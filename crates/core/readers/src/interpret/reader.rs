//! Values of the rows of a topic, read as a role's source says.

use nalgebra::{Quaternion, UnitQuaternion};

use super::board_axes::BoardReading;
use super::origin;
use super::source::factor_of_unit;
use crate::log::{FieldKind, FieldLayout, Log, Topic};
use crate::role::{Role, RoleSource, RowReading};

/// Kind of fix from which on a receiver knows its height.
pub(super) const FULL_FIX: f64 = 3.0;
/// `STATUS_UNKNOWN` of ROS.
const UNKNOWN_FIX: f64 = -2.0;

/// Pressures of the ground in hectopascals, which some drivers write in the place of pascals: as these it would be 30 km up.
const HECTOPASCALS: std::ops::Range<f64> = 300.0..1200.0;

/// A field and its factor to SI: the stated unit's, else the one that is usual there. The sign is that of the usual
/// one: no unit tells which way an axis points.
struct Scaled<'a> {
    field: &'a FieldLayout,
    factor: f64,
}

impl<'a> Scaled<'a> {
    fn new(topic: &'a Topic, name: &str, usual: f64) -> Option<Self> {
        let field = topic.field(name).filter(|f| f.kind.is_number())?;
        let known = factor_of_unit(&field.unit);
        let factor = known.map_or(usual, |factor| factor.copysign(usual));
        Some(Self { field, factor })
    }

    /// The value in SI; `None` where it is the largest of its whole numbers, by which MAVLink says that nobody knows it.
    fn value(&self, row: &[u8]) -> Option<f64> {
        let stored = self.field.bytes(row)?;
        let is_short = matches!(self.field.kind, FieldKind::U8 | FieldKind::U16);
        if is_short && stored.iter().all(|byte| *byte == u8::MAX) {
            return None;
        }
        Some(self.field.value(row)? * self.factor)
    }
}

/// Function from a row to a value.
pub(super) type RowValue<'a> = Box<dyn Fn(&[u8]) -> Option<f64> + 'a>;
/// Function from a row to a value, and the name of the fields that it reads.
pub(super) type RowReader<'a> = (RowValue<'a>, String);

pub(super) fn reader<'a>(
    log: &Log,
    source: &RoleSource,
    topic: &'a Topic,
) -> Option<RowReader<'a>> {
    let role = source.role;
    let north = matches!(role, Role::GpsVelocityNorth | Role::WindNorth);
    Some(match source.reading {
        RowReading::Field(name, usual) | RowReading::FieldBeside(name, usual, _) => {
            if let RowReading::FieldBeside(_, _, beside) = source.reading {
                topic.field(beside)?;
            }
            let board = BoardReading::of(topic);
            let mut field = Scaled::new(topic, name, usual)?;
            field.factor = board.factor(role, field.factor);
            let told = board.told(role);
            (
                Box::new(move |row| field.value(row)),
                format!("{name}{told}"),
            )
        }
        RowReading::Quaternion(name) => {
            let part = |i: usize| {
                let called = |name: String| Scaled::new(topic, &name, 1.0);
                called(format!("{name}[{i}]"))
                    .or_else(|| called(format!("{name}{}", i + 1)))
                    .or_else(|| called(format!("{name}{}", ["w", "x", "y", "z"][i])))
            };
            let parts = [part(0)?, part(1)?, part(2)?, part(3)?];
            (angle(role, parts, false), name.to_owned())
        }
        RowReading::RosQuaternion(name) => {
            let part = |part: &str| Scaled::new(topic, &format!("{name}.{part}"), 1.0);
            let parts = [part("w")?, part("x")?, part("y")?, part("z")?];
            let board = BoardReading::of(topic);
            let told = board.told(role);
            (angle(role, parts, !board.is_down), format!("{name}{told}"))
        }
        RowReading::RosFix(name) => {
            let status = Scaled::new(topic, name, 1.0)?;
            // -2 of drivers that do not say.
            let fix = move |row: &[u8]| match status.value(row)? {
                UNKNOWN_FIX => None,
                status => Some(if status < 0.0 { 0.0 } else { FULL_FIX }),
            };
            (Box::new(fix), name.to_owned())
        }
        RowReading::Pressure(name) => {
            let mut pressure = Scaled::new(topic, name, 1.0)?;
            let first = topic.rows.iter().find_map(|row| pressure.value(row));
            let is_in_hundreds = first.is_some_and(|first| HECTOPASCALS.contains(&first));
            if is_in_hundreds {
                pressure.factor *= 100.0;
            }
            let told = if is_in_hundreds { " (in hPa)" } else { "" };
            let height = move |row: &[u8]| Some(standard_height(pressure.value(row)?));
            (Box::new(height), format!("{name}{told}"))
        }
        RowReading::Course(speed, speed_factor, course, course_factor) => {
            let name = format!("{speed}, {course}");
            let speed = Scaled::new(topic, speed, speed_factor)?;
            let course = Scaled::new(topic, course, course_factor)?;
            let part = move |row: &[u8]| {
                let (sin, cos) = course.value(row)?.sin_cos();
                Some(speed.value(row)? * if north { cos } else { sin })
            };
            (Box::new(part), name)
        }
        RowReading::FromOrigin => {
            let origin = origin::origin(log)?;
            let part = |name| Scaled::new(topic, name, 1.0);
            let (north, east, down) = (part("PN")?, part("PE")?, part("PD")?);
            let value = move |row: &[u8]| {
                let (north, east) = (north.value(row)?, east.value(row)?);
                let place = origin::place(&origin, north, east, down.value(row)?);
                Some(match role {
                    Role::AutopilotLatitude => place.latitude,
                    Role::AutopilotLongitude => place.longitude,
                    _ => place.height,
                })
            };
            (Box::new(value), "PN, PE, PD".to_owned())
        }
        RowReading::WindFrom(direction, factor, speed) => {
            let name = format!("{direction}, {speed}");
            let direction = Scaled::new(topic, direction, factor)?;
            let speed = Scaled::new(topic, speed, 1.0)?;
            let part = move |row: &[u8]| {
                let (sin, cos) = direction.value(row)?.sin_cos();
                Some(-speed.value(row)? * if north { cos } else { sin })
            };
            (Box::new(part), name)
        }
    })
}

/// The angle of a role out of the parts of a quaternion, the real one first. That of ROS (`is_ros`) is about the same forward
/// axis, but a left axis and one up in place of right and down, and counts from east.
fn angle(role: Role, parts: [Scaled<'_>; 4], is_ros: bool) -> RowValue<'_> {
    Box::new(move |row| {
        let [w, x, y, z] = [0, 1, 2, 3].map(|i| parts[i].value(row));
        let attitude = UnitQuaternion::try_new(Quaternion::new(w?, x?, y?, z?), 1e-6)?;
        let (roll, pitch, yaw) = attitude.euler_angles();
        Some(match (role, is_ros) {
            (Role::Roll, _) => roll,
            (Role::Pitch, false) => pitch,
            (Role::Pitch, true) => -pitch,
            (_, false) => yaw,
            (_, true) => std::f64::consts::FRAC_PI_2 - yaw,
        })
    })
}

/// Height at which the standard atmosphere (ISO 2533) has a pressure in Pa, metres.
///
/// Where temperature falls by L = 6.5 K/km from T = 288.15 K: p/p₀ = (1 - L h / T)^(g M / (R L)).
fn standard_height(pressure: f64) -> f64 {
    const TEMPERATURE: f64 = 288.15;
    const LAPSE: f64 = 0.0065;
    const EXPONENT: f64 = 5.255_876;
    TEMPERATURE / LAPSE * (1.0 - (pressure / 101_325.0).powf(1.0 / EXPONENT))
}
