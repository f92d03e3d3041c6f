//! Tables of flights that wait for long, and of clocks that are coarser than their rows.

use std::fmt::Write as _;

use pilotage_flight::ChannelName;

use super::ColumnRole::Channel;
use super::tests::{files, guessed, is};
use super::{flight_of_tables, guess_table};

#[test]
fn rows_of_a_clock_that_is_coarser_than_they_are_keep_their_places_and_are_spread() {
    let clock = |row: u32| row / 5;
    let times: [(&str, &dyn Fn(u32) -> String); 3] = [
        ("time [s]", &|row| clock(row).to_string()),
        ("time", &|row| {
            format!("10:{:02}:{:02}", clock(row) / 60, clock(row) % 60)
        }),
        ("timestamp", &|row| (1_714_557_600 + clock(row)).to_string()),
    ];
    for (name, time) in times {
        for (is_doubled, rows) in [(false, 200), (true, 40)] {
            let place = |row: u32| if is_doubled { clock(row) } else { row };
            let row = |row: u32| {
                let north = 47.1 + 2e-5 * f64::from(place(row));
                format!("{},{north:.6},8.5,{}\n", time(row), 500 + place(row))
            };
            let table =
                format!("{name},lat,lon,altitude [m]\n") + &(0..200).map(row).collect::<String>();
            let files = files(&[("a.csv", &table)]);
            let maps = [guess_table("a.csv", table.as_bytes()).expect(name)];
            let folder = flight_of_tables(&files, &maps).expect(name);
            let states = &folder.flight.truth.as_ref().expect(name).states;
            assert_eq!(states.len(), rows, "{name}");
            let step = 200.0 / rows as f64 / 5.0;
            for (i, state) in states.iter().enumerate() {
                let since = state.time - states[0].time;
                assert!(
                    (since - step * i as f64).abs() < 1e-6,
                    "{name} {i}: {since}"
                );
                let north = state.position.x - states[0].position.x;
                assert!(
                    (north - 2.2238 * i as f64).abs() < 0.1,
                    "{name} {i}: {north}"
                );
            }
            let is_told = |note: &String| note.contains("clock is coarser");
            assert_eq!(folder.notes.iter().any(is_told), !is_doubled, "{name}");
        }
    }
}

#[test]
fn rows_of_several_bodies_at_each_time_are_refused() {
    for apart in ["A,B", "1,2", ","] {
        let names: Vec<&str> = apart.split(',').collect();
        let row = |row: usize| {
            let latitude = 47.1 + 1e-4 * row as f64 + 0.1 * (row % 2) as f64;
            format!(
                "{},{},{latitude:.6},8.5,{}\n",
                row / 2,
                names[row % 2],
                500 + row % 3
            )
        };
        let table =
            "time,id,lat,lon,altitude [m]\n".to_owned() + &(0..200).map(row).collect::<String>();
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let found = flight_of_tables(&files(&[("a.csv", &table)]), &maps);
        let wrong = found.err().unwrap();
        assert!(wrong.to_string().contains("several bodies"), "{wrong}");
        // Another table is read without it.
        let row = |t: u32| format!("{t},{}\n", 15 + t % 3);
        let own: String = (0..100).map(row).collect();
        let own = format!("time,airspeed [m/s]\n{own}");
        let both = [
            maps[0].clone(),
            guess_table("b.csv", own.as_bytes()).unwrap(),
        ];
        let files = files(&[("a.csv", &table), ("b.csv", &own)]);
        let folder = flight_of_tables(&files, &both).ok().unwrap();
        assert!(
            folder
                .flight
                .channel(pilotage_flight::ChannelName::Airspeed)
                .is_some()
        );
        assert!(folder.notes.iter().any(|note| note.contains("left out")));
    }
}

#[test]
fn rows_of_several_cameras_or_sensors_at_each_time_are_not_refused() {
    let row = |row: usize| {
        let latitude = 47.1 + 1e-4 * (row / 2) as f64;
        format!(
            "10:00:{:02},{},{row}.jpg,{latitude:.6},8.5\n",
            row / 2,
            row % 2
        )
    };
    let cameras = "time,camera,file,lat,lon\n".to_owned() + &(0..100).map(row).collect::<String>();
    let maps = [guess_table("a.csv", cameras.as_bytes()).unwrap()];
    let folder = flight_of_tables(&files(&[("a.csv", &cameras)]), &maps);
    assert_eq!(folder.ok().unwrap().flight.truth.unwrap().states.len(), 50);
    let row = |row: u32| {
        let latitude = 47.1 + 1e-4 * f64::from(row);
        format!(
            "10:00:{row:02},GPS,{latitude:.6},8.5,500,\n10:00:{row:02},AIR,,,,{}\n",
            15 + row % 3
        )
    };
    let sensors = "time,of,lat,lon,altitude [m],airspeed [m/s]\n".to_owned()
        + &(0..50).map(row).collect::<String>();
    let maps = [guess_table("a.csv", sensors.as_bytes()).unwrap()];
    let folder = flight_of_tables(&files(&[("a.csv", &sensors)]), &maps);
    assert_eq!(folder.ok().unwrap().flight.truth.unwrap().states.len(), 50);
}

#[test]
fn directions_of_a_flight_that_waits_for_long_are_judged_by_the_time_that_it_flies() {
    // At rest for 40 minutes, then a circle at 15 m/s for one; directions in hundredths of a degree, at rest 0 and noise.
    let mut table = String::from("time,lat,lon,heading,course,speed\n");
    for row in 0..2460 {
        let turned = 6.0 * (f64::from(row) - 2400.0).max(0.0);
        let (sin, cos) = turned.to_radians().sin_cos();
        let radius = 15.0 / 6.0_f64.to_radians();
        let (north, east) = (radius * sin, radius * (1.0 - cos));
        let heading = 100.0 * (turned % 360.0) + f64::from(row % 2);
        let _ = writeln!(
            table,
            "{row},{:.7},{:.7},{heading},{},{}",
            47.1 + north / 111_190.0,
            8.5 + east / 75_690.0,
            100.0 * (turned % 360.0),
            if row < 2400 { 0 } else { 15 }
        );
    }
    let map = guess_table("a.csv", table.as_bytes()).unwrap();
    assert_eq!(
        guessed(&map, "heading"),
        is(Channel(ChannelName::Heading), "cdeg")
    );
    assert_eq!(guessed(&map, "course").1, "cdeg");
}

#[test]
fn places_over_the_equator_and_greenwich_keep_the_hemispheres_of_their_rows() {
    let place = |row: f64| [1e-4 * row - 0.01, 0.012 - 1.5e-4 * row];
    let row = |row: u32, order: [usize; 4]| {
        let [latitude, longitude] = place(f64::from(row));
        let letter = |angle: f64, of: [&str; 2]| of[usize::from(angle < 0.0)].to_owned();
        let cells = [
            format!("{:.7}", latitude.abs()),
            letter(latitude, ["N", "S"]),
            format!("{:.7}", longitude.abs()),
            letter(longitude, ["E", "\"W\""]),
        ];
        let cells = order.map(|at| cells[at].clone()).join(",");
        format!("{row},{cells},500\n")
    };
    for order in [[0, 1, 2, 3], [0, 2, 1, 3], [1, 0, 3, 2]] {
        let names = order.map(|at| ["latitude", "N/S", "longitude", "E/W"][at]);
        let names = format!("time [s],{},altitude [m]\n", names.join(","));
        let rows: String = (0..200).map(|i| row(i, order)).collect();
        // A letter that is none, and names again.
        let table = format!("{names}{rows}")
            .replace("\n150,", &format!("\n{names}150,"))
            .replace("\n160,", "\n159.5,1,1,1,1,500\n160,");
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let folder = flight_of_tables(&files, &maps).unwrap();
        let is_told = |note: &String| note.contains("1 row has no place");
        assert!(folder.notes.iter().any(is_told), "{:?}", folder.notes);
        let frame = folder.flight.frame_on_globe.unwrap();
        let states = folder.flight.truth.unwrap().states;
        assert_eq!(states.len(), 200);
        for (i, state) in states.iter().enumerate() {
            let ground =
                pilotage_base::frames::GroundPoint::new(state.position.x, state.position.y);
            let found = frame.geodetic_from_ground(&ground);
            let [latitude, longitude] = place(i as f64);
            assert!((found.latitude.to_degrees() - latitude).abs() < 1e-6, "{i}");
            assert!(
                (found.longitude.to_degrees() - longitude).abs() < 1e-6,
                "{i}"
            );
        }
    }
}

#[test]
fn places_with_an_o_of_german_or_french_tables_are_east_or_west() {
    for (names, side) in [
        ("Zeit [s];Breite;Länge;Höhe [m]", 1.0),
        ("time [s];latitude;longitude;hauteur [m]", -1.0),
    ] {
        let row = |row: u32| {
            let [latitude, longitude] = [338_500 + row, 184_200 + row];
            format!(
                "{row};33,{:04} S;18,{:04} O;120\n",
                latitude % 10_000,
                longitude % 10_000
            )
        };
        let rows: String = (0..100).map(row).collect();
        let table = format!("{names}\n{rows}");
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).expect(names)];
        let folder = flight_of_tables(&files, &maps).expect(names);
        let frame = folder.flight.frame_on_globe.unwrap();
        let states = folder.flight.truth.unwrap().states;
        assert_eq!(states.len(), 100);
        let last = states[99].position;
        let ground = pilotage_base::frames::GroundPoint::new(last.x, last.y);
        let found = frame.geodetic_from_ground(&ground);
        let [latitude, longitude] = [found.latitude, found.longitude].map(f64::to_degrees);
        assert!((latitude + 33.8599).abs() < 1e-6, "{names} {latitude}");
        assert!(
            (longitude - side * 18.4299).abs() < 1e-6,
            "{names} {longitude}"
        );
    }
}

#[test]
fn a_mode_or_a_level_called_by_a_letter_turns_no_place() {
    for (names, of) in [
        ("altitude,mode", "S"),
        ("altitude,level", "W"),
        ("mode,altitude", "W"),
        ("altitude,Flight mode", "N\u{0}S"),
    ] {
        let is_behind = names.starts_with("alt");
        let row = |i: u32| {
            let letter = of.split('\0').nth(usize::from(i > 50 && of.len() > 1));
            let [a, b] = [
                format!("{}", 500 + i % 7),
                letter.unwrap_or_default().to_owned(),
            ];
            let [a, b] = if is_behind { [a, b] } else { [b, a] };
            format!("{i},{:.5},{:.5},{a},{b}\n", 47.1 + 1e-4 * f64::from(i), 8.5)
        };
        let rows: String = (0..100).map(row).collect();
        let table = format!("time [s],latitude,longitude,{names}\n{rows}");
        let files = files(&[("a.csv", &table)]);
        let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
        let flight = flight_of_tables(&files, &maps).unwrap().flight;
        let origin = flight.frame_on_globe.unwrap().origin;
        let degrees = [origin.latitude, origin.longitude].map(f64::to_degrees);
        assert!((degrees[0] - 47.1).abs() < 1e-9, "{names}: {degrees:?}");
        assert!((degrees[1] - 8.5).abs() < 1e-9, "{names}: {degrees:?}");
    }
}

#[test]
fn one_name_over_date_and_time_does_not_shift_the_others() {
    let dated = |row: u32| format!("2024/05/01 10:00:{row:02}.000");
    // 2312 is the week of 28 April 2024.
    let of_week = |row: u32| format!("2312 {:.3}", 345_600.0 + f64::from(row));
    let times: [&dyn Fn(u32) -> String; 2] = [&dated, &of_week];
    for time in times {
        let row = |row: u32| {
            let latitude = 47.1 + 1e-5 * f64::from(row);
            format!(
                "{}   {latitude:.9}    8.500000000   512.3  1  12\n",
                time(row)
            )
        };
        let table = "% program   : RTKLIB ver.2.4.3\n%\n%  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns\n"
            .to_owned()
            + &(0..50).map(row).collect::<String>();
        let map = guess_table("a.pos", table.as_bytes()).unwrap();
        let files = files(&[("a.pos", &table)]);
        let flight = flight_of_tables(&files, &[map]).unwrap().flight;
        let origin = flight.frame_on_globe.unwrap().origin;
        assert!((origin.latitude.to_degrees() - 47.1).abs() < 1e-9);
        assert!((origin.longitude.to_degrees() - 8.5).abs() < 1e-9);
        let states = flight.truth.unwrap().states;
        assert_eq!(states.len(), 50);
        assert!((states[49].time - states[0].time - 49.0).abs() < 1e-9);
    }
}

#[test]
fn rows_that_end_in_a_separator_keep_their_columns() {
    for (names, end) in [
        ("date,time,lat,lon,alt", ","),
        ("Date,UTC,lat,lon,alt", ","),
        ("date,time,lat,lon,alt", ",x"),
        ("day,of,lat,lon,alt", ","),
    ] {
        let row = |row: u32| {
            let latitude = 47.1 + 1e-4 * f64::from(row);
            format!(
                "2024/05/01,10:00:{row:02},{latitude:.6},8.5,{}{end}\n",
                500 + row % 7
            )
        };
        let table = format!("{names}\n") + &(0..50).map(row).collect::<String>();
        let map = guess_table("a.csv", table.as_bytes()).expect(names);
        let name = |role| map.column(role).map(|column| column.name.as_str());
        assert_eq!(name(super::ColumnRole::Latitude), Some("lat"), "{names}");
        let index = map.columns.iter().position(|column| column.name == "lat");
        assert_eq!(index, Some(2), "{names}{end}");
    }
}

#[test]
fn a_clock_that_stands_is_not_taken_before_one_that_grows() {
    // Pauses make the seconds of the fine clock uneven.
    let row = |row: u32| {
        let fine = 0.02 * f64::from(row) + f64::from(row / 37);
        let latitude = 47.1 + 2e-6 * f64::from(row);
        format!(
            "{},{fine:.2},{latitude:.6},8.5,{}\n",
            100_000.0 + fine.floor(),
            500 + row % 3
        )
    };
    let rows: String = (0..400).map(row).collect();
    let table = format!("GPS time [s],time [s],lat,lon,altitude [m]\n{rows}");
    let map = guess_table("a.csv", table.as_bytes()).unwrap();
    let time = map.column(super::ColumnRole::Time).unwrap();
    assert_eq!(time.name, "time [s]");
}
