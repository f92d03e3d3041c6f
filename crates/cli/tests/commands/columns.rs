//! `pilotage columns` and what uses its maps, as a user calls them.

use std::fmt::Write as _;

use super::folder::Folder;

/// Circles in still air, course in tenths of degrees, speeds in cm/s.
fn circles() -> String {
    let mut text = String::from("t,lat,lon,alt,course,speed,psi,tas\n");
    let (radius, speed) = (100.0, 15.0);
    for row in 0..1500 {
        let time = 0.2 * f64::from(row);
        let turn: f64 = speed / radius * time;
        let (north, east) = (radius * turn.sin(), -radius * turn.cos());
        let course = turn.rem_euclid(std::f64::consts::TAU).to_degrees();
        let alt = 400.0 + 50.0 * (time / 30.0).min(1.0);
        writeln!(
            text,
            "{time:.1},{:.7},{:.7},{alt:.1},{:.0},{:.0},{course:.1},{:.0}",
            47.0 + north / 111_195.0,
            8.0 + east / 111_195.0 / 47.0_f64.to_radians().cos(),
            10.0 * course,
            100.0 * speed,
            100.0 * speed
        )
        .expect("a text can be written to");
    }
    text
}

#[test]
fn a_map_is_printed_saved_edited_and_used_again() {
    let folder = Folder::new("columns-map");
    folder.write("a.csv", circles());
    let shown = folder.run(&["columns", "a.csv"]).unwrap();
    assert!(shown.contains("course over ground       ddeg"), "{shown}");
    assert!(shown.contains("question: No unit is stated"), "{shown}");
    folder
        .run(&["columns", "a.csv", "--save", "map.json"])
        .unwrap();
    let map = std::fs::read_to_string(folder.0.join("map.json")).unwrap();
    std::fs::write(
        folder.0.join("map.json"),
        map.replace("\"ddeg\"", "\"deg\""),
    )
    .unwrap();
    let edited = folder
        .run(&["columns", "a.csv", "--columns", "map.json"])
        .unwrap();
    assert!(edited.contains("course over ground       deg "), "{edited}");
    let other = folder.run(&["inspect", "a.csv", "--columns", "nowhere.json"]);
    assert!(other.unwrap_err().contains("nowhere.json"));
    // What lies beside the table is found without being named.
    folder
        .run(&["columns", "a.csv", "--columns", "map.json", "--save"])
        .unwrap();
    let beside = folder.run(&["columns", "a.csv"]).unwrap();
    assert!(beside.contains("course over ground       deg "), "{beside}");
    // Where it was written is no part of the JSON.
    let json = folder
        .run(&["columns", "a.csv", "--json", "--save"])
        .unwrap();
    assert!(
        serde_json::from_str::<serde_json::Value>(&json).is_ok(),
        "{json}"
    );
}

#[test]
fn a_table_is_replayed_without_a_flight_file() {
    let folder = Folder::new("columns-replay");
    folder.write("a.csv", circles());
    let said = folder.run(&["replay", "a.csv"]).unwrap();
    assert!(said.contains("without GPS for 60 s"), "{said}");
    assert!(said.contains("Airspeed and wind"), "{said}");
    let lost = folder.run(&["replay", "a.csv", "--map", "b.tif"]);
    assert!(lost.unwrap_err().contains("b.tif"));
    // A run is flown by the instruments alone, as the page flies it.
    let flown = folder.call(&["replay", "a.csv", "--out", "a.run"]);
    let told = String::from_utf8_lossy(&flown.stderr);
    assert!(told.contains("its instruments alone"), "{told}");
    let run = folder.run(&["inspect", "a.run"]).unwrap();
    assert!(run.starts_with("run \"a\": "), "{run}");
    let both = folder.run(&["replay", "a.csv", "--outage", "30", "--out", "b.run"]);
    assert!(both.unwrap().contains("without GPS for 30 s"));
    assert!(
        folder
            .run(&["inspect", "b.run"])
            .unwrap()
            .starts_with("run \"a\": ")
    );
}

/// Page and terminal look for a flight in one order: what people said of the columns of tables, what says itself that it
/// is a flight, and tables as they are guessed.
#[test]
fn what_people_said_of_tables_comes_before_a_log_and_a_guess_behind_what_says_itself_that_it_flew()
{
    let folder = Folder::new("columns-order");
    folder.write("a.csv", circles());
    let guessed = folder.run(&["inspect", "."]).unwrap();
    assert!(guessed.contains(": 299.8 s"), "{guessed}");
    let sentences = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n\
                     $GPGGA,123520,4807.044,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n";
    folder.write("walk.nmea", sentences);
    let walked = folder.run(&["inspect", "."]).unwrap();
    assert!(walked.contains(": 1.0 s"), "{walked}");
    let log = "FMT, 1, 13, ATT, Qcc, TimeUS,Roll,Yaw\n\
               ATT, 1000000, 1.5, 90.0\n\
               ATT, 1500000, -2.25, 91.0\n";
    folder.write("b.log", log);
    let logged = folder.run(&["inspect", "."]).unwrap();
    assert!(logged.contains("ArduPilot dataflash, text"), "{logged}");
    folder.run(&["columns", "a.csv", "--save"]).unwrap();
    let said = folder.run(&["inspect", "."]).unwrap();
    assert!(said.contains(": 299.8 s"), "{said}");
}
