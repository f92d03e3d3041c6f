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

#[test]
fn values_beside_a_track_are_those_of_the_log_to_the_digit_or_computed_of_them() {
    let folder = Folder::new("export-track");
    let mut log = "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
        FMT, 2, 27, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n\
        FMT, 3, 19, CNT, QQ, TimeUS,Count\n"
        .to_owned();
    for i in 0..40_u64 {
        let (time, along) = (1_000_000 + 100_000 * i, 8.0 + i as f64 * 3e-5);
        let count = 40_000_000_000_001 * i;
        let lines = [
            format!("CNT, {time}, {count}"),
            format!("GPS, {time}, 3, 47.0, {along:.7}, 520, 20, 90"),
        ];
        log.push_str(&(lines.join("\n") + "\n"));
    }
    folder.write("count.log", log);
    let written = |channel: &str| {
        let words = [
            "export",
            "count.log",
            "--track",
            "gps",
            "--channel",
            channel,
        ];
        let csv = folder.run(&[&words[..], &["--format", "csv"]].concat());
        csv.expect("a track")
    };
    let csv = written("CNT.Count");
    assert!(csv.contains("1560000000000039"), "{csv}");
    assert!(written("2 * CNT.Count").contains("3120000000000078"));
    let words = ["export", "count.log", "--track", "gps", "--channel"];
    let refused = folder.run(&[&words[..], &["CNT.Cuont"]].concat());
    let refused = refused.unwrap_err();
    assert!(refused.contains("there are TimeUS, Count"), "{refused}");
}
