//! Tracks that a log holds beside the satellite receiver's of the vehicle that flies.

use super::series::series;
use super::{Navigation, Role, RoleSeries, places};
use crate::log::Log;
use pilotage_base::frames::Geodetic;

/// Most points of a track: more cannot be told apart on a screen.
const MOST: usize = 2000;
/// Roles that places need, and that tell whether a receiver measured them.
const PLACED: [Role; 4] = [
    Role::Latitude,
    Role::Longitude,
    Role::GpsFix,
    Role::AutopilotLatitude,
];

/// A track in a log.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordedTrack {
    /// Whose it is, for people.
    pub name: String,
    /// Times, seconds in the log's time base, and places; at most some thousands.
    pub points: Vec<(f64, Geodetic)>,
}

/// The autopilot's own estimate of the vehicle that flies, and the tracks of other vehicles by their satellite receivers,
/// or by their autopilots where these tell no more; without those that have no place. `found` are the series of the vehicle
/// that flies.
pub fn recorded_tracks(log: &mut Log, found: &[RoleSeries]) -> Vec<RecordedTrack> {
    let mut tracks = Vec::new();
    let mut add = |name: String, points: Vec<(f64, Geodetic)>| {
        let every = points.len().div_ceil(MOST).max(1);
        if !points.is_empty() {
            tracks.push(RecordedTrack {
                name,
                points: points.into_iter().step_by(every).collect(),
            });
        }
    };
    add("Autopilot".to_owned(), places(found, Navigation::Autopilot));
    let own = log.chosen_vehicle();
    for system in log.vehicles.clone() {
        if Some(system) == own {
            continue;
        }
        let track = log.with_vehicle(system, |log| {
            let found: Vec<RoleSeries> = PLACED
                .into_iter()
                .filter_map(|role| series(log, role))
                .collect();
            places(&found, Navigation::Gps)
        });
        add(format!("System {system}"), track);
    }
    tracks
}

#[cfg(test)]
mod tests {
    use super::super::flight::all_series;
    use super::*;
    use crate::log::{FieldKind, FieldLayout, LogFormat, TopicName};

    /// A telemetry log in which the systems send their position, each 0.01° further east.
    fn log_of(systems: &[u32], rows: u32) -> Log {
        let mut log = Log::new("two.tlog", LogFormat::Tlog);
        for system in systems {
            log.vehicles.push(*system);
            for name in ["GPS_RAW_INT", "GLOBAL_POSITION_INT"] {
                let fields = || {
                    let names = ["lat", "lon", "fix_type"];
                    let layout = |(i, name): (usize, &&str)| {
                        FieldLayout::plain(*name, FieldKind::F64, 8 * i)
                    };
                    names.iter().enumerate().map(layout).collect()
                };
                let topic = TopicName {
                    instance: Some(1000 * system + 1),
                    ..TopicName::single(name)
                };
                let place = log.topic_or_new(&topic, fields);
                for row in 0..rows {
                    let (latitude, longitude) =
                        (f64::from(row) * 10.0 + 4.7e8, 1e5 * f64::from(*system));
                    let bytes: Vec<u8> = [latitude, longitude, 3.0]
                        .iter()
                        .flat_map(|v| v.to_le_bytes())
                        .collect();
                    log.topics[place].push(0.2 * f64::from(row), &bytes);
                }
            }
        }
        log
    }

    fn tracks_of(log: &mut Log) -> Vec<RecordedTrack> {
        let found = all_series(log);
        recorded_tracks(log, &found)
    }

    #[test]
    fn the_autopilot_and_the_other_vehicles_have_tracks_of_their_own() {
        let mut log = log_of(&[7, 9, 12], 5000);
        let east = |track: &RecordedTrack| track.points[0].1.longitude.to_degrees();
        let tracks = tracks_of(&mut log);
        let names: Vec<&str> = tracks.iter().map(|track| track.name.as_str()).collect();
        assert_eq!(names, ["Autopilot", "System 9", "System 12"]);
        for (track, expected) in tracks.iter().zip([0.07, 0.09, 0.12]) {
            assert!((east(track) - expected).abs() < 1e-9, "{}", east(track));
            assert!(track.points.len() <= MOST && track.points.len() > MOST / 2);
        }
        log.choose_vehicle(9).unwrap();
        let names: Vec<String> = tracks_of(&mut log)
            .into_iter()
            .map(|track| track.name)
            .collect();
        assert_eq!(names, ["Autopilot", "System 7", "System 12"]);
        assert_eq!(log.chosen_vehicle(), Some(9));
    }

    #[test]
    fn a_log_without_places_has_no_track() {
        let mut log = Log::new("empty.bin", LogFormat::Dataflash);
        assert_eq!(tracks_of(&mut log), []);
    }
}
