//! Recorded flights of tables and of photos, looked over as logs: held against what their cells say by themselves.
#![expect(
    clippy::unwrap_used,
    reason = "a test stops where something is missing"
)]

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use pilotage_core::flight::columns::{flight_of_tables, guess_tables};
use pilotage_core::flight::files::{FileSet, MemoryFiles};
use pilotage_core::flight::interpret::{Role, log_of_flight};
use pilotage_core::flight::log::{Log, TopicName};
use pilotage_core::flight::overview::{Overview, overview};
use pilotage_core::flight::photo::read_photos;
use pilotage_core::flight::{FlightFolder, read_flight};
use pilotage_tests::data::shared;

fn files(folder: &Path, wanted: impl Fn(&str) -> bool) -> Arc<dyn FileSet> {
    let mut files = BTreeMap::new();
    for folder in [folder.to_owned(), folder.join("frames")] {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let name = entry.file_name().into_string().unwrap();
            if wanted(&name) && entry.path().is_file() {
                files.insert(name, std::fs::read(entry.path()).unwrap());
            }
        }
    }
    Arc::new(MemoryFiles(files))
}

/// A flight with its log and overview.
fn looked_over(folder: &FlightFolder) -> (Log, Overview) {
    let log = folder.log();
    let beside = log_of_flight(&log, &folder.flight);
    let mut seen = overview(&log, &beside.measured());
    seen.add_pictures(folder.flight.frames.len());
    (log, seen)
}

/// The cells of a column as they stand in the file.
fn cells(folder: &Path, file: &str, column: &str) -> Vec<String> {
    let text = std::fs::read_to_string(folder.join(file)).unwrap();
    let mut lines = text.lines().map(|line| line.split(','));
    let index = lines.next().unwrap().position(|name| name == column);
    let index = index.unwrap();
    lines
        .map(|mut cells| cells.nth(index).unwrap().to_owned())
        .collect()
}

fn numbers(folder: &Path, file: &str, column: &str) -> Vec<f64> {
    let cells = cells(folder, file, column);
    cells.iter().map(|cell| cell.parse().unwrap()).collect()
}

/// The middle of the intervals between times that grow.
fn usual_interval(times: &[f64]) -> f64 {
    let mut steps: Vec<f64> = times.windows(2).map(|w| w[1] - w[0]).collect();
    steps.retain(|step| *step > 0.0);
    steps.sort_by(f64::total_cmp);
    steps[steps.len() / 2]
}

#[test]
fn the_x8_tables_have_the_rates_the_gaps_and_the_columns_that_stand_in_their_cells() {
    let Some(folder) = shared("inertialnav_x8") else {
        return;
    };
    let files = files(&folder, |name| {
        let rest = name.strip_prefix("TestLog2_");
        rest.is_some_and(|rest| rest.strip_suffix(".csv").is_some())
    });
    let tables = guess_tables(files.as_ref(), &files.names());
    let maps: Vec<_> = (tables.into_iter())
        .filter(|table| table.is_proposed)
        .map(|table| table.map)
        .collect();
    let flight = flight_of_tables(&files, &maps).unwrap();
    let (log, seen) = looked_over(&flight);

    for (role, file, column) in [
        (Role::Roll, "TestLog2_ATT.csv", "TimeMS"),
        (Role::YawRate, "TestLog2_IMU.csv", "TimeMS"),
        (Role::Airspeed, "TestLog2_NTUN.csv", "TimeMS"),
        (Role::Latitude, "TestLog2_GPS.csv", "T"),
    ] {
        let times: Vec<f64> = (numbers(&folder, file, column).iter())
            .map(|ms| 1e-3 * ms)
            .collect();
        let sensor = seen.sensors.iter().find(|s| s.role == role).unwrap();
        let usual = usual_interval(&times);
        assert!(
            (sensor.rate * usual - 1.0).abs() < 1e-6,
            "{role:?}: {} Hz, intervals of {usual} s",
            sensor.rate
        );
        let longest = (5.0 * usual).max(1.0);
        let gaps: Vec<_> = (times.windows(2).filter(|w| w[1] - w[0] > longest))
            .map(|w| (w[0], w[1]))
            .collect();
        let told: Vec<_> = sensor.gaps.iter().map(|g| (g.from, g.to)).collect();
        assert_eq!(told.len(), gaps.len(), "{role:?}: {told:?} and {gaps:?}");
        for (a, b) in told.iter().zip(&gaps) {
            assert!((a.0 - b.0).abs() < 1e-6 && (a.1 - b.1).abs() < 1e-6);
        }
        println!(
            "{:9} {:18} {:6} samples {:6.1} Hz {} gaps",
            role.label(),
            sensor.source,
            sensor.samples,
            sensor.rate,
            gaps.len()
        );
    }
    // Columns that a flight has no place for.
    for (topic, column) in [
        ("TestLog2_ATT", "ErrorYaw"),
        ("TestLog2_GPS", "NSats"),
        ("TestLog2_GPS", "HDop"),
        ("TestLog2_NTUN", "WpDist"),
    ] {
        let of_log = log.topic(&TopicName::single(topic)).unwrap();
        let wanted = numbers(&folder, &format!("{topic}.csv"), column);
        assert_eq!(of_log.values(column).unwrap(), wanted, "{topic}.{column}");
    }
    println!(
        "in the air {:?}, {:.2} km, {:?} m above the start",
        seen.airborne,
        1e-3 * seen.distance,
        seen.heights
    );
    for finding in &seen.findings {
        println!(
            "{:?}: {}. {}",
            finding.severity, finding.title, finding.text
        );
    }
    assert!(seen.air_data.is_some());
    let can = |what: &str| {
        let mut all = seen.abilities.iter().filter(|a| a.lacks.is_none());
        all.any(|ability| ability.what.starts_with(what))
    };
    assert!(can("Replay without GPS") && can("Estimate the wind") && can("Show the track"));
    assert!(!can("Find landmarks"));
}

#[test]
fn the_pictures_of_brighton_are_a_flight_in_the_air_with_a_column_for_everything() {
    let Some(folder) = shared("brighton_beach") else {
        return;
    };
    let files = files(&folder, |name| {
        ["csv", "json", "jpg"].iter().any(|end| name.ends_with(end))
    });
    let flight = read_flight(files).unwrap();
    let (log, seen) = looked_over(&flight);
    let topic = log.topic(&TopicName::single("frames")).unwrap();
    for column in ["flight_pitch", "gimbal_yaw", "sift_inliers", "lat"] {
        let wanted = numbers(&folder, "frames.csv", column);
        assert_eq!(topic.values(column).unwrap(), wanted, "{column}");
    }
    assert_eq!(
        topic.texts("file").unwrap(),
        cells(&folder, "frames.csv", "file")
    );
    // One every seven seconds, all of them 40 m up.
    let heading = seen
        .sensors
        .iter()
        .find(|s| s.role == Role::Heading)
        .unwrap();
    assert!((heading.rate - 1.0 / 7.0).abs() < 1e-9 && heading.gaps.is_empty());
    assert_eq!(heading.source, "frames.gimbal_yaw");
    assert_eq!(seen.airborne, [(0.0, 124.0)]);
    // What the gimbal held still is no fault of a sensor.
    let faults = seen
        .findings
        .iter()
        .filter(|f| f.title.contains("never move"));
    assert_eq!(faults.count(), 0, "{:?}", seen.findings);
    let stuck = seen.findings.iter().filter(|f| f.title.contains("stuck"));
    assert_eq!(stuck.count(), 0, "{:?}", seen.findings);
    // The way from place to place, by the degrees that stand in the cells.
    let (lat, lon) = (
        numbers(&folder, "frames.csv", "lat"),
        numbers(&folder, "frames.csv", "lon"),
    );
    let metres = 6_371_000.0_f64 * std::f64::consts::PI / 180.0;
    let way: f64 = (lat.windows(2).zip(lon.windows(2)))
        .map(|(a, o)| {
            let east = (o[1] - o[0]) * a[0].to_radians().cos();
            metres * (a[1] - a[0]).hypot(east)
        })
        .sum();
    let ratio = seen.distance / way;
    assert!((ratio - 1.0).abs() < 0.005, "{} and {way} m", seen.distance);
    let cannot: Vec<_> = seen
        .abilities
        .iter()
        .filter(|a| a.lacks.is_some())
        .collect();
    println!("{cannot:?}; {:?}", seen.findings);
    assert!(cannot.iter().all(|a| !a.what.starts_with("Find landmarks")));
    assert!(cannot.iter().all(|a| !a.what.starts_with("Camera to log")));
}

/// Originals of two cameras lie beside the data; those of Caliterra were taken by one.
#[test]
fn photos_are_a_flight_with_what_they_tell_of_themselves() {
    let Some(folder) = shared("caliterra") else {
        return;
    };
    let files = files(&folder, |name| name.contains("_original"));
    assert_eq!(files.names().len(), 2);
    let flight = read_photos(&files).unwrap();
    let (log, seen) = looked_over(&flight);
    let photos = log.first("photos").unwrap();
    assert_eq!(photos.len(), 2);
    // The author's own table of the same pictures.
    let (names, lat) = (
        cells(&folder, "frames.csv", "file"),
        numbers(&folder, "frames.csv", "lat"),
    );
    let latitudes = photos.values("latitude").unwrap();
    for (name, latitude) in photos.texts("file").unwrap().iter().zip(latitudes) {
        let plain = name.replace("_original", "");
        let row = names.iter().position(|n| *n == plain).unwrap();
        assert!((lat[row] - latitude).abs() < 1e-6, "{name}: {latitude}");
    }
    let what: Vec<_> = seen.sensors.iter().map(|s| s.role.label()).collect();
    println!("{what:?}; {:?}", seen.findings);
    assert!(what.contains(&"Latitude") && what.contains(&"GPS height"));
}
