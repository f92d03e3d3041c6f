//! Flights told apart by the names of their tables.

use std::collections::{BTreeMap, BTreeSet};

/// Letters between the words of a file's name.
const SEAMS: [char; 4] = ['_', '-', '/', ' '];
/// Share of the fewer tables of two flights that both have.
const ALIKE: f64 = 0.5;

/// Beginnings of the names of the tables of each flight; empty if all may be of one.
///
/// Two flights have tables of the same names but for what they begin with (`one_att`, `one_air`, `two_att`, `two_air`);
/// what tables of one flight have before the last seam may differ in any way (`vehicle_attitude`, `sensor_gps`).
pub(super) fn beginnings_of_flights(names: &[&str]) -> Vec<String> {
    let whole = common(names);
    let mut groups: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for name in names {
        let rest = &name[whole..];
        let word = rest.find(SEAMS).map_or(rest.len(), |end| end + 1);
        groups.entry(&name[..whole + word]).or_default().push(name);
    }
    let flights: Vec<(&str, BTreeSet<String>)> = groups
        .values()
        .filter(|names| names.len() > 1)
        .map(|names| {
            let start = common(names);
            let topics = names.iter().map(|name| name[start..].to_lowercase());
            (&names[0][..start], topics.collect())
        })
        .collect();
    let is_like = |a: &BTreeSet<String>, b: &BTreeSet<String>| {
        let shared = a.intersection(b).count() as f64;
        shared >= ALIKE * a.len().min(b.len()) as f64
    };
    let is_flight = |(start, topics): &&(&str, BTreeSet<String>)| {
        let mut others = flights.iter().filter(|(other, _)| other != start);
        others.any(|(_, other)| is_like(topics, other))
    };
    let found: Vec<String> = flights
        .iter()
        .filter(is_flight)
        .map(|(start, _)| (*start).to_owned())
        .collect();
    if found.len() > 1 { found } else { Vec::new() }
}

/// Length of what all names begin with, up to and with a seam.
fn common(names: &[&str]) -> usize {
    let Some((first, others)) = names.split_first() else {
        return 0;
    };
    let is_common = |end: &usize| others.iter().all(|name| name.starts_with(&first[..*end]));
    let ends = first.match_indices(SEAMS).map(|(at, _)| at + 1);
    ends.rev().find(is_common).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flights_have_tables_of_the_same_names() {
        let of = |names: &[&str]| beginnings_of_flights(names);
        assert_eq!(
            of(&[
                "x/one_att.csv",
                "x/one_air.csv",
                "x/two_att.csv",
                "x/two_air.csv"
            ]),
            ["x/one_", "x/two_"]
        );
        let days = [
            "carbon_2018-07-18-15-53_1-mavros-imu-data.csv",
            "carbon_2018-07-18-15-53_1-mavros-global-fix.csv",
            "carbon_2018-07-18-16-37_2-mavros-imu-data.csv",
            "carbon_2018-07-18-16-37_2-mavros-global-fix.csv",
        ];
        assert_eq!(
            of(&days),
            [
                "carbon_2018-07-18-15-53_1-mavros-",
                "carbon_2018-07-18-16-37_2-mavros-"
            ]
        );
    }

    #[test]
    fn topics_of_one_flight_are_no_flights() {
        let names = [
            "log_vehicle_attitude_0.csv",
            "log_vehicle_gps_position_0.csv",
            "log_vehicle_air_data_0.csv",
            "log_sensor_combined_0.csv",
            "log_sensor_baro_0.csv",
            "log_airspeed_0.csv",
        ];
        assert_eq!(beginnings_of_flights(&names), Vec::<String>::new());
        assert_eq!(beginnings_of_flights(&[]), Vec::<String>::new());
        assert_eq!(beginnings_of_flights(&["a.csv"]), Vec::<String>::new());
    }
}
