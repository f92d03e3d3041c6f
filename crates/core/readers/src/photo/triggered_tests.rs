//! Photos beside a log that tells when its camera took them.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use super::tests::photo;
use super::triggered::{PlacedPhotos, add_photos};
use crate::interpret::flight_from_log;
use crate::log::{Log, recognise};
use pilotage_base::files::{FileSet, MemoryFiles};
use pilotage_flight::Flight;

/// A flight with an event of its camera at each of these times, seconds from the seventh on.
fn log(events: &[f64]) -> Log {
    let mut text = String::from(
        "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\n\
         FMT, 1, 23, ATT, Qfff, TimeUS,Roll,Pitch,Yaw\n\
         FMT, 3, 12, CAM, QB, TimeUS,Img\n\
         FMT, 2, 27, GPS, QBLLfff, TimeUS,Status,Lat,Lng,Alt,Spd,GCrs\n",
    );
    for i in 0..900_u32 {
        let time = 7_000_000 + 100_000 * i;
        let gps = format!("GPS, {time}, 3, 47.0, 8.0, 500, 20, 90");
        writeln!(text, "ATT, {time}, 0, 0, 90\n{gps}").unwrap();
    }
    for event in events {
        let time = 7_000_000 + (1e6 * event) as u64;
        writeln!(text, "CAM, {time}, 1").unwrap();
    }
    let info = recognise(text.as_bytes()).unwrap();
    let mut reader = (info.reader)();
    let mut log = Log::new("a.log", info.format);
    reader.feed(text.as_bytes(), &mut log);
    reader.finish(&mut log);
    log
}

/// Photos named so, taken at these seconds of a minute or without a time.
fn files(photos: &[(&str, Option<u32>)]) -> Arc<dyn FileSet> {
    let made = photos.iter().map(|(name, second)| {
        let bytes = match second {
            Some(second) => photo(&format!("{second:02}"), "", 0, ""),
            None => photo("xx", "", 0, ""),
        };
        ((*name).to_owned(), bytes)
    });
    Arc::new(MemoryFiles(made.collect::<BTreeMap<_, _>>()))
}

fn placed(events: &[f64], photos: &[(&str, Option<u32>)]) -> (Flight, PlacedPhotos) {
    let log = log(events);
    let mut flight = flight_from_log(&log).into_flight().unwrap();
    let placed = add_photos(&log, &mut flight, &files(photos)).unwrap();
    (flight, placed)
}

fn times(flight: &Flight) -> Vec<(&str, f64)> {
    let frames = flight.frames.iter();
    let time = |time: f64| ((time - 7.0) * 1e3).round() / 1e3;
    frames.map(|f| (f.name.as_str(), time(f.time))).collect()
}

#[test]
fn as_many_photos_as_events_belong_together_in_the_order_of_their_numbers() {
    let photos = [("P9.jpg", None), ("P10.jpg", None), ("P8.jpg", None)];
    let (flight, placed) = placed(&[1.0, 2.5, 6.0], &photos);
    let expected = [("P8.jpg", 1.0), ("P9.jpg", 2.5), ("P10.jpg", 6.0)];
    assert_eq!(times(&flight), expected);
    assert!(placed.frames.is_some());
    let note = &placed.notes[0];
    assert!(
        note.starts_with("3 photos") && note.contains("3 events of CAM, in order"),
        "{note}"
    );
}

#[test]
fn photos_with_times_are_found_among_more_events_by_the_clock_of_the_camera() {
    let events = [1.0, 4.2, 6.0, 11.3, 13.0, 20.4, 29.0];
    // The camera is 20 s behind the log and counts whole seconds; two photos were removed.
    let photos = [
        ("a.jpg", Some(24)),
        ("b.jpg", Some(31)),
        ("c.jpg", Some(33)),
        ("d.jpg", Some(40)),
        ("e.jpg", Some(49)),
    ];
    let (flight, placed) = placed(&events, &photos);
    let expected = [
        ("a.jpg", 4.2),
        ("b.jpg", 11.3),
        ("c.jpg", 13.0),
        ("d.jpg", 20.4),
        ("e.jpg", 29.0),
    ];
    assert_eq!(times(&flight), expected, "{:?}", placed.notes);
    assert!(placed.notes[0].contains("5 photos") && placed.notes[0].contains("clock"));
}

#[test]
fn photos_that_may_be_any_of_the_events_are_left_out_with_both_counts() {
    // Every two seconds: any shift fits.
    let events: Vec<f64> = (0..10).map(|i| 2.0 * f64::from(i)).collect();
    let timed: Vec<(String, Option<u32>)> = (0..8)
        .map(|i| (format!("{i}.jpg"), Some(10 + 2 * i)))
        .collect();
    let timed: Vec<(&str, Option<u32>)> = timed.iter().map(|(n, t)| (n.as_str(), *t)).collect();
    for photos in [&timed[..], &[("a.jpg", None), ("b.jpg", None)]] {
        let (flight, placed) = placed(&events, photos);
        assert!(flight.frames.is_empty() && placed.frames.is_none());
        let note = &placed.notes[0];
        assert!(
            note.contains(&format!("{} photos", photos.len())) && note.contains("10 (CAM)"),
            "{note}"
        );
    }
}

#[test]
fn gaps_in_the_numbers_of_photos_tell_which_were_removed() {
    let photos = [
        ("P0101.jpg", None),
        ("P0103.jpg", None),
        ("P0104.jpg", None),
    ];
    let (flight, _) = placed(&[1.0, 2.0, 3.0, 9.0], &photos);
    let expected = [("P0101.jpg", 1.0), ("P0103.jpg", 3.0), ("P0104.jpg", 9.0)];
    assert_eq!(times(&flight), expected);
}

#[test]
fn a_log_that_tells_of_no_photos_leaves_them_alone() {
    let log = log(&[]);
    let mut flight = flight_from_log(&log).into_flight().unwrap();
    assert!(add_photos(&log, &mut flight, &files(&[("a.jpg", None)])).is_none());
}
