//! What can be done with a flight, and what cannot and why.

use serde::{Deserialize, Serialize};

use super::super::interpret::{Interpreted, Role};
use super::AirDataFit;

/// Something that can or cannot be done with a flight.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ability {
    /// What it is, in a few words.
    pub what: String,
    /// Why it cannot be done, or `None` if it can.
    pub lacks: Option<String>,
}

/// Every ability in the order in which people need them.
pub fn abilities(interpreted: &Interpreted, air_data: Option<&AirDataFit>) -> Vec<Ability> {
    let has = |role| interpreted.found.iter().any(|s| s.role == role);
    let trouble = interpreted.trouble().map(ToString::to_string);
    let missing = |roles: &[Role]| {
        let missing: Vec<&str> = roles
            .iter()
            .filter(|role| !has(**role))
            .map(|role| role.label())
            .collect();
        (!missing.is_empty())
            .then(|| format!("The log has no {}.", missing.join(", no ").to_lowercase()))
    };
    let ability = |what: &str, lacks| Ability {
        what: what.to_owned(),
        lacks,
    };
    vec![
        ability("Plot every field against time", None),
        ability(
            "Show the track on the map",
            missing(&[Role::Latitude, Role::Longitude]),
        ),
        ability(
            "Replay without GPS: airspeed, heading and wind",
            trouble.or_else(|| missing(&[Role::Airspeed])),
        ),
        ability(
            "Estimate the wind",
            missing(&[Role::Airspeed, Role::GpsVelocityNorth]).or_else(|| {
                air_data
                    .is_none()
                    .then(|| "The flight hardly turns.".to_owned())
            }),
        ),
        ability(
            "Find landmarks",
            Some("Drop the camera frames of the flight and a map beside the log.".to_owned()),
        ),
    ]
}
