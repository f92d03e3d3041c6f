//! Tables as home-made recorders and small autopilots write them: zones of UTM, dates of a receiver beside another clock,
//! degrees a hundred million times, kinematics.

use pilotage_flight::ChannelName;

use super::ColumnRole::{Channel, Latitude, Longitude};
use super::tests::files;
use super::{ColumnRole, flight_of_tables, guess_table};
use crate::folder::FlightFolder;

fn flown(table: &str) -> FlightFolder {
    let files = files(&[("a.csv", table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    flight_of_tables(&files, &maps).unwrap()
}

/// A table of those names whose rows `row` makes of tenths of seconds.
fn table(names: &str, row: impl Fn(f64) -> String) -> String {
    let rows = (0..100).map(|i| row(0.1 * f64::from(i)));
    format!("{names}\n{}\n", rows.collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_flight_in_a_zone_of_utm_is_where_it_was() {
    let text = table("time,utm_e,utm_n,utm_zone,heading", |t| {
        format!(
            "{t:.1},{:.3},{:.3},19H,{:.1}",
            360_505.620 + 12.0 * t,
            6_303_362.288 + 3.0 * t,
            76.0 + t
        )
    });
    let folder = flown(&text);
    let origin = folder.flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() + 33.4).abs() < 3e-7);
    assert!((origin.longitude.to_degrees() + 70.5).abs() < 3e-7);
    let truth = folder.flight.truth.unwrap();
    let way = (truth.states[99].position - truth.states[0].position)
        .xy()
        .norm();
    // The zone's scale is 0.9996 and 240e-6 there.
    assert!((way - 9.9 * 12.369).abs() < 0.1, "{way}");
}

#[test]
fn a_date_of_the_receiver_beside_another_clock_is_told_as_supposed() {
    for (names, date) in [
        (
            "GPS_year,GPS_month,GPS_day,GPS_hour,GPS_minute,GPS_second",
            "2024,5,1,10,0,",
        ),
        ("gps_date,gps_time", "2024-05-01,10:00:0"),
    ] {
        let text = table(&format!("time [s],lat,lon,heading,{names}"), |t| {
            format!(
                "{:.1},{:.6},8.0,{:.1},{date}{}",
                200.0 + t,
                47.0 + 1e-4 * t,
                5.0 * t,
                t as u32
            )
        });
        let folder = flown(&text);
        assert!(
            folder
                .notes
                .iter()
                .any(|n| n.contains("supposed to be universal time")),
            "{:?}",
            folder.notes
        );
        let (first, last) = folder.flight.span();
        assert!(
            (last - first - 9.9).abs() < 1e-6,
            "{names}: {first} to {last}"
        );
        let utc = folder.utc_at_zero().unwrap() + first;
        assert!((utc - 1_714_557_600.0).abs() < 1.0, "{names}: {utc}");
    }
}

#[test]
fn degrees_a_hundred_million_times_are_places() {
    let text = table(
        "timestamp,latitude_deg_1e8,longitude_deg_1e8,heading",
        |t| {
            format!(
                "{t:.1},{:.0},{:.0},{:.1}",
                -33.85e8 + 1e4 * t,
                18.42e8,
                5.0 * t
            )
        },
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    for role in [Latitude, Longitude] {
        assert_eq!(map.column(role).unwrap().unit, "deg1e8");
    }
    let origin = flown(&text).flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() + 33.85).abs() < 1e-8);
    assert!((origin.longitude.to_degrees() - 18.42).abs() < 1e-8);
}

#[test]
fn kinematics_of_configurators_are_roll_pitch_and_heading() {
    let text = table(
        "timestamp,gyroscopeX,kinematicsX,kinematicsY,kinematicsZ",
        |t| {
            format!(
                "{:.0},0.1,{:.1},{:.1},{:.0}",
                1000.0 * t,
                20.0 * t.sin(),
                5.0 * t.cos(),
                10.0 * t
            )
        },
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    for (role, name) in [
        (ChannelName::Roll, "kinematicsX"),
        (ChannelName::Pitch, "kinematicsY"),
        (ChannelName::Heading, "kinematicsZ"),
    ] {
        let column = map.column(Channel(role)).unwrap();
        assert_eq!((column.name.as_str(), column.unit.as_str()), (name, "deg"));
    }
}

#[test]
fn a_receiver_that_says_no_yaw_tells_no_heading() {
    let text = table("GPS.TimeUS,GPS.Lat,GPS.Lng,GPS.Yaw", |t| {
        format!("{:.0},{:.7},8.0,0", 1e6 * t, 47.0 + 1e-5 * t)
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    assert!(
        map.column(ColumnRole::Channel(ChannelName::Heading))
            .is_none()
    );
}

/// Role of a column by its name, with its unit and scale.
fn role_of(text: &str, name: &str) -> (ColumnRole, String, f64) {
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let column = map.columns.into_iter().find(|c| c.name == name).unwrap();
    (column.role, column.unit, column.scale)
}

#[test]
fn yuneec_calls_its_speed_over_ground_an_airspeed() {
    let text = table(
        "stamp,fsk_rssi,altitude,latitude,longitude,tas,gps_used,yaw",
        |t| {
            format!(
                "{t:.1},-60,{:.1},{:.7},18.42,11.1,true,{:.1}",
                t,
                -33.85 + 1e-4 * t,
                5.0 * t
            )
        },
    );
    assert_ne!(role_of(&text, "tas").0, Channel(ChannelName::Airspeed));
    let height = role_of(&text, "altitude").0;
    assert_eq!(height, Channel(ChannelName::HeightAboveGround));
}

#[test]
fn a_crazyflie_turns_its_yaw_and_its_left_the_other_way() {
    let text = table(
        "Timestamp,stateEstimate.x,stateEstimate.y,stateEstimate.z,stabilizer.roll,stabilizer.pitch,stabilizer.yaw",
        |t| {
            format!(
                "{:.0},{:.3},{:.3},0.5,{:.1},{:.1},{:.1}",
                1000.0 * t,
                0.3 * t,
                0.1 * t * t,
                2.0 * t.sin(),
                t.cos(),
                10.0 * t.sin()
            )
        },
    );
    for (name, role, sign) in [
        ("stateEstimate.x", ChannelName::GpsNorth, 1.0),
        ("stateEstimate.y", ChannelName::GpsEast, -1.0),
        ("stabilizer.yaw", ChannelName::Heading, -1.0),
        ("stabilizer.pitch", ChannelName::Pitch, 1.0),
    ] {
        let (found, _, scale) = role_of(&text, name);
        assert_eq!((found, scale), (Channel(role), sign), "{name}");
    }
}

#[test]
fn a_height_beside_that_above_sea_level_is_none_above_ground() {
    let text = table("time,Lat,Long,Height [x8103],MSL Height [x8103]", |t| {
        format!(
            "{t:.1},{:.7},8.0,{:.2},{:.2}",
            47.0 + 1e-4 * t,
            448.0 + t,
            400.0 + t
        )
    });
    assert_eq!(role_of(&text, "Height [x8103]").0, ColumnRole::Nothing);
    let level = role_of(&text, "MSL Height [x8103]").0;
    assert_eq!(level, Channel(ChannelName::GpsHeight));
}

#[test]
fn a_geodetic_latitude_goes_before_the_geocentric_one() {
    let text = table(
        "Time,Latitude (deg),Latitude Geodetic (deg),Longitude (deg)",
        |t| {
            let latitude = 47.0 + 1e-4 * t;
            format!("{t:.1},{:.7},{latitude:.7},8.0", latitude - 0.19)
        },
    );
    assert_eq!(role_of(&text, "Latitude Geodetic (deg)").0, Latitude);
    assert_eq!(role_of(&text, "Latitude (deg)").0, ColumnRole::Nothing);
}

#[test]
fn pitch_is_in_the_unit_that_the_track_tells_of_roll() {
    // Turns at 17 m/s; the heading beside roll and pitch is in another unit.
    let (mut north, mut east) = (0.0, 0.0);
    let row = |i: u32| {
        let t = 0.2 * f64::from(i);
        let heading = 40.0 + 150.0 * (t / 17.0).sin();
        let rate = (150.0 / 17.0 * (t / 17.0).cos()).to_radians();
        let roll = (17.0 * rate / 9.81).atan();
        let (sin, cos) = heading.to_radians().sin_cos();
        north += 3.4 * cos;
        east += 3.4 * sin;
        format!(
            "{t:.1},{:.8},{:.8},{roll:.5},{:.5},{:.2}\n",
            47.0 + north / 111_200.0,
            8.0 + east / 75_900.0,
            0.07 * (t / 9.0).sin(),
            heading.rem_euclid(360.0)
        )
    };
    let rows: String = (0..600).map(row).collect();
    let text = format!("time,lat,lon,att_roll,att_pitch,motion_heading_deg\n{rows}");
    for name in ["att_roll", "att_pitch"] {
        assert_eq!(role_of(&text, name).1, "rad", "{name}");
    }
}

#[test]
fn a_climb_in_metres_a_second_beside_kilometres_an_hour_makes_no_feet_of_heights() {
    let (mut north, mut height) = (0.0, 300.0);
    let row = |i: u32| {
        let t = 0.2 * f64::from(i);
        let climb = 1.6 * (t / 9.0).sin();
        north += 3.0;
        height += 0.2 * climb;
        format!(
            "{t:.1},{:.6},8.0,{height:.0},54.0,0,{climb:.1}\n",
            47.0 + north / 111_200.0
        )
    };
    let rows: String = (0..600).map(row).collect();
    let text = format!("time,lat,lon,GPS_altitude,GPS_speed,GPS_ground_course,VSpd\n{rows}");
    assert_eq!(role_of(&text, "GPS_speed").1, "km/h");
    assert_eq!(role_of(&text, "GPS_altitude").1, "m");
    assert_eq!(role_of(&text, "VSpd").1, "m/s");
}

#[test]
fn whole_seconds_and_microseconds_beside_them_are_one_time() {
    let text = table("Unix Time,Microseconds,Latitude,Longitude,Height", |t| {
        let micros = (t.fract() * 1e6).round();
        format!(
            "{},{micros},{:.8},8.0,{:.2}",
            1_714_557_600 + t as u64,
            47.0 + 1e-4 * t,
            400.0 + t
        )
    });
    assert_eq!(role_of(&text, "Microseconds").0, ColumnRole::TimeRest);
    let height = role_of(&text, "Height").0;
    assert_eq!(height, Channel(ChannelName::GpsHeight));
    let (first, last) = flown(&text).flight.span();
    assert!((last - first - 9.9).abs() < 1e-4, "{first} to {last}");
}

#[test]
fn transponders_tell_a_course_and_no_heading() {
    let text = table("time,icao24,lat,lon,velocity,heading,vertrate", |t| {
        format!("{t:.1},a0b1c2,{:.7},8.0,111.2,0.5,0", 47.0 + 1e-3 * t)
    });
    assert_ne!(role_of(&text, "heading").0, Channel(ChannelName::Heading));
}

#[test]
fn velocities_in_kilometres_an_hour_by_the_middle_of_their_names_are_read() {
    let text = table(
        "time,lat,lon,gps_kph_north,gps_kph_east,gps_kph_down,heading",
        |t| {
            format!(
                "{t:.1},{:.7},8.0,{:.3},0,0,{:.1}",
                47.0 + (15.0 / 3.6) * t / 111_195.0,
                15.0,
                5.0 * t
            )
        },
    );
    let flight = flown(&text).flight;
    let north = flight.channel(ChannelName::GpsVelocityNorth).unwrap();
    assert!((north.values[50] - 15.0 / 3.6).abs() < 1e-6);
    assert!(flight.channel(ChannelName::GpsVelocityEast).is_some());
}

#[test]
fn what_a_phone_measured_along_its_own_axes_is_told_and_not_the_aircrafts() {
    use super::conventions::flown::{Craft, moments};
    let moments = moments(Craft::Airplane);
    let write = |is_along_body: bool| {
        let rows = moments.iter().map(|m| {
            let a = m.acceleration;
            // In a pocket, or with its axes along those of the aircraft.
            let [x, y, z] = if is_along_body {
                [a.x, a.y, a.z]
            } else {
                [0.6 * a.y + 0.8 * a.z, 0.8 * a.y - 0.6 * a.z, a.x]
            };
            format!(
                "{x:.4},{y:.4},{z:.4},0,0,9.8,{:.7},{:.7},{:.2},{:.2},{:.2},{:.0}",
                m.latitude().to_degrees(),
                m.longitude().to_degrees(),
                m.roll.to_degrees(),
                m.pitch.to_degrees(),
                m.heading.to_degrees().rem_euclid(360.0),
                1000.0 * m.time
            )
        });
        let names = ["X", "Y", "Z"].map(|axis| format!("ACCELEROMETER {axis} (m/s²)"));
        let gravity = ["X", "Y", "Z"].map(|axis| format!("GRAVITY {axis} (m/s²)"));
        format!(
            "{},{},LOCATION Latitude,LOCATION Longitude,roll (deg),pitch (deg),heading (deg),Time since start in ms\n{}\n",
            names.join(","),
            gravity.join(","),
            rows.collect::<Vec<_>>().join("\n")
        )
    };
    let folder = flown(&write(false));
    let force = |folder: &FlightFolder| {
        folder
            .flight
            .channel(ChannelName::AccelerationDown)
            .cloned()
    };
    assert_eq!(force(&folder), None);
    assert!(
        folder
            .notes
            .iter()
            .any(|note| note.contains("a phone measured them")),
        "{:?}",
        folder.notes
    );
    // A word that aircraft have as well makes no phone.
    let words = ["proximity left", "proximity right", "gravity norm"];
    let mut other = write(false);
    for (axis, word) in ["X", "Y", "Z"].into_iter().zip(words) {
        other = other.replace(&format!("GRAVITY {axis} (m/s²)"), word);
    }
    let notes = flown(&other).notes;
    assert!(!notes.iter().any(|note| note.contains("a phone")));
    let alone = other.replace("gravity norm", "PROXIMITY (cm)");
    let notes = flown(&alone).notes;
    assert!(notes.iter().any(|note| note.contains("a phone")));
    let found = force(&flown(&write(true))).unwrap();
    let mean = found.values.iter().sum::<f64>() / found.values.len() as f64;
    assert!((-13.0..-9.0).contains(&mean), "{mean}");
}

#[test]
fn heights_of_blackbox_logs_are_decimetres_unless_others_tell_otherwise() {
    // Climbs and sinks at up to 5 m/s while it flies 10 m/s northwards.
    let text = |names: &str, per_metre: f64, more: &str| {
        table(names, |t| {
            let t = 10.0 * t;
            let height = 50.0 + 40.0 * (t / 8.0).sin();
            let place = 47.0 + 10.0 * t / 111_200.0;
            let baro = if names.contains("baroAlt") {
                format!("{:.0}, ", 100.0 * (height - 50.0))
            } else {
                String::new()
            };
            format!(
                "{:.0}, {baro}12, {place:.7}, 8.0000000, {:.0}, 10.00, 0.0{more}",
                1e6 * t,
                per_metre * (height + 400.0)
            )
        })
    };
    let receiver =
        "GPS_numSat, GPS_coord[0], GPS_coord[1], GPS_altitude, GPS_speed (m/s), GPS_ground_course";
    let unit = |text: &str| role_of(text, "GPS_altitude").1;
    let with_baro = format!("time (us), baroAlt (cm), {receiver}");
    let alone = format!("time (us), {receiver}");
    let of_inav = format!("time (us), {receiver}, GPS_hdop");
    assert_eq!(unit(&text(&with_baro, 10.0, "")), "dm");
    assert_eq!(unit(&text(&with_baro, 1.0, "")), "m");
    assert_eq!(unit(&text(&alone, 10.0, "")), "dm");
    assert_eq!(unit(&text(&of_inav, 1.0, ", 1.2")), "m");
    let map = guess_table("a.csv", text(&alone, 10.0, "").as_bytes()).unwrap();
    let is_asked = |question: &String| question.contains("(GPS_altitude) in dm");
    assert!(map.questions.iter().any(is_asked), "{:?}", map.questions);
}

#[test]
fn speeds_of_an_aircraft_that_circles_in_few_rows_keep_their_units() {
    // A circle of 60 m at 15 m/s, a row a second: its velocity turns by a quarter of itself from row to row.
    let text = table(
        "time [s],lat,lon,alt [m],Airspeed (kts),speed,course,heading",
        |t| {
            let (time, turned) = (10.0 * t, 2.5 * t);
            let course = turned.to_degrees().rem_euclid(360.0);
            let degrees = 60.0 / 6_371_000.0_f64.to_radians();
            format!(
                "{time:.0},{:.8},{:.8},{:.1},{:.2},{:.2},{course:.2},{course:.2}",
                degrees * turned.sin(),
                8.0 - degrees * turned.cos(),
                430.0 + 0.1 * time,
                15.0 * 3600.0 / 1852.0,
                15.0 * 3.6,
            )
        },
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let unit = |role| map.column(role).unwrap().unit.clone();
    assert_eq!(unit(Channel(ChannelName::Airspeed)), "kt");
    assert_eq!(unit(ColumnRole::SpeedOverGround), "km/h");
    assert_eq!(map.column(ColumnRole::Course).unwrap().scale, 1.0);
}

#[test]
fn semicircles_of_activities_are_places() {
    let semicircles = |degrees: f64| (degrees / 180.0 * 2_147_483_648.0).round();
    let row = |t: f64| {
        [
            semicircles(-33.85 - 1e-4 * t),
            semicircles(18.42 + 1e-4 * t),
            1e-4 * 111_195.0 * (1.0 + (33.85_f64.to_radians()).cos().powi(2)).sqrt(),
        ]
    };
    let named = |names: &str| {
        table(names, |t| {
            let [latitude, longitude, speed] = row(t);
            format!("{t:.1},{latitude},{longitude},{speed:.2},140.3")
        })
    };
    for (names, what) in [
        (
            "timestamp [s],position_lat,position_long,distance_of_it,enhanced_altitude",
            "the names of FIT",
        ),
        (
            "time [s],lat [semicircles],lon [semicircles],distance_of_it,alt",
            "a unit",
        ),
        ("time [s],lat,lon,ground speed,course", "a speed"),
    ] {
        let text = named(names);
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        for role in [Latitude, Longitude] {
            assert_eq!(map.column(role).unwrap().unit, "semicircles", "{what}");
        }
        let origin = flown(&text).flight.frame_on_globe.unwrap().origin;
        assert!(
            (origin.latitude.to_degrees() + 33.85).abs() < 1e-7,
            "{what}"
        );
        assert!(
            (origin.longitude.to_degrees() - 18.42).abs() < 1e-7,
            "{what}"
        );
    }
    // Degrees of FIT that a script has converted, and whole numbers of other programs.
    for (latitude, unit) in [(-33.85, "deg"), (-338_500_000.0, "deg1e7")] {
        let text = table("timestamp [s],lat,lon,ground speed", |t| {
            let step = latitude * 3e-6 * t;
            format!("{t:.1},{},{},{:.2}", latitude + step, -latitude, 11.29)
        });
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        assert_eq!(map.column(Latitude).unwrap().unit, unit);
    }
}

#[test]
fn attitudes_and_heights_of_german_and_french_tables_are_known() {
    let row = |t: f64| {
        format!(
            "{t:.1};{:.6};{:.6};{:.1};{:.1};{:.1};{:.1};{:.1}",
            47.0 + 1e-4 * t,
            8.0 + 1e-4 * t,
            430.0 + t,
            t,
            34.0 + 0.1 * t,
            2.0 + 0.1 * t,
            3.0 - 0.1 * t
        )
    };
    for names in [
        "Zeit [s];GPS Breite;GPS Länge;GPS Höhe [m];Höhe über Grund [m];Steuerkurs [°];Rollwinkel [°];Nickwinkel [°]",
        "Temps (s);Latitude;Longitude;Altitude GPS (m);Hauteur (m);Cap (°);Roulis (°);Tangage (°)",
    ] {
        let text = table(names, row);
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let named: Vec<&str> = names.split(';').collect();
        let roles = [
            ColumnRole::Time,
            Latitude,
            Longitude,
            Channel(ChannelName::GpsHeight),
            Channel(ChannelName::HeightAboveGround),
            Channel(ChannelName::Heading),
            Channel(ChannelName::Roll),
            Channel(ChannelName::Pitch),
        ];
        for (role, name) in roles.into_iter().zip(named) {
            assert_eq!(map.column(role).unwrap().name, name);
        }
    }
    // A height without more beside that of the receiver is none of the receiver.
    let text = table(
        "Zeit [s];GPS Breite;GPS Länge;GPS Höhe [m];Höhe [m]",
        |t| format!("{t:.1};{:.6};8,5;{:.1};{t:.1}", 47.0 + 1e-4 * t, 430.0 + t).replace('.', ","),
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let height = map.column(Channel(ChannelName::GpsHeight)).unwrap();
    assert_eq!(height.name, "GPS Höhe [m]");
}
