use std::fmt::Write as _;
use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use pilotage_base::files::{FileSet, MemoryFiles};
use pilotage_flight::ChannelName;

use super::studies::either;
use ColumnRole::{Channel, Course, Latitude, Longitude, Nothing, SpeedOverGround, Time};

/// Role and unit that were guessed for a column of a table.
pub(super) fn guessed(map: &ColumnMap, column: &str) -> (ColumnRole, String) {
    let column = map.columns.iter().find(|c| c.name == column);
    let column = column.unwrap_or_else(|| panic!("no such column in {}", map.file));
    (column.role, column.unit.clone())
}

pub(super) fn is(role: ColumnRole, unit: &str) -> (ColumnRole, String) {
    (role, unit.to_owned())
}

/// Ten seconds eastward at 20 m/s along 47° north, ten rows a second.
fn eastward() -> String {
    let mut table = String::from("time [s];Lat;Lon;roll (deg);Airspeed [km/h];Climb;battery\n");
    for row in 0..100 {
        let time = 0.1 * f64::from(row);
        let longitude = 8.0 + time * 20.0 / 76_058.0;
        let roll = f64::from(row % 40 - 20);
        let volts = 11.1 + time;
        writeln!(table, "{time:.1};47.0;{longitude:.7};{roll};72;0.5;{volts}").unwrap();
    }
    table
}

pub(super) fn files(tables: &[(&str, &str)]) -> Arc<dyn FileSet> {
    let entry = |(name, text): &(&str, &str)| ((*name).to_owned(), text.as_bytes().to_vec());
    Arc::new(MemoryFiles(tables.iter().map(entry).collect()))
}

/// Tables of the flying wing X-8, or `None`, said aloud, where they are not beside the repository.
fn recorded(names: &[&str]) -> Option<Arc<dyn FileSet>> {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../../shared/data/inertialnav_x8"
    );
    let mut found = MemoryFiles::default();
    for name in names {
        let Ok(bytes) = std::fs::read(format!("{folder}/{name}")) else {
            println!("skipped: no shared data (inertialnav_x8/{name})");
            return None;
        };
        found.0.insert((*name).to_owned(), bytes);
    }
    Some(Arc::new(found))
}

fn tables(files: &Arc<dyn FileSet>) -> Vec<GuessedTable> {
    guess_tables(files.as_ref(), &files.names())
}

fn map_of<'a>(tables: &'a [GuessedTable], file: &str) -> &'a ColumnMap {
    let table = tables.iter().find(|table| table.map.file == file);
    &table.unwrap_or_else(|| panic!("{file} was no table")).map
}

#[test]
fn a_written_table_is_understood_with_its_units_and_reasons() {
    let map = guess_table("east.csv", eastward().as_bytes()).unwrap();
    assert_eq!(guessed(&map, "time [s]"), is(Time, "s"));
    assert_eq!(guessed(&map, "Lat"), is(Latitude, "deg"));
    assert_eq!(guessed(&map, "Lon"), is(Longitude, "deg"));
    let roll = Channel(ChannelName::Roll);
    assert_eq!(guessed(&map, "roll (deg)"), is(roll, "deg"));
    let airspeed = Channel(ChannelName::Airspeed);
    assert_eq!(guessed(&map, "Airspeed [km/h]"), is(airspeed, "km/h"));
    let down = Channel(ChannelName::GpsVelocityDown);
    assert_eq!(guessed(&map, "Climb"), is(down, "m/s"));
    assert_eq!(guessed(&map, "battery"), is(Nothing, ""));
    assert_eq!(map.column(down).map(|c| c.scale), Some(-1.0));
    assert_eq!(map.lacks(), None);
    for column in &map.columns {
        assert!((0.0..=1.0).contains(&column.confidence), "{column:?}");
        assert!(!column.reason.is_empty(), "{column:?}");
        assert!(
            column.role == Nothing || column.role.units().contains(&column.unit.as_str()),
            "{column:?}"
        );
    }
}

/// Photos of a survey: too far apart for a speed.
#[test]
fn places_a_minute_apart_are_degrees_of_which_no_speed_is_told() {
    let mut table = String::from("file,time_s,latitude_deg,longitude_deg\n");
    for row in 0..20 {
        let north = f64::from(row) * 2e-4;
        writeln!(table, "{row}.jpg,{},{},8.5", 60 * row, 47.0 + north).unwrap();
    }
    let map = guess_table("photos.csv", table.as_bytes()).unwrap();
    assert_eq!(guessed(&map, "latitude_deg"), is(Latitude, "deg"));
    assert_eq!(guessed(&map, "longitude_deg"), is(Longitude, "deg"));
    for column in &map.columns {
        assert!(!column.reason.contains("NaN"), "{column:?}");
    }
}

#[test]
fn a_flight_of_a_written_table_has_its_origin_channels_and_values() {
    let files = files(&[("east.csv", &eastward())]);
    let maps = [guess_table("east.csv", eastward().as_bytes()).unwrap()];
    let folder = flight_of_tables(&files, &maps).unwrap();
    assert_eq!(folder.notes.len(), 1, "{:?}", folder.notes);
    assert!(folder.notes[0].ends_with("taken: GPS velocity down (Climb) in m/s. Is that right?"));
    let flight = folder.flight;
    assert_eq!(flight.name, "east");
    let origin = flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() - 47.0).abs() < 1e-12);
    assert!((origin.longitude.to_degrees() - 8.0).abs() < 1e-9);
    assert_eq!(flight.start.time, 0.0);
    assert!(
        flight
            .start
            .position
            .north
            .hypot(flight.start.position.east)
            < 1e-9
    );
    let value = |name, time| flight.value(name, time).unwrap();
    assert!((value(ChannelName::GpsEast, 9.9) - 198.0).abs() < 0.5);
    assert!(value(ChannelName::GpsNorth, 9.9).abs() < 0.1);
    assert!((value(ChannelName::Airspeed, 5.0) - 20.0).abs() < 1e-12);
    assert!((value(ChannelName::Roll, 0.0) + 20_f64.to_radians()).abs() < 1e-12);
    assert!((value(ChannelName::GpsVelocityDown, 5.0) + 0.5).abs() < 1e-12);
    assert_eq!(flight.channels.len(), 5);
    assert_eq!(flight.truth.unwrap().states.len(), 100);
}

#[test]
fn what_people_correct_is_done() {
    let files = files(&[("east.csv", &eastward())]);
    let mut map = guess_table("east.csv", eastward().as_bytes()).unwrap();
    for column in &mut map.columns {
        match column.name.as_str() {
            "Airspeed [km/h]" => column.unit = "kt".to_owned(),
            "Climb" | "Lat" | "Lon" => column.role = Nothing,
            _ => {}
        }
    }
    let folder = flight_of_tables(&files, &[map]).unwrap();
    let airspeed = folder.flight.value(ChannelName::Airspeed, 5.0).unwrap();
    assert!((airspeed - 72.0 * 1852.0 / 3600.0).abs() < 1e-9);
    assert_eq!(folder.flight.channels.len(), 2);
    assert_eq!(folder.flight.frame_on_globe, None);
    assert!(folder.notes[0].contains("begins at the world's origin"));
}

#[test]
fn a_map_says_what_it_lacks() {
    let whole = guess_table("east.csv", eastward().as_bytes()).unwrap();
    let with = |name: &str, role: ColumnRole| {
        let mut map = whole.clone();
        let column = map.columns.iter_mut().find(|c| c.name == name).unwrap();
        column.role = role;
        map
    };
    let lacks = |map: &ColumnMap| map.lacks().unwrap_or_default();
    let mut timeless = with("time [s]", Nothing);
    assert!(lacks(&timeless).contains("no column is the time"));
    for rate in [0.0, -1.0, f64::NAN] {
        timeless.rows_per_second = Some(rate);
        assert!(lacks(&timeless).contains("no column is the time"));
    }
    timeless.rows_per_second = Some(10.0);
    assert_eq!(timeless.lacks(), None);
    let flight = flight_of_tables(&files(&[("east.csv", &eastward())]), &[timeless]);
    let (first, last) = flight.unwrap().flight.span();
    assert!(first == 0.0 && (last - 9.9).abs() < 1e-9);
    assert!(lacks(&with("Lon", Nothing)).contains("latitude is of no use without longitude"));
    assert!(lacks(&with("Climb", Course)).contains("course over ground is of no use"));
    assert!(lacks(&with("battery", Latitude)).contains("two columns are latitude"));
    assert_eq!(tables_lack(&[&whole]), None);
    let mut other = whole.clone();
    other.file = "folder/other.csv".to_owned();
    assert_eq!(
        tables_lack(&[&whole, &other]).unwrap(),
        "east.csv and other.csv both tell the roll; let one of them not be used"
    );
    assert_eq!(tables_lack(&[]).unwrap(), "no table is to be used");
}

#[test]
fn columns_of_one_name_and_of_none_are_told_apart() {
    let table = "t,alt,alt,\n0,1,10,5\n1,2,20,6\n2,3,30,7\n3,4,40,8\n";
    let map = guess_table("a.csv", table.as_bytes()).unwrap();
    let names: Vec<&str> = map.columns.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["t", "alt", "alt (2)", "#4"]);
    let mut map = map;
    map.columns[1].role = Nothing;
    map.columns[2].role = Channel(ChannelName::BarometricHeight);
    map.columns[2].unit = "m".to_owned();
    let folder = flight_of_tables(&files(&[("a.csv", table)]), &[map]).unwrap();
    let height = folder.flight.value(ChannelName::BarometricHeight, 3.0);
    assert_eq!(height, Some(40.0));
}

#[test]
fn places_of_a_receiver_without_a_fix_are_left_out() {
    let mut table = String::from("t,lat,lon,roll_deg\n");
    for row in 0..20 {
        let place = if row < 5 { "0,0" } else { "47.0,8.0" };
        writeln!(table, "{row},{place},{row}").unwrap();
    }
    let files = files(&[("a.csv", &table)]);
    let maps = [guess_table("a.csv", table.as_bytes()).unwrap()];
    let folder = flight_of_tables(&files, &maps).unwrap();
    let north = folder.flight.channel(ChannelName::GpsNorth).unwrap();
    assert_eq!(north.values.len(), 15);
    assert_eq!(folder.flight.start.time, 5.0);
    assert!(
        folder.notes[0].starts_with("5 places were left out"),
        "{:?}",
        folder.notes
    );
}

#[test]
fn one_damaged_place_says_nothing_of_the_unit_of_the_others() {
    for (factor, digits) in [(1.0, 7), (1e7, 0), (1.0_f64.to_radians(), 10)] {
        for damaged in [0, 1, 30, 58, 59] {
            for (off, is_latitude) in [(30.0, true), (300.0, true), (-60.0, false), (150.0, false)]
            {
                let mut table = String::from("time,lat,lon\n");
                for row in 0..60 {
                    let mut place = [47.1 + 1e-5 * f64::from(row), 8.5 + 2e-5 * f64::from(row)];
                    if row == damaged {
                        place[usize::from(!is_latitude)] += off;
                    }
                    let [latitude, longitude] = place.map(|degrees| degrees * factor);
                    writeln!(table, "{row},{latitude:.digits$},{longitude:.digits$}").unwrap();
                }
                let files = files(&[("flight.csv", &table)]);
                let maps: Vec<_> = tables(&files).into_iter().map(|t| t.map).collect();
                let folder = flight_of_tables(&files, &maps).unwrap();
                let case = format!("{factor} {damaged} {off}");
                let origin = folder.flight.frame_on_globe.unwrap().origin;
                assert!(
                    (origin.latitude.to_degrees() - 47.1).abs() < 0.01,
                    "{case}: {origin:?}"
                );
                let north = &folder.flight.channel(ChannelName::GpsNorth).unwrap().values;
                assert_eq!(north.len(), 59, "{case}");
                assert!(north.iter().all(|north| north.abs() < 100.0), "{case}");
            }
        }
    }
}

#[test]
fn one_damaged_time_or_direction_says_nothing_of_the_units_of_the_others() {
    // A circle flown at 15 m/s, 54 km/h, three degrees a half second.
    let table = |damaged: Option<(usize, usize, f64)>| {
        let mut table = String::from("time,lat,lon,heading,course,speed\n");
        for row in 0..100 {
            let turned = 3.0 * f64::from(row);
            let (sin, cos) = turned.to_radians().sin_cos();
            let radius = 15.0 / (2.0 * 3.0_f64.to_radians());
            let place = [
                47.1 + radius * sin / 111_190.0,
                8.5 + radius * (1.0 - cos) / 75_690.0,
            ];
            let mut cells = [
                0.5 * f64::from(row),
                place[0],
                place[1],
                turned,
                turned,
                54.0,
            ];
            if let Some((_, column, value)) = damaged.filter(|d| d.0 == row as usize) {
                cells[column] = value;
            }
            let [time, latitude, longitude, heading, course, speed] = cells;
            writeln!(
                table,
                "{time},{latitude:.7},{longitude:.7},{heading},{course},{speed}"
            )
            .unwrap();
        }
        let files = files(&[("flight.csv", &table)]);
        let map = tables(&files).remove(0).map;
        ["heading", "course", "speed"].map(|column| guessed(&map, column))
    };
    let sound = table(None);
    assert_eq!(sound[0], is(Channel(ChannelName::Heading), "deg"));
    assert_eq!(sound[2], is(SpeedOverGround, "km/h"));
    for row in [0, 50, 99] {
        for (column, value) in [(0, 1e9), (3, 1e9), (3, 150_000.0), (4, 1e9), (4, 1500.0)] {
            assert_eq!(
                table(Some((row, column, value))),
                sound,
                "{row} {column} {value}"
            );
        }
    }
}

#[test]
fn one_damaged_height_or_velocity_says_nothing_of_the_units_of_the_others() {
    // A circle flown at 15 m/s up and down, velocities in cm/s, heights in mm.
    let table = |damaged: Option<(usize, usize, f64)>| {
        let mut table = String::from("time,lat,lon,alt,vn,ve,vd\n");
        for row in 0..150 {
            let (sin, cos) = (3.0 * f64::from(row)).to_radians().sin_cos();
            let (wave, slope) = (f64::from(row) / 9.0).sin_cos();
            let radius = 15.0 / (2.0 * 3.0_f64.to_radians());
            let mut cells = [
                0.5 * f64::from(row),
                47.1 + radius * sin / 111_190.0,
                8.5 + radius * (1.0 - cos) / 75_690.0,
                440_000.0 + 6750.0 * wave,
                1500.0 * cos,
                1500.0 * sin,
                -150.0 * slope,
            ];
            if let Some((_, column, value)) = damaged.filter(|d| d.0 == row as usize) {
                cells[column] = value;
            }
            let [time, latitude, longitude, rest @ ..] = cells;
            let rest = rest.map(|cell| format!("{cell:.2}")).join(",");
            writeln!(table, "{time},{latitude:.7},{longitude:.7},{rest}").unwrap();
        }
        let files = files(&[("flight.csv", &table)]);
        let map = tables(&files).remove(0).map;
        ["alt", "vn", "ve", "vd"].map(|column| guessed(&map, column))
    };
    let sound = table(None);
    assert_eq!(sound[0], is(Channel(ChannelName::GpsHeight), "mm"));
    assert_eq!(sound[3], is(Channel(ChannelName::GpsVelocityDown), "cm/s"));
    for row in [0, 75, 149] {
        for (column, value) in [(3, 0.0), (3, 1e9), (4, 1e9), (5, 1e9), (6, -1e6)] {
            assert_eq!(
                table(Some((row, column, value))),
                sound,
                "{row} {column} {value}"
            );
        }
    }
}

#[test]
fn a_last_line_that_lacks_what_is_read_is_left_out_and_told() {
    let whole = eastward();
    let begin = whole.trim_end().rfind('\n').unwrap() + 1;
    let last = whole.rfind(';').unwrap();
    for cut in begin + 1..whole.len() {
        let files = files(&[("flight.csv", &whole[..cut])]);
        let maps: Vec<_> = tables(&files).into_iter().map(|t| t.map).collect();
        let folder = flight_of_tables(&files, &maps).unwrap();
        let is_told = folder
            .notes
            .iter()
            .any(|note| note.contains("line 101") && note.contains("cut off"));
        let rows = folder
            .flight
            .channel(ChannelName::GpsEast)
            .unwrap()
            .values
            .len();
        // Nothing reads the battery's voltage, the last cell.
        let expected = if cut < last {
            (99, true)
        } else {
            (100, cut == last)
        };
        assert_eq!((rows, is_told), expected, "{}", &whole[begin..cut]);
    }
}

#[test]
fn a_preview_shows_the_first_rows_as_the_map_reads_them() {
    let map = guess_table("east.csv", eastward().as_bytes()).unwrap();
    let shown = preview(eastward().as_bytes(), &map, 3);
    assert_eq!(shown.rows.len(), 3);
    assert_eq!(shown.rows[1][0], "0.1");
    assert_eq!(shown.ranges[5], Some((-0.5, -0.5)));
    assert!(shown.before[0].starts_with("time [s];Lat"));
}

#[test]
fn the_text_tables_of_the_swiss_flight_are_understood() {
    let names = [
        "SwissLog1_airdata.csv",
        "SwissLog1_att.csv",
        "SwissLog1_gps.csv",
        "SwissLog1_imu.csv",
    ];
    let Some(files) = recorded(&names) else {
        return;
    };
    let tables = tables(&files);
    let gps = map_of(&tables, "SwissLog1_gps.csv");
    assert_eq!(guessed(gps, "t_s"), is(Time, "s"));
    assert_eq!(guessed(gps, "lat"), is(Latitude, "deg"));
    assert_eq!(guessed(gps, "course_rad"), is(Course, "rad"));
    assert_eq!(guessed(gps, "gnd_spd"), is(SpeedOverGround, "m/s"));
    let height = Channel(ChannelName::GpsHeight);
    assert_eq!(guessed(gps, "hgt"), is(height, "m"));
    let att = map_of(&tables, "SwissLog1_att.csv");
    let heading = Channel(ChannelName::Heading);
    assert_eq!(guessed(att, "yaw"), is(heading, "deg"));
    let imu = map_of(&tables, "SwissLog1_imu.csv");
    let rate = Channel(ChannelName::RollRate);
    assert_eq!(guessed(imu, "gx"), is(rate, "rad/s"));
    let down = Channel(ChannelName::AccelerationDown);
    assert_eq!(guessed(imu, "az"), is(down, "m/s2"));
    let air = map_of(&tables, "SwissLog1_airdata.csv");
    let airspeed = Channel(ChannelName::EquivalentAirspeed);
    assert_eq!(guessed(air, "Veas"), is(airspeed, "m/s"));
    assert!(tables.iter().all(GuessedTable::is_of_a_flight));
    let maps: Vec<ColumnMap> = tables.into_iter().map(|table| table.map).collect();
    assert_eq!(tables_lack(&maps.iter().collect::<Vec<_>>()), None);
    let flight = flight_of_tables(&files, &maps).unwrap().flight;
    // Nothing but air pressure tells the height: that above the start.
    let height = flight.channel(ChannelName::HeightAboveGround).unwrap();
    assert!(height.values[0].abs() < 1.0 && height.values.len() > 1000);
    let origin = flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() - 47.389_156).abs() < 1e-9);
    assert!((origin.longitude.to_degrees() - 8.033_634).abs() < 1e-9);
    let (first, last) = flight.span();
    assert!(first.abs() < 0.2 && (last - 100.0).abs() < 2.0, "{last}");
}

#[test]
fn a_table_of_one_value_a_row_is_refused_with_what_to_do() {
    use std::fmt::Write as _;
    let mut text = "time,name,value\n".to_owned();
    for i in 0..100 {
        let time = 0.1 * f64::from(i);
        for (name, value) in [("gps.lat", 47.1), ("gps.lon", 8.2), ("airspeed", 15.0)] {
            writeln!(text, "{time:.1},{name},{}", value + 1e-4 * time).unwrap();
        }
    }
    let map = guess_table("log.csv", text.as_bytes()).unwrap();
    assert!(map.lacks().is_some());
    let told = map.findings.join("; ");
    let call = r#"pivot_table(index="time", columns="name", values="value")"#;
    assert!(
        told.contains("one value with its name") && told.contains(call),
        "{told}"
    );
    // A mode beside what was measured is no name of it.
    let modes =
        "time,mode,airspeed\n0,AUTO,15\n1,AUTO,16\n2,LOITER,15.5\n3,LOITER,15.1\n4,LOITER,15\n";
    let map = guess_table("log.csv", modes.as_bytes()).unwrap();
    assert_eq!(map.findings, Vec::<String>::new());
}

/// The flight that the tests of dead reckoning read by a flight.json written by hand.
#[test]
fn the_text_tables_without_names_of_the_same_flight_are_understood_by_their_values() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../../shared/data/inertialnav_x8/InputFilesPX4_search.zip");
    let Ok(bytes) = std::fs::read(path) else {
        println!("skipped: no shared data");
        return;
    };
    let files = pilotage_base::files::ZipFiles::open(&bytes).unwrap();
    let files: Arc<dyn FileSet> = Arc::new(files);
    let tables = tables(&files);
    let channel = |name| Channel(name);
    let expected = [
        ("ATT.txt", "#1", Time, "ms"),
        ("ATT.txt", "#3", channel(ChannelName::Roll), "deg"),
        ("ATT.txt", "#4", channel(ChannelName::Pitch), "deg"),
        ("ATT.txt", "#5", channel(ChannelName::Heading), "deg"),
        ("IMU.txt", "#3", channel(ChannelName::RollRate), "rad/s"),
        ("IMU.txt", "#4", channel(ChannelName::PitchRate), "rad/s"),
        ("IMU.txt", "#5", channel(ChannelName::YawRate), "rad/s"),
        (
            "IMU.txt",
            "#6",
            channel(ChannelName::AccelerationForward),
            "m/s2",
        ),
        (
            "IMU.txt",
            "#7",
            channel(ChannelName::AccelerationRight),
            "m/s2",
        ),
        (
            "IMU.txt",
            "#8",
            channel(ChannelName::AccelerationDown),
            "m/s2",
        ),
        ("NTUN.txt", "#8", channel(ChannelName::Airspeed), "m/s"),
    ];
    for table in &tables {
        for column in table
            .map
            .columns
            .iter()
            .filter(|c| c.role != ColumnRole::Nothing)
        {
            println!(
                "{} {} {:?} {}",
                table.map.file, column.name, column.role, column.unit
            );
        }
    }
    for (file, name, role, unit) in expected {
        assert_eq!(
            guessed(map_of(&tables, file), name),
            is(role, unit),
            "{file} {name}"
        );
    }
    let maps: Vec<ColumnMap> = tables
        .into_iter()
        .filter(|t| t.is_proposed)
        .map(|t| t.map)
        .collect();
    let flight = flight_of_tables(&files, &maps).unwrap().flight;
    let origin = flight.frame_on_globe.unwrap().origin;
    assert!((origin.latitude.to_degrees() - 47.389_156).abs() < 1e-4);
    assert!((origin.longitude.to_degrees() - 8.033_634).abs() < 1e-4);
    for name in [
        ChannelName::GpsNorth,
        ChannelName::GpsVelocityNorth,
        ChannelName::GpsHeight,
    ] {
        assert!(
            flight.channel(name).is_some_and(|c| c.values.len() > 100),
            "{name:?}"
        );
    }
}

#[test]
fn the_tables_of_a_log_agree_on_one_clock_and_share_the_channels_out() {
    let kinds = ["ATT", "CMD", "GPS", "IMU", "MAG", "MODE", "NTUN"];
    let names = kinds.map(|kind| format!("TestLog2_{kind}.csv"));
    let Some(files) = recorded(&names.each_ref().map(String::as_str)) else {
        return;
    };
    let tables = tables(&files);
    let used = |table: &&GuessedTable| table.is_of_a_flight();
    let used: Vec<&GuessedTable> = tables.iter().filter(used).collect();
    let files_used: Vec<&str> = used.iter().map(|t| t.map.file.as_str()).collect();
    assert_eq!(
        files_used,
        [
            "TestLog2_ATT.csv",
            "TestLog2_GPS.csv",
            "TestLog2_IMU.csv",
            "TestLog2_NTUN.csv"
        ]
    );
    let gps = map_of(&tables, "TestLog2_GPS.csv");
    // Its TimeMS is that of the satellites; the others count from the start of the autopilot.
    assert_eq!(guessed(gps, "T"), is(Time, "ms"));
    assert_eq!(guessed(gps, "TimeMS"), is(Nothing, ""));
    let height = Channel(ChannelName::GpsHeight);
    assert_eq!(guessed(gps, "Alt"), is(height, "m"));
    let heading = Channel(ChannelName::Heading);
    let att = map_of(&tables, "TestLog2_ATT.csv");
    assert_eq!(guessed(att, "Yaw"), is(heading, "deg"));
    let ntun = map_of(&tables, "TestLog2_NTUN.csv");
    assert_eq!(guessed(ntun, "Yaw"), is(Nothing, ""));
    let airspeed = Channel(ChannelName::Airspeed);
    assert_eq!(guessed(ntun, "Arspd"), is(airspeed, "m/s"));
    let maps: Vec<ColumnMap> = used.into_iter().map(|t| t.map.clone()).collect();
    assert_eq!(tables_lack(&maps.iter().collect::<Vec<_>>()), None);
    let folder = flight_of_tables(&files, &maps).unwrap();
    assert_eq!(folder.notes, Vec::<String>::new());
    let flight = folder.flight;
    assert_eq!(flight.name, "TestLog2");
    let (first, last) = flight.span();
    assert!((first - 13.178).abs() < 1e-9 && (last - first - 613.1).abs() < 0.1);
    // A line of the file: 316080 ms, 11.68 m/s towards 84.64°.
    let course = 84.64_f64.to_radians();
    let value = |name| flight.value(name, 316.08).unwrap();
    assert!((value(ChannelName::GpsVelocityNorth) - 11.68 * course.cos()).abs() < 1e-9);
    assert!((value(ChannelName::GpsVelocityEast) - 11.68 * course.sin()).abs() < 1e-9);
}

#[test]
fn tables_of_two_flights_are_told_apart() {
    let attitude = |rows: u32| {
        let row = |row: u32| format!("{row},{},{}\n", row % 7, row % 5);
        "t,roll_deg,pitch_deg\n".to_owned() + &(0..rows).map(row).collect::<String>()
    };
    let air = |rows: u32| {
        let row = |row: u32| format!("{row},{}\n", 20 + row % 3);
        "t,airspeed\n".to_owned() + &(0..rows).map(row).collect::<String>()
    };
    let files = files(&[
        ("x/one_att.csv", &attitude(50)),
        ("x/one_air.csv", &air(50)),
        ("x/two_att.csv", &attitude(90)),
        ("x/two_air.csv", &air(90)),
    ]);
    let tables = tables(&files);
    let proposed = tables.iter().filter(|table| table.is_proposed);
    let proposed: Vec<&str> = proposed.map(|t| t.map.file.as_str()).collect();
    assert_eq!(proposed, ["x/two_air.csv", "x/two_att.csv"]);
    let roll = Channel(ChannelName::Roll);
    let first = map_of(&tables, "x/one_att.csv");
    assert_eq!(guessed(first, "roll_deg"), is(roll, "deg"));
}

/// Bytes that begin like a table and are damaged.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let change = (0_usize..6000, any::<u8>());
    (
        prop::collection::vec(change, 0..40),
        0_usize..6000,
        any::<bool>(),
    )
        .prop_map(|(changes, length, swaps)| {
            let mut bytes = eastward().into_bytes();
            if swaps {
                bytes
                    .iter_mut()
                    .filter(|b| **b == b';')
                    .for_each(|b| *b = b',');
            }
            for (at, byte) in changes {
                let at = at % bytes.len();
                bytes[at] = byte;
            }
            bytes.truncate(length.max(1));
            bytes
        })
}

/// Does everything that is done with a table.
fn go_through(bytes: &[u8]) {
    let files: Arc<dyn FileSet> = Arc::new(MemoryFiles(
        [
            ("a.csv".to_owned(), bytes.to_vec()),
            ("b.csv".to_owned(), bytes.to_vec()),
        ]
        .into(),
    ));
    for mut table in tables(&files) {
        let _ = preview(bytes, &table.map, 5);
        if let Ok(folder) = flight_of_tables(&files, &[table.map.clone()]) {
            assert!(folder.flight.channels.iter().all(|c| {
                c.times.len() == c.values.len() && c.times.windows(2).all(|w| w[0] <= w[1])
            }));
        }
        for column in &mut table.map.columns {
            column.role = match column.role {
                Time => Nothing,
                _ => Channel(ChannelName::Roll),
            };
            column.unit = "deg".to_owned();
        }
        table.map.rows_per_second = Some(3.0);
        let _ = flight_of_tables(&files, &[table.map]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn bytes_of_any_kind_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..3000)) {
        go_through(&bytes);
    }

    #[test]
    fn damaged_tables_never_panic(bytes in damaged()) {
        go_through(&bytes);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(either(8, 64)))]

    #[test]
    fn long_tables_are_looked_at_in_places_and_never_panic(
        seed in prop::collection::vec(any::<u8>(), 1..40),
        length in 60_000_usize..200_000,
    ) {
        let mut bytes = eastward().into_bytes();
        while bytes.len() < length {
            bytes.extend_from_slice(b"1.0;47.0;8.0;3;72;0.5;");
            bytes.extend_from_slice(&seed);
        }
        let _ = guess_table("a.csv", &bytes);
    }
}
