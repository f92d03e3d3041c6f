//! Tables as programs export them: rows of several lengths, axes of simulators, heights of several zeros, clocks of a processor.

use pilotage_flight::{ChannelName, Flight};

use super::ColumnRole::{Channel, Course, SpeedOverGround, Time};
use super::tests::{files, guessed, is};
use super::{ColumnMap, flight_of_tables, guess_table};

/// A moment of a flight round a point at 33.85° S 18.42° E: 10 m/s on 200 m, five rows a second, climbing by half a metre a
/// second from 120 m.
struct Moment {
    time: f64,
    latitude: f64,
    longitude: f64,
    north: f64,
    east: f64,
    up: f64,
    /// Degrees.
    course: f64,
}

fn moments() -> impl Iterator<Item = Moment> {
    (0..600).map(|row| {
        let time = 0.2 * f64::from(row);
        let angle = time / 20.0;
        let (north, east) = (10.0 * angle.cos(), -10.0 * angle.sin());
        Moment {
            time,
            latitude: -33.85 + 200.0 * angle.sin() / 110_914.0,
            longitude: 18.42 + 200.0 * angle.cos() / 92_517.0,
            north,
            east,
            up: 0.5 * time,
            course: east.atan2(north).to_degrees().rem_euclid(360.0),
        }
    })
}

fn table(head: &str, row: impl Fn(usize, &Moment) -> String) -> String {
    let rows = moments().enumerate().map(|(at, it)| row(at, &it) + "\n");
    format!("{head}\n{}", rows.collect::<String>())
}

fn read(text: &str) -> (ColumnMap, Flight) {
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let files = files(&[("a.csv", text)]);
    let flight = flight_of_tables(&files, std::slice::from_ref(&map));
    (map, flight.unwrap().flight)
}

/// Asserts that all rows are there and lie where they were, within what a sphere differs by.
fn assert_places(flight: &Flight, text: &str) {
    let head = text.lines().next();
    let origin = flight.frame_on_globe.unwrap().origin;
    let first = moments().next().unwrap();
    let off = (origin.latitude.to_degrees() - first.latitude).abs();
    assert!(off < 1e-6, "{off} {head:?}");
    let off = (origin.longitude.to_degrees() - first.longitude).abs();
    assert!(off < 1e-6, "{off} {head:?}");
    let north = flight.channel(ChannelName::GpsNorth).unwrap();
    assert_eq!(north.values.len(), 600, "{head:?}");
    let span = north.times[599] - north.times[0];
    assert!((span - 119.8).abs() < 1e-6, "{span} {head:?}");
    for (value, it) in north.values.iter().zip(moments()) {
        assert!((value - 200.0 * (it.time / 20.0).sin()).abs() < 0.1);
    }
}

#[test]
fn names_of_columns_stand_whatever_the_length_of_the_first_rows() {
    let heads = [
        "time,lon,lat,alt,yaw,p,q,event",
        "time,lon,lat,alt,yaw,p,q,event,remark",
        "time,lon,lat,alt,yaw,p,q,Attribute|Value,ConvertDatV3,3.6.1",
    ];
    for head in heads {
        for events in [vec![], vec![0], vec![0, 1, 7, 300]] {
            let text = table(head, |at, it| {
                let event = if events.contains(&at) {
                    ",take-off"
                } else {
                    ""
                };
                format!(
                    "{:.1},{:.8},{:.8},{:.2},{:.1},0,0{event}",
                    it.time,
                    it.longitude,
                    it.latitude,
                    120.0 + it.up,
                    it.course
                )
            });
            let (_, flight) = read(&text);
            assert_places(&flight, &text);
        }
    }
}

#[test]
fn velocities_of_a_simulator_are_along_east_up_and_south() {
    let head = "   _real,_time |   __lat,__deg |   __lon,__deg |   __alt,ftmsl |   __alt,ftagl |   ___vX,__m/s |   ___vY,__m/s |   ___vZ,__m/s | ";
    let text = table(head, |_, it| {
        format!(
            " {:.5} | {:.8} | {:.8} | {:.5} | {:.5} | {:.5} | {:.5} | {:.5} | ",
            it.time,
            it.latitude,
            it.longitude,
            (120.0 + it.up) / 0.3048,
            it.up / 0.3048,
            it.east,
            0.5,
            -it.north
        )
    });
    let (map, flight) = read(&text);
    assert_places(&flight, &text);
    for (name, value) in [
        (
            ChannelName::GpsVelocityNorth,
            moments().map(|it| it.north).collect::<Vec<_>>(),
        ),
        (
            ChannelName::GpsVelocityEast,
            moments().map(|it| it.east).collect(),
        ),
        (ChannelName::GpsVelocityDown, vec![-0.5; 600]),
        (
            ChannelName::GpsHeight,
            moments().map(|it| 120.0 + it.up).collect(),
        ),
        (
            ChannelName::HeightAboveGround,
            moments().map(|it| it.up).collect(),
        ),
    ] {
        let found = &flight.channel(name).unwrap().values;
        let off = found.iter().zip(value).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-3, "{name:?}");
    }
    assert!(!map.findings.join(";").contains("different zeros"));
}

#[test]
fn the_clock_of_a_flight_recorder_is_its_seconds_and_not_its_ticks() {
    let head = "Clock:Tick#,Clock:offsetTime,GPS:dateTimeStamp,IMU_ATTI(0):Longitude,IMU_ATTI(0):Latitude,IMU_ATTI(0):yaw360";
    for has_date in [false, true] {
        let text = table(head, |at, it| {
            let second = at / 5;
            let date = format!("2024-05-13T09:{:02}:{:02}Z", second / 60, second % 60);
            let is_told = has_date && at % 3 == 0;
            format!(
                "{},{:.3},{},{:.8},{:.8},{:.1}",
                900_000 * at,
                it.time,
                if is_told { date.as_str() } else { "" },
                it.longitude,
                it.latitude,
                it.course
            )
        });
        let (map, flight) = read(&text);
        assert_eq!(guessed(&map, "Clock:offsetTime"), is(Time, "s"));
        let heading = Channel(ChannelName::Heading);
        assert_eq!(guessed(&map, "IMU_ATTI(0):yaw360").0, heading);
        assert_places(&flight, &text);
    }
}

#[test]
fn places_of_vbox_are_minutes_of_which_west_is_positive() {
    let head = "File created on 13/05/2024 @ 09:30:15\n\n[header]\nsatellites\ntime\nlatitude\nlongitude\nvelocity {unit}\nheading\nheight\n\n[comments]\nLog rate (Hz) : 5\n\n[column names]\nsats time lat long velocity heading height\n\n[data]";
    for (unit, metres_per_second) in [("kmh", 1.0 / 3.6), ("knots", 1852.0 / 3600.0)] {
        let text = table(&head.replace("{unit}", unit), |_, it| {
            format!(
                "011 {:02.0}{:02.0}{:05.2} {:+014.8} {:+014.8} {:06.2} {:06.2} {:+08.2}",
                9.0,
                (it.time / 60.0).floor(),
                it.time % 60.0,
                60.0 * it.latitude,
                -60.0 * it.longitude,
                10.0 / metres_per_second,
                it.course,
                120.0 + it.up
            )
        });
        let (map, flight) = read(&text);
        assert_places(&flight, &text);
        assert_eq!(guessed(&map, "course [deg]").0, Course);
        let speed = map.column(SpeedOverGround).unwrap();
        let unit = if unit == "kmh" { "km/h" } else { "kt" };
        assert_eq!(speed.unit, unit);
        let height = flight.channel(ChannelName::GpsHeight).unwrap().values[0];
        assert!((height - 120.0).abs() < 0.01, "{height}");
    }
}

#[test]
fn a_height_above_sea_level_goes_before_one_that_does_not_say_its_zero() {
    for (unit, metres) in [("feet", 0.3048), ("m", 1.0)] {
        for is_last in [false, true] {
            let (bare, level) = ("altitude", "altitude_above_seaLevel");
            let names = if is_last {
                [level, bare]
            } else {
                [bare, level]
            };
            let [first, second] = names.map(|name| format!("{name}({unit})"));
            let head = format!(
                "time(millisecond),latitude,longitude,height_above_takeoff({unit}),{first},compass_heading(degrees),{second}"
            );
            let text = table(&head, |_, it| {
                let (up, height) = (it.up / metres, (120.0 + it.up) / metres);
                let [first, second] = if is_last { [height, up] } else { [up, height] };
                format!(
                    "{:.0},{:.8},{:.8},{up:.3},{first:.3},{:.1},{second:.3}",
                    1000.0 * it.time,
                    it.latitude,
                    it.longitude,
                    it.course
                )
            });
            let (_, flight) = read(&text);
            let start = |name| flight.channel(name).unwrap().values[0];
            assert!(
                (start(ChannelName::GpsHeight) - 120.0).abs() < 0.01,
                "{head}"
            );
            assert!(start(ChannelName::HeightAboveGround).abs() < 0.01, "{head}");
        }
    }
}

#[test]
fn heights_of_litchi_count_from_the_start_in_whatever_unit() {
    let speed = "velocityX(mph),velocityY(mph),velocityZ(mph)";
    for heights in [
        &[("feet", 0.3048)][..],
        &[("m", 1.0)],
        &[("feet", 0.3048), ("m", 1.0)],
    ] {
        let names = heights.iter().map(|(unit, _)| format!("altitude({unit})"));
        let names = names.collect::<Vec<_>>().join(",");
        let head = format!(
            "latitude,longitude,{names},time(millisecond),home_latitude,home_longitude,{speed},yaw(deg),isflying"
        );
        let text = table(&head, |_, it| {
            let heights = heights
                .iter()
                .map(|(_, metres)| format!("{:.2}", it.up / metres));
            format!(
                "{:.8},{:.8},{},{:.0},-33.85,18.42,{:.2},{:.2},{:.2},{:.1},1",
                it.latitude,
                it.longitude,
                heights.collect::<Vec<_>>().join(","),
                1000.0 * it.time,
                it.north / 0.44704,
                it.east / 0.44704,
                -0.5 / 0.44704,
                it.course
            )
        });
        let (_, flight) = read(&text);
        assert!(flight.channel(ChannelName::GpsHeight).is_none(), "{names}");
        let above = flight.channel(ChannelName::HeightAboveGround);
        let last = *above.unwrap().values.last().unwrap();
        assert!((last - 59.9).abs() < 0.02, "{names} {last}");
    }
}

#[test]
fn a_radio_without_attitude_writes_the_course_of_its_receiver() {
    let row = |it: &Moment, attitude: &str| {
        format!(
            "2024-05-13,09:{:02.0}:{:06.3},{:.2},{:.1},{:.8} {:.8}{attitude}",
            (it.time / 60.0).floor(),
            it.time % 60.0,
            10.0 * 3600.0 / 1852.0,
            it.course,
            it.latitude,
            it.longitude
        )
    };
    let text = table("Date,Time,GSpd(kts),Hdg(@),GPS", |_, it| row(it, ""));
    let (map, flight) = read(&text);
    assert_eq!(guessed(&map, "Hdg(@)").0, Course);
    let north = flight.channel(ChannelName::GpsVelocityNorth).unwrap();
    assert!((north.values[0] - 10.0).abs() < 0.05);
    // Flight controllers send the heading of the attitude in its place.
    let head = "Date,Time,GSpd(kts),Hdg(@),GPS,Ptch(@),Roll(@)";
    let text = table(head, |at, it| {
        row(it, &format!(",{}.0,{}.0", at % 3, at % 5))
    });
    let heading = Channel(ChannelName::Heading);
    assert_eq!(guessed(&read(&text).0, "Hdg(@)").0, heading);
}

#[test]
fn a_clock_in_every_row_goes_before_a_date_in_some() {
    let text = table("elapsed,lat,lon,alt,yaw,utc", |at, it| {
        let second = at / 5;
        let date = format!("2024-05-13T09:{:02}:{:02}Z", second / 60, second % 60);
        format!(
            "{:.1},{:.8},{:.8},120,{:.1},{}",
            it.time,
            it.latitude,
            it.longitude,
            it.course,
            if at % 5 == 0 { date.as_str() } else { "" }
        )
    });
    let (map, flight) = read(&text);
    assert_eq!(guessed(&map, "elapsed"), is(Time, "s"));
    assert_places(&flight, &text);
}

#[test]
fn a_table_of_photos_without_times_says_that_it_is_one() {
    let head = "imagename,latitude [decimal degrees],longitude [decimal degrees],altitude [meter]";
    let text = table(head, |at, it| {
        format!("DJI_{at:04}.JPG,{:.8},{:.8},150", it.latitude, it.longitude)
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let lacks = map.lacks().unwrap();
    assert!(lacks.contains("pictures by their names"), "{lacks}");
}

#[test]
fn velocities_that_agree_with_the_track_in_part_are_told() {
    let head = "time,lat,lon,alt,yaw,vx,vy,vz";
    for (share, is_told) in [(1.0, false), (0.5, true)] {
        let text = table(head, |_, it| {
            let other = (1.0 - share) * 16.0 * (3.0 * it.time / 20.0).cos();
            format!(
                "{:.1},{:.8},{:.8},{:.2},{:.1},{:.3},{:.3},-0.5",
                it.time,
                it.latitude,
                it.longitude,
                120.0 + it.up,
                it.course,
                it.north,
                share * it.east + other
            )
        });
        let (map, _) = read(&text);
        let told = map.findings.join("; ");
        assert_eq!(told.contains("in part only"), is_told, "{told}");
    }
}

#[test]
fn the_axes_of_a_gyro_are_read_in_one_unit() {
    let text = table("time,lat,lon,alt,yaw,gyroX,gyroY,gyroZ", |_, it| {
        format!(
            "{:.1},{:.8},{:.8},120,{:.1},{:.4},{:.4},{:.4}",
            it.time,
            it.latitude,
            it.longitude,
            it.course,
            0.5 * (1.3 * it.time).sin(),
            0.5 * (1.7 * it.time).cos(),
            150.0 * (1.1 * it.time).sin()
        )
    });
    let (map, _) = read(&text);
    for name in ["gyroX", "gyroY", "gyroZ"] {
        assert_eq!(guessed(&map, name).1, "deg/s", "{name}");
    }
}
