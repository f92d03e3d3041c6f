//! The log that photos are: what each tells of itself, and what that is in navigation.

use super::place::PhotoPlace;
use super::read::Photo;
use super::timed::TimedPhoto;
use crate::folder::of_samples;
use crate::interpret::{Role, RoleSeries};
use crate::log::{Cells, Column, Log, LogFormat};
use pilotage_base::frames::Attitude;
use pilotage_flight::{Channel, ChannelName};

/// Name of the topic of the photos.
const TOPIC: &str = "photos";
/// Fields that become roles, beside others.
const LATITUDE: &str = "latitude";
const LONGITUDE: &str = "longitude";
const ALTITUDE: &str = "altitude";
const HEIGHT: &str = "height_above_take_off";
const DIRECTION: &str = "direction";

/// Reads a number of a photo.
type PhotoNumber = Box<dyn Fn(&Photo) -> Option<f64>>;

/// A number that a photo may tell of itself.
struct ToldNumber {
    name: String,
    unit: &'static str,
    value: PhotoNumber,
}

fn told(
    name: impl Into<String>,
    unit: &'static str,
    value: impl Fn(&Photo) -> Option<f64> + 'static,
) -> ToldNumber {
    ToldNumber {
        name: name.into(),
        unit,
        value: Box::new(value),
    }
}

/// Roll, pitch and yaw of what `of` tells of, degrees.
fn angles(what: &str, of: fn(&Photo) -> Option<Attitude>) -> [ToldNumber; 3] {
    let angle = |name: &str, part: fn(&Attitude) -> f64| {
        told(format!("{what}_{name}"), "deg", move |photo| {
            Some(part(&of(photo)?).to_degrees())
        })
    };
    [
        angle("roll", |a| a.roll),
        angle("pitch", |a| a.pitch),
        angle("yaw", |a| a.yaw),
    ]
}

/// Every number that a photo may tell, in the units of its maker.
fn numbers() -> Vec<ToldNumber> {
    let place = |name, unit, part: fn(&PhotoPlace) -> Option<f64>| {
        told(name, unit, move |photo| part(&photo.place?))
    };
    let length =
        |name, of: fn(&Photo) -> Option<f64>| told(name, "mm", move |photo| Some(1e3 * of(photo)?));
    let mut all = vec![
        place(LATITUDE, "deg", |p| Some(p.latitude.to_degrees())),
        place(LONGITUDE, "deg", |p| Some(p.longitude.to_degrees())),
        place(ALTITUDE, "m", |p| p.altitude),
        told(HEIGHT, "m", |p| p.height_above_take_off),
    ];
    all.extend(angles("gimbal", |p| p.gimbal));
    all.extend(angles("flight", |p| p.aircraft));
    all.push(told(DIRECTION, "deg", |p| Some(p.direction?.to_degrees())));
    all.push(length("focal_length", |p| p.focal_length));
    all.push(length("focal_length_35", |p| p.focal_length_35));
    all.push(told("orientation", "", |p| Some(f64::from(p.orientation))));
    all
}

/// Log of one topic, a row for each photo, with every value that any of them tells; and the series that
/// `channels` have of it.
pub(super) fn log(name: &str, photos: &[TimedPhoto], channels: &[Channel]) -> Log {
    let mut log = Log::new(name, LogFormat::Photos);
    let names = photos.iter().map(|p| p.photo.name.clone()).collect();
    let mut columns = vec![Column {
        name: "file".to_owned(),
        unit: String::new(),
        cells: Cells::Texts(names),
    }];
    columns.extend(numbers().into_iter().filter_map(|told| {
        let value = |p: &TimedPhoto| (told.value)(&p.photo).unwrap_or(f64::NAN);
        let values: Vec<f64> = photos.iter().map(value).collect();
        let is_told = values.iter().any(|value| value.is_finite());
        is_told.then(|| Column {
            name: told.name,
            unit: told.unit.to_owned(),
            cells: Cells::Numbers(values),
        })
    }));
    let times: Vec<_> = photos.iter().map(|p| Some(p.time)).collect();
    log.add_columns(TOPIC, &times, &columns);
    log.utc_at_zero = photos.iter().find_map(|p| {
        let (whole, fraction) = p.photo.taken.filter(|_| p.photo.is_utc)?;
        Some(whole as f64 + fraction - p.time)
    });
    let camera = photos.iter().find(|p| !p.photo.camera.is_empty());
    log.vehicle = camera.map_or_else(String::new, |p| p.photo.camera.clone());
    log.given = given(photos, channels);
    log.report.bytes = photos.iter().map(|p| p.photo.bytes).sum();
    log.report.used_bytes = log.report.bytes;
    log
}

/// Roles of the numbers in navigation: places as they are told, the rest as the flight has it.
fn given(photos: &[TimedPhoto], channels: &[Channel]) -> Vec<RoleSeries> {
    let source = |field: &str| format!("{TOPIC}.{field}");
    let place = |role, field, part: fn(&PhotoPlace) -> f64| {
        let placed = photos.iter().filter_map(|p| Some((p.time, p.photo.place?)));
        let samples = placed.map(|(time, place)| (time, Some(part(&place))));
        RoleSeries::new(role, source(field), samples)
    };
    let of_gimbal = photos.iter().any(|p| p.photo.gimbal.is_some());
    let has_aircraft = photos.iter().any(|p| p.photo.aircraft.is_some());
    let angle = |name: &str| match (of_gimbal, has_aircraft) {
        (true, _) => format!("gimbal_{name}"),
        (false, true) => format!("flight_{name}"),
        (false, false) => DIRECTION.to_owned(),
    };
    let channel = |(role, field, name): (Role, String, ChannelName)| {
        let channel = channels.iter().find(|channel| channel.name == name)?;
        let is_attitude = matches!(role, Role::Heading | Role::Roll | Role::Pitch);
        Some(RoleSeries {
            is_held: of_gimbal && is_attitude,
            ..of_samples(role, source(&field), channel)
        })
    };
    let mut given = vec![
        place(Role::Latitude, LATITUDE, |p| p.latitude),
        place(Role::Longitude, LONGITUDE, |p| p.longitude),
    ];
    let channels = [
        (Role::Heading, angle("yaw"), ChannelName::Heading),
        (Role::Roll, angle("roll"), ChannelName::Roll),
        (Role::Pitch, angle("pitch"), ChannelName::Pitch),
        (
            Role::HeightAboveGround,
            HEIGHT.to_owned(),
            ChannelName::HeightAboveGround,
        ),
        (Role::GpsHeight, ALTITUDE.to_owned(), ChannelName::GpsHeight),
    ];
    given.extend(channels.into_iter().filter_map(channel));
    given.retain(|series| !series.times.is_empty());
    given
}
