//! A file that `SciPy` wrote, damaged ones, and a flight that Mission Planner exported.

use proptest::prelude::*;

use super::*;

/// Written by scipy.io.savemat (1.17) with `do_compression`: `t` and `roll` of 5 rows, `GPS` of 4 rows and 3 columns with
/// `GPS_label`, the structure `imu` with `t`, `acc` (6 × 3, single) and `n` (6, 16 bits).
const SCIPY: &[u8] = include_bytes!("scipy.mat");

fn table(files: &MatFiles, name: &str) -> String {
    String::from_utf8(files.read(name).unwrap()).unwrap()
}

#[test]
fn variables_of_all_kinds_are_tables() {
    let files = MatFiles::open("a.mat", SCIPY).unwrap();
    assert_eq!(files.names(), ["a/GPS.csv", "a/imu.csv", "a/variables.csv"]);
    let gps = table(&files, "a/GPS.csv");
    assert_eq!(gps.lines().next(), Some("\"TimeMS\",\"Lat\",\"Lng\""));
    assert_eq!(gps.lines().nth(2), Some("200,47.0001,8.0001"));
    let imu = table(&files, "a/imu.csv");
    assert_eq!(
        imu.lines().next(),
        Some("\"t\",\"acc_1\",\"acc_2\",\"acc_3\",\"n\"")
    );
    assert_eq!(imu.lines().nth(2), Some("0.25,3,4,-9.75,-1"));
    let both = table(&files, "a/variables.csv");
    assert_eq!(both.lines().nth(1), Some("0,"), "{both}");
    assert_eq!(both.lines().nth(5), Some("0.4,-12.5"));
}

#[test]
fn what_is_no_such_file_is_refused_with_a_word() {
    let refused = |bytes: &[u8]| MatFiles::open("a.mat", bytes).unwrap_err().to_string();
    assert!(refused(b"MATLAB 7.3 MAT-file").contains("-v7"));
    assert!(refused(b"t,lat,lon").contains("no MATLAB file"));
    assert!(refused(&SCIPY[..128]).contains("no variable"));
}

#[test]
fn an_export_of_mission_planner_is_a_flight() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../../shared/data/inertialnav_x8/TestLog2.mat"
    );
    let Ok(bytes) = std::fs::read(path) else {
        println!("skipped: no shared data (inertialnav_x8/TestLog2.mat)");
        return;
    };
    let files = MatFiles::open("TestLog2.mat", &bytes).unwrap();
    let gps = table(&files, "TestLog2/GPS.csv");
    assert!(
        gps.starts_with("\"LineNo\",\"Status\",\"TimeMS\""),
        "{}",
        &gps[..200]
    );
    let tables = crate::columns::guess_tables(&files, &files.names());
    let maps: Vec<_> = tables
        .into_iter()
        .filter(|t| t.is_proposed)
        .map(|t| t.map)
        .collect();
    let files: std::sync::Arc<dyn FileSet> = std::sync::Arc::new(files);
    let flight = crate::columns::flight_of_tables(&files, &maps)
        .unwrap()
        .flight;
    let (first, last) = flight.span();
    assert!((last - first - 613.1).abs() < 0.5, "{first} to {last}");
    let value = |name| flight.value(name, 316.08).unwrap();
    let course = 84.64_f64.to_radians();
    let north = value(pilotage_flight::ChannelName::GpsVelocityNorth);
    assert!((north - 11.68 * course.cos()).abs() < 1e-3, "{north}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn damaged_files_never_panic(
        changes in prop::collection::vec((0_usize..4000, any::<u8>()), 0..30),
        length in 0_usize..4000,
    ) {
        let mut bytes = SCIPY.to_vec();
        for (at, byte) in changes {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        bytes.truncate(length);
        let _ = MatFiles::open("a.mat", &bytes);
    }
}
