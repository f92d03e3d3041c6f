//! Round trips, somebody else's files, and broken ones.

use std::sync::Arc;

use nalgebra::{Point3, Vector2};
use proptest::prelude::*;

use super::*;
use pilotage_base::files::MemoryFiles;
use pilotage_base::frames::{Attitude, Geodetic, GroundPoint, LocalFrame};
use pilotage_flight::{
    Channel, ChannelName, Flight, Frame, FrameError, FrameSource, FrameTruth, StartFix, Truth,
    TruthState,
};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::raster::Picture;

struct Gray;

impl FrameSource for Gray {
    fn picture(&mut self, index: usize) -> Result<Picture, FrameError> {
        Ok(Picture::filled(4, 3, [index as u8; 3]))
    }

    fn encoded(&mut self, index: usize) -> Result<Vec<u8>, FrameError> {
        let mut bytes = std::io::Cursor::new(Vec::new());
        image::RgbImage::from_pixel(4, 3, image::Rgb([index as u8; 3]))
            .write_to(&mut bytes, image::ImageFormat::Png)
            .unwrap();
        Ok(bytes.into_inner())
    }
}

fn flight() -> Flight {
    let times: Vec<f64> = (0..30).map(|i| f64::from(i) / 20.0).collect();
    let channel = |name, f: &dyn Fn(f64) -> f64| Channel {
        name,
        values: times.iter().map(|t| f(*t)).collect(),
        times: times.clone(),
    };
    Flight {
        name: "Somewhere, \"else\"".to_owned(),
        frame_on_globe: Some(LocalFrame::new(Geodetic::from_degrees(45.0, -30.0, 12.0))),
        camera: CameraModel::pinhole(640, 480, 1.0),
        ground_down: 0.25,
        channels: vec![
            channel(ChannelName::Airspeed, &|t| 18.0 + t.sin() / 3.0),
            channel(ChannelName::Heading, &|t| 3.0 * t.cos()),
            Channel {
                name: ChannelName::GpsNorth,
                times: vec![0.0, 1.0 / 3.0],
                values: vec![1e-7, -4.2],
            },
        ],
        frames: (0..3)
            .map(|i| Frame {
                time: 0.5 * f64::from(i),
                name: format!("a {i}.png"),
                stored_turn: if i == 1 { std::f64::consts::PI } else { 0.0 },
            })
            .collect(),
        start: StartFix {
            time: 0.0,
            position: GroundPoint::new(1.0 / 7.0, -3.0),
            standard_deviation: 3.0,
        },
        truth: Some(Truth {
            states: times
                .iter()
                .map(|t| TruthState {
                    time: *t,
                    position: Point3::new(18.0 * t, 0.1, -100.0 / 3.0),
                    attitude: Some(Attitude::level(0.3 + t / 7.0)),
                    wind: (*t < 1.0).then(|| Vector2::new(3.0, -1.0 / 3.0)),
                })
                .collect(),
            frames: (0..3)
                .map(|i| FrameTruth {
                    position: Point3::new(f64::from(i) / 9.0, 2.0, -33.0),
                    camera_attitude: (i != 2).then(|| Attitude::level(0.1)),
                })
                .collect(),
        }),
    }
}

fn written() -> MemoryFiles {
    let mut files = MemoryFiles::default();
    write_flight(&flight(), Some(&mut Gray), &mut files, &mut |_, _| true).unwrap();
    files
}

fn error_of(files: MemoryFiles) -> FolderError {
    match read_flight(Arc::new(files)) {
        Ok(_) => panic!("read although broken"),
        Err(e) => e,
    }
}

#[test]
fn a_flight_survives_the_folder_to_the_bit() {
    let mut folder = read_flight(Arc::new(written())).unwrap();
    assert_eq!(folder.flight, flight());
    assert!(folder.notes.is_empty(), "{:?}", folder.notes);
    assert_eq!(folder.frames.picture(2).unwrap().get(0, 0), [2; 3]);
    assert_eq!(folder.frames.picture(3), Err(FrameError::OutOfRange(3)));
}

#[test]
fn a_flight_is_found_in_a_folder_inside_the_dropped_set() {
    let inside = MemoryFiles(
        written()
            .0
            .into_iter()
            .map(|(name, bytes)| (format!("some/where/{name}"), bytes))
            .collect(),
    );
    let mut folder = read_flight(Arc::new(inside)).unwrap();
    assert_eq!(folder.flight, flight());
    assert!(folder.frames.picture(0).is_ok());
}

#[test]
fn a_missing_picture_is_told_only_when_it_is_asked_for() {
    let mut files = written();
    files.0.remove("frames/a 1.png");
    let mut folder = read_flight(Arc::new(files)).unwrap();
    assert!(folder.frames.picture(0).is_ok());
    let wrong = folder.frames.picture(1).unwrap_err();
    assert_eq!(wrong.to_string(), "frames/a 1.png: the file is missing");
}

/// A table with knots, degrees, feet and dates, as another program might write it.
fn foreign(map: &str) -> MemoryFiles {
    let json = format!(
        r#"{{
  "pilotage_flight": 1,
  "name": "foreign",
  "data": "logs",
  "origin": {{ "latitude_deg": 46.0, "longitude_deg": 7.0 }},
  "camera": {{ "width": 1600, "height": 900, "focal_px": 966.4 }},
  "start": {{ "standard_deviation_m": 3 }},
  "channels": [
    {{ "name": "gps", "file": "log.csv", "time": {{ "column": "when", "format": "iso" }},
      "latitude": {{ "column": "lat" }}, "longitude": {{ "column": "lon" }} }},
    {{ "name": "airspeed", "file": "log.csv", "time": {{ "column": "when", "format": "iso" }},
      "value": {{ "column": "ias", "unit": "kt" }} }},
    {{ "name": "heading", "file": "log.csv", "time": {{ "column": "when", "format": "iso" }},
      "value": {{ "column": "hdg", "unit": "deg", {map} }} }}
  ]
}}"#
    );
    let log = "when,lat,lon,ias,hdg\n\
               2020-01-01T00:00:10Z,46.001,7.0,20,90\n\
               2020-01-01T00:00:10.5Z,46.002,7.0,,350\n";
    MemoryFiles(
        [
            ("flight.json".to_owned(), json.into_bytes()),
            ("logs/log.csv".to_owned(), log.as_bytes().to_vec()),
        ]
        .into(),
    )
}

#[test]
fn somebody_elses_table_is_read_where_it_lies() {
    let folder = read_flight(Arc::new(foreign("\"scale\": -1, \"offset\": 100"))).unwrap();
    let flight = &folder.flight;
    let heading = flight.channel(ChannelName::Heading).unwrap();
    assert_eq!(heading.times, [0.0, 0.5]);
    assert!((heading.values[0] - 10.0_f64.to_radians()).abs() < 1e-12);
    assert!((heading.values[1] - 110.0_f64.to_radians()).abs() < 1e-12);
    let airspeed = flight.channel(ChannelName::Airspeed).unwrap();
    assert_eq!(airspeed.values.len(), 1);
    assert!((airspeed.values[0] - 10.2889).abs() < 1e-3);
    // One thousandth of a degree of latitude is 111.15 m at 46 degrees.
    assert!((flight.start.position.north - 111.15).abs() < 0.02);
    assert_eq!(
        folder.notes,
        ["airspeed: 1 of 2 samples is empty and was skipped"]
    );
}

#[test]
fn every_channel_has_a_key_and_a_unit_and_survives_the_folder() {
    let mut all = flight();
    all.channels = ChannelName::ALL
        .into_iter()
        .map(|name| Channel {
            name,
            times: vec![0.0, 0.1],
            values: vec![0.1, -1.0 / 3.0],
        })
        .collect();
    let mut files = MemoryFiles::default();
    write_flight(&all, Some(&mut Gray), &mut files, &mut |_, _| true).unwrap();
    let read = read_flight(Arc::new(files)).unwrap().flight;
    assert_eq!(read, all);
    let mut keys: Vec<&str> = ChannelName::ALL.iter().map(|name| name.key()).collect();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), ChannelName::ALL.len());
}

#[test]
fn a_log_without_pictures_needs_no_camera_and_gives_velocity_as_speed_and_course() {
    let json = r##"{
      "pilotage_flight": 1, "name": "log", "start": { "north_m": 0, "east_m": 0, "standard_deviation_m": 3 },
      "channels": [
        { "name": "gps_velocity", "file": "gps.txt", "time": { "column": "#1", "format": "ms" },
          "speed": { "column": "#2" }, "course": { "column": "#3", "unit": "deg" } },
        { "name": "yaw_rate", "file": "gps.txt", "time": { "column": "#1", "format": "ms" },
          "value": { "column": "#4", "unit": "deg/s" } },
        { "name": "acceleration_down", "file": "gps.txt", "time": { "column": "#1", "format": "ms" },
          "value": { "column": "#5", "unit": "g" } }
      ]
    }"##;
    let files = |json: &str| {
        let table = b" 100  10  90  18 -1\n 300  10 180 -18 -1\n".to_vec();
        let json = json.as_bytes().to_vec();
        MemoryFiles(
            [
                ("flight.json".to_owned(), json),
                ("gps.txt".to_owned(), table),
            ]
            .into(),
        )
    };
    let flight = read_flight(Arc::new(files(json))).unwrap().flight;
    let value = |name, time| flight.value(name, time).unwrap();
    assert!((value(ChannelName::GpsVelocityEast, 0.1) - 10.0).abs() < 1e-12);
    assert!((value(ChannelName::GpsVelocityNorth, 0.3) + 10.0).abs() < 1e-12);
    assert!((value(ChannelName::YawRate, 0.1) - 0.1 * std::f64::consts::PI).abs() < 1e-12);
    assert!((value(ChannelName::AccelerationDown, 0.1) + 9.806_65).abs() < 1e-12);
    let wrong = error_of(files(&json.replace("\"course\"", "\"value\""))).to_string();
    assert!(
        wrong.contains("gps_velocity needs \"speed\" and \"course\""),
        "{wrong}"
    );
}

#[test]
fn times_that_cannot_be_seconds_are_read_in_their_unit_and_told() {
    for (per_second, start, unit) in [
        (1e3, 0.0, "milliseconds"),
        (1e6, 5e6, "microseconds"),
        (1e9, 0.0, "nanoseconds"),
        (1e9, 1.7e18, "nanoseconds"),
    ] {
        let row = |i: u32| {
            format!(
                "{:.0},{}\n",
                start + per_second * 0.2 * f64::from(i),
                20 + i % 3
            )
        };
        let table = "stamp,v\n".to_owned() + &(0..100).map(row).collect::<String>();
        let map = r#"{"pilotage_flight": 1, "name": "n", "start": {"north_m": 0, "east_m": 0,
            "standard_deviation_m": 1}, "channels": [{"name": "airspeed", "file": "t.csv",
            "time": {"column": "stamp"}, "value": {"column": "v"}}]}"#;
        let files = [("flight.json", map), ("t.csv", &table)];
        let files = files.map(|(name, text)| (name.to_owned(), text.as_bytes().to_vec()));
        let folder = read_flight(Arc::new(MemoryFiles(files.into()))).unwrap();
        let (first, last) = folder.flight.span();
        assert!(
            (last - first - 19.8).abs() < 1e-5,
            "{unit}: {first} to {last}"
        );
        assert!(folder.notes[0].contains(unit), "{:?}", folder.notes);
    }
}

#[test]
fn what_is_wrong_is_told_with_file_and_place() {
    let edited = |name: &str, from: &str, to: &str| {
        let mut files = foreign("\"scale\": 1");
        let text = String::from_utf8(files.0[name].clone()).unwrap();
        assert!(text.contains(from));
        files
            .0
            .insert(name.to_owned(), text.replacen(from, to, 1).into_bytes());
        error_of(files).to_string()
    };
    let told = [
        edited("flight.json", "\"kt\"", "\"knots\""),
        edited("flight.json", "\"ias\"", "\"tas\""),
        edited("flight.json", "\"start\"", "\"begin\""),
        edited("flight.json", "log.csv", "lag.csv"),
        edited("flight.json", "\"airspeed\"", "\"groundspeed\""),
        edited(
            "flight.json",
            "\"origin\": {",
            "\"origin\": { \"height\": 3,",
        ),
        edited("flight.json", "46.0", "146.0"),
        edited("logs/log.csv", "10.5Z", "09.5Z"),
        edited("logs/log.csv", "350", "three"),
    ];
    let expected = [
        "use one of m/s, kt",
        "log.csv, line 1: there is no column \"tas\"",
        "flight.json, line 7, column 9: unknown field `begin`",
        "lag.csv is missing; flight.json refers to it",
        "channels[1]: \"groundspeed\" is no channel",
        "unknown field `height`",
        "origin: 146 is not a latitude",
        "log.csv, line 3, column \"when\": the time goes back",
        "log.csv, line 3, column \"hdg\": \"three\" is not a number",
    ];
    for (message, part) in told.iter().zip(expected) {
        assert!(message.contains(part), "\"{message}\" lacks \"{part}\"");
    }
    assert_eq!(error_of(MemoryFiles::default()), FolderError::NoFlightFile);
}

proptest! {
    #[test]
    fn broken_files_are_refused_or_read_but_never_panic(
        which in 0_usize..4,
        cut in 0.0_f64..1.0,
        flips in proptest::collection::vec((0.0_f64..1.0, any::<u8>()), 0..6),
        truncate in any::<bool>(),
    ) {
        let mut files = written();
        let name = ["flight.json", "channels-1.csv", "frames.csv", "truth.csv"][which];
        let bytes = files.0.get_mut(name).unwrap();
        for (place, value) in flips {
            let at = (place * bytes.len() as f64) as usize;
            bytes[at] = value;
        }
        if truncate {
            bytes.truncate((cut * bytes.len() as f64) as usize);
        }
        if let Ok(mut folder) = read_flight(Arc::new(files)) {
            let _ = folder.frames.picture(0);
            let _ = folder.flight.attitude(0.3);
        }
    }
}
