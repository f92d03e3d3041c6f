//! `pilotage export` as a user calls it.

use serde_json::Value;

use super::folder::Folder;

/// A table that has a column of the name that exports give the time of the log.
const TABLE: &str = "time_s,lat,lon,alt\n\
    1700000000,46.8500,-92.0700,300\n\
    1700000001,46.8501,-92.0700,300\n\
    1700000002,46.8502,-92.0700,301\n";

#[test]
fn a_column_called_as_the_time_stands_beside_the_time_of_the_log() {
    let folder = Folder::new("export");
    folder.write("flight.csv", TABLE);
    let csv = folder.run(&["export", "flight.csv", "--format", "csv"]);
    let csv = csv.expect("a table");
    let head: Vec<&str> = csv.lines().next().unwrap_or_default().split(',').collect();
    assert_eq!(head[0], "time_s");
    assert!(head[1].starts_with("time_s-2"), "{csv}");
    let row: Vec<&str> = csv.lines().nth(2).unwrap_or_default().split(',').collect();
    assert_eq!([row[0], row[1]], ["1", "1700000001"]);
    let json = folder.run(&["export", "flight.csv", "--format", "json"]);
    let json: Value = serde_json::from_str(&json.expect("JSON")).expect("JSON");
    let topic = json.as_object().and_then(|all| all.values().next());
    let topic = topic.expect("a topic");
    let numbers = |name: &str| {
        let all = topic[name].as_array().into_iter().flatten();
        all.filter_map(Value::as_f64).collect::<Vec<_>>()
    };
    assert_eq!(numbers("time_s"), [0.0, 1.0, 2.0]);
    assert_eq!(numbers("time_s-2"), [1.7e9, 1.7e9 + 1.0, 1.7e9 + 2.0]);
    let parquet = ["export", "flight.csv", "--out", "flight.parquet"];
    folder.run(&parquet).expect("a table");
    let bytes = std::fs::read(folder.0.join("flight.parquet")).expect("a file");
    let is_there = |name: &[u8]| bytes.windows(name.len()).any(|part| part == name);
    assert!(is_there(b"time_s-2"));
}
