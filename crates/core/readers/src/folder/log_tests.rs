//! Tables with columns of every kind, and the log that they are.

use std::fmt::Write as _;
use std::sync::Arc;

use super::super::read_flight;
use super::*;
use crate::FlightFolder;
use crate::interpret::log_of_flight;
use crate::log::TopicName;
use crate::overview::overview;
use pilotage_base::files::MemoryFiles;

const LAYOUT: &str = r#"{
  "pilotage_flight": 1,
  "name": "East",
  "origin": { "latitude_deg": 47.0, "longitude_deg": 8.0 },
  "start": { "standard_deviation_m": 3 },
  "channels": [
    { "name": "heading", "file": "a/air.csv", "time": { "column": "ms", "format": "ms" },
      "value": { "column": "yaw", "unit": "deg" } },
    { "name": "pitch", "file": "a/air.csv", "time": { "column": "ms", "format": "ms" },
      "value": { "column": "gimbal_pitch", "unit": "deg", "offset": 90 } },
    { "name": "equivalent_airspeed", "file": "a/air.csv", "time": { "column": "ms", "format": "ms" },
      "value": { "column": "ias", "unit": "kt" } },
    { "name": "height_above_ground", "file": "gps.csv", "time": { "column": "s" },
      "value": { "column": "depth", "unit": "m", "scale": -1 } },
    { "name": "gps", "file": "gps.csv", "time": { "column": "s" },
      "latitude": { "column": "lat", "unit": "deg" }, "longitude": { "column": "lon", "unit": "deg" } },
    { "name": "gps_velocity", "file": "gps.csv", "time": { "column": "s" },
      "speed": { "column": "spd", "unit": "m/s" }, "course": { "column": "cog", "unit": "deg" } }
  ],
  "truth": { "states": { "file": "truth.csv", "time": { "column": "t" },
    "position": { "north": { "column": "n" }, "east": { "column": "e" }, "down": { "column": "d" } } } }
}"#;

/// A minute eastward at 20 m/s: attitude at 10 Hz, with a hole from second 20 to second 26, and a fix each second.
fn folder() -> FlightFolder {
    let mut air = "ms,yaw,gimbal_pitch,ias,volts,state\n".to_owned();
    for i in 0..600_u32 {
        if !(200..260).contains(&i) {
            let ias = 38.0 + 0.1 * f64::from(i % 4);
            writeln!(air, "{},90.{},-90,{ias},12.{},on", 100 * i, i % 3, i % 7).unwrap();
        }
    }
    let mut gps = "s,lat,lon,depth,spd,cog\n".to_owned();
    for i in 0..60_u32 {
        let along = 8.0 + f64::from(i) * 20.0 / 76_000.0;
        writeln!(gps, "{i},47.0,{along:.7},-{},20.{},90", 80 + i % 5, i % 2).unwrap();
    }
    let files = [
        ("flight.json", LAYOUT.to_owned()),
        ("a/air.csv", air),
        ("gps.csv", gps),
        (
            "truth.csv",
            "t,n,e,d\n0,0,0,-80\n59,0,1180,-80\n".to_owned(),
        ),
    ];
    let files = files.map(|(name, text)| (name.to_owned(), text.into_bytes()));
    read_flight(Arc::new(MemoryFiles(files.into()))).unwrap()
}

#[test]
fn every_column_of_every_table_is_there_in_its_own_unit() {
    let log = folder().log();
    let names: Vec<String> = log.topics.iter().map(|t| t.name.to_string()).collect();
    assert_eq!(names, ["air", "gps", "truth"]);
    let air = log.topic(&TopicName::single("air")).unwrap();
    let fields: Vec<_> = (air.fields.iter())
        .map(|f| (f.name.as_str(), f.unit.as_str()))
        .collect();
    let expected = [
        ("ms", "ms"),
        ("yaw", "deg"),
        ("gimbal_pitch", "deg"),
        ("ias", "kt"),
        ("volts", ""),
        ("state", ""),
    ];
    assert_eq!(fields, expected);
    assert_eq!((air.len(), air.times[1]), (540, 0.1));
    assert_eq!(air.values("volts").unwrap()[..3], [12.0, 12.1, 12.2]);
    assert_eq!(air.texts("state").unwrap()[539], "on");
    let gps = log.topic(&TopicName::single("gps")).unwrap();
    assert_eq!(gps.values("depth").unwrap()[1], -81.0);
    assert_eq!(log.report.messages, 540 + 60 + 2);
}

#[test]
fn what_was_said_of_columns_makes_them_roles_as_the_flight_has_them() {
    let folder = folder();
    let log = folder.log();
    let of = |role| log.given.iter().find(|s| s.role == role).unwrap();
    let heading = of(Role::Heading);
    assert_eq!(heading.source, "air.yaw");
    assert!((heading.values[1] - 90.1_f64.to_radians()).abs() < 1e-12);
    let pitch = of(Role::Pitch);
    assert!(pitch.is_held && pitch.values.iter().all(|v| v.abs() < 1e-12));
    let knots = of(Role::Airspeed).values[0] / pilotage_base::frames::units::MPS_PER_KNOT;
    assert!((knots - 38.0).abs() < 1e-9);
    assert_eq!(of(Role::HeightAboveGround).values[1], 81.0);
    assert!((of(Role::Longitude).values[0].to_degrees() - 8.0).abs() < 1e-12);
    let east = of(Role::GpsVelocityEast);
    assert_eq!(east.source, "gps.spd, cog");
    assert!((east.values[1] - 20.1).abs() < 1e-12);
    assert_eq!(of(Role::GroundSpeed).values[1], 20.1);
}

#[test]
fn its_overview_tells_rates_a_gap_and_what_can_be_done() {
    let folder = folder();
    let log = folder.log();
    let beside = log_of_flight(&log, &folder.flight);
    let mut seen = overview(&log, &beside.measured());
    let sensor = |role| seen.sensors.iter().find(|s| s.role == role).unwrap();
    assert!((sensor(Role::Heading).rate - 10.0).abs() < 1e-6);
    assert!((sensor(Role::Latitude).rate - 1.0).abs() < 1e-9);
    let gap = sensor(Role::Heading).gaps[0];
    assert!((gap.from - 19.9).abs() < 1e-9 && (gap.to - 26.0).abs() < 1e-9);
    let titles: Vec<&str> = seen.findings.iter().map(|f| f.title.as_str()).collect();
    assert!(
        titles.contains(&"Airspeed and 2 more are missing for 6.1 s"),
        "{titles:?}"
    );
    // What a gimbal holds may rest.
    let is_of_pitch = |t: &&&str| {
        ["Pitch never", "Pitch is stuck"]
            .iter()
            .any(|s| t.starts_with(s))
    };
    assert_eq!(titles.iter().find(is_of_pitch), None);
    assert_eq!(seen.airborne.len(), 1);
    assert!(
        (seen.distance - 59.0 * 20.0).abs() < 5.0,
        "{}",
        seen.distance
    );
    assert_eq!(seen.heights, Some((0.0, 4.0)));
    let can = |seen: &crate::overview::Overview, what: &str| {
        let found = seen.abilities.iter().find(|a| a.what.starts_with(what));
        found.unwrap().lacks.is_none()
    };
    assert!(can(&seen, "Replay without GPS") && can(&seen, "Show the track"));
    assert!(!can(&seen, "Find landmarks") && !can(&seen, "Camera to log"));
    seen.add_pictures(7);
    assert!(can(&seen, "Find landmarks") && can(&seen, "Camera to log"));
}

#[test]
fn tables_of_the_same_name_keep_their_folders_and_words_are_no_numbers() {
    let table = |text: &str| Arc::new(CsvTable::parse("a.csv", text.as_bytes()).unwrap());
    let tables = FlightTables {
        layout: serde_json::from_str(LAYOUT).unwrap(),
        by_file: ["x/a.csv", "y/a.csv", "b.csv"]
            .map(|name| (name.to_owned(), table("t\n0\n")))
            .into(),
        time_origin: None,
        dated: None,
    };
    let names: Vec<String> = tables.topic_names().into_values().collect();
    assert_eq!(names, ["b", "x/a.csv", "y/a.csv"]);
    let odd = table("t,word,none,some\n0,on,,1\n1,off,nan,x\n");
    assert_eq!(odd.numbers("word").unwrap(), None);
    assert!(odd.numbers("none").unwrap().unwrap()[1].is_nan());
    let some = odd.numbers("some").unwrap().unwrap();
    assert!(some[0] == 1.0 && some[1].is_nan());
    assert!(odd.numbers("lost").is_err());
}
