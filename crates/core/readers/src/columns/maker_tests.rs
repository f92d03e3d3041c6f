//! Tables as the programs of pilots, radios and receivers write them: units above the names or nowhere, second names.

use std::fmt::Write as _;

use pilotage_flight::ChannelName;

use super::ColumnRole::{Channel, Course, SpeedOverGround};
use super::guess_table;
use super::tests::{guessed, is};

/// Rows eastward along 47° north at 50 m/s, one a second, with what `cells` makes of a row's number behind the place.
fn table(head: &str, cells: impl Fn(usize) -> String) -> String {
    let row = |i: usize| {
        let longitude = 8.0 + i as f64 * 50.0 / 76_058.0;
        let clock = format!("09:{:02}:{:02}", 10 + i / 60, i % 60);
        cells(i)
            .replace("{lat}", "47.0000000")
            .replace("{lon}", &format!("{longitude:.7}"))
            .replace("{clock}", &clock)
            + "\n"
    };
    head.to_owned() + &(0..100).map(row).collect::<String>()
}

#[test]
fn heights_of_pilots_programs_are_in_feet_where_the_table_or_its_maker_says_so() {
    let height = Channel(ChannelName::GpsHeight);
    let feet = |i: usize| 4000 + 10 * (i % 30);
    let garmin = "#airframe_info, log_version=\"1.00\"\n#yyy-mm-dd, hh:mm:ss,   degrees,   degrees,  ft msl,     kt,    fpm\n  Lcl Date, Lcl Time,  Latitude, Longitude,  AltMSL, GndSpd,   VSpd\n";
    let twice = "#airframe_info,product=\"G3X\"\nDate (yyyy-mm-dd),Time (hh:mm:ss),Latitude (deg),Longitude (deg),GPS Altitude (ft),GPS Ground Speed (kt)\nLcl Date,Lcl Time,Latitude,Longitude,AltGPS,GndSpd\n";
    let foreflight =
        "Timestamp,Latitude,Longitude,Altitude,Course,Speed,Bank,Pitch,Horizontal Error,g Load\n";
    let adsb = "timestamp,lat,lon,alt_baro,alt_geom,gs,track\n";
    let flightaware = "Time,Latitude,Longitude,Course,kts,mph,feet,Rate\n";
    let xplane = "_real,_time|__lat,__deg|__lon,__deg|__alt,ftmsl|\n";
    for (column, text) in [
        (
            "AltMSL",
            table(garmin, |i| {
                format!(
                    "2024-05-14, {{clock}}, {{lat}}, {{lon}}, {}, 97, 0",
                    feet(i)
                )
            }),
        ),
        (
            "GPS Altitude (ft)",
            table(twice, |i| {
                format!("2024-05-14,{{clock}},{{lat}},{{lon}},{},97", feet(i))
            }),
        ),
        (
            "Altitude",
            table(foreflight, |i| {
                let time = 1_715_679_012_000_u64 + 1000 * i as u64;
                format!("{time},{{lat}},{{lon}},{},90,97,0,1,5,1", feet(i))
            }),
        ),
        (
            "alt_geom",
            table(adsb, |i| {
                let time = 1_715_679_012 + i;
                format!("{time},{{lat}},{{lon}},{},{},97.2,90", feet(i), feet(i))
            }),
        ),
        (
            "feet",
            table(flightaware, |i| {
                format!("Tue {{clock}} AM,{{lat}},{{lon}},90,97,112,{},0", feet(i))
            }),
        ),
        (
            "__alt,ftmsl",
            table(xplane, |i| format!("{i}.0|{{lat}}|{{lon}}|{}|", feet(i))),
        ),
    ] {
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        assert_eq!(guessed(&map, column), is(height, "ft"), "{text:.300}");
        assert!(map.column(super::ColumnRole::Time).is_some(), "{text:.300}");
    }
}

#[test]
fn the_course_of_a_radios_receiver_is_no_heading() {
    let head =
        "Date,Time,GPS,GSpd(kmh),Hdg(°),Alt(m),GAlt(m),Ptch(rad),Roll(rad),Yaw(rad),VSpd(m/s)\n";
    let text = table(head, |i| {
        let bank = 0.1 * (i as f64 / 9.0).sin();
        let height = 50 + i % 7;
        format!(
            "2024-05-14,{{clock}}.000,{{lat}} {{lon}},180.0,90.0,{height},{},0.02,{bank:.2},1.40,0.1",
            height + 430
        )
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    for (column, role) in [
        ("Hdg(°)", Course),
        ("GSpd(kmh)", SpeedOverGround),
        ("Yaw(rad)", Channel(ChannelName::Heading)),
        ("Ptch(rad)", Channel(ChannelName::Pitch)),
        ("GAlt(m)", Channel(ChannelName::GpsHeight)),
    ] {
        assert_eq!(guessed(&map, column).0, role, "{column}");
    }
}

#[test]
fn the_bearing_of_a_phones_receiver_is_its_course() {
    let role = |head: &str, rest: &str| {
        let text = table(head, |i| format!("{i},{{lat}},{{lon}},90.{},{rest}", i % 9));
        guessed(&guess_table("a.csv", text.as_bytes()).unwrap(), "bearing").0
    };
    assert_eq!(role("time [s],lat,lon,bearing,speed\n", "50.0"), Course);
    let heading = Channel(ChannelName::Heading);
    assert_eq!(role("time [s],lat,lon,bearing,sats\n", "9"), heading);
}

#[test]
fn heights_and_dates_of_a_garmin_g5_stand_behind_their_datum() {
    let head = "#info,log_version=\"1.00\"\nUTC Date (yyyy-mm-dd),UTC Time (hh:mm:ss),Latitude (WGS84 deg),Longitude (WGS84 deg),GPS Altitude (WGS84 ft),GPS Ground Speed (kt)\nUTC Date,UTC Time,Latitude,Longitude,AltGPS,GndSpd\n";
    let text = table(head, |i| {
        format!("2024-05-14,{{clock}},{{lat}},{{lon}},{},97", 4000 + i % 30)
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let height = Channel(ChannelName::GpsHeight);
    assert_eq!(guessed(&map, "GPS Altitude (WGS84 ft)"), is(height, "ft"));
    let plain = crate::folder::decoded_table(text.as_bytes());
    assert!(String::from_utf8_lossy(&plain).contains(",2024-05-14 09:10:01Z,"));
}

#[test]
fn positions_of_ros_are_east_north_and_up() {
    let head = "%time,field.header.seq,field.pose.position.x,field.pose.position.y,field.pose.position.z\n";
    let text = table(head, |i| {
        let (t, way) = (i as f64, 12.0 * i as f64);
        format!(
            "{}000000000,{i},{:.3},{way:.3},{:.3}",
            175 + i,
            30.0 * (t / 9.0).sin(),
            40.0 + 0.2 * t
        )
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    for (axis, name) in [
        ("x", ChannelName::GpsEast),
        ("y", ChannelName::GpsNorth),
        ("z", ChannelName::GpsHeight),
    ] {
        let name_of = format!("field.pose.position.{axis}");
        assert_eq!(guessed(&map, &name_of).0, Channel(name), "{axis}");
        assert!(
            map.columns
                .iter()
                .any(|c| c.name == name_of && c.scale > 0.0),
            "{axis}"
        );
    }
}

#[test]
fn both_numbers_of_a_place_may_stand_below_one_name() {
    let head = "Date,Time,RSSI(dB),GPS,GPS alt.(m),GPS speed(km/h),GPS course(°)\n";
    let text = table(head, |i| {
        format!(
            "2021-08-26,{{clock}}.000,88,{{lat}},{{lon}},{},180.0,90.0",
            520 + i % 9
        )
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    assert_eq!(guessed(&map, "GPS latitude").0, super::ColumnRole::Latitude);
    assert_eq!(
        guessed(&map, "GPS longitude").0,
        super::ColumnRole::Longitude
    );
    let height = Channel(ChannelName::GpsHeight);
    assert_eq!(guessed(&map, "GPS alt.(m)"), is(height, "m"));
    assert_eq!(
        guessed(&map, "GPS speed(km/h)"),
        is(SpeedOverGround, "km/h")
    );
}

#[test]
fn cells_of_a_battery_are_no_quaternion_and_rows_of_a_rotation_no_accelerations() {
    let text = table("time [s],lat,lon,Cell 1,Cell 2,Cell 3,Cell 4\n", |i| {
        format!("{i},{{lat}},{{lon}},3.8{},3.82,3.81,3.80", i % 9)
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    assert_eq!(guessed(&map, "Cell 1").0, super::ColumnRole::Nothing);
    let row = |i: u32| {
        let (sine, cosine) = (0.03 * f64::from(i)).sin_cos();
        format!(
            "{cosine:.9} 0 {sine:.9} {:.3} 0 0 1 0 {:.9} 0 {cosine:.9} {}\n",
            0.1 * f64::from(i),
            -sine,
            0.9 * f64::from(i)
        )
    };
    let rows: String = (0..60).map(row).collect();
    let map = guess_table("poses.txt", rows.as_bytes()).unwrap();
    let forward = Channel(ChannelName::AccelerationForward);
    assert!(map.column(forward).is_none());
}

#[test]
fn fixes_of_googles_logger_stand_among_other_rows() {
    let head = "# \n# Header Description:\n# Raw,utcTimeMillis,TimeNanos\n# Fix,Provider,LatitudeDegrees,LongitudeDegrees,AltitudeMeters,SpeedMps,AccuracyMeters,BearingDegrees,UnixTimeMillis\n# \n";
    let text = table(head, |i| {
        let time = 1_715_679_012_000_u64 + 1000 * i as u64;
        format!(
            "Raw,{time},12\nFix,GPS,{{lat}},{{lon}},{}.5,50.0,3.8,90.0,{time}",
            400 + i % 9
        )
    });
    let map = guess_table("gnss_log.txt", text.as_bytes()).unwrap();
    assert_eq!(
        guessed(&map, "LatitudeDegrees").0,
        super::ColumnRole::Latitude
    );
    assert_eq!(guessed(&map, "BearingDegrees").0, Course);
}

#[test]
fn decimal_commas_may_have_powers_of_ten_behind_them() {
    let text = table("\"Time (s)\";\"Latitude (°)\";\"Longitude (°)\"\n", |i| {
        let longitude = 8.0 + i as f64 * 50.0 / 76_058.0;
        format!("{i}.0E0;4.7E1;{longitude:.9}E0").replace('.', ",")
    });
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    assert!(map.shape.has_decimal_comma);
    assert!(map.column(super::ColumnRole::Longitude).is_some());
}

#[test]
fn a_bare_height_that_is_never_low_is_asked_for() {
    let asks = |lowest: usize| {
        let text = table("time [s],latitude,longitude,Height (m)\n", |i| {
            format!("{i},{{lat}},{{lon}},{}", lowest + i % 9)
        });
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        map.questions.iter().any(|q| q.contains("above the sea"))
    };
    assert!(asks(430));
    assert!(!asks(60));
}

#[test]
fn pressures_of_a_barometer_are_no_heights() {
    for (name, value) in [("Baro (hPa)", 960.0), ("baro [inHg]", 29.92)] {
        let text = table(&format!("time [s],latitude,longitude,{name}\n"), |i| {
            format!("{i},{{lat}},{{lon}},{}", value + 0.01 * (i % 9) as f64)
        });
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        assert_eq!(guessed(&map, name).0, super::ColumnRole::Nothing, "{name}");
    }
}

#[test]
fn heights_count_from_where_the_program_counts_them() {
    let time = |i: usize| 1_715_679_012 + i;
    let (gps, above) = (ChannelName::GpsHeight, ChannelName::HeightAboveGround);
    for (column, channel, unit, text) in [
        (
            "hMSL",
            gps,
            "mm",
            table("time,lat,lon,height,hMSL,velD\n", |i| {
                let height = 80_000 + 500 * (i % 30);
                format!(
                    "{},{{lat}},{{lon}},{},{height},-500",
                    time(i),
                    height + 47_000
                )
            }),
        ),
        (
            "altitude(m)",
            above,
            "m",
            table(
                "latitude,longitude,altitude(m),speed(mps),distance(m),velocityX(mps),isflying,time\n",
                |i| format!("{{lat}},{{lon}},{},50,0,0,1,{}", 30 + i % 30, time(i)),
            ),
        ),
        (
            "altitude",
            above,
            "mm",
            table(
                "time,product_gps_latitude,product_gps_longitude,angle_psi,altitude\n",
                |i| {
                    format!(
                        "{},{{lat}},{{lon}},1.5707963,{}",
                        time(i),
                        30_000 + 500 * (i % 30)
                    )
                },
            ),
        ),
        (
            "Height (m)",
            gps,
            "m",
            table(
                "Time (s),Latitude (°),Longitude (°),Height (m),Velocity (m/s),Direction (°)\n",
                |i| format!("{i},{{lat}},{{lon}},{},50,90", 400 + i % 30),
            ),
        ),
    ] {
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let found = map
            .columns
            .iter()
            .find(|known| known.role == Channel(channel));
        let found = found.map(|known| (known.name.as_str(), known.unit.as_str()));
        assert_eq!(found, Some((column, unit)), "{text}");
        let heights =
            [gps, above].map(|name| map.columns.iter().any(|known| known.role == Channel(name)));
        assert_eq!(heights, [channel == gps, channel == above], "{column}");
    }
}

#[test]
fn loggers_made_at_home_have_their_clock_and_pressure_height() {
    let text = table(
        "FC_Boot_Time_ms,GPS_Unix_Time_usec,GPS_Lat,GPS_Lon,GPS_Alt,bmp_altitude_m,gps_baro_alt_diff_m\n",
        |i| {
            let micros = 1_715_679_012_000_000_u64 + 1_000_000 * i as u64;
            let height = 400 + i % 30;
            format!(
                "{},{micros},{{lat}},{{lon}},{height},{},3",
                1000 * i,
                height - 3
            )
        },
    );
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let pressure = Channel(ChannelName::BarometricHeight);
    for (column, role, unit) in [
        ("GPS_Unix_Time_usec", super::ColumnRole::Time, "us"),
        ("bmp_altitude_m", pressure, "m"),
        ("gps_baro_alt_diff_m", super::ColumnRole::Nothing, ""),
    ] {
        assert_eq!(guessed(&map, column), is(role, unit), "{column}");
    }
}

#[test]
fn a_height_beside_north_and_east_has_their_unit() {
    let row = |i: usize| {
        let time = 0.5 * i as f64;
        let pitch: f64 = 0.05 + 0.035 * (time / 9.0).sin();
        let fallen = 13.5 * ((time / 9.0).cos() - 1.0);
        let (w, y) = ((pitch / 2.0).cos(), (pitch / 2.0).sin());
        format!(
            "{}\t{:.3}\t0.0\t{fallen:.4}\t{w:.6}\t0\t{y:.6}\t0\n",
            1_715_595_630_000 + 500 * i as u64,
            12.0 * time
        )
    };
    let text = "TimeStamp\tPOS_X\tPOS_Y\tPOS_Z\tQ_W\tQ_X\tQ_Y\tQ_Z\n".to_owned()
        + &(0..120).map(row).collect::<String>();
    let map = guess_table("airsim_rec.txt", text.as_bytes()).unwrap();
    assert_eq!(
        guessed(&map, "POS_Z"),
        is(Channel(ChannelName::GpsHeight), "m")
    );
}

#[test]
fn simulators_have_heights_above_sea_level_and_climbs_in_feet_a_minute() {
    let jsbsim = table(
        "Time,/fdm/jsbsim/position/lat-geod-deg,/fdm/jsbsim/position/long-gc-deg,/fdm/jsbsim/position/h-sl-ft\n",
        |i| format!("{i},{{lat}},{{lon}},{}", 1000 + i % 30),
    );
    let map = guess_table("a.csv", jsbsim.as_bytes()).unwrap();
    assert_eq!(
        guessed(&map, "/fdm/jsbsim/position/h-sl-ft"),
        is(Channel(ChannelName::GpsHeight), "ft")
    );
    let flown = table(
        "time [s],lat,lon,heading,Airspeed True,Vertical Speed\n",
        |i| {
            format!(
                "{i},{{lat}},{{lon}},90,{},{}",
                97 + i % 2,
                295 - 5 * (i % 30)
            )
        },
    );
    let map = guess_table("a.csv", flown.as_bytes()).unwrap();
    assert_eq!(guessed(&map, "Airspeed True").1, "kt");
    assert_eq!(guessed(&map, "Vertical Speed").1, "ft/min");
}

#[test]
fn positions_beside_a_rotation_are_east_north_and_up_and_no_turn_rates() {
    let pose = |i: usize, separator: &str, real_first: bool| {
        let (yaw, time) = (0.02 * i as f64, 0.5 * i as f64);
        let place =
            [600.0 * yaw.sin(), 600.0 - 600.0 * yaw.cos(), time / 4.0].map(|at| format!("{at:.4}"));
        let (z, w) = (yaw / 2.0).sin_cos();
        let turn = if real_first {
            [w, 0.0, 0.0, z]
        } else {
            [0.0, 0.0, z, w]
        };
        let cells = place
            .into_iter()
            .chain(turn.map(|part| format!("{part:.6}")));
        cells.collect::<Vec<_>>().join(separator) + "\n"
    };
    let tum = |i: usize| {
        format!(
            "{:.3} {}",
            1_715_595_630.0 + 0.5 * i as f64,
            pose(i, " ", false)
        )
    };
    let euroc = |i: usize| {
        format!(
            "{},{}",
            1_715_595_630_000_000_000 + 500_000_000 * i as u64,
            pose(i, ",", true)
        )
    };
    let head = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []\n";
    for (text, names) in [
        (
            "# timestamp tx ty tz qx qy qz qw\n".to_owned()
                + &(0..120).map(tum).collect::<String>(),
            ["tx", "ty", "tz"],
        ),
        (
            head.to_owned() + &(0..120).map(euroc).collect::<String>(),
            ["p_RS_R_x [m]", "p_RS_R_y [m]", "p_RS_R_z [m]"],
        ),
    ] {
        let map = guess_table("a.txt", text.as_bytes()).unwrap();
        let roles = [
            ChannelName::GpsEast,
            ChannelName::GpsNorth,
            ChannelName::GpsHeight,
        ];
        for (name, role) in names.into_iter().zip(roles) {
            assert_eq!(guessed(&map, name), is(Channel(role), "m"), "{name}");
            assert_eq!(
                map.columns.iter().find(|c| c.name == name).unwrap().scale,
                1.0
            );
        }
    }
}

#[test]
fn a_direction_that_is_stated_in_degrees_is_none_in_hundredths_because_it_hardly_turns_then() {
    let row = |i: usize| {
        let turn = 40.0 + 55.0 * (1.0 - (0.06 * i as f64).cos());
        let (sine, cosine) = turn.to_radians().sin_cos();
        (turn, sine, cosine)
    };
    let mut text = "time [s],lat,lon,speed(m/s),course(°),TrueHeading(°)\n".to_owned();
    let (mut latitude, mut longitude) = (47.0, 8.0);
    for i in 0..120 {
        let (turn, sine, cosine) = row(i);
        let aside = turn + 90.0;
        writeln!(
            text,
            "{i},{latitude:.7},{longitude:.7},12.0,{turn:.2},{aside:.2}"
        )
        .unwrap();
        latitude += 12.0 * cosine / 111_190.0;
        longitude += 12.0 * sine / 76_058.0;
    }
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    assert_eq!(
        guessed(&map, "TrueHeading(°)"),
        is(Channel(ChannelName::Heading), "deg")
    );
    assert_eq!(guessed(&map, "course(°)"), is(Course, "deg"));
}

#[test]
fn heights_and_speeds_of_sim_connect_are_feet_and_knots_unless_their_names_say_otherwise() {
    for (seam, stated) in [(" ", ""), ("_", ""), (" ", " (meters)")] {
        let spelled = |name: &str| name.replace(' ', seam);
        let names = [
            "PLANE LATITUDE",
            "PLANE LONGITUDE",
            "PLANE HEADING DEGREES TRUE",
            "PLANE BANK DEGREES",
            "AIRSPEED TRUE",
        ]
        .map(spelled);
        let altitude = spelled("PLANE ALTITUDE") + stated;
        let mut text = format!("time [s],{},{altitude}\n", names.join(","));
        // A circle to the right at 60 m/s in still air; SimConnect's bank is positive to the left.
        let (speed, rate) = (60.0, 0.05_f64);
        let bank = -(speed * rate / 9.81).atan();
        for i in 0..120 {
            let turned = rate * f64::from(i);
            let (sin, cos) = turned.sin_cos();
            let radius = speed / rate;
            let (north, east) = (radius * sin, radius * (1.0 - cos));
            let heading = turned % std::f64::consts::TAU;
            let height = 3000.0 + 100.0 * (0.1 * f64::from(i)).sin();
            let knots = speed / 0.514_444 + 0.2 * f64::from(i % 3);
            writeln!(
                text,
                "{i},{:.7},{:.7},{heading:.5},{bank:.4},{knots:.2},{height:.1}",
                47.1 + north / 111_190.0,
                8.5 + east / 75_690.0,
            )
            .unwrap();
        }
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let unit = if stated.is_empty() { "ft" } else { "m" };
        assert_eq!(guessed(&map, &altitude).1, unit, "{altitude}");
        assert_eq!(
            guessed(&map, &names[4]),
            is(Channel(ChannelName::Airspeed), "kt"),
            "{altitude}"
        );
        let roll = map.columns.iter().find(|c| c.name == names[3]).unwrap();
        assert_eq!(
            (roll.unit.as_str(), roll.scale),
            ("rad", -1.0),
            "{altitude}"
        );
    }
}
