//! Tables of a flight are dropped, what their columns mean is looked over and corrected, and the flight opens.

use std::fmt::Write as _;

use egui::{Key, Vec2};
use egui_kittest::kittest::Queryable as _;
use pilotage_jobs::{COLUMNS_FILE, FlightSource, FlyOrder, Job, ProvideOrder};
use pilotage_ui::host::OpenedFile;
use serde_json::Value;

use super::log::eastward;
use super::support::{Rig, ScriptedHost, rig, rig_on};

/// A flight eastward at 20 m/s, a column of which is called so that nobody can know it.
fn gps() -> String {
    let mut table = "time_s,lat,lon,alt,quux\n".to_owned();
    for row in 0..300_u32 {
        let time = 0.1 * f64::from(row);
        let along = 8.0 + f64::from(row) * 2.0 / 76_000.0;
        let height = 500 + row / 10;
        writeln!(table, "{time:.1},47.0,{along:.7},{height},{}", 20 + row % 3).expect("memory");
    }
    table
}

fn attitude() -> String {
    let mut table = "time_s,roll_deg,pitch_deg,yaw_deg\n".to_owned();
    for row in 0..300_u32 {
        let time = 0.1 * f64::from(row);
        writeln!(table, "{time:.1},{},{},90", row % 7, row % 5).expect("memory");
    }
    table
}

fn drop_files(rig: &mut Rig, files: &[(&str, String)]) {
    rig.host().really_open = true;
    let file = |(path, text): &(&str, String)| OpenedFile {
        path: (*path).to_owned(),
        content: text.clone().into_bytes().into(),
    };
    let files = files.iter().map(file).collect();
    rig.host().opened.push(files);
    rig.settle();
}

/// The app with two tables dropped.
pub fn asked() -> Rig {
    let mut rig = rig();
    drop_files(&mut rig, &[("x/gps.csv", gps()), ("x/att.csv", attitude())]);
    rig
}

fn dialog(rig: &Rig) -> Value {
    rig.state()["columns"].clone()
}

/// The role and the unit of a column.
fn column(rig: &Rig, file: &str, name: &str) -> (String, String) {
    let dialog = dialog(rig);
    let of = |list: &Value, key: &str, wanted: &str| -> Value {
        let list = list.as_array().expect("a list").iter();
        let mut fitting = list.filter(|it| it[key] == wanted);
        fitting.next().expect("such a one").clone()
    };
    let table = of(&dialog["tables"], "file", file);
    let column = of(&table["columns"], "name", name);
    let text = |key: &str| column[key].as_str().unwrap_or_default().to_owned();
    (text("role"), text("unit"))
}

fn choose(rig: &mut Rig, combo: &str, choice: &str) {
    rig.harness.get_by_label(combo).click();
    rig.frames(3);
    let role = egui::accesskit::Role::Button;
    let choices = rig.harness.get_all_by_role_and_label(role, choice);
    choices.last().expect("the choice").click();
    rig.frames(4);
}

#[test]
fn dropped_tables_are_asked_about_with_a_guess_and_its_reason() {
    let rig = asked();
    rig.harness.get_by_label("What do the columns mean?");
    let is = |role: &str, unit: &str| (role.to_owned(), unit.to_owned());
    assert_eq!(column(&rig, "x/gps.csv", "time_s"), is("time", "s"));
    assert_eq!(column(&rig, "x/gps.csv", "lat"), is("latitude", "deg"));
    assert_eq!(column(&rig, "x/gps.csv", "quux"), is("not used", ""));
    assert_eq!(column(&rig, "x/att.csv", "roll_deg"), is("roll", "deg"));
    assert_eq!(dialog(&rig)["lacks"], Value::Null);
    rig.harness
        .get_by_label_contains("it is called roll_deg; the table says deg");
    rig.harness.get_by_label("0.00 to 6.00 °");
}

#[test]
fn a_role_and_a_unit_are_corrected_and_what_they_read_as_follows() {
    let mut rig = asked();
    rig.harness.get_by_label("Columns of gps.csv").click();
    rig.frames(3);
    choose(&mut rig, "Meaning of quux", "airspeed");
    let now = column(&rig, "x/gps.csv", "quux");
    assert_eq!(now, ("airspeed".to_owned(), "m/s".to_owned()));
    rig.harness.get_by_label("20.0 to 22.0 m/s");
    choose(&mut rig, "Unit of quux", "km/h");
    rig.harness.get_by_label("5.56 to 6.11 m/s");
    choose(&mut rig, "Meaning of quux", "latitude");
    rig.harness
        .get_by_label_contains("gps.csv: two columns are latitude");
    rig.key(Key::Enter);
    assert!(dialog(&rig).is_object(), "no flight can be made of that");
}

#[test]
fn a_table_is_left_out_by_its_box() {
    let mut rig = asked();
    rig.harness.get_by_label("Use gps.csv").click();
    rig.frames(3);
    assert_eq!(dialog(&rig)["tables"][1]["used"], false);
    rig.harness.get_by_label("Use att.csv").click();
    rig.frames(3);
    rig.harness.get_by_label("Not yet: no table is to be used.");
}

#[test]
fn the_flight_is_made_kept_with_its_maps_and_there_again_after_a_reload() {
    let mut rig = asked();
    rig.harness.get_by_label("Open flight").click();
    rig.settle();
    assert_eq!(dialog(&rig), Value::Null);
    let state = rig.state();
    assert_eq!(state["flight"], "x", "{}", state["toasts"]);
    assert_eq!(state["run_complete"], true);
    let stored = rig.host().stored.clone();
    let again = ScriptedHost {
        stored,
        ..ScriptedHost::default()
    };
    let mut again = rig_on(again, Vec2::new(1440.0, 900.0));
    let has_maps = again.host().jobs.iter().any(|(_, job)| match job {
        Job::Provide(ProvideOrder { files, .. }) => {
            files.iter().any(|(path, _)| path == COLUMNS_FILE)
        }
        _ => false,
    });
    assert!(has_maps);
    let Some((_, Job::Fly(FlyOrder { flight, .. }))) = again.host().last_flight() else {
        panic!("nothing is flown");
    };
    assert!(matches!(flight, FlightSource::Files(_)), "{flight:?}");
}

#[test]
fn enter_opens_the_flight_and_escape_leaves_the_tables_alone() {
    let mut rig = asked();
    rig.key(Key::Escape);
    assert_eq!(dialog(&rig), Value::Null);
    let before = rig.state()["flight"].clone();
    let all = gps().replace("quux", "heading_deg");
    drop_files(&mut rig, &[("east.csv", all)]);
    assert!(dialog(&rig).is_object());
    assert_eq!(rig.state()["flight"], before);
    rig.key(Key::Enter);
    rig.settle();
    assert_eq!(dialog(&rig), Value::Null);
    assert_eq!(rig.state()["flight"], "east");
}

#[test]
fn a_table_without_times_asks_how_many_rows_a_second_has() {
    let mut rig = rig();
    let table = attitude().replace("time_s", "quux");
    drop_files(&mut rig, &[("att.csv", table)]);
    rig.harness
        .get_by_label_contains("Not yet: att.csv: no column is the time");
    choose(&mut rig, "Meaning of quux", "time");
    rig.harness
        .get_by_label_contains("It can be looked at, but not navigated: no column is a height");
    // As on the terminal: what is there is shown.
    rig.harness.get_by_label("Open flight").click();
    rig.settle();
    assert_eq!(dialog(&rig), Value::Null);
    assert_eq!(rig.state()["flight"], "att");
}

#[test]
fn the_dialog_fits_a_narrow_window() {
    let mut rig = rig_on(ScriptedHost::default(), Vec2::new(760.0, 700.0));
    drop_files(&mut rig, &[("x/gps.csv", gps()), ("x/att.csv", attitude())]);
    let button = rig.harness.get_by_label("Open flight").rect();
    assert!(button.bottom() < 700.0, "{button:?}");
}

#[test]
fn a_table_alone_is_called_by_its_own_name_whatever_lies_beside_it() {
    let mut rig = rig();
    let other = ("a/README.md", "A flight.".to_owned());
    drop_files(&mut rig, &[other, ("a/gps.csv", gps())]);
    let told = |words: &str| rig.harness.query_by_label_contains(words).is_some();
    assert!(told("gps.csv: guessed from names"), "{}", rig.state());
}

#[test]
fn a_flight_that_is_opened_while_tables_are_asked_about_ends_the_question() {
    let mut rig = asked();
    assert!(dialog(&rig).is_object());
    let log = String::from_utf8(eastward()).expect("a log of text");
    drop_files(&mut rig, &[("east.log", log)]);
    assert_eq!(rig.state()["log"]["file"], "east.log");
    assert!(dialog(&rig).is_null());
}

#[test]
fn a_table_that_is_dropped_while_a_flight_is_made_of_others_ends_the_making() {
    let mut rig = asked();
    rig.host().left = Some(|job| matches!(job, Job::MakeFlight(_)));
    rig.harness.get_by_label("Open flight").click();
    rig.settle();
    assert_eq!(dialog(&rig)["making"], true);
    let made = rig.host().jobs.last().cloned();
    let Some((made, Job::MakeFlight(_))) = made else {
        panic!("{made:?}");
    };
    drop_files(&mut rig, &[("east.csv", gps())]);
    assert!(rig.host().cancelled.contains(&made));
    assert_eq!(dialog(&rig)["tables"][0]["file"], "east.csv");
    assert_eq!(dialog(&rig)["making"], false);
}
