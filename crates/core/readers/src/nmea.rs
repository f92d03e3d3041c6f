//! Sentences of a satellite receiver (NMEA 0183: GGA, RMC, VTG; headings by HDT, attitudes by PASHR), as a flight.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::cells::{DEGREES_AND_MINUTES, days_since_1970, linear};
use crate::folder::{FlightFolder, FolderError, decoded};
use crate::nmea_receivers::{SaidPlace, of_others};
use crate::nmea_velocity::{SaidMotion, velocity_leads};
use crate::text_tables::{first_flight, flight_of_table, table};
use pilotage_base::files::FileSet;
use pilotage_base::frames::units::{METRES_PER_FOOT, MPS_PER_KNOT};
use pilotage_base::text::{by_count, utc_text};

const DAY: f64 = 86_400.0;
/// Dates before this year may be of a receiver that takes one week for another, 1024 weeks earlier.
const WEEKS_BEGIN_AGAIN: i64 = 2010;
/// Receivers write two digits of a year; from this one on they are of the century before.
const CENTURY: i64 = 80;
/// Moments in which that of an attitude is looked for.
const LATEST: usize = 20;
/// Columns behind the time.
const COLUMNS: [&str; 8] = [
    "latitude [deg]",
    "longitude [deg]",
    "altitude msl [m]",
    "speed over ground [m/s]",
    "course over ground [deg]",
    "heading [deg]",
    "roll [deg]",
    "pitch [deg]",
];

/// Values that the sentences of one moment say.
#[derive(Clone, Copy, Debug, Default)]
struct Epoch {
    /// Seconds of the day (UTC).
    second: f64,
    /// Days since 1970, where they were told.
    day: Option<i64>,
    /// In the order of [`COLUMNS`].
    values: [Option<f64>; COLUMNS.len()],
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
        // Sentences of instruments have short names: `$D,11.25,97863.281*44`.
        let is_named = |name: &&str| name.len() >= 4 || line.starts_with('$') && line.contains('*');
        let Some(name) = name.filter(|name| name.is_ascii()).filter(is_named) else {
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
            "{} {} wrong or missing",
            sentences.damaged,
            by_count(
                sentences.damaged,
                "sentence was left out: its check sum is",
                "sentences were left out: their check sums are"
            )
        ));
    }
    if sentences.unfixed > 0 {
        findings.push(format!(
            "{} {} no place",
            sentences.unfixed,
            by_count(
                sentences.unfixed,
                "sentence was told without a fix, and has",
                "sentences were told without a fix, and have"
            )
        ));
    }
    findings.extend(sentences.others);
    let day = sentences.epochs.iter().find_map(|epoch| epoch.day);
    if day.is_some_and(|day| day < days_since_1970(WEEKS_BEGIN_AGAIN, 1, 1)) {
        findings.push(format!(
            "its dates are before {WEEKS_BEGIN_AGAIN}: an old receiver may count weeks that have begun again, and be off by \
             19.6 years or twice that"
        ));
    }
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
    let places: Vec<SaidPlace> = all().filter_map(said_place).collect();
    let (others, told) = of_others(&places);
    found.others = told;
    let is_read = |sentence: &&str| !others.contains(sentence.get(..2).unwrap_or_default());
    found.velocity_leads = velocity_leads(all().filter(is_read).filter_map(said_motion));
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
            "HDT" | "THS" => found.heading(&fields),
            "SHR" => found.attitude(&fields),
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
            let mut epoch = Epoch {
                second,
                ..Epoch::default()
            };
            (epoch.values[3], epoch.values[4]) = (speed, course);
            self.epochs.push(epoch);
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

    /// HDT, THS: true heading of the vehicle, in degrees, and a letter; that of THS is V where it is not valid.
    fn heading(&mut self, fields: &[&str]) {
        let is_valid = fields.get(2).is_none_or(|letter| *letter != "V");
        let heading = fields.get(1).and_then(|field| number(field));
        if let (Some(epoch), true) = (self.epochs.last_mut(), is_valid) {
            epoch.values[5] = epoch.values[5].or(heading);
        }
    }

    /// PASHR: time, true heading, T, roll, pitch, in degrees.
    fn attitude(&mut self, fields: &[&str]) {
        let [_, time, heading, "T", roll, pitch, ..] = fields else {
            return;
        };
        let Some(second) = second_of_day(time) else {
            return;
        };
        // It may come a little after the sentences of the next moment.
        let from = self.epochs.len().saturating_sub(LATEST);
        let mut latest = self.epochs[from..].iter();
        let known = latest.rposition(|epoch| epoch.second == second);
        let is_next = self.epochs.last().is_none_or(|last| {
            let step = second - last.second;
            !(-0.5 * DAY..=0.0).contains(&step)
        });
        let epoch = match known {
            Some(at) => self.epochs.get_mut(from + at),
            None if is_next => self.epoch(time),
            None => None,
        };
        let Some(epoch) = epoch else { return };
        for (at, field) in [(5, heading), (6, roll), (7, pitch)] {
            epoch.values[at] = number(field).or(epoch.values[at]);
        }
    }
}

/// The place or the velocity that a sentence tells, whether it is sound or not.
fn said_motion(sentence: &str) -> Option<SaidMotion> {
    if kind_of(sentence).get(2..)? != "VTG" {
        let (_, second, place) = said_place(sentence)?;
        return Some(SaidMotion::Place(second, place));
    }
    let fields: Vec<&str> = sentence.trim_end().split(',').collect();
    let of = |index: usize| fields.get(index).and_then(|field| number(field));
    let velocity = of(1).zip(of(5));
    Some(SaidMotion::Velocity(velocity.map(|(course, knots)| {
        [course.to_radians(), knots * MPS_PER_KNOT]
    })))
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
        second_of_day(fields.get(time)?)?,
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
#[path = "nmea_tests.rs"]
mod tests;
