//! Tables as loggers and radios write them: dates, hemispheres, units in cells, times that leap.

use pilotage_flight::{ChannelName, FrameSource as _};

use super::ColumnRole::{Channel, Latitude};
use std::sync::Arc;

use pilotage_base::files::{FileSet, MemoryFiles};

use super::tests::{files, guessed, is};
use super::{flight_of_tables, guess_table, guess_tables};

#[test]
fn a_wrong_time_costs_its_row_wherever_it_stands_and_is_told() {
    for at in [0, 50, 99] {
        for wrong in ["1e9", "-1e9", "0", "nan", "", "700"] {
            let row = |i: usize| {
                let time = if i == at {
                    wrong.to_owned()
                } else {
                    format!("{:.1}", 200.0 + 0.1 * i as f64)
                };
                format!("{time},{:.6},8.0,{i}\n", 47.0 + 1e-5 * i as f64)
            };
            let table =
                "time [s],lat,lon,heading\n".to_owned() + &(0..100).map(row).collect::<String>();
            let files = files(&[("a.csv", &table)]);
            let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
            let folder = flight_of_tables(&files, &maps).unwrap();
            let heading = folder.flight.channel(ChannelName::Heading).unwrap();
            assert_eq!(heading.values.len(), 99, "{wrong} at {at}");
            let (first, last) = folder.flight.span();
            let expected = if at == 50 { 9.9 } else { 9.8 };
            assert!(
                (last - first - expected).abs() < 1e-6,
                "{wrong} at {at}: {first} to {last}"
            );
            let is_told = |note: &String| note.contains("1 row was left out");
            assert!(folder.notes.iter().any(is_told), "{:?}", folder.notes);
        }
    }
}

#[test]
fn degrees_and_minutes_with_hemispheres_are_places() {
    for (latitude, longitude) in [
        ("33°51'{}\"S", "18°25'12\"W"),
        ("S33 51.{}", "W18 25.2"),
        ("33:51:{} South", "18:25:12 West"),
    ] {
        let row = |i: usize| {
            format!(
                "{:.1};{};{longitude};{i}\n",
                0.1 * i as f64,
                latitude.replace("{}", &format!("{:02}", i % 60))
            )
        };
        let table =
            "time;latitude;longitude;heading\n".to_owned() + &(0..60).map(row).collect::<String>();
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let origin = flight.frame_on_globe.expect(latitude).origin;
        assert!(
            (origin.latitude.to_degrees() + 33.85).abs() < 1e-6,
            "{latitude}"
        );
        assert!(
            (origin.longitude.to_degrees() + 18.42).abs() < 1e-6,
            "{latitude}"
        );
    }
}

#[test]
fn columns_of_blackbox_tables_units_behind_times_and_minutes_of_receivers_are_known() {
    let rows = |head: &str, row: &dyn Fn(f64) -> String| {
        head.to_owned()
            + "\n"
            + &(0..60)
                .map(|i| row(f64::from(i)) + "\n")
                .collect::<String>()
    };
    let blackbox = rows("time (us),GPS_coord[0],GPS_coord[1]", &|i| {
        format!(
            "{},{:.7},{:.7}",
            1_000_000.0 + 1e5 * i,
            47.0 + 8e-6 * i,
            8.0 + 3e-6 * i
        )
    });
    let units = rows("time;latitude;longitude", &|i| {
        format!(
            "{:.1} s;{:.6}°;{:.6}°",
            0.1 * i,
            47.0 + 8e-6 * i,
            8.0 + 3e-6 * i
        )
    });
    for table in [blackbox, units] {
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let (first, last) = flight.span();
        assert!((last - first - 5.9).abs() < 1e-6, "{table}");
        let origin = flight.frame_on_globe.expect(&table).origin;
        assert!(
            (origin.latitude.to_degrees() - 47.0).abs() < 1e-6,
            "{table}"
        );
    }
    let receiver = rows("time,latitude,N/S,longitude,E/W", &|i| {
        format!(
            "{:.2},{:.4},N,{:.4},E",
            0.1 * i,
            4730.0 + 5e-4 * i,
            830.0 + 5e-4 * i
        )
    });
    let by_letters = rows("time,latitude,longitude", &|i| {
        let minutes = 5e-4 * i;
        format!(
            "{:.2},47{:07.4}N,008{:07.4}E",
            0.1 * i,
            30.0 + minutes,
            30.0 + minutes
        )
    });
    let signed = receiver.replace(",N,", ",,").replace(",E\n", ",\n");
    for table in [receiver, by_letters, signed] {
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let origin = flight.frame_on_globe.expect(&table).origin;
        assert!(
            (origin.latitude.to_degrees() - 47.5).abs() < 1e-6,
            "{table}"
        );
        assert!(
            (origin.longitude.to_degrees() - 8.5).abs() < 1e-6,
            "{table}"
        );
        // 59 steps of half a thousandth of a minute.
        let north = flight.value(ChannelName::GpsNorth, 5.9).unwrap();
        assert!(
            (north - 59.0 * 5e-4 * 1852.8).abs() < 0.5,
            "{north} {table}"
        );
    }
}

#[test]
fn minutes_south_and_west_of_a_receiver_are_turned_and_near_the_equator_no_degrees() {
    let row = |i: u32| {
        let minutes = 5e-4 * f64::from(i);
        let (latitude, longitude) = (30.0 + minutes, 7830.0 + minutes);
        format!(
            "{:.2},{latitude:.4},S,{longitude:.4},W\n",
            0.1 * f64::from(i)
        )
    };
    let table =
        "time,latitude,N/S,longitude,E/W\n".to_owned() + &(0..60).map(row).collect::<String>();
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let flight = flight_of_tables(&files, &maps).unwrap().flight;
    let origin = flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() + 0.5).abs() < 1e-6);
    assert!((origin.longitude.to_degrees() + 78.5).abs() < 1e-6);
}

#[test]
fn a_date_that_can_be_read_in_two_ways_is_asked_for_and_one_that_cannot_is_not() {
    let questions = |day: &str| {
        let row = |i: usize| {
            format!(
                "{day} 10:00:{:06.3},{:.6},8.0\n",
                0.1 * i as f64,
                47.0 + 1e-5 * i as f64
            )
        };
        let table = "time,latitude,longitude\n".to_owned() + &(0..60).map(row).collect::<String>();
        let asked = guess_table("a.csv", table.as_bytes()).unwrap().questions;
        asked
            .into_iter()
            .filter(|question| question.contains("2024-"))
            .count()
    };
    assert_eq!([questions("5/1/2024"), questions("01.05.2024")], [1, 1]);
    assert_eq!(
        [
            questions("13/5/2024"),
            questions("2024/05/01"),
            questions("5/5/2024")
        ],
        [0, 0, 0]
    );
}

#[test]
fn a_table_of_times_of_day_goes_on_over_midnight() {
    let row = |i: u32| {
        let second = (86_390 + i) % 86_400;
        let time = format!(
            "{:02}:{:02}:{:02}",
            second / 3600,
            second / 60 % 60,
            second % 60
        );
        format!("{time},{:.6},8.0\n", 47.0 + 1e-5 * f64::from(i))
    };
    let table = "time,latitude,longitude\n".to_owned() + &(0..60).map(row).collect::<String>();
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let (first, last) = flight_of_tables(&files, &maps).unwrap().flight.span();
    assert!((last - first - 59.0).abs() < 1e-9, "{first} to {last}");
}

#[test]
fn whole_degrees_whose_minutes_stand_elsewhere_are_given_up_and_others_are_not() {
    let is_read = |head: &str, lat: &dyn Fn(u32) -> String| {
        let row = |i: u32| format!("{i},{},8,5{}.5,{}.25\n", lat(i), i % 10, 30 + i % 7);
        let table = head.to_owned() + &(0..60).map(row).collect::<String>();
        let files = files(&[("a.csv", &table)]);
        let tables = guess_tables(files.as_ref(), &["a.csv".to_owned()]);
        tables[0].map.column(Latitude).is_some()
    };
    let head = "time_s,lat,lon,lat_min,lat_max\n";
    assert!(!is_read(head, &|_| "47".to_owned()));
    let seconds = "time_s,lat_deg,lon,lat_min,lat_sec\n";
    assert!(!is_read(seconds, &|_| "47".to_owned()));
    assert!(is_read(head, &|i| format!(
        "{:.6}",
        47.0 + 1e-5 * f64::from(i)
    )));
}

#[test]
fn a_table_that_stands_alone_is_read_whatever_its_file_is_called() {
    let row = |i: u32| format!("{},{:.6},8.0\n", i, 47.0 + 1e-5 * f64::from(i));
    let table = "time_s,latitude,longitude\n".to_owned() + &(0..60).map(row).collect::<String>();
    for name in ["home.csv", "nav.csv", "track.csv"] {
        let files = files(&[(name, &table)]);
        let tables = guess_tables(files.as_ref(), &[name.to_owned()]);
        assert!(tables[0].map.column(Latitude).is_some(), "{name}");
    }
}

#[test]
fn digits_of_a_clock_go_on_over_midnight() {
    let row = |i: u32| {
        let second = (86_397.0 + 0.1 * f64::from(i)) % 86_400.0;
        let [hours, minutes] = [second / 3600.0, second / 60.0 % 60.0].map(|part| part as u32);
        let lat = -33.85 - 1e-5 * f64::from(i);
        format!(
            "{hours:02}{minutes:02}{:04.1},{lat:.6},-18.42,{}\n",
            second % 60.0,
            50 + i
        )
    };
    let table = "time,lat,lon,alt\n".to_owned() + &(0..60).map(row).collect::<String>();
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let flight = flight_of_tables(&files, &maps).unwrap().flight;
    let height = flight.channel(ChannelName::GpsHeight).unwrap();
    assert_eq!(height.values.len(), 60);
    let length = height.times[59] - height.times[0];
    assert!((length - 5.9).abs() < 1e-6, "{length}");
}

#[test]
fn a_vertical_velocity_that_never_moves_does_not_judge_the_heights() {
    // Half a foot of climb a second, a sensor that shows -0.2 miles an hour all the time.
    let row = |i: u32| {
        let lat = 47.0 + 1e-5 * f64::from(i);
        let height = 1500.0 + 0.05 * f64::from(i);
        format!("{},{lat:.6},8.0,{height:.2},-0.2\n", 100 * i)
    };
    let head = "time(millisecond),latitude,longitude,altitude_above_seaLevel(feet),zSpeed(mph)\n";
    let table = head.to_owned() + &(0..60).map(row).collect::<String>();
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let flight = flight_of_tables(&files, &maps).unwrap().flight;
    let height = flight.channel(ChannelName::GpsHeight).unwrap().values[0];
    assert!((height - 1500.0 * 0.3048).abs() < 1e-6, "{height}");
}

#[test]
fn a_table_in_utf_16_is_read_by_its_mark() {
    let row = |i: usize| {
        format!(
            "{:.1}\t{:.6}\t8.0\t{i}\r\n",
            0.1 * i as f64,
            47.0 + 1e-5 * i as f64
        )
    };
    let table = "time\tlatitude\tlongitude\theading (°)\r\n".to_owned()
        + &(0..60).map(row).collect::<String>();
    for to_bytes in [u16::to_le_bytes, u16::to_be_bytes] {
        let units = std::iter::once(0xfeff).chain(table.encode_utf16());
        let bytes: Vec<u8> = units.flat_map(to_bytes).collect();
        let files: Arc<dyn FileSet> =
            Arc::new(MemoryFiles([("a.csv".to_owned(), bytes.clone())].into()));
        let maps = [guess_table("a.csv", &bytes).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        assert_eq!(
            flight.channel(ChannelName::Heading).map(|c| c.values.len()),
            Some(60)
        );
    }
}

#[test]
fn tables_with_german_french_and_spanish_names_are_flights() {
    for names in [
        "Uhrzeit;Breite;Länge;Höhe (m);Geschwindigkeit (km/h);Kurs (°)",
        "Zeit;Breitengrad;Laengengrad;Hoehe [m];Geschwindigkeit [km/h];Kurs [°]",
        "Heure;Latitude;Longitude;Altitude (m);Vitesse (km/h);Course (°)",
        "Hora;Latitud;Longitud;Altitud (m);Velocidad (km/h);Rumbo (°)",
    ] {
        // 36 km/h to the north, over midnight.
        let row = |i: u32| {
            let seconds = (86_390 + i) % 86_400;
            let (hour, minute, second) = (seconds / 3600, seconds / 60 % 60, seconds % 60);
            let latitude = 47.0 + f64::from(i) * 10.0 / 111_170.0;
            let clock = format!("{hour:02}:{minute:02}:{second:02},000");
            format!("{clock};{latitude:.7};8,5;{},5;36,0;0,0\n", 400 + i).replace('.', ",")
        };
        let table = format!("{names}\n{}", (0..60).map(row).collect::<String>());
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).expect(names).flight;
        let (first, last) = flight.span();
        assert!((last - first - 59.0).abs() < 1e-6, "{names}");
        let north = flight.channel(ChannelName::GpsVelocityNorth).expect(names);
        assert!(
            north.values.iter().all(|v| (v - 10.0).abs() < 1e-6),
            "{names}"
        );
        let height = flight.channel(ChannelName::GpsHeight).expect(names);
        assert_eq!(height.values[10], 410.5, "{names}");
        let origin = flight.frame_on_globe.expect(names).origin;
        assert!(
            (origin.longitude.to_degrees() - 8.5).abs() < 1e-9,
            "{names}"
        );
    }
}

#[test]
fn milliseconds_since_1970_are_the_time_whatever_they_are_called() {
    for name in [
        "unix_ms",
        "epoch_ms",
        "posix_ms",
        "UnixTime",
        "unix time [ms]",
    ] {
        let row = |i: u64| {
            format!(
                "{},{:.5},8.5\n",
                1_714_557_600_000 + 200 * i,
                47.0 + 1e-5 * i as f64
            )
        };
        let table = format!("{name},lat,lon\n{}", (0..60).map(row).collect::<String>());
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).expect(name).flight;
        let (first, last) = flight.span();
        assert!(
            (last - first - 11.8).abs() < 1e-6,
            "{name}: {first} to {last}"
        );
    }
}

#[test]
fn the_date_of_a_table_is_known_where_its_zone_is() {
    type Case<'a> = (&'a str, &'a dyn Fn(usize) -> String, Option<f64>);
    const NOON: f64 = 1_714_564_800.0;
    let day = "2024-05-01";
    let cases: [Case<'_>; 7] = [
        ("time", &|i| format!("{day}T12:00:{i:02}Z"), Some(NOON)),
        ("time", &|i| format!("{day} 14:00:{i:02}+02:00"), Some(NOON)),
        (
            "datetime(utc)",
            &|i| format!("{day} 12:00:{i:02}"),
            Some(NOON),
        ),
        ("time", &|i| format!("{day} 12:00:{i:02}"), None),
        (
            "unix_ms",
            &|i| format!("{}", 1_714_564_800_000 + 1000 * i),
            Some(NOON),
        ),
        ("gps_time", &|i| format!("{}", 1_398_600_000 + i), None),
        ("time [s]", &|i| format!("{i}"), None),
    ];
    for (name, time, expected) in cases {
        let row = |i: usize| format!("{},{:.6},8.0,{i}\n", time(i), 47.0 + 1e-5 * i as f64);
        let table = format!(
            "{name},lat,lon,heading\n{}",
            (0..50).map(row).collect::<String>()
        );
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let folder = flight_of_tables(&files, &maps).expect(name);
        let (first, _) = folder.flight.span();
        let found = folder.log().utc_at_zero.map(|utc| utc + first);
        assert_eq!(found, expected, "{name}, {}", time(0));
    }
}

#[test]
fn tables_of_loggers_are_read_as_they_are() {
    let place = |i: u32| (47.0 + 8e-6 * f64::from(i), 8.0 + 3e-6 * f64::from(i));
    let rows = |head: &str, row: &dyn Fn(u32) -> String| {
        head.to_owned() + "\n" + &(0..60).map(|i| row(i) + "\n").collect::<String>()
    };
    let time = |i: u32| format!("{:06.3}", 0.1 * f64::from(i));
    let times: [(&str, &dyn Fn(u32) -> String); 5] = [
        ("slashes", &|i| format!("2024/05/01 10:00:{}", time(i))),
        ("day first", &|i| format!("01.05.2024 10:00:{}", time(i))),
        ("month first", &|i| format!("5/1/2024 10:00:{} AM", time(i))),
        ("time of day", &|i| format!("10:00:{}", time(i))),
        ("date beside", &|i| format!("10:00:{}", time(i))),
    ];
    for (what, of) in times {
        let table = rows("time,latitude,longitude", &|i| {
            let (lat, lon) = place(i);
            format!("{},{lat:.6},{lon:.6}", of(i))
        });
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let (first, last) = flight.span();
        assert!(
            (last - first - 5.9).abs() < 1e-6,
            "{what}: {first} to {last}"
        );
    }
    let hemispheres = rows("time,latitude,N/S,longitude,E/W", &|i| {
        let (lat, lon) = place(i);
        format!("{},{lat:.6},S,{lon:.6},W", 0.1 * f64::from(i))
    });
    let letters = rows("time,latitude,longitude", &|i| {
        let (lat, lon) = place(i);
        format!("{},{lat:.6}S,{lon:.6}W", 0.1 * f64::from(i))
    });
    for table in [hemispheres, letters] {
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let origin = flight.frame_on_globe.unwrap().origin;
        assert!(
            (origin.latitude.to_degrees() + 47.0).abs() < 1e-6,
            "{table}"
        );
        assert!(
            (origin.longitude.to_degrees() + 8.0).abs() < 1e-6,
            "{table}"
        );
        assert!(flight.value(ChannelName::GpsNorth, 5.9).unwrap() < -50.0);
    }
    let units = rows("time,height,airspeed", &|i| {
        format!("{},{} ft,18.0 km/h", 0.1 * f64::from(i), 100 + i % 7)
    });
    let map = guess_table("a.csv", units.as_bytes()).unwrap();
    let height = Channel(ChannelName::HeightAboveGround);
    assert_eq!(guessed(&map, "height"), is(height, "ft"));
    assert_eq!(
        guessed(&map, "airspeed"),
        is(Channel(ChannelName::Airspeed), "km/h")
    );
}

#[test]
fn a_time_that_leaps_ahead_takes_only_its_own_row() {
    let row = |i: u32| {
        let time = if i == 50 { 1e9 } else { 0.1 * f64::from(i) };
        format!("{time:.1},{}\n", i % 9)
    };
    let table = "time,roll_deg\n".to_owned() + &(0..100).map(row).collect::<String>();
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let folder = flight_of_tables(&files, &maps).unwrap();
    assert_eq!(
        folder
            .flight
            .channel(ChannelName::Roll)
            .unwrap()
            .values
            .len(),
        99
    );
    assert!(
        folder
            .notes
            .iter()
            .any(|note| note.contains("1 row was left out"))
    );
}

#[test]
fn a_radio_writes_places_into_one_cell() {
    let row = |i: u32| {
        let t = 0.1 * f64::from(i);
        let (lat, lon) = (47.0 + 8e-6 * f64::from(i), 8.0 + 3e-6 * f64::from(i));
        format!(
            "2024-05-01,10:00:{t:06.3},{lat:.6} {lon:.6},33.0,14.3,{:.1}\n",
            30.0 + t
        )
    };
    let table = "Date,Time,GPS,GSpd(kmh),Hdg(°),Alt(m)\n".to_owned()
        + &(0..200).map(row).collect::<String>();
    let files = files(&[("radio.csv", &table)]);
    let maps = [guess_table("radio.csv", table.as_bytes()).unwrap()];
    assert_eq!(
        guessed(&maps[0], "GPS"),
        is(super::ColumnRole::Place, "deg")
    );
    let flight = flight_of_tables(&files, &maps).unwrap().flight;
    let origin = flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() - 47.0).abs() < 1e-9);
    let (first, last) = flight.span();
    assert!((last - first - 19.9).abs() < 1e-6);
    let north = flight.value(ChannelName::GpsNorth, first + 19.9).unwrap();
    assert!((north - 177.0).abs() < 1.0, "{north}");
}

#[test]
fn seconds_and_their_parts_in_two_columns_are_one_time() {
    for start in [0_u64, 1_700_000_000] {
        let row = |i: u64| {
            let nanoseconds = i * 50_000_000;
            let (whole, rest) = (
                start + nanoseconds / 1_000_000_000,
                nanoseconds % 1_000_000_000,
            );
            format!("{whole},{rest},{}\n", i % 9)
        };
        let table = "header.stamp.sec,header.stamp.nanosec,roll_deg\n".to_owned()
            + &(0..400).map(row).collect::<String>();
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let roll = flight_of_tables(&files, &maps).unwrap().flight;
        let roll = roll.channel(ChannelName::Roll).unwrap();
        assert_eq!(roll.values.len(), 400);
        assert!(
            roll.times
                .windows(2)
                .all(|w| (w[1] - w[0] - 0.05).abs() < 1e-6)
        );
    }
}

#[test]
fn a_speed_that_contradicts_the_track_leaves_a_flight_without_it() {
    let row = |i: u32| {
        let (lat, lon) = (47.0 + 8e-6 * f64::from(i), 8.0 + 3e-6 * f64::from(i));
        format!("{},{lat:.6},{lon:.6},5.0,20.0\n", 0.1 * f64::from(i))
    };
    let table =
        "time,latitude,longitude,speed,course\n".to_owned() + &(0..60).map(row).collect::<String>();
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let folder = flight_of_tables(&files, &maps).unwrap();
    assert!(
        folder
            .flight
            .channel(ChannelName::GpsVelocityNorth)
            .is_none()
    );
    let told = "differ by a factor of 1.8, which no unit explains";
    assert!(
        folder.notes.iter().any(|note| note.contains(told)),
        "{:?}",
        folder.notes
    );
}

#[test]
fn pictures_that_a_table_names_are_the_frames_of_its_flight() {
    let row = |i: u32| {
        let lat = 47.0 + 4e-5 * f64::from(i);
        format!(
            "p{i}.png,{},{lat:.6},8.0,{},{}\n",
            2 * i,
            100 + i % 3,
            10 * i
        )
    };
    let table = "file,time_s,lat,lon,height_agl_m,heading_deg\n".to_owned()
        + &(0..6).map(row).collect::<String>();
    let mut png = std::io::Cursor::new(Vec::new());
    let picture = image::RgbImage::from_pixel(8, 6, image::Rgb([7; 3]));
    picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
    let mut all = MemoryFiles([("x/t.csv".to_owned(), table.clone().into_bytes())].into());
    for i in 0..6 {
        all.0
            .insert(format!("x/shots/p{i}.png"), png.get_ref().clone());
    }
    let files: Arc<dyn FileSet> = Arc::new(all);
    let maps = [guess_table("x/t.csv", table.as_bytes()).unwrap()];
    let mut folder = flight_of_tables(&files, &maps).unwrap();
    assert_eq!(folder.flight.frames.len(), 6);
    assert_eq!(folder.flight.frames[3].time, 6.0);
    assert_eq!(
        (folder.flight.camera.width, folder.flight.camera.height),
        (8, 6)
    );
    assert_eq!(folder.frames.picture(5).unwrap().width(), 8);
    assert!(
        folder
            .notes
            .iter()
            .any(|note| note.contains("names 6 pictures"))
    );
}

#[test]
fn hemispheres_in_the_names_of_columns_turn_places() {
    for (names, turned) in [
        (["Latitude (S)", "Longitude (W)"], [-1.0, -1.0]),
        (["Lat S", "Lon E"], [-1.0, 1.0]),
        (["lat_n", "lon_w"], [1.0, -1.0]),
        (["LAT [°N]", "LON [°E]"], [1.0, 1.0]),
    ] {
        let row = |i: usize| {
            let time = 0.1 * i as f64;
            format!("{time:.1},{:.6},8.25,{i}\n", 47.0 + 1e-5 * i as f64)
        };
        let rows: String = (0..60).map(row).collect();
        let table = format!("time,{},heading\n{rows}", names.join(","));
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let origin = flight.frame_on_globe.expect(names[0]).origin;
        let found = [origin.latitude, origin.longitude].map(f64::to_degrees);
        let right = [47.0 * turned[0], 8.25 * turned[1]];
        for (found, right) in found.iter().zip(right) {
            assert!((found - right).abs() < 1e-6, "{names:?}: {found}");
        }
    }
}
