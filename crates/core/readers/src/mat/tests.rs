//! A file that `SciPy` wrote, damaged ones, and a flight that Mission Planner exported.

use proptest::prelude::*;

use super::value::MatValue;
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
fn variables_that_are_too_large_are_left_out_and_told_by_their_names() {
    let files = MatFiles::open_within("a.mat", SCIPY, 300).unwrap();
    assert_eq!(files.names(), ["a/GPS.csv", "a/variables.csv"]);
    let told = files.left_out();
    assert!(
        matches!(told.as_slice(), [one] if one.starts_with("a.mat: imu was left out")),
        "{told:?}"
    );
    let none = MatFiles::open_within("a.mat", SCIPY, 60).unwrap_err();
    assert!(
        none.to_string().contains("a.mat: GPS was left out"),
        "{none}"
    );
    assert!(
        MatFiles::open("a.mat", SCIPY)
            .unwrap()
            .left_out()
            .is_empty()
    );
}

#[test]
fn what_is_no_such_file_is_refused_with_a_word() {
    let refused = |bytes: &[u8]| MatFiles::open("a.mat", bytes).unwrap_err().to_string();
    assert!(refused(b"MATLAB 7.3 MAT-file").contains("-v7"));
    assert!(refused(b"t,lat,lon").contains("no MATLAB file"));
    assert!(refused(&SCIPY[..128]).contains("no variable"));
}

#[test]
fn what_is_cut_off_or_damaged_is_refused_and_says_behind_what() {
    for cut in [200, SCIPY.len() / 2, SCIPY.len() - 1] {
        let told = MatFiles::open("a.mat", &SCIPY[..cut]).unwrap_err();
        assert!(matches!(told, MatError::Damaged(..)), "{cut}: {told}");
    }
    let mut flipped = SCIPY.to_vec();
    flipped[SCIPY.len() - 20] ^= 0x40;
    let told = MatFiles::open("a.mat", &flipped).unwrap_err().to_string();
    assert!(told.contains("damaged behind"), "{told}");
}

#[test]
fn a_few_bytes_behind_the_last_variable_are_no_damage_unless_they_begin_another() {
    for strays in 1..8 {
        for stray in [0, b'\n', 0xff] {
            let file = [SCIPY, &vec![stray; strays]].concat();
            let files = MatFiles::open("a.mat", &file).unwrap();
            assert_eq!(files.names().len(), 3);
        }
        let begun = [SCIPY, &[15, 0, 0, 0, 9, 1, 0][..strays]].concat();
        let told = MatFiles::open("a.mat", &begun).unwrap_err();
        assert!(matches!(told, MatError::Damaged(..)), "{strays}: {told}");
    }
}

/// A variable of version 4: `kind` by its digits, numbers of eight bytes or letters of one.
fn fourth(kind: u32, name: &str, rows: u32, values: &[f64]) -> Vec<u8> {
    let columns = values.len() as u32 / rows;
    let is_big = kind >= 1000;
    let mut bytes = Vec::new();
    for part in [kind, rows, columns, 0, name.len() as u32 + 1] {
        let part = part.to_le_bytes();
        bytes.extend(if is_big {
            [part[3], part[2], part[1], part[0]]
        } else {
            part
        });
    }
    bytes.extend(name.bytes().chain([0]));
    for value in values {
        match (kind / 10 % 10, is_big) {
            (0, false) => bytes.extend(value.to_le_bytes()),
            (0, true) => bytes.extend(value.to_be_bytes()),
            _ => bytes.push(*value as u8),
        }
    }
    bytes
}

#[test]
fn files_of_version_four_are_read_in_both_orders_of_bytes_and_by_labels_of_letters() {
    for order in [0, 1000] {
        let numbers = [0.0, 1.0, 2.0, 47.25, 47.5, -47.75];
        let letters = [b't', b'L', b' ', b'a', b' ', b't'].map(f64::from);
        let file = [
            fourth(order, "GPS", 3, &numbers),
            fourth(51 + order, "GPS_label", 2, &letters),
        ];
        let files = MatFiles::open("a.mat", &file.concat()).unwrap();
        assert_eq!(
            table(&files, "a/GPS.csv"),
            "\"t\",\"Lat\"\n0,47.25\n1,47.5\n2,-47.75\n"
        );
        let file = file.concat();
        let told = MatFiles::open("a.mat", &file[..file.len() - 1]).unwrap_err();
        assert_eq!(
            told,
            MatError::Damaged("a.mat".to_owned(), "GPS".to_owned())
        );
    }
}

#[test]
fn arrays_of_structures_and_structures_with_times_of_their_own_are_tables() {
    let column = |values: &[f64]| MatValue::Numbers {
        rows: values.len(),
        columns: 1,
        values: values.to_vec(),
    };
    let field = |name: &str, value: MatValue| (name.to_owned(), value);
    let signal = |of: f64| MatValue::Fields(vec![field("values", column(&[of, of, of]))]);
    let times = || field("time", column(&[0.0, 1.0, 2.0]));
    let own = MatValue::Fields(vec![times(), field("roll", column(&[4.0, 5.0, 6.0]))]);
    let log = MatValue::Fields(vec![times(), field("Lat", signal(7.0)), field("att", own)]);
    let tables = tables::of("a", &[field("log", log)]);
    let text = |name: &str| String::from_utf8_lossy(&tables[name]).into_owned();
    assert_eq!(text("a/log.csv"), "\"time\",\"Lat\"\n0,7\n1,7\n2,7\n");
    assert_eq!(text("a/log.att.csv"), "\"time\",\"roll\"\n0,4\n1,5\n2,6\n");
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

#[test]
fn rows_of_no_letters_take_no_room() {
    let mut file = fourth(51, "GPS_label", 1, &[]);
    file[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(matches!(
        MatFiles::open("a.mat", &file),
        Err(MatError::Empty(_))
    ));
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
