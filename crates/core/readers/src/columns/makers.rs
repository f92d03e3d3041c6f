//! Units and meanings that only the program tells whose names of columns a table has.

use pilotage_flight::ChannelName;

use super::ColumnRole;
use super::header::NameParts;
use super::names::NameGuess;

/// Columns that only one program's tables have all of, and the units and meanings of its columns.
struct Maker {
    has: &'static [&'static str],
    units: &'static [(&'static str, &'static str)],
    roles: &'static [(&'static str, ColumnRole)],
}

/// Height and direction of a receiver that calls them as an aircraft calls its own.
const OF_LOGGER: &[(&str, ColumnRole)] = &[
    ("HEIGHT", ColumnRole::Channel(ChannelName::GpsHeight)),
    ("HEADING", ColumnRole::Course),
    ("SPEED", ColumnRole::SpeedOverGround),
];

/// A height above the place of the take-off.
const ABOVE_START: ColumnRole = ColumnRole::Channel(ChannelName::HeightAboveGround);

/// Columns of Crazyflie, whose axes are those of ROS; its pitch is positive with the nose up all the same.
const OF_CRAZYFLIE: &[(&str, ColumnRole)] = &[
    (
        "stateEstimate.x",
        ColumnRole::Channel(ChannelName::GpsNorth),
    ),
    ("stateEstimate.y", ColumnRole::Channel(ChannelName::GpsEast)),
    ("stateEstimate.z", ABOVE_START),
    (
        "stateEstimate.vx",
        ColumnRole::Channel(ChannelName::GpsVelocityNorth),
    ),
    (
        "stateEstimate.vy",
        ColumnRole::Channel(ChannelName::GpsVelocityEast),
    ),
    (
        "stateEstimate.vz",
        ColumnRole::Channel(ChannelName::GpsVelocityDown),
    ),
    ("stabilizer.yaw", ColumnRole::Channel(ChannelName::Heading)),
    (
        "stateEstimate.yaw",
        ColumnRole::Channel(ChannelName::Heading),
    ),
];
/// Columns of those that count the other way.
const TURNED: [&str; 6] = [
    "vertrate",
    "stateEstimate.y",
    "stateEstimate.vy",
    "stateEstimate.vz",
    "stabilizer.yaw",
    "stateEstimate.yaw",
];

/// Heights of Litchi, in whichever unit.
const OF_LITCHI: &[(&str, ColumnRole)] = &[
    ("altitude(m)", ABOVE_START),
    ("altitude(feet)", ABOVE_START),
];

/// Units in which `SimConnect` gives heights and speeds where nobody asks for others; angles are asked for in either.
const OF_SIM_CONNECT: &[(&str, &str)] = &[
    ("PLANE ALTITUDE", "ft"),
    ("INDICATED ALTITUDE", "ft"),
    ("PLANE ALT ABOVE GROUND", "ft"),
    ("GROUND ALTITUDE", "ft"),
    ("AIRSPEED TRUE", "kt"),
    ("AIRSPEED INDICATED", "kt"),
    ("GROUND VELOCITY", "kt"),
    ("PLANE_ALTITUDE", "ft"),
    ("INDICATED_ALTITUDE", "ft"),
    ("PLANE_ALT_ABOVE_GROUND", "ft"),
    ("GROUND_ALTITUDE", "ft"),
    ("AIRSPEED_TRUE", "kt"),
    ("AIRSPEED_INDICATED", "kt"),
    ("GROUND_VELOCITY", "kt"),
];

const MAKERS: [Maker; 23] = [
    // Variables of SimConnect (Microsoft's simulators), as its manual spells them and as programs in Python do.
    Maker {
        has: &["PLANE LATITUDE", "PLANE LONGITUDE"],
        units: OF_SIM_CONNECT,
        roles: &[],
    },
    Maker {
        has: &["PLANE_LATITUDE", "PLANE_LONGITUDE"],
        units: OF_SIM_CONNECT,
        roles: &[],
    },
    // Receivers of Advanced Navigation.
    Maker {
        has: &["Unix Time", "Microseconds", "Height"],
        units: &[],
        roles: &[("Height", ColumnRole::Channel(ChannelName::GpsHeight))],
    },
    // OpenSky: what transponders tell is the course.
    Maker {
        has: &["icao24", "velocity", "vertrate"],
        units: &[],
        roles: &[
            ("velocity", ColumnRole::SpeedOverGround),
            ("heading", ColumnRole::Course),
            (
                "vertrate",
                ColumnRole::Channel(ChannelName::GpsVelocityDown),
            ),
        ],
    },
    // Crazyflie, with its place or its attitude alone.
    Maker {
        has: &["stateEstimate.x", "stateEstimate.y"],
        units: &[],
        roles: OF_CRAZYFLIE,
    },
    Maker {
        has: &["stabilizer.roll", "stabilizer.yaw"],
        units: &[],
        roles: OF_CRAZYFLIE,
    },
    // Yuneec: its `tas` is the speed over ground.
    Maker {
        has: &["fsk_rssi", "tas", "gps_used"],
        units: &[],
        roles: &[
            ("tas", ColumnRole::SpeedOverGround),
            ("altitude", ABOVE_START),
        ],
    },
    // The receiver in a radio of Yuneec.
    Maker {
        has: &["lon", "lat", "alt", "accuracy", "speed", "angle"],
        units: &[],
        roles: &[("angle", ColumnRole::Course)],
    },
    // The page of sensors of Betaflight's and INAV's configurators.
    Maker {
        has: &["kinematicsX", "kinematicsY", "kinematicsZ"],
        units: &[
            ("kinematicsX", "deg"),
            ("kinematicsY", "deg"),
            ("kinematicsZ", "deg"),
        ],
        roles: &[
            ("kinematicsX", ColumnRole::Channel(ChannelName::Roll)),
            ("kinematicsY", ColumnRole::Channel(ChannelName::Pitch)),
            ("kinematicsZ", ColumnRole::Channel(ChannelName::Heading)),
        ],
    },
    // The track log of FlightAware's pages.
    Maker {
        has: &["Course", "kts", "mph", "feet"],
        units: &[("kts", "kt"), ("feet", "ft")],
        roles: &[],
    },
    // ForeFlight's track log.
    Maker {
        has: &["Altitude", "Speed", "Bank", "Horizontal Error", "g Load"],
        units: &[("Altitude", "ft"), ("Speed", "kt")],
        roles: &[],
    },
    // FlightRadar24.
    Maker {
        has: &["UTC", "Callsign", "Position", "Altitude", "Direction"],
        units: &[("Altitude", "ft"), ("Speed", "kt")],
        roles: &[],
    },
    // The receivers of transponders: dump1090, readsb, tar1090 and ADS-B Exchange.
    Maker {
        has: &["alt_baro", "gs"],
        units: &[
            ("alt_baro", "ft"),
            ("alt_geom", "ft"),
            ("gs", "kt"),
            ("baro_rate", "ft/min"),
            ("geom_rate", "ft/min"),
        ],
        roles: &[],
    },
    // Sky Dolly, of Microsoft's simulator.
    Maker {
        has: &["Altitude", "TrueHeading", "VelocityBodyX"],
        units: &[("Altitude", "ft")],
        roles: &[],
    },
    // RTKLIB, and receivers of Emlid.
    Maker {
        has: &["height(m)", "Q", "ns"],
        units: &[],
        roles: &[("height(m)", ColumnRole::Channel(ChannelName::GpsHeight))],
    },
    // Loggers of Columbus.
    Maker {
        has: &["INDEX", "TAG", "LATITUDE N/S"],
        units: &[("HEIGHT", "m"), ("SPEED", "km/h"), ("HEADING", "deg")],
        roles: OF_LOGGER,
    },
    // Loggers of MediaTek, such as Qstarz and i-Blue.
    Maker {
        has: &["INDEX", "RCR", "VALID"],
        units: &[],
        roles: OF_LOGGER,
    },
    // FlySight.
    Maker {
        has: &["hMSL", "velN", "cAcc"],
        units: &[],
        roles: &[("heading", ColumnRole::Course)],
    },
    // Messages of u-blox, whose `height` is above the ellipsoid.
    Maker {
        has: &["hMSL", "height"],
        units: &[],
        roles: &[("height", ColumnRole::Nothing)],
    },
    // Flights of Litchi.
    Maker {
        has: &["isflying", "velocityX(mps)"],
        units: &[],
        roles: OF_LITCHI,
    },
    Maker {
        has: &["isflying", "home_latitude"],
        units: &[],
        roles: OF_LITCHI,
    },
    // Flights of Parrot's FreeFlight.
    Maker {
        has: &["angle_psi", "product_gps_latitude"],
        units: &[("altitude", "mm")],
        roles: &[("altitude", ABOVE_START)],
    },
    // Phyphox, of phones.
    Maker {
        has: &["Height (m)", "Velocity (m/s)", "Direction (°)"],
        units: &[],
        roles: &[("Height (m)", ColumnRole::Channel(ChannelName::GpsHeight))],
    },
];

/// Radios (`EdgeTX`, `OpenTX`) write the course of the receiver as `Hdg` and the attitude's heading as `Yaw`, beside `Ptch`;
/// without any attitude, of a receiver alone, there is no other heading that `Hdg` beside `GSpd` could be.
pub(super) fn course_of_radio(names: &[NameParts], guesses: &mut [Vec<NameGuess>]) {
    let is = |parts: &NameParts, word: &str| parts.plain_words() == [word];
    let has = |word: &str| names.iter().any(|parts| is(parts, word));
    let has_speed = || {
        names
            .iter()
            .any(|parts| parts.plain_words() == ["g", "spd"])
    };
    let has_attitude = || {
        ["ptch", "pitch", "roll", "yaw"]
            .iter()
            .any(|word| has(word))
    };
    if !(has("ptch") && has("yaw") || has_speed() && !has_attitude()) {
        return;
    }
    let found = names
        .iter()
        .zip(guesses)
        .filter(|(parts, _)| is(parts, "hdg"));
    for (_, guesses) in found {
        *guesses = vec![NameGuess {
            role: ColumnRole::Course,
            sign: 1.0,
            confidence: 0.9,
        }];
    }
}

/// Receivers of phones and loggers call their course a bearing, beside the speed over ground.
pub(super) fn course_of_phone(names: &[NameParts], guesses: &mut [Vec<NameGuess>]) {
    let is_course = |guess: &NameGuess| guess.role == ColumnRole::Course;
    let is_speed = |guess: &NameGuess| guess.role == ColumnRole::SpeedOverGround;
    let has = |is: fn(&NameGuess) -> bool| guesses.iter().any(|of| of.first().is_some_and(is));
    if has(is_course) || !has(is_speed) {
        return;
    }
    for (parts, guesses) in names.iter().zip(guesses) {
        if matches!(parts.plain_words(), [word] if word == "bearing") {
            *guesses = vec![NameGuess {
                role: ColumnRole::Course,
                sign: 1.0,
                confidence: 0.85,
            }];
        }
    }
}

/// Whether a column is a clock that counts in none of the units of times: tenths of milliseconds of Xsens.
pub(super) fn is_clock_of_no_unit(name: &str) -> bool {
    name == "SampleTimeFine"
}

/// Columns whose meaning the program tells, whatever they are called.
pub(super) fn roles<'a>(
    names: impl Iterator<Item = &'a str> + Clone,
    guesses: &mut [Vec<NameGuess>],
) {
    let has = |name: &&str| names.clone().any(|other| other == *name);
    let Some(maker) = MAKERS.iter().find(|maker| maker.has.iter().all(has)) else {
        return;
    };
    for (name, guesses) in names.zip(guesses) {
        if let Some((_, role)) = maker.roles.iter().find(|(known, _)| *known == name) {
            *guesses = vec![NameGuess {
                role: *role,
                sign: if TURNED.contains(&name) { -1.0 } else { 1.0 },
                confidence: 0.9,
            }];
            guesses.retain(|guess| guess.role != ColumnRole::Nothing);
        }
    }
}

/// Takes back the meanings of short names that count only beside others: `q` as a rate beside `p` or `r` (alone it is the
/// quality of a receiver), `velU` as a velocity upwards beside one along north or east (else it is an uncertainty).
pub(super) fn short_names(names: &[NameParts], guesses: &mut [Vec<NameGuess>]) {
    let is = |parts: &NameParts, words: &[&str]| parts.plain_words() == words;
    let has = |words: &[&str]| names.iter().any(|parts| is(parts, words));
    let rates = ["p", "q", "r"].map(|word| has(&[word]));
    let has_rates = rates.into_iter().filter(|has| *has).count() > 1;
    let has_velocity = ["n", "e"].iter().any(|to| has(&["vel", to]));
    let has_short = has(&["vn"]) || has(&["ve"]);
    // Beside one above sea level a height is that above the ellipsoid.
    let has_level = [["msl", "height"], ["height", "msl"]]
        .iter()
        .any(|words| has(words));
    for (parts, guesses) in names.iter().zip(guesses) {
        if has_level && is(parts, &["height"]) {
            guesses.clear();
        }
        let is_rate = ["p", "q", "r"].iter().any(|word| is(parts, &[word]));
        let is_up = is(parts, &["vel", "u"]) && !has_velocity || is(parts, &["vu"]) && !has_short;
        if is_rate && !has_rates || is_up {
            guesses.clear();
        }
    }
}

/// The unit of each column, empty where none is known; no units at all for tables of no program that is known.
pub(super) fn units(names: &[String]) -> Vec<String> {
    let has = |name: &&str| names.iter().any(|other| other == name);
    let maker = MAKERS.iter().find(|maker| maker.has.iter().all(&has));
    maker.map_or_else(Vec::new, |maker| {
        let unit = |name: &String| maker.units.iter().find(|(other, _)| other == name);
        let found = names.iter().map(unit);
        found
            .map(|unit| unit.map_or("", |(_, unit)| unit).to_owned())
            .collect()
    })
}
