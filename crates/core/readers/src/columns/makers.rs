//! Units and meanings that only the program tells whose names of columns a table has.

use super::ColumnRole;
use super::header::NameParts;
use super::names::NameGuess;

/// Columns that only one program's tables have all of, and the units of its columns.
struct Maker {
    has: &'static [&'static str],
    units: &'static [(&'static str, &'static str)],
}

const MAKERS: [Maker; 5] = [
    // The track log of FlightAware's pages.
    Maker {
        has: &["Course", "kts", "mph", "feet"],
        units: &[("kts", "kt"), ("feet", "ft")],
    },
    // ForeFlight's track log.
    Maker {
        has: &["Altitude", "Speed", "Bank", "Horizontal Error", "g Load"],
        units: &[("Altitude", "ft"), ("Speed", "kt")],
    },
    // FlightRadar24.
    Maker {
        has: &["UTC", "Callsign", "Position", "Altitude", "Direction"],
        units: &[("Altitude", "ft"), ("Speed", "kt")],
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
    },
    // Sky Dolly, of Microsoft's simulator.
    Maker {
        has: &["Altitude", "TrueHeading", "VelocityBodyX"],
        units: &[("Altitude", "ft")],
    },
];

/// Radios (`EdgeTX`, `OpenTX`) write the course of the receiver as `Hdg` and the attitude's heading as `Yaw`, beside `Ptch`.
pub(super) fn course_of_radio(names: &[NameParts], guesses: &mut [Vec<NameGuess>]) {
    let is = |parts: &NameParts, word: &str| parts.plain_words() == [word];
    if !["ptch", "yaw"]
        .iter()
        .all(|word| names.iter().any(|parts| is(parts, word)))
    {
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
