//! Tables of flight simulators, and of programs that call heights otherwise.

use super::tests::files;
use super::{ColumnMap, flight_of_tables, guess_table};
use pilotage_base::frames::units::{METRES_PER_FOOT, MPS_PER_KNOT};
use pilotage_flight::{ChannelName, Flight};

/// Moment of a winding flight in still air: seconds, degrees, metres, radians, m/s.
struct Moment {
    time: f64,
    latitude: f64,
    longitude: f64,
    height: f64,
    heading: f64,
    pitch: f64,
    roll: f64,
    climb: f64,
}

const SPEED: f64 = 50.0;

/// Two minutes of it, five moments a second.
fn flown() -> Vec<Moment> {
    let (mut north, mut east) = (0.0, 0.0);
    (0..600)
        .map(|i| {
            let time = 0.2 * f64::from(i);
            let heading = 1.5 + 1.2 * (time / 15.0).sin();
            let turn = 0.08 * (time / 15.0).cos();
            let climb = 3.0 * (time / 9.0).sin();
            let moment = Moment {
                time,
                latitude: -33.85 + f64::to_degrees(north / 6_371_000.0),
                longitude: 18.42 + f64::to_degrees(east / 6_371_000.0 / f64::cos(0.5908)),
                height: 900.0 + 27.0 * (1.0 - (time / 9.0).cos()),
                heading,
                pitch: (climb / SPEED).asin() + 0.03,
                roll: (SPEED * turn / 9.806_65).atan(),
                climb,
            };
            north += 0.2 * SPEED * heading.cos();
            east += 0.2 * SPEED * heading.sin();
            moment
        })
        .collect()
}

fn read(names: &str, row: impl Fn(&Moment) -> String) -> (ColumnMap, Flight) {
    let rows: Vec<String> = flown().iter().map(row).collect();
    let text = format!("{names}\n{}\n", rows.join("\n"));
    let map = guess_table("a.csv", text.as_bytes()).unwrap();
    let files = files(&[("a.csv", &text)]);
    let flight = flight_of_tables(&files, std::slice::from_ref(&map)).unwrap();
    (map, flight.flight)
}

#[test]
fn radians_that_a_simulator_calls_degrees_are_those_of_all_three_angles() {
    let names = "ABSOLUTE TIME,PLANE LATITUDE,PLANE LONGITUDE,PLANE ALTITUDE,PLANE PITCH DEGREES,PLANE BANK DEGREES,\
                 PLANE HEADING DEGREES TRUE,AIRSPEED TRUE,VERTICAL SPEED";
    let (map, flight) = read(names, |at| {
        format!(
            "{:.3},{:.8},{:.8},{:.2},{:.6},{:.6},{:.6},{:.2},{:.2}",
            63_849_196_800.0 + at.time,
            at.latitude,
            at.longitude,
            at.height / METRES_PER_FOOT,
            -at.pitch,
            -at.roll,
            at.heading,
            SPEED / MPS_PER_KNOT,
            at.climb / METRES_PER_FOOT * 60.0
        )
    });
    let right = flown();
    let value = |name, at: usize| flight.channel(name).unwrap().values[at];
    for at in [10, 200, 555] {
        let moment = &right[at];
        assert!((value(ChannelName::Heading, at) - moment.heading).abs() < 1e-4);
        assert!((value(ChannelName::Roll, at) - moment.roll).abs() < 1e-4);
        assert!(
            (value(ChannelName::Pitch, at) - moment.pitch).abs() < 1e-4,
            "{:?}",
            map.findings
        );
    }
    let told = |word: &str| map.findings.iter().any(|told| told.contains(word));
    assert!(
        told("PLANE PITCH DEGREES: the table says deg"),
        "{:?}",
        map.findings
    );
}

#[test]
fn brackets_say_what_heights_count_from_and_their_short_name_is_one() {
    let names = "Time (s),Lat,Lon,Alt (HAE),Alt (MSL)";
    let (map, flight) = read(names, |at| {
        let (above, height) = (at.height + 31.0, at.height);
        format!(
            "{:.1},{:.8},{:.8},{above:.3},{height:.3}",
            at.time, at.latitude, at.longitude
        )
    });
    let heights = flight.channel(ChannelName::GpsHeight).unwrap();
    assert_eq!(heights.values[0], 900.0, "{:?}", map.findings);
    let (_, flight) = read("Time (s),Lat,Lon,Elev (ft)", |at| {
        let feet = at.height / METRES_PER_FOOT;
        format!(
            "{:.1},{:.8},{:.8},{feet:.3}",
            at.time, at.latitude, at.longitude
        )
    });
    let heights = flight.channel(ChannelName::GpsHeight).unwrap();
    assert!((heights.values[0] - 900.0).abs() < 1e-3);
}

#[test]
fn ticks_of_windows_are_dates() {
    // 2024-05-01 10:00:00, since the year 1 and since 1601.
    for first in [638_501_544_000_000_000_u64, 133_590_312_000_000_000] {
        let (map, flight) = read("Timestamp,latitude,longitude,altitude [m]", |at| {
            let ticks = first + 1000 * (at.time * 1e4).round() as u64;
            format!(
                "{ticks},{:.8},{:.8},{:.2}",
                at.latitude, at.longitude, at.height
            )
        });
        let (begin, end) = flight.span();
        assert!(
            (end - begin - 119.8).abs() < 1e-6,
            "{} {:?}",
            end - begin,
            map.findings
        );
    }
    let moment = crate::cells::date_and_time("638501544002500000");
    assert_eq!(
        moment,
        Some(crate::cells::Moment::Absolute(1_714_557_600, 0.25))
    );
    assert_eq!(crate::cells::date_and_time("1714557600000000000"), None);
}

#[test]
fn clocks_count_in_the_part_of_a_second_that_their_names_say() {
    for (name, per_second) in [
        ("Time_cs", 1e2),
        ("time_100us", 1e4),
        ("t [0.1 ms]", 1e4),
        ("Time (centiseconds)", 1e2),
        ("time_ms", 1e3),
    ] {
        let names = format!("{name},latitude,longitude,altitude [m]");
        let (map, flight) = read(&names, |at| {
            let count = (at.time * per_second).round();
            format!(
                "{count},{:.8},{:.8},{:.2}",
                at.latitude, at.longitude, at.height
            )
        });
        let (begin, end) = flight.span();
        assert!(
            (end - begin - 119.8).abs() < 1e-6,
            "{name}: {} {:?}",
            end - begin,
            map.findings
        );
    }
}

#[test]
fn a_counter_that_begins_anew_is_the_time_of_a_short_table_too() {
    let of = |count: usize, counter: &dyn Fn(usize) -> u32| {
        let rows = flown().into_iter().take(count).enumerate();
        let rows = rows.map(|(i, at)| {
            format!(
                "{},{:.7},{:.7},{:.2}\n",
                counter(i),
                at.latitude,
                at.longitude,
                at.height
            )
        });
        let text = format!("time_ms,lat,lon,alt_m\n{}", rows.collect::<String>());
        let map = guess_table("a.csv", text.as_bytes()).unwrap();
        let files = files(&[("a.csv", &text)]);
        flight_of_tables(&files, &[map]).map(|folder| folder.flight.span())
    };
    for count in [12, 30, 45] {
        let (begin, end) = of(count, &|i| (64_000 + 200 * i as u32) % 65_536).unwrap();
        assert!(
            (end - begin - 0.2 * (count - 1) as f64).abs() < 1e-6,
            "{count}"
        );
    }
    // One that was started anew is none.
    assert!(
        of(30, &|i| if i < 15 {
            40_000 + 200 * i as u32
        } else {
            200 * i as u32
        })
        .is_err()
    );
}
