//! Sentences of a satellite receiver (NMEA 0183: GGA, RMC, VTG), as a flight.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::cells::{DEGREES_AND_MINUTES, days_since_1970, linear};
use crate::folder::{FlightFolder, FolderError, decoded};
use crate::nmea_receivers::{SaidPlace, of_others};
use crate::text_tables::{first_flight, flight_of_table, table};
use pilotage_base::files::FileSet;
use pilotage_base::frames::units::{METRES_PER_FOOT, MPS_PER_KNOT};
use pilotage_base::text::utc_text;

const DAY: f64 = 86_400.0;
/// Receivers write two digits of a year; from this one on they are of the century before.
const CENTURY: i64 = 80;
/// Sentences of a moment.
const TIMED: [&str; 5] = ["GGA", "GNS", "GLL", "RMC", "VTG"];
/// Columns behind the time.
const COLUMNS: [&str; 5] = [
    "latitude [deg]",
    "longitude [deg]",
    "altitude msl [m]",
    "speed over ground [m/s]",
    "course over ground [deg]",
];

/// Values that the sentences of one moment say.
#[derive(Clone, Copy, Debug, Default)]
struct Epoch {
    /// Seconds of the day (UTC).
    second: f64,
    /// Days since 1970, where they were told.
    day: Option<i64>,
    /// In the order of [`COLUMNS`].
    values: [Option<f64>; 5],
}

/// Moments that were read, and the number of sentences that were not used.
#[derive(Debug, Default)]
struct Sentences {
    epochs: Vec<Epoch>,
    damaged: usize,
    unfixed: usize,
    /// Whether the sentence of a moment's velocity comes before the others of the moment.
    velocity_leads: bool,
    /// Course in degrees and speed in m/s of the moment that comes next.
    next_velocity: [Option<f64>; 2],
    /// Words about receivers that are left out.
    others: Vec<String>,
}

/// Whether the first bytes of a file are sentences of a receiver: most lines are, and one says a place.
pub fn is_nmea(head: &[u8]) -> bool {
    let head = decoded(head);
    let text = String::from_utf8_lossy(&head);
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let (mut all, mut sentences, mut has_place) = (0, 0, false);
    for line in lines {
        all += 1;
        // Loggers put times of their own before a sentence.
        let name = line
            .rsplit_once('$')
            .and_then(|(_, rest)| rest.split(',').next());
        let Some(name) = name.filter(|name| name.is_ascii() && name.len() >= 4) else {
            continue;
        };
        sentences += 1;
        let says_place = ["GGA", "RMC", "GNS", "GLL"]
            .iter()
            .any(|kind| name.ends_with(kind));
        has_place |= name.len() == 5 && says_place;
    }
    has_place && 2 * sentences > all
}

/// The flight that the first file of sentences among `files` tells of; `None` if there is none. Others are left out with
/// a note.
///
/// # Errors
/// Sentences of which no flight can be made.
pub fn flight_of_sentences(files: &Arc<dyn FileSet>) -> Result<Option<FlightFolder>, FolderError> {
    let because = "it is a recording of its own";
    first_flight(files.as_ref(), ".nmea", because, read_nmea)
}

/// The flight that sentences tell of; `None` if `bytes` have fewer than two places in sentences. Heights are above mean sea
/// level, as receivers reckon it.
///
/// # Errors
/// Sentences of which no flight can be made, as the tables of a flight.
///
/// ```
/// use pilotage_readers::nmea::read_nmea;
///
/// // 48°07.038' N, 11°31.000' E; a second later 0.006' farther north, which are 11.1 m.
/// let text = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n\
///             $GPGGA,123520,4807.044,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n";
/// let folder = read_nmea("walk.nmea", text.as_bytes())?.ok_or("no two places")?;
/// let truth = folder.flight.truth.ok_or("no track")?;
/// let (first, last) = (truth.states[0], truth.states[1]);
/// assert!(((last.position - first.position).norm() - 11.1).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_nmea(name: &str, bytes: &[u8]) -> Result<Option<FlightFolder>, FolderError> {
    let bytes = decoded(bytes);
    let sentences = sentences(&String::from_utf8_lossy(&bytes));
    let is_placed = |epoch: &&Epoch| epoch.values[0].is_some();
    if sentences.epochs.iter().filter(is_placed).count() < 2 {
        return Ok(None);
    }
    let mut findings = Vec::new();
    if sentences.damaged > 0 {
        findings.push(format!(
            "{} sentences were left out: their check sums are wrong or missing",
            sentences.damaged
        ));
    }
    if sentences.unfixed > 0 {
        findings.push(format!(
            "{} sentences were told without a fix, and have no place",
            sentences.unfixed
        ));
    }
    findings.extend(sentences.others);
    flight_of_table(name, table_of(&sentences.epochs), findings)
}

/// Table with a line for each moment; by date and time where the day is told, else by seconds.
fn table_of(epochs: &[Epoch]) -> String {
    let first_day = epochs.iter().find_map(|epoch| epoch.day);
    let mut day = first_day.unwrap_or(0);
    let mut last = epochs.first().map_or(0.0, |epoch| epoch.second);
    let row = |epoch: &Epoch| {
        // A day that nobody told begins where the clock goes round.
        let is_next = last - epoch.second > 0.5 * DAY;
        day = epoch.day.unwrap_or(day + i64::from(is_next));
        last = epoch.second;
        let seconds = day as f64 * DAY + epoch.second;
        let time = match first_day {
            Some(_) => utc_text(seconds),
            None => format!("{seconds:.3}"),
        };
        (time, epoch.values)
    };
    let rows: Vec<_> = epochs.iter().map(row).collect();
    let time = if first_day.is_some() {
        "time"
    } else {
        "time [s]"
    };
    table(time, COLUMNS, &rows)
}

fn sentences(text: &str) -> Sentences {
    let mut found = Sentences::default();
    // Loggers put times of their own before a sentence.
    let all = || {
        text.lines()
            .filter_map(|line| Some(line.rsplit_once('$')?.1))
    };
    // Where sentences of a kind have check sums, those without were cut off.
    let mut sums = SumCounts::default();
    all().for_each(|sentence| sums.add(sentence));
    let kinds = all().map(|sentence| kind_of(sentence).get(2..).unwrap_or_default());
    let kinds: Vec<&str> = kinds.filter(|kind| TIMED.contains(kind)).collect();
    let leads = |kind: Option<&&str>| kind == Some(&"VTG");
    found.velocity_leads = leads(kinds.first()) && !leads(kinds.last());
    let places: Vec<SaidPlace> = all().filter_map(said_place).collect();
    let (others, told) = of_others(&places);
    found.others = told;
    for sentence in all() {
        let body = match sentence.trim_end().split_once('*') {
            Some((body, sum)) if is_whole(body, sum) => body,
            None if !sums.are_usual(sentence) => sentence.trim_end(),
            _ => {
                found.damaged += 1;
                continue;
            }
        };
        let fields: Vec<&str> = body.split(',').collect();
        let name = fields[0];
        if name.len() != 5 || !name.is_ascii() || others.contains(&name[..2]) {
            continue;
        }
        match &name[2..] {
            "GGA" => found.fix(&fields),
            "GNS" => found.fix_of_systems(&fields),
            "GLL" => found.place_alone(&fields),
            "RMC" => found.least(&fields),
            "VTG" => found.velocity(&fields),
            "ZDA" => found.date(&fields),
            _ => {}
        }
    }
    found
}

/// Numbers of sentences with a check sum and of all, by their kinds and together: a program may give sums to some kinds only.
#[derive(Default)]
struct SumCounts<'a> {
    kinds: BTreeMap<&'a str, [usize; 2]>,
    all: [usize; 2],
}

impl<'a> SumCounts<'a> {
    fn add(&mut self, sentence: &'a str) {
        let has_sum = usize::from(sentence.contains('*'));
        let kind = self.kinds.entry(kind_of(sentence)).or_default();
        for count in [kind, &mut self.all] {
            count[0] += has_sum;
            count[1] += 1;
        }
    }

    /// Whether most sentences of the same kind have check sums; of all, where it is the only one of its kind.
    fn are_usual(&self, sentence: &str) -> bool {
        let own = self.kinds.get(kind_of(sentence)).filter(|own| own[1] > 1);
        let [with, all] = own.copied().unwrap_or(self.all);
        2 * with > all
    }
}

/// Letters before the first comma of a sentence: talker and kind.
fn kind_of(sentence: &str) -> &str {
    sentence
        .split([',', '*'])
        .next()
        .unwrap_or_default()
        .trim_end()
}

/// Whether the letters of a sentence have the check sum behind its star.
fn is_whole(body: &str, sum: &str) -> bool {
    let found = body.bytes().fold(0, |sum, byte| sum ^ byte);
    let said = sum
        .get(..2)
        .and_then(|sum| u8::from_str_radix(sum, 16).ok());
    said == Some(found)
}

impl Sentences {
    /// The moment of a sentence, which may be that of the one before.
    fn epoch(&mut self, time: &str) -> Option<&mut Epoch> {
        let second = second_of_day(time)?;
        if self.epochs.last().is_none_or(|last| last.second != second) {
            let [course, speed] = std::mem::take(&mut self.next_velocity);
            self.epochs.push(Epoch {
                second,
                values: [None, None, None, speed, course],
                ..Epoch::default()
            });
        }
        self.epochs.last_mut()
    }

    /// GGA: time, latitude, its hemisphere, longitude, its hemisphere, kind of fix, satellites, dilution, height above sea
    /// level.
    fn fix(&mut self, fields: &[&str]) {
        let [_, time, rest @ ..] = fields else { return };
        let is_fixed = !matches!(rest.get(4), None | Some(&("" | "0")));
        let place = place(rest).filter(|_| is_fixed);
        // Some write the height in feet, and say so.
        let unit = match rest.get(8) {
            Some(&("F" | "f")) => METRES_PER_FOOT,
            _ => 1.0,
        };
        self.place(time, place, height(rest.get(7), unit));
    }

    /// GNS: time, latitude, its hemisphere, longitude, its hemisphere, a letter for each satellite system that says its
    /// kind of fix, satellites, dilution, height above sea level.
    fn fix_of_systems(&mut self, fields: &[&str]) {
        let [_, time, rest @ ..] = fields else { return };
        let is_fixed = rest
            .get(4)
            .is_some_and(|modes| modes.contains(|mode| mode != 'N'));
        let place = place(rest).filter(|_| is_fixed);
        self.place(time, place, height(rest.get(7), 1.0));
    }

    /// GLL: latitude, its hemisphere, longitude, its hemisphere, time, whether it is valid.
    fn place_alone(&mut self, fields: &[&str]) {
        let [_, rest @ ..] = fields else { return };
        let Some(time) = rest.get(4) else { return };
        let place = place(rest).filter(|_| rest.get(5).is_none_or(|valid| *valid == "A"));
        self.place(time, place, None);
    }

    /// Takes the place of a moment. Of several receivers the first that says a height counts.
    fn place(&mut self, time: &str, place: Option<[f64; 2]>, height: Option<f64>) {
        self.unfixed += usize::from(place.is_none());
        let (Some(epoch), Some([latitude, longitude])) = (self.epoch(time), place) else {
            return;
        };
        let is_better = epoch.values[0].is_none() || height.is_some();
        if epoch.values[2].is_none() && is_better {
            epoch.values[0] = Some(latitude);
            epoch.values[1] = Some(longitude);
            epoch.values[2] = height;
        }
    }

    /// RMC: time, whether it is valid, latitude and longitude with their hemispheres, speed in knots, course, date.
    fn least(&mut self, fields: &[&str]) {
        let [_, time, valid, rest @ ..] = fields else {
            return;
        };
        let place = place(rest).filter(|_| *valid == "A");
        let speed = rest.get(4).and_then(|speed| number(speed));
        let course = rest.get(5).and_then(|course| number(course));
        let day = rest.get(6).and_then(|date| day(date));
        self.unfixed += usize::from(place.is_none());
        let Some(epoch) = self.epoch(time) else {
            return;
        };
        epoch.day = day.or(epoch.day);
        let Some([latitude, longitude]) = place else {
            return;
        };
        epoch.values[0] = epoch.values[0].or(Some(latitude));
        epoch.values[1] = epoch.values[1].or(Some(longitude));
        epoch.values[3] = speed.map(|knots| knots * MPS_PER_KNOT).or(epoch.values[3]);
        epoch.values[4] = course.or(epoch.values[4]);
    }

    /// ZDA: time, day, month, year.
    fn date(&mut self, fields: &[&str]) {
        let [_, time, date @ ..] = fields else { return };
        let part = |index: usize| date.get(index)?.parse::<i64>().ok();
        let day = part(0).zip(part(1)).zip(part(2));
        let day =
            day.filter(|((day, month), _)| (1..=31).contains(day) && (1..=12).contains(month));
        if let (Some(((day, month), year)), Some(epoch)) = (day, self.epoch(time)) {
            epoch.day = Some(days_since_1970(year, month, day));
        }
    }

    /// VTG: true course, T, magnetic course, M, knots, N: of the moment before it, or of that which follows.
    fn velocity(&mut self, fields: &[&str]) {
        let of = |index: usize| fields.get(index).and_then(|field| number(field));
        let (course, speed) = (of(1), of(5).map(|knots| knots * MPS_PER_KNOT));
        if self.velocity_leads {
            self.next_velocity = [course, speed];
            return;
        }
        let Some(epoch) = self.epochs.last_mut() else {
            return;
        };
        epoch.values[3] = epoch.values[3].or(speed);
        epoch.values[4] = epoch.values[4].or(course);
    }
}

/// The place that a sentence tells, whether it is sound or not.
fn said_place(sentence: &str) -> Option<SaidPlace<'_>> {
    let fields: Vec<&str> = sentence.trim_end().split(',').collect();
    let (time, at) = match kind_of(sentence).get(2..)? {
        "GGA" | "GNS" => (1, 2),
        "RMC" => (1, 3),
        "GLL" => (5, 1),
        _ => return None,
    };
    Some((
        sentence.get(..2)?,
        fields.get(time)?,
        place(fields.get(at..)?)?,
    ))
}

/// A height in metres that a sentence tells in that unit.
fn height(text: Option<&&str>, unit: f64) -> Option<f64> {
    Some(number(text?)? * unit)
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Degrees of latitude and longitude in the first four of these fields, degrees and minutes with their hemispheres.
fn place(fields: &[&str]) -> Option<[f64; 2]> {
    let angle = |number: &str, letter: &str, letters: [&str; 2], most: f64| {
        let degrees = linear(DEGREES_AND_MINUTES, self::number(number)?);
        let is_there = (0.0..=most).contains(&degrees) && letters.contains(&letter);
        is_there.then_some(if letter == letters[1] {
            -degrees
        } else {
            degrees
        })
    };
    let [latitude, north, longitude, east, ..] = fields else {
        return None;
    };
    let place = [
        angle(latitude, north, ["N", "S"], 90.0)?,
        angle(longitude, east, ["E", "W"], 180.0)?,
    ];
    (place != [0.0, 0.0]).then_some(place)
}

/// Seconds of the day of `102030.25`.
fn second_of_day(text: &str) -> Option<f64> {
    let part = |from: usize, to: usize| text.get(from..to)?.parse::<u32>().ok();
    let (hours, minutes) = (part(0, 2)?, part(2, 4)?);
    let seconds = number(text.get(4..)?).filter(|s| (0.0..61.0).contains(s))?;
    (hours < 24 && minutes < 60).then(|| f64::from(3600 * hours + 60 * minutes) + seconds)
}

/// Days since 1970 of `010524`, the first of May 2024.
fn day(text: &str) -> Option<i64> {
    let part = |at: usize| text.get(at..at + 2)?.parse::<i64>().ok();
    let (day, month, year) = (part(0)?, part(2)?, part(4)?);
    let year = if year < CENTURY { 2000 } else { 1900 } + year;
    ((1..=31).contains(&day) && (1..=12).contains(&month))
        .then(|| days_since_1970(year, month, day))
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_flight::ChannelName;

    fn sentence(body: &str) -> String {
        let sum = body.bytes().fold(0, |sum, byte| sum ^ byte);
        format!("${body}*{sum:02X}\r\n")
    }

    /// Southward and down at 36 km/h from 33° 30' S, 70° 30' W, over midnight.
    fn recording() -> String {
        let mut text = sentence("GPTXT,01,01,02,u-blox");
        for i in 0..60_u32 {
            let clock = if i < 30 {
                format!("2359{:02}.00", 30 + i)
            } else {
                format!("0000{:02}.00", i - 30)
            };
            let date = if i < 30 { "311223" } else { "010124" };
            let minutes = 30.0 + 10.0 / 1848.0 * f64::from(i);
            let height = 900.0 - f64::from(i);
            let place = format!("33{minutes:07.4},S,07030.0000,W");
            text += &sentence(&format!(
                "GNGGA,{clock},{place},1,12,0.8,{height:.1},M,24.0,M,,"
            ));
            text += &sentence(&format!("GNRMC,{clock},A,{place},19.438,180.0,{date},,,A"));
            text += &sentence("GNVTG,180.0,T,,M,19.438,N,36.0,K,A");
        }
        text
    }

    #[test]
    fn sentences_are_a_flight_with_heights_and_speeds_over_midnight() {
        let text = recording();
        assert!(is_nmea(text.as_bytes()));
        let folder = read_nmea("flight.nmea", text.as_bytes()).unwrap().unwrap();
        let flight = &folder.flight;
        let (first, last) = flight.span();
        assert!((last - first - 59.0).abs() < 1e-9, "{first} {last}");
        // 31 December 2023, 23:59:30.
        let utc = folder.log().utc_at_zero.unwrap() + first;
        assert_eq!(utc, 1_704_067_170.0);
        let origin = flight.frame_on_globe.unwrap().origin;
        assert!((origin.latitude.to_degrees() + 33.5).abs() < 1e-9);
        assert!((origin.longitude.to_degrees() + 70.5).abs() < 1e-9);
        let last = |name| *flight.channel(name).unwrap().values.last().unwrap();
        assert!((last(ChannelName::GpsNorth) + 590.0).abs() < 1.0);
        assert!((last(ChannelName::GpsHeight) - 841.0).abs() < 1e-9);
        assert!((last(ChannelName::GpsVelocityNorth) + 10.0).abs() < 0.01);
    }

    #[test]
    fn damaged_sentences_and_those_without_a_fix_are_left_out_and_told() {
        let text = recording().replacen("33.4", "33.5", 1) + &recording().replace("GNGGA", "GNGGB");
        let read = sentences(&text);
        assert_eq!(read.damaged, 60);
        let unfixed = recording().replace(",A,33", ",V,33");
        let unfixed: String = unfixed
            .lines()
            .filter(|line| line.contains("RMC"))
            .map(|line| sentence(&line[1..line.len() - 3]))
            .collect();
        assert!(read_nmea("a.nmea", unfixed.as_bytes()).unwrap().is_none());
    }

    #[test]
    fn a_sentence_that_is_cut_off_is_left_out_and_told_where_others_have_sums() {
        let fix = |i: u32| {
            sentence(&format!(
                "GPGGA,1200{i:02}.00,4730.{i:02}0,N,00830.000,E,1,8,1,440.5,M,47.0,M,,"
            ))
        };
        let text: String = (0..10).map(fix).collect();
        let begin = text.rfind('$').unwrap();
        for cut in begin + 1..text.rfind('*').unwrap() + 3 {
            let read = sentences(&text[..cut]);
            assert_eq!(
                (read.epochs.len(), read.damaged),
                (9, 1),
                "{}",
                &text[begin..cut]
            );
        }
        let bare: String = text
            .lines()
            .map(|line| line[..line.len() - 3].to_owned() + "\n")
            .collect();
        assert_eq!(sentences(&bare).epochs.len(), 10);
    }

    #[test]
    fn check_sums_of_some_kinds_of_sentences_do_not_condemn_the_others() {
        let bare = |line: &str| line.trim_end()[..line.trim_end().len() - 3].to_owned() + "\n";
        let epoch = |i: u32| {
            let place = format!("1200{i:02}.00");
            let fix = sentence(&format!(
                "GPGGA,{place},4730.0{i:02},N,00830.000,E,1,8,1,440.5,M,47.0,M,,"
            ));
            let others = ["GPRMC", "GPGSA", "GPGSV"].map(|kind| {
                sentence(&format!(
                    "{kind},{place},A,4730.0{i:02},N,00830.000,E,1,2,130524,,"
                ))
            });
            bare(&fix) + &others.concat()
        };
        let text: String = (0..10).map(epoch).collect();
        let read = sentences(&text);
        assert_eq!((read.epochs.len(), read.damaged), (10, 0));
        assert!(
            read.epochs
                .iter()
                .all(|epoch| epoch.values[2] == Some(440.5))
        );
        let begin = text.rfind("$GPRMC").unwrap();
        assert_eq!(sentences(&text[..begin + 40]).damaged, 1);
    }

    #[test]
    fn a_velocity_that_comes_before_the_place_of_its_moment_is_of_that_moment() {
        let places = |i: u32| {
            let place = format!("4730.{i:02}0,N,00830.000,E");
            sentence(&format!(
                "GPGGA,1200{i:02}.00,{place},1,8,1,440.5,M,47.0,M,,"
            ))
        };
        let velocity = |i: u32| sentence(&format!("GPVTG,0.0,T,,M,{i}.0,N,,K,A"));
        let speeds = |text: String| -> Vec<Option<f64>> {
            let epochs = sentences(&text).epochs;
            epochs.iter().map(|epoch| epoch.values[3]).collect()
        };
        let expected: Vec<_> = (0..9).map(|i| Some(f64::from(i) * MPS_PER_KNOT)).collect();
        let before = (0..9).map(|i| velocity(i) + &places(i)).collect();
        assert_eq!(speeds(before), expected);
        let behind = (0..9).map(|i| places(i) + &velocity(i)).collect();
        assert_eq!(speeds(behind), expected);
        // A recording that begins within a moment.
        let within = velocity(7) + &(0..9).map(|i| places(i) + &velocity(i)).collect::<String>();
        assert_eq!(speeds(within), expected);
    }

    #[test]
    fn of_two_receivers_in_turn_the_one_with_most_places_counts() {
        let of = |talker: &str, tenth: u32, minutes: f64| {
            let clock = format!("1200{:02}.{}0", tenth / 10, tenth % 10);
            sentence(&format!(
                "{talker}GGA,{clock},47{minutes:08.5},N,00830.00000,E,1,8,1,440.5,M,47.0,M,,"
            ))
        };
        // 18.5 m/s northward, the second half a second later; it is lost from second 40 on.
        let read = |second: &str, apart: f64| {
            let mut text = String::new();
            for i in 0..60 {
                let minutes = 30.0 + 0.01 * f64::from(i);
                text += &of("GP", 10 * i, minutes);
                if i < 40 {
                    text += &of(second, 10 * i + 5, minutes + 0.005 + apart);
                }
            }
            sentences(&text)
        };
        let two = read("GN", 0.1);
        assert_eq!(two.epochs.len(), 60);
        assert!(
            two.others[0].contains("40 places of GN are left out"),
            "{:?}",
            two.others
        );
        // One receiver that names itself after the satellites that it uses makes one track.
        let one = read("GN", 0.0);
        assert_eq!((one.epochs.len(), one.others.len()), (100, 0));
    }

    #[test]
    fn heights_in_feet_and_dates_alone_are_read() {
        let text = sentence("GPZDA,120000.00,13,05,2024,00,00")
            + &sentence("GPGGA,120000.00,4730.000,N,00830.000,E,1,8,1,1000.0,F,47.0,M,,");
        let read = sentences(&text);
        assert_eq!(read.epochs.len(), 1);
        assert_eq!(read.epochs[0].day, Some(days_since_1970(2024, 5, 13)));
        assert!((read.epochs[0].values[2].unwrap() - 304.8).abs() < 1e-9);
    }

    #[test]
    fn a_receiver_without_dates_goes_on_over_midnight() {
        let text = recording();
        let fixes = text.lines().filter(|line| line.contains("GGA"));
        let alone: Vec<String> = fixes.map(|line| format!("12:00:01 {line}")).collect();
        let alone = alone.join("\n");
        let folder = read_nmea("a.nmea", alone.as_bytes()).unwrap().unwrap();
        assert_eq!(folder.log().utc_at_zero, None);
        let (first, last) = folder.flight.span();
        assert!((last - first - 59.0).abs() < 1e-9, "{first} {last}");
    }

    #[test]
    fn sentences_of_several_systems_and_of_places_alone_are_read() {
        let of = |kinds: &[&str]| {
            let mut text = String::new();
            for (i, kind) in (0..3).flat_map(|i| kinds.iter().map(move |kind| (i, *kind))) {
                let place = format!("4730.{i}00,N,00830.000,W");
                let own = match kind {
                    "GNS" => format!("GNGNS,12000{i}.00,{place},AN,12,0.8,440.5,47.0,,"),
                    "GLL" => format!("GPGLL,{place},12000{i}.00,A,A"),
                    // Another receiver, a minute of arc beside.
                    _ => {
                        format!("GLGGA,12000{i}.00,4731.{i}00,N,00830.000,W,1,8,1,99.0,M,47.0,M,,")
                    }
                };
                for line in sentence(&own).lines() {
                    text += "2024-05-13 12:00:00 ";
                    text += line;
                    text += "\n";
                }
            }
            assert!(is_nmea(text.as_bytes()), "{kinds:?}");
            read_nmea("a.nmea", text.as_bytes())
                .unwrap()
                .unwrap()
                .flight
        };
        for kinds in [&["GNS"][..], &["GLL"], &["GNS", "GGA"]] {
            let flight = of(kinds);
            let origin = flight.frame_on_globe.unwrap().origin;
            assert!(
                (origin.latitude.to_degrees() - 47.5).abs() < 1e-9,
                "{kinds:?}"
            );
            assert!((origin.longitude.to_degrees() + 8.5).abs() < 1e-9);
            let height = flight.channel(ChannelName::GpsHeight).map(|c| c.values[0]);
            assert_eq!(height, kinds.contains(&"GNS").then_some(440.5), "{kinds:?}");
        }
    }

    #[test]
    fn tables_and_texts_are_no_sentences() {
        for text in ["time,lat\n0,47\n", "$5 for GGA,1\n", "$GPGSV,1\n", ""] {
            assert!(!is_nmea(text.as_bytes()), "{text}");
        }
    }
}
