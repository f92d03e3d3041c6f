//! Tests of times and angles whose parts stand in several columns, and of dates beside a clock.

use std::sync::Arc;

use super::{ColumnRole, flight_of_tables, guess_table, guess_tables};
use crate::folder::FlightFolder;
use pilotage_base::files::{FileSet, MemoryFiles};

/// The flight of a table, as its columns are guessed.
fn flight(table: &str) -> FlightFolder {
    let files = MemoryFiles([("a.csv".to_owned(), table.as_bytes().to_vec())].into());
    let files: Arc<dyn FileSet> = Arc::new(files);
    let names = ["a.csv".to_owned()];
    let guessed = guess_tables(files.as_ref(), &names).into_iter();
    let maps: Vec<_> = guessed
        .filter(|table| table.is_proposed)
        .map(|table| table.map)
        .collect();
    flight_of_tables(&files, &maps).unwrap_or_else(|e| panic!("{e}\n{table}"))
}

/// A hundred rows under a line of names.
fn table(names: &str, row: impl Fn(u32) -> String) -> String {
    let rows: Vec<String> = (0..100).map(row).collect();
    format!("{names}\n{}\n", rows.join("\n"))
}

#[track_caller]
fn assert_regular(folder: &FlightFolder, step: f64) {
    let track = &folder.flight.truth.as_ref().unwrap().states;
    assert_eq!(track.len(), 100);
    for pair in track.windows(2) {
        assert!((pair[1].time - pair[0].time - step).abs() < 1e-6);
    }
}

/// Hours, minutes and seconds of tenths after a second before midnight.
fn clock(tenths: u32) -> (u32, u32, u32, f64) {
    let all = 863_950 + tenths;
    let (day, rest) = (all / 864_000, all % 864_000);
    let seconds = f64::from(rest % 600) / 10.0;
    (day, rest / 36_000, rest / 600 % 60, seconds)
}

#[test]
fn a_time_in_six_columns_goes_over_midnight() {
    let row = |i: u32| {
        let (day, hour, minute, second) = clock(i);
        let place = 47.0 + 1e-5 * f64::from(i);
        format!(
            "2024,5,{},{hour},{minute},{second:.1},{place:.6},8.5,430",
            13 + day
        )
    };
    for names in [
        "year,month,day,hour,minute,second,lat,lon,alt",
        "YYYY,MM,DD,HH,MM,SS,lat,lon,alt",
        "utc_year,utc_month,utc_day,utc_hour,utc_min,utc_sec,lat,lon,alt",
    ] {
        let folder = flight(&table(names, row));
        assert_regular(&folder, 0.1);
        // date -u -d '2024-05-13 23:59:55' +%s
        let utc = names.contains("utc").then_some(1_715_644_795.0);
        let log = folder.log();
        let first = folder.flight.truth.as_ref().unwrap().states[0].time;
        assert_eq!(log.utc_at_zero.map(|zero| zero + first), utc, "{names}");
    }
    let row = |i: u32| {
        let (_, hour, minute, second) = clock(i);
        let place = 47.0 + 1e-5 * f64::from(i);
        format!("{hour},{minute},{second:.1},{place:.6},8.5,430")
    };
    assert_regular(&flight(&table("hour,min,sec,lat,lon,alt", row)), 0.1);
}

#[test]
fn angles_in_two_or_three_columns_are_the_places_that_they_say() {
    let start = [-33.85, 18.42];
    let place = |i: u32, of: usize| start[of] + 1e-5 * f64::from(i);
    let parts = |angle: f64| {
        let seconds = (angle.abs() * 3600.0 * 1e5).round() / 1e5;
        let (degrees, rest) = ((seconds / 3600.0).floor(), seconds % 3600.0);
        (degrees.copysign(angle), rest)
    };
    let three = |i: u32| {
        let angles = [0, 1].map(|of| {
            let (degrees, rest) = parts(place(i, of));
            format!("{degrees},{},{:.5}", (rest / 60.0).floor(), rest % 60.0)
        });
        format!("{:.1},{},50", 0.1 * f64::from(i), angles.join(","))
    };
    let two = |i: u32| {
        let angles = [0, 1].map(|of| {
            let (degrees, rest) = parts(place(i, of));
            format!("{degrees},{:.7}", rest / 60.0)
        });
        format!("{:.1},{},50", 0.1 * f64::from(i), angles.join(","))
    };
    let of_three = "time,lat_deg,lat_min,lat_sec,lon_deg,lon_min,lon_sec,height";
    let of_two = "time,lat_deg,lat_min,lon_deg,lon_min,height";
    for table in [table(of_three, three), table(of_two, two)] {
        let folder = flight(&table);
        assert_regular(&folder, 0.1);
        let frame = folder.flight.frame_on_globe.unwrap();
        let states = &folder.flight.truth.as_ref().unwrap().states;
        for i in [0_u32, 99] {
            let found = frame.geodetic_from_world(&states[i as usize].position);
            let found = [found.latitude, found.longitude].map(f64::to_degrees);
            for (of, found) in found.into_iter().enumerate() {
                let right = place(i, of);
                assert!((found - right).abs() < 2e-9 + 1e-8, "{i} {found} {right}");
            }
        }
    }
}

#[test]
fn a_date_in_universal_time_beside_milliseconds_is_that_of_the_flight() {
    let row = |i: u32| {
        let tenths = 3 + i;
        format!(
            "{},2024-05-01 10:00:{:02},{:.6},8.5,30",
            100 * i,
            tenths / 10,
            47.0 + 1e-5 * f64::from(i)
        )
    };
    let names = "time(millisecond),datetime(utc),latitude,longitude,height_above_takeoff(meters)";
    let folder = flight(&table(names, row));
    assert_regular(&folder, 0.1);
    // date -u -d '2024-05-01 10:00:00' +%s, and the three tenths at which the clock began.
    let utc = folder.log().utc_at_zero.unwrap();
    assert!((utc - 1_714_557_600.3).abs() < 1e-3, "{utc}");
    let local = names.replace("(utc)", "(local)");
    assert_eq!(flight(&table(&local, row)).log().utc_at_zero, None);
}

#[test]
fn rows_of_ten_seconds_whose_hours_minutes_and_seconds_are_one_number_are_known() {
    let row = |i: u32| {
        let seconds = 36_000 + 10 * i;
        let clock = seconds / 3600 * 10_000 + seconds / 60 % 60 * 100 + seconds % 60;
        format!("{clock},{:.6},8.5,430", 47.0 + 1e-4 * f64::from(i))
    };
    assert_regular(&flight(&table("time,lat,lon,alt", row)), 10.0);
}

#[test]
fn a_clock_that_is_finer_than_the_calendar_beside_it_stays_the_clock() {
    let names = "time_ms,year,month,day,hour,minute,second,lat,lon,alt";
    let row = |i: u32| {
        let (second, east) = (i / 10, 8.0 + f64::from(i) * 2e-5);
        format!("{},2024,5,1,10,0,{second},47.0,{east:.6},430", 100 * i)
    };
    assert_regular(&flight(&table(names, row)), 0.1);
}

#[test]
fn a_row_of_no_calendar_is_left_out_and_breaks_nothing() {
    let names = "year,month,day,hour,minute,second,lat,lon,alt";
    let rows: Vec<String> = (0..30_000_u32)
        .map(|i| {
            let year = if i == 29_990 {
                "9000000000000000000"
            } else {
                "2024"
            };
            let (hour, minute, second) = (i / 3600, i / 60 % 60, i % 60);
            let east = 8.0 + f64::from(i) * 1e-5;
            format!("{year},5,1,{hour},{minute},{second},47.0,{east:.6},430")
        })
        .collect();
    let folder = flight(&format!("{names}\n{}\n", rows.join("\n")));
    let track = &folder.flight.truth.as_ref().unwrap().states;
    assert_eq!(track.len(), 29_999);
}

#[test]
fn deviations_in_millimetres_are_no_minutes_of_places() {
    let names = "time_s,lat,lon,alt,lat_std_mm,lon_std_mm";
    let row = |i: u32| {
        let east = 80_000_000 + 200 * i;
        format!(
            "{:.1},470000000,{east},430,{},{}",
            0.1 * f64::from(i),
            12 + i % 5,
            14 + i % 3
        )
    };
    assert_regular(&flight(&table(names, row)), 0.1);
}

#[test]
fn rows_without_a_fix_do_not_hide_degrees_and_minutes() {
    let row = |i: u32| {
        let fix = if i < 140 {
            "0.0,0.0".to_owned()
        } else {
            format!("4730.{:03},00830.{:03}", i, 2 * i)
        };
        format!("{:.1},{fix},440.5\n", 0.1 * f64::from(i))
    };
    let table =
        "time,latitude,longitude,altitude\n".to_owned() + &(0..200).map(row).collect::<String>();
    let map = guess_table("a.csv", table.as_bytes()).unwrap();
    for role in [ColumnRole::Latitude, ColumnRole::Longitude] {
        let column = map.columns.iter().find(|column| column.role == role);
        assert_eq!(column.unwrap().unit, "ddmm");
    }
}
