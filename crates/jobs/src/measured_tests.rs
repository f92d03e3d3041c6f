//! Flights of tables and of photos, read as logs.

use std::fmt::Write as _;

use pilotage_core::flight::columns::guess_tables;
use pilotage_core::flight::files::MemoryFiles;
use pilotage_core::flight::interpret::Role;
use pilotage_core::flight::log::{LogFormat, TopicName};

use super::super::{
    COLUMNS_FILE, FlightSource, InlineWorkers, Job, JobEvent, LogAnswer, LogOrder, LogQuestion,
    LogSeries, MapSource, ReadLog, SeriesName, write_columns,
};
use crate::{FlyOrder, ProvideOrder, ReadLogOrder, SeriesOrder};

const KEY: &str = "drop";

/// Twenty seconds eastward at 20 m/s at ten rows a second, without those of three of them; of one column nobody can
/// know what it is.
fn gps() -> String {
    let mut table = "time_s,lat,lon,alt,quux\n".to_owned();
    for row in (0..80_u32).chain(110..200) {
        let time = 0.1 * f64::from(row);
        let along = 8.0 + f64::from(row) * 2.0 / 76_000.0;
        let height = 500 + row / 10;
        writeln!(table, "{time:.1},47.0,{along:.7},{height},{}", 20 + row % 3).unwrap();
    }
    table
}

fn attitude() -> String {
    let mut table = "time_s,roll_deg,pitch_deg,yaw_deg\n".to_owned();
    for row in 0..400_u32 {
        let time = 0.05 * f64::from(row);
        writeln!(table, "{time:.2},{},{},90.{}", row % 7, row % 5, row % 3).unwrap();
    }
    table
}

fn events(host: &mut InlineWorkers) -> Vec<JobEvent> {
    let mut seen = Vec::new();
    while host.busy() {
        seen.extend(host.events().into_iter().map(|(_, event)| event));
    }
    seen.extend(host.events().into_iter().map(|(_, event)| event));
    seen
}

/// A host that was given tables with what their columns are guessed to mean.
fn host() -> InlineWorkers {
    let files = [("x/gps.csv", gps()), ("x/att.csv", attitude())];
    let named = files.map(|(name, text)| (name.to_owned(), text.into_bytes()));
    let set = MemoryFiles(named.clone().into());
    let names = named.iter().map(|(name, _)| name.clone());
    let maps: Vec<_> = guess_tables(&set, &names.collect::<Vec<_>>())
        .into_iter()
        .map(|table| table.map)
        .collect();
    let maps = (COLUMNS_FILE.to_owned(), write_columns(&maps));
    let files = named.into_iter().chain([maps]);
    let files = files.map(|(name, bytes)| (name, bytes.into())).collect();
    let mut host = InlineWorkers::new();
    let key = KEY.to_owned();
    host.start(Job::Provide(ProvideOrder { key, files }));
    host
}

fn read(host: &mut InlineWorkers) -> ReadLog {
    let (key, file) = (KEY.to_owned(), "x".to_owned());
    host.start(Job::ReadLog(ReadLogOrder { key, file }));
    let seen = events(host);
    let read = seen.iter().find_map(|event| match event {
        JobEvent::LogRead(read) => Some(ReadLog::clone(read)),
        _ => None,
    });
    read.unwrap_or_else(|| panic!("{seen:?}"))
}

fn series(host: &mut InlineWorkers, series: SeriesName) -> LogSeries {
    let (key, file) = (KEY.to_owned(), "x".to_owned());
    host.start(Job::LogSeries(SeriesOrder { key, file, series }));
    let found = events(host).into_iter().find_map(|event| match event {
        JobEvent::LogSeries(series) => Some(*series),
        _ => None,
    });
    found.unwrap()
}

#[test]
fn tables_are_looked_over_with_the_rates_and_the_gap_that_their_rows_have() {
    let read = read(&mut host());
    assert_eq!(read.outline.format, LogFormat::Tables);
    assert!(read.flight.is_ok_and(|frame| frame.is_some()));
    let sensor = |role| {
        read.overview
            .sensors
            .iter()
            .find(|s| s.role == role)
            .unwrap()
    };
    assert!((sensor(Role::Heading).rate - 20.0).abs() < 1e-6);
    assert!((sensor(Role::Latitude).rate - 10.0).abs() < 1e-6);
    assert_eq!(sensor(Role::Roll).source, "att.roll_deg");
    let gaps = &sensor(Role::Latitude).gaps;
    let (from, to) = (gaps[0].from, gaps[0].to);
    assert!(gaps.len() == 1 && (from - 7.9).abs() < 1e-9 && (to - 11.0).abs() < 1e-9);
    let titles = read.overview.findings.iter().map(|f| f.title.as_str());
    assert!(titles.clone().any(|t| t.ends_with("missing for 3.1 s")));
    let cannot = read.overview.abilities.iter().filter(|a| a.lacks.is_some());
    let cannot: Vec<&str> = cannot.map(|a| a.what.as_str()).collect();
    assert!(cannot[0].starts_with("Replay without GPS"), "{cannot:?}");
}

#[test]
fn columns_that_nothing_was_said_of_are_plotted_computed_with_and_summed_up() {
    let mut host = host();
    let read = read(&mut host);
    let topics: Vec<_> = (read.outline.topics.iter())
        .map(|t| (t.name.to_string(), t.rows))
        .collect();
    assert_eq!(topics, [("att".to_owned(), 400), ("gps".to_owned(), 170)]);
    let quux = SeriesName {
        topic: TopicName::single("gps"),
        field: "quux".to_owned(),
    };
    let values = series(&mut host, quux.clone());
    let all: Vec<_> = values.samples().collect();
    assert_eq!(all.len(), 170);
    for (time, value) in &all {
        let row = (10.0 * time).round() as u32;
        assert_eq!(values.base + f64::from(*value), f64::from(20 + row % 3));
    }
    let heading = series(&mut host, SeriesName::role(Role::Heading));
    assert_eq!((heading.len(), heading.unit.as_str()), (400, "deg"));
    let twice = series(&mut host, SeriesName::expression("2 * gps.quux + {Roll}"));
    assert_eq!(twice.lacks, None);
    let at = |wanted: f64| twice.samples().find(|(t, _)| (t - wanted).abs() < 1e-6);
    // Row 1 of one table and row 2 of the other are of one time.
    let (_, value) = at(0.1).unwrap();
    assert!((twice.base + f64::from(value) - (2.0 * 21.0 + 2.0)).abs() < 1e-6);
    host.start(Job::AskLog(Box::new(LogOrder {
        key: KEY.to_owned(),
        file: "x".to_owned(),
        series: vec![(quux, "quux".to_owned())],
        span: (0.0, 0.85),
        question: LogQuestion::Statistics,
    })));
    let answer = events(&mut host).into_iter().find_map(|event| match event {
        JobEvent::LogAnswer(answer) => Some(*answer),
        _ => None,
    });
    let Some(LogAnswer::Statistics(_, Ok(Some(figures)))) = answer else {
        panic!("{answer:?}");
    };
    // Nine rows: 20, 21, 22 three times over.
    assert_eq!((figures.count, figures.mean), (9, 21.0));
}

#[test]
fn the_flight_of_tables_that_were_read_is_flown() {
    let mut host = host();
    read(&mut host);
    host.start(Job::Fly(FlyOrder {
        flight: FlightSource::Files(KEY.to_owned()),
        map: MapSource::Nothing,
        mission: None,
    }));
    let flown = events(&mut host);
    let steps = flown.iter().map(|event| match event {
        JobEvent::Steps(steps) => steps.len(),
        _ => 0,
    });
    assert!(steps.sum::<usize>() >= 399, "{:?}", flown.last());
}

#[test]
fn files_that_are_gone_are_said_to_be_gone() {
    let mut host = InlineWorkers::new();
    let (key, files) = (KEY.to_owned(), Vec::new());
    host.start(Job::Provide(ProvideOrder { key, files }));
    let (key, file) = (KEY.to_owned(), "east.log".to_owned());
    host.start(Job::ReadLog(ReadLogOrder { key, file }));
    let seen = events(&mut host);
    let Some(JobEvent::Failed(why)) = seen.last() else {
        panic!("{seen:?}");
    };
    assert!(why.contains("it is not here any more"), "{why}");
}
