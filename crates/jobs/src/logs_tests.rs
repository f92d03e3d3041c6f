//! Logs read from beginning to end, and what is asked of them then.

use std::fmt::Write as _;

use pilotage_core::flight::interpret::Role;
use pilotage_core::flight::log::TopicName;

use super::super::{InlineWorkers, Job, JobEvent, MapSource, SeriesName};
use crate::{FlyOrder, ProvideOrder, ReadLogOrder, SeriesOrder};

/// A flight eastward at 20 m/s as a text log, its airspeed with one digit too many now and then.
fn eastward() -> Vec<u8> {
    let mut log = String::from(
        "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
         FMT, 1, 23, ATT, Qfff, TimeUS,Roll,Pitch,Yaw\n\
         FMT, 2, 27, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n\
         FMT, 3, 15, ARSP, Qf, TimeUS,Airspeed\n",
    );
    for i in 0..600_u32 {
        let time = 1_000_000 + 100_000 * i;
        let along = 8.0 + f64::from(i) * 2.0 / 76_000.0;
        let roll = f64::from(i % 7);
        writeln!(log, "ATT, {time}, {roll}, 2, 90").unwrap();
        writeln!(log, "GPS, {time}, 3, 47.0, {along:.7}, 520, 20, 90").unwrap();
        writeln!(log, "ARSP, {time}, {}", 20.0 + 0.1 * roll).unwrap();
    }
    log.into_bytes()
}

fn events(host: &mut InlineWorkers) -> Vec<JobEvent> {
    let mut seen = Vec::new();
    while host.busy() {
        seen.extend(host.events().into_iter().map(|(_, event)| event));
    }
    seen.extend(host.events().into_iter().map(|(_, event)| event));
    seen
}

fn host_with(name: &str, bytes: Vec<u8>) -> InlineWorkers {
    let mut host = InlineWorkers::new();
    let files = vec![(name.to_owned(), bytes.into())];
    let key = "drop".to_owned();
    host.start(Job::Provide(ProvideOrder { key, files }));
    host
}

fn read(host: &mut InlineWorkers, file: &str) -> Vec<JobEvent> {
    host.start(Job::ReadLog(ReadLogOrder {
        key: "drop".to_owned(),
        file: file.to_owned(),
    }));
    events(host)
}

#[test]
fn a_log_is_read_looked_over_plotted_and_flown() {
    let mut host = host_with("east.log", eastward());
    let seen = read(&mut host, "east.log");
    let log = seen.iter().find_map(|event| match event {
        JobEvent::LogRead(read) => Some(read),
        _ => None,
    });
    let log = log.unwrap();
    // Beside the three, the formats themselves.
    assert_eq!(log.outline.topics.len(), 4);
    assert_eq!(log.overview.airborne.len(), 1);
    assert!(log.flight.is_ok(), "{:?}", log.flight);

    let mut series = |series: SeriesName| {
        let (key, file) = ("drop".to_owned(), "east.log".to_owned());
        host.start(Job::LogSeries(SeriesOrder { key, file, series }));
        let found = events(&mut host).into_iter().find_map(|event| match event {
            JobEvent::LogSeries(series) => Some(*series),
            _ => None,
        });
        found.unwrap()
    };
    let field = series(SeriesName {
        topic: TopicName::single("ATT"),
        field: "Roll".to_owned(),
    });
    let third = field.samples().nth(2).unwrap();
    assert!((third.0 - 1.2).abs() < 1e-9);
    assert_eq!(field.base + f64::from(third.1), 2.0);
    let heading = series(SeriesName::role(Role::Heading));
    assert_eq!((heading.len(), heading.unit.as_str()), (600, "deg"));
    assert!((heading.base - 90.0).abs() < 1e-9);
    assert!(heading.samples().all(|(_, value)| value == 0.0));
    let twice = series(SeriesName::expression("2 * ATT.Roll + {Heading}"));
    let third = twice.samples().nth(2).unwrap();
    assert!((twice.base + f64::from(third.1) - 94.0).abs() < 1e-6);
    assert_eq!((twice.total, twice.lacks), (600, None));
    let none = series(SeriesName::expression("ATT.Rol"));
    let why = none.lacks.unwrap();
    assert!(why.ends_with("did you mean ATT.Roll?"), "{why}");

    host.start(Job::Fly(FlyOrder {
        flight: super::super::FlightSource::Files("drop".to_owned()),
        map: MapSource::Nothing,
        mission: None,
    }));
    let flown = events(&mut host);
    let steps = flown.iter().map(|event| match event {
        JobEvent::Steps(steps) => steps.len(),
        _ => 0,
    });
    assert!(steps.sum::<usize>() >= 599);
}

#[test]
fn a_log_is_known_by_its_content_and_not_by_its_name() {
    let mut host = host_with("flight.dat", eastward());
    let seen = read(&mut host, "flight.dat");
    assert!(matches!(seen.last(), Some(JobEvent::Finished)), "{seen:?}");
    let mut host = host_with("letter.bin", b"Dear engineer,\n".repeat(50));
    let seen = read(&mut host, "letter.bin");
    let Some(JobEvent::Failed(why)) = seen.last() else {
        panic!("{seen:?}");
    };
    assert!(why.starts_with("letter.bin: "), "{why}");
}
