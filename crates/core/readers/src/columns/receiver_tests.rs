//! Tables of satellite receivers and of what computes positions of their observations, as each program writes them.

use std::f64::consts::TAU;
use std::fmt::Write;

use nalgebra::Vector3;
use pilotage_base::frames::{Ellipsoid, Geodetic};
use pilotage_flight::{ChannelName, Flight};

use super::ColumnRole::{Channel, Course, Nothing, SpeedOverGround, Time};
use super::tests::{files, guessed, is};
use super::{ColumnMap, flight_of_tables, guess_table};

/// A moment of a winding flight in the south and west.
struct Fix {
    time: f64,
    latitude: f64,
    longitude: f64,
    height: f64,
    /// North, east and up, m/s.
    velocity: [f64; 3],
}

/// A fix each fifth of a second for a minute; heights rise and fall about 620 m.
fn fixes() -> Vec<Fix> {
    let (mut north, mut east, mut height) = (0.0, 0.0, 620.0);
    let fix = |i: usize| {
        let time = 0.2 * i as f64;
        let course = 0.7 + (TAU * time / 45.0).sin();
        let speed = 14.0 + 2.0 * (time / 5.0).sin();
        let velocity = [
            speed * course.cos(),
            speed * course.sin(),
            (time / 4.0).sin(),
        ];
        let found = Fix {
            time,
            latitude: -33.85 + north / 110_921.0,
            longitude: -0.42 + east / 92_560.0,
            height,
            velocity,
        };
        north += 0.2 * velocity[0];
        east += 0.2 * velocity[1];
        height += 0.2 * velocity[2];
        found
    };
    (0..300).map(fix).collect()
}

/// Date and time of day with that between them and within the date.
fn moment(fix: &Fix, within: &str, between: &str) -> String {
    let seconds = fix.time % 60.0;
    format!("2024{within}05{within}13{between}10:00:{seconds:06.3}")
}

/// A table with those lines before a row for each fix.
fn table(head: &str, row: impl Fn(&Fix) -> String) -> String {
    let mut table = head.to_owned();
    for fix in fixes() {
        writeln!(table, "{}", row(&fix)).unwrap();
    }
    table
}

fn flight(table: &str) -> (ColumnMap, Flight) {
    let map = guess_table("a.csv", table.as_bytes()).unwrap();
    let files = files(&[("a.csv", table)]);
    let flight = flight_of_tables(&files, std::slice::from_ref(&map)).unwrap();
    (map, flight.flight)
}

/// Values of a channel.
#[track_caller]
fn values(flight: &Flight, name: ChannelName) -> &[f64] {
    let found = flight.channels.iter().find(|c| c.name == name);
    &found.unwrap_or_else(|| panic!("no {name:?}")).values
}

/// Places to 1e-6 degrees and heights above the sea, row by row.
#[track_caller]
fn assert_flown(flight: &Flight, height_tolerance: f64) {
    let world = flight.frame_on_globe.unwrap();
    let [north, east, height] = [
        ChannelName::GpsNorth,
        ChannelName::GpsEast,
        ChannelName::GpsHeight,
    ]
    .map(|name| values(flight, name));
    let fixes = fixes();
    assert_eq!(north.len(), fixes.len());
    for (i, fix) in fixes.iter().enumerate() {
        let place = Geodetic::from_degrees(fix.latitude, fix.longitude, 0.0);
        let expected = world.world_from_geodetic(&place);
        assert!(
            (north[i] - expected.x).abs() < 0.1,
            "row {i}: {} {}",
            north[i],
            expected.x
        );
        assert!(
            (east[i] - expected.y).abs() < 0.1,
            "row {i}: {} {}",
            east[i],
            expected.y
        );
        assert!((height[i] - fix.height).abs() < height_tolerance, "row {i}");
    }
}

const QUALITY: &str = "1 12 0.0120 0.0090 0.0300 0.0010 0.0010 0.0010 0.80 20.5";

#[test]
fn positions_of_rtklib_are_read_in_degrees_minutes_and_seconds_and_geocentric() {
    let head = |names: &str| {
        format!(
            "% program   : RTKPOST ver.2.4.3 b34\n% ref pos   : -33.841210525  -0.411228361   600.0251\n%\n%  GPST  {names}  Q  ns  \
             sdn(m)  sde(m)  sdu(m)  sdne(m)  sdeu(m)  sdun(m) age(s)  ratio"
        )
    };
    let angle = |degrees: f64| {
        let seconds = degrees.abs() * 3600.0;
        let (whole, rest) = ((seconds / 3600.0).floor(), seconds % 3600.0);
        let sign = if degrees < 0.0 { "-" } else { "" };
        format!(
            "{sign}{whole} {:02} {:08.5}",
            (rest / 60.0).floor(),
            rest % 60.0
        )
    };
    let degrees = head("latitude(d'\")   longitude(d'\")  height(m)") + "\n";
    let degrees = table(&degrees, |fix| {
        format!(
            "{}  {}  {}  {:.4} {QUALITY}",
            moment(fix, "/", " "),
            angle(fix.latitude),
            angle(fix.longitude),
            fix.height
        )
    });
    let geocentric = head("x-ecef(m)  y-ecef(m)  z-ecef(m)") + "  vx(m/s)  vy(m/s)  vz(m/s)\n";
    let geocentric = table(&geocentric, |fix| {
        let [latitude, longitude] = [fix.latitude, fix.longitude].map(f64::to_radians);
        let Vector3 { data, .. } = Ellipsoid::WGS84.geocentric(latitude, longitude, fix.height);
        let [[x, y, z]] = data.0;
        let moment = moment(fix, "/", " ");
        format!("{moment}  {x:.4}  {y:.4}  {z:.4} {QUALITY} 1.0 2.0 3.0")
    });
    for table in [&degrees, &geocentric] {
        let (map, flight) = flight(table);
        assert_flown(&flight, 0.001);
        // The quality of a position is no rate of pitch.
        assert_eq!(guessed(&map, "Q").0, Nothing);
        assert!(map.questions.is_empty(), "{:?}", map.questions);
    }
}

#[test]
fn a_rate_of_one_letter_stands_beside_another() {
    let rates = table("time,lat,lon,alt,p,q,r\n", |fix| {
        let rate = 0.1 * (fix.time / 3.0).sin();
        format!(
            "{:.1},{:.7},{:.7},{:.2},{rate:.4},{rate:.4},{rate:.4}",
            fix.time, fix.latitude, fix.longitude, fix.height
        )
    });
    let map = guess_table("a.csv", rates.as_bytes()).unwrap();
    assert_eq!(guessed(&map, "q").0, Channel(ChannelName::PitchRate));
    let map = guess_table("a.csv", rates.replace("p,q,r", "d,q,ns").as_bytes()).unwrap();
    assert_eq!(guessed(&map, "q").0, Nothing);
}

#[test]
fn the_track_of_a_flysight_is_a_table() {
    let head = "$FLYS,1\r\n$VAR,FIRMWARE_VER,v2023.09.22.2\r\n$VAR,DEVICE_ID,0019\r\n$COL,GNSS,time,lat,lon,hMSL,velN,velE,velD,hAcc,vAcc,\
                sAcc,numSV\r\n$UNIT,GNSS,,deg,deg,m,m/s,m/s,m/s,m,m,m/s,\r\n$DATA\r\n";
    let table = table(head, |fix| {
        let [north, east, up] = fix.velocity;
        format!(
            "$GNSS,{}Z,{:.7},{:.7},{:.3},{north:.2},{east:.2},{:.2},1.5,2.5,0.25,12\r",
            moment(fix, "-", "T"),
            fix.latitude,
            fix.longitude,
            fix.height,
            -up
        )
    });
    let (_, flight) = flight(&table);
    assert_flown(&flight, 0.001);
    let down = values(&flight, ChannelName::GpsVelocityDown);
    assert!((down[30] + fixes()[30].velocity[2]).abs() < 0.006);
}

#[test]
fn loggers_fill_cells_up_with_zeros_and_call_the_course_a_heading() {
    let head = "INDEX,TAG,DATE,TIME,LATITUDE N/S,LONGITUDE E/W,HEIGHT,SPEED,HEADING,VOX\r\n";
    let rows = table("", |fix| {
        let [north, east, _] = fix.velocity;
        let course = east.atan2(north).to_degrees().rem_euclid(360.0);
        format!(
            "1\0\0\0\0\0,T,240513,1000{:02},{:09.6}S,{:010.6}W,{:.0}\0\0,{:.0}\0\0,{course:.0}\0,\0\0\0\r",
            fix.time.floor(),
            -fix.latitude,
            -fix.longitude,
            fix.height,
            3.6 * north.hypot(east)
        )
    });
    // One row a second.
    let rows = rows.lines().step_by(5);
    let table = rows.fold(head.to_owned(), |table, row| table + row + "\n");
    let (map, flight) = flight(&table);
    assert_eq!(
        ["HEIGHT", "SPEED", "HEADING"].map(|name| guessed(&map, name)),
        [
            is(Channel(ChannelName::GpsHeight), "m"),
            is(SpeedOverGround, "km/h"),
            is(Course, "deg")
        ]
    );
    assert_eq!(values(&flight, ChannelName::GpsHeight).len(), 60);
    assert!((values(&flight, ChannelName::GpsHeight)[4] - fixes()[20].height).abs() < 0.51);
}

#[test]
fn units_in_brackets_stand_below_their_names_where_some_have_none() {
    let head = "Program:     Inertial Explorer Version 8.90\nDatum:       WGS84\n\n     SeqNum     UTCTime       Latitude      Longitude        H-Ell     \
                VEast    VNorth       VUp Q\n                  (sec)          (deg)          (deg)          (m)    (km/h)    (km/h)    (km/h)\n";
    let table = table(head, |fix| {
        let [north, east, up] = fix.velocity.map(|v| 3.6 * v);
        format!(
            "{} {:.3} {:.10} {:.10} {:.3} {east:.3} {north:.3} {up:.3} 1",
            (5.0 * fix.time).round() + 1.0,
            122_382.0 + fix.time,
            fix.latitude,
            fix.longitude,
            fix.height
        )
    });
    let (map, flight) = flight(&table);
    assert_flown(&flight, 0.001);
    assert_eq!(
        guessed(&map, "VUp"),
        is(Channel(ChannelName::GpsVelocityDown), "km/h")
    );
    let down = values(&flight, ChannelName::GpsVelocityDown);
    assert!((down[30] + fixes()[30].velocity[2]).abs() < 0.001);
    assert_eq!(guessed(&map, "Q").0, Nothing);
}

#[test]
fn tabulators_in_a_row_are_empty_cells() {
    let head = "// General information: \n//  MT Manager version: 2022.2.0 \n// Coordinate system: NED\nPacketCounter\tYear\tMonth\tDay\t\
                Second\ttime [s]\tLatitude\tLongitude\tAltitude\n";
    let table = table(head, |fix| {
        format!(
            "{:.0}\t\t\t\t\t{:.1}\t{:.9}\t{:.9}\t{:.6}",
            51_400.0 + 5.0 * fix.time,
            fix.time,
            fix.latitude,
            fix.longitude,
            fix.height
        )
    });
    let (_, flight) = flight(&table);
    assert_flown(&flight, 0.001);
}

#[test]
fn an_uncertainty_of_velocity_is_no_velocity_upwards() {
    let head =
        "timeGpsTow,timeGpsWeek,yaw,posLat,posLon,posAlt,velNedN,velNedE,velNedD,attU,posU,velU\n";
    let table = table(head, |fix| {
        let [north, east, up] = fix.velocity;
        format!(
            "{:.3},2314,{:.2},{:.8},{:.8},{:.3},{north:.3},{east:.3},{:.3},0.1,1.0,0.05",
            122_400.0 + fix.time,
            east.atan2(north).to_degrees(),
            fix.latitude,
            fix.longitude,
            fix.height,
            -up
        )
    });
    let (map, flight) = flight(&table);
    assert_flown(&flight, 0.001);
    assert_eq!(guessed(&map, "velU").0, Nothing);
    let down = values(&flight, ChannelName::GpsVelocityDown);
    assert!((down[30] + fixes()[30].velocity[2]).abs() < 0.001);
}

#[test]
fn nanoseconds_belong_to_the_seconds_beside_them_and_ticks_are_no_milliseconds() {
    let of_xsens = |clock: &str| {
        let head =
            format!("PacketCounter\tSampleTimeFine\t{clock}\tLatitude\tLongitude\tAltitude\n");
        table(&head, |fix| {
            let clock = match clock {
                "" => String::new(),
                _ => format!(
                    "2024\t5\t13\t10\t0\t{}\t{:.0}",
                    fix.time.floor(),
                    1e9 * (fix.time - fix.time.floor())
                ),
            };
            format!(
                "{:.0}\t{:.0}\t{clock}\t{:.9}\t{:.9}\t{:.6}",
                5.0 * fix.time,
                1e6 + 1e4 * fix.time,
                fix.latitude,
                fix.longitude,
                fix.height
            )
        })
    };
    let clock = "UTC_Year\tUTC_Month\tUTC_Day\tUTC_Hour\tUTC_Minute\tUTC_Second\tUTC_Nano";
    let (_, flight) = flight(&of_xsens(clock));
    assert_flown(&flight, 0.001);
    let times = &flight.channels[0].times;
    assert!((times[299] - times[0] - 59.8).abs() < 1e-6);
    // Without it the ticks are the time.
    let map = guess_table("a.csv", of_xsens("").as_bytes()).unwrap();
    let (role, unit) = guessed(&map, "SampleTimeFine time [s]");
    assert_eq!((role, &*unit), (Time, "s"));
}

#[test]
fn a_heading_from_magnetic_north_is_told() {
    let of = |name: &str| {
        let head = format!("time,latitude,longitude,altitude,{name}\n");
        let table = table(&head, |fix| {
            let [north, east, _] = fix.velocity;
            let heading = east.atan2(north).to_degrees() - 3.0;
            format!(
                "{:.1},{:.7},{:.7},{:.2},{:.1}",
                fix.time,
                fix.latitude,
                fix.longitude,
                fix.height,
                heading.rem_euclid(360.0)
            )
        });
        let map = guess_table("a.csv", table.as_bytes()).unwrap();
        assert_eq!(
            guessed(&map, name),
            is(Channel(ChannelName::Heading), "deg")
        );
        let mut told = map.findings.iter();
        told.any(|words| words.contains("magnetic north"))
    };
    assert!(of("Magnetic Heading (deg)"));
    assert!(!of("Heading (deg)"));
}

#[test]
fn a_column_without_any_number_is_no_channel() {
    let of = |heading: &str| {
        let table = table(
            "timestamp,latitude_deg,longitude_deg,altitude_msl_m,heading\n",
            |fix| {
                format!(
                    "{:.0},{:.9},{:.9},{:.3},{heading}",
                    5e7 + 1e6 * fix.time,
                    fix.latitude,
                    fix.longitude,
                    fix.height
                )
            },
        );
        let (map, flight) = flight(&table);
        assert_flown(&flight, 0.001);
        guessed(&map, "heading").0
    };
    assert_eq!(of("nan"), Nothing);
    assert_eq!(of("0.5"), Channel(ChannelName::Heading));
}

#[test]
fn positions_without_names_are_read_and_their_heights_told_to_be_above_the_ellipsoid() {
    let degrees = |fix: &Fix| {
        format!(
            "{:.9}  {:.9}  {:.4} {QUALITY}",
            fix.latitude, fix.longitude, fix.height
        )
    };
    let dated = table("", |fix| {
        format!("{}  {}", moment(fix, "/", " "), degrees(fix))
    });
    let weeks = table("", |fix| {
        format!("2314 {:.3}  {}", 122_400.0 + fix.time, degrees(fix))
    });
    let commas = dated.replace("  ", ",").replace(' ', ",");
    let head = |heights: &str| {
        format!(
            "% (lat/lon/height=WGS84/{heights},Q=1:fix)\n%  GPST latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   sdu(m)  sdne(m)  sdeu(m)  sdun(m) age(s)  ratio\n"
        )
    };
    let told = head("ellipsoidal") + &dated;
    for table in [&dated, &weeks, &commas, &told] {
        let (map, flight) = flight(table);
        assert_flown(&flight, 0.001);
        assert!(
            map.findings.iter().any(|told| told.contains("ellipsoid")),
            "{:?}",
            map.findings
        );
    }
    let (map, _) = flight(&(head("geodetic") + &dated));
    assert!(
        !map.findings.iter().any(|told| told.contains("ellipsoid")),
        "{:?}",
        map.findings
    );
}

#[test]
fn baselines_are_flown_about_their_station() {
    let station = Geodetic::from_degrees(-33.841_210_525, -0.411_228_361, 600.025_1);
    let frame = pilotage_base::frames::LocalFrame::new(station);
    let head = "% ref pos   : -33.841210525  -0.411228361   600.0251\n%  GPST e-baseline(m) n-baseline(m)  u-baseline(m)   Q  ns   sde(m)   sdn(m)   sdu(m)  sden(m)  sdnu(m)  sdue(m) age(s)  ratio\n";
    let table = table(head, |fix| {
        let place = Geodetic::from_degrees(fix.latitude, fix.longitude, fix.height);
        let from = frame.world_from_geodetic(&place);
        format!(
            "{}  {:.4}  {:.4}  {:.4} {QUALITY}",
            moment(fix, "/", " "),
            from.y,
            from.x,
            -from.z
        )
    });
    let (_, flight) = flight(&table);
    assert_flown(&flight, 0.001);
}

#[test]
fn ticks_of_xsens_time_a_table_and_local_times_have_their_zone() {
    let ticks = table(
        "PacketCounter,SampleTimeFine,Latitude,Longitude,Altitude\n",
        |fix| {
            format!(
                "{:.0},{:.0},{:.8},{:.8},{:.3}",
                5.0 * fix.time,
                1e6 + 1e4 * fix.time,
                fix.latitude,
                fix.longitude,
                fix.height
            )
        },
    );
    let local = table(
        "Lcl Date,Lcl Time,UTCOfst,Latitude,Longitude,GPS Altitude (m)\n",
        |fix| {
            format!(
                "2024-05-13,14:00:{:09.6},-04:00,{:.8},{:.8},{:.3}",
                fix.time % 60.0,
                fix.latitude,
                fix.longitude,
                fix.height
            )
        },
    );
    for table in [&ticks, &local] {
        let (_, flight) = flight(table);
        assert_flown(&flight, 0.01);
    }
}

#[test]
fn words_for_no_value_and_times_in_minutes_leave_the_rest_of_a_table_as_it_is() {
    let places = |fix: &Fix| format!("{:.8},{:.8},{:.3}", fix.latitude, fix.longitude, fix.height);
    for word in ["NULL", "N/A", "None", "-", "--", "?", ""] {
        let missing = [word; 3].join(",");
        let rows = table("time_s,lat,lon,alt_msl_m\n", |fix| {
            let is_late = fix.time > 8.0;
            format!(
                "{:.2},{}",
                fix.time,
                if is_late {
                    places(fix)
                } else {
                    missing.clone()
                }
            )
        });
        let (map, flight) = flight(&rows);
        assert_eq!(guessed(&map, "lat").1, "deg", "{word}");
        assert_eq!(
            values(&flight, ChannelName::GpsNorth).len(),
            fixes().len() - 41,
            "{word}"
        );
    }
    for (name, seconds) in [
        ("time [min]", 60.0),
        ("Time (hours)", 3600.0),
        ("time", 60.0),
    ] {
        let rows = table(&format!("{name},lat,lon,alt_msl_m\n"), |fix| {
            format!("{:.9},{}", fix.time / seconds, places(fix))
        });
        let (map, flight) = flight(&rows);
        assert_eq!(guessed(&map, "lat").1, "deg", "{name}");
        assert_flown(&flight, 0.002);
        let times = &flight.channels[0].times;
        assert!(
            (times[299] - times[0] - 59.8).abs() < 1e-4,
            "{name}: {}",
            times[299]
        );
    }
}

#[test]
fn places_of_a_long_flight_are_straight_below_it() {
    let row = |i: i32| {
        let t = f64::from(i);
        (-33.85 + 0.0055 * t, -0.42 + 0.0044 * t, 1500.0 + t)
    };
    let mut rows = String::from("time_s,lat,lon,alt_msl_m\n");
    for i in 0..400 {
        let (latitude, longitude, height) = row(i);
        writeln!(rows, "{},{latitude:.7},{longitude:.7},{height}", 10 * i).unwrap();
    }
    let (_, flight) = flight(&rows);
    let world = flight.frame_on_globe.unwrap();
    let [north, east] =
        [ChannelName::GpsNorth, ChannelName::GpsEast].map(|name| values(&flight, name));
    for i in [0, 100, 399] {
        let ground = pilotage_base::frames::GroundPoint::new(north[i], east[i]);
        let place = world.geodetic_from_ground(&ground);
        let (latitude, longitude, _) = row(i as i32);
        let off = (place.latitude.to_degrees() - latitude)
            .hypot(place.longitude.to_degrees() - longitude);
        assert!(off < 1e-7, "row {i}: {off} degrees");
    }
}
