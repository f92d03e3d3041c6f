//! Uses of a flight: those that are possible, and those that are not and why.

use serde::{Deserialize, Serialize};

use super::super::interpret::{MeasuredSeries, Role};
use super::AirDataFit;

const TRACK: &str = "Show the track on the map";
const LANDMARKS: &str = "Find landmarks";
/// Title of the use that puts the camera in time and place; people open it by this name.
const CAMERA: &str = "Camera to log: lag of the pictures, mount and focal length";

/// Something that can or cannot be done with a flight.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ability {
    /// Title of the use, in a few words.
    pub what: String,
    /// Why it cannot be done, or `None` if it can.
    pub lacks: Option<String>,
}

impl Ability {
    fn new(what: &str, lacks: Option<String>) -> Self {
        Self {
            what: what.to_owned(),
            lacks,
        }
    }

    /// Whether it is to put the camera beside its log.
    pub fn is_camera_to_log(&self) -> bool {
        self.what == CAMERA
    }
}

/// Every ability that rests on what was measured, in the order in which people need them, and those that rest on
/// pictures, of which there are none yet.
pub fn abilities(measured: &MeasuredSeries<'_>, air_data: Option<&AirDataFit>) -> Vec<Ability> {
    let has = |role| measured.found.iter().any(|s| s.role == role);
    let trouble = measured.trouble.map(ToString::to_string);
    let missing = |roles: &[Role]| {
        let missing = roles.iter().filter(|role| !has(**role));
        let missing: Vec<String> = missing.map(|role| inside(role.label())).collect();
        let is_one = !missing.is_empty();
        is_one.then(|| format!("There is no {} in it.", missing.join(", no ")))
    };
    let is_placed = !measured.track.is_empty();
    let track = missing(&[Role::Latitude, Role::Longitude]).filter(|_| !is_placed);
    let mut abilities = vec![
        Ability::new("Plot every field against time", None),
        Ability::new(TRACK, track),
        Ability::new(
            "Replay without GPS: airspeed, heading and wind",
            trouble.or_else(|| missing(&[Role::Airspeed])),
        ),
        Ability::new(
            "Estimate the wind",
            missing(&[Role::Airspeed, Role::GpsVelocityNorth]).or_else(|| {
                air_data
                    .is_none()
                    .then(|| "The flight hardly turns.".to_owned())
            }),
        ),
    ];
    abilities.extend(of_pictures(0, is_placed));
    abilities
}

/// A name inside a sentence.
fn inside(label: &str) -> String {
    label.to_lowercase().replace("gps", "GPS")
}

/// Whether an ability is the one to show a track, which there is none of.
pub fn lacks_track(ability: &Ability) -> bool {
    ability.what == TRACK && ability.lacks.is_some()
}

/// Whether an ability is one of [`of_pictures`].
pub fn rests_on_pictures(ability: &Ability) -> bool {
    [LANDMARKS, CAMERA].contains(&ability.what.as_str())
}

/// Uses of so many pictures of a flight, whose place on the globe is known or is not.
pub fn of_pictures(count: usize, is_placed: bool) -> Vec<Ability> {
    let none = "Drop the camera frames of the flight and a map beside it.";
    let no_pictures = (count == 0).then(|| none.to_owned());
    let no_track = (!is_placed)
        .then(|| "There is no track in it that the pictures could be held against.".to_owned());
    vec![
        Ability::new(LANDMARKS, no_pictures.clone()),
        Ability::new(CAMERA, no_pictures.or(no_track)),
    ]
}
