//! Meanings of the columns of a table, guessed.

use super::bodies::of_one_body;
use super::groups::{ColumnGroup, GroupQuantity, context, groups, quaternion_roles, telling};
use super::header::{NameParts, parts as parts_of_name};
use super::map::OF_PICTURES;
use super::names::{NameGuess, is_otherwise, meanings};
use super::physics::{self, Hint, TableEvidence, is_of_ros};
use super::pictures::ENDINGS;
use super::rows::EvenRows;
use super::sampling::sampled;
use super::settle::{settle, unused};
use super::several::{
    degrees_and_minutes, fraction_of_time, hemispheres, parts_of_time, parts_without_hemispheres,
    places,
};
use super::values::{UnitGuess, are_degrees, unit};
use super::{
    Alternative, ColumnMap, ColumnRole, ColumnSample, MappedColumn, long, makers, parts,
    two_heights,
};
use crate::cells::time::unit_of_time;
use crate::cells::{Dimension, date_and_time, readings};
use crate::folder::{RECEIVER_DATE, are_above_ellipsoid};
use pilotage_base::sorting::sort;
use pilotage_flight::ChannelName;

/// Below this a name says nothing.
const LEAST: f64 = 0.3;
/// A column whose name says so surely is the time, though values fit no flight: in seconds.
const SURELY_TIME: f64 = 0.9;
/// Words of columns that number their rows.
const NUMBERS: [&str; 10] = [
    "id", "index", "idx", "no", "number", "seq", "sequence", "row", "sample", "frame",
];

/// Guesses the meanings of the columns of a table; `None` if it is no table with numbers.
///
/// Names and values are looked at first, at the table's beginning and at some places all over it; then units and axes
/// are judged together by what columns must have to do with each other.
///
/// ```
/// use pilotage_readers::columns::{ColumnRole, guess_table};
///
/// let row = |t: usize| format!("{t},{:.6},{:.6},{}\n", 46.8 + 1e-4 * t as f64, -92.0, 20 + t % 2);
/// let rows: String = (0..50).map(row).collect();
/// let table = format!("time_s,lat_deg,lon_deg,temperature\n{rows}");
/// let map = guess_table("track.csv", table.as_bytes()).ok_or("no table")?;
/// let column = |role| map.column(role).map(|column| column.name.as_str());
/// assert_eq!(column(ColumnRole::Time), Some("time_s"));
/// assert_eq!(column(ColumnRole::Latitude), Some("lat_deg"));
/// # Ok::<(), &str>(())
/// ```
pub fn guess_table(file: &str, bytes: &[u8]) -> Option<ColumnMap> {
    let guess = guess_with_samples(file, bytes, true)?;
    let mut maps = [guess.map];
    let wanted = wanted(&maps[0], &guess.groups, &[]);
    let rows = EvenRows::of(bytes, &maps[0].shape, &wanted).with_parts(&maps[0]);
    let evidence = [TableEvidence {
        rows,
        hints: guess.hints,
        groups: guess.groups,
    }];
    physics::judge(&mut maps.iter_mut().collect::<Vec<_>>(), &evidence);
    let [map] = maps;
    Some(map)
}

/// Marks the columns that may come to mean something: those that do, those at `times` that may be the time, and
/// groups of unknown quantity.
pub(super) fn wanted(map: &ColumnMap, groups: &[ColumnGroup], times: &[usize]) -> Vec<bool> {
    let unknown = groups.iter().filter(|group| group.kind.is_none());
    let unknown: Vec<usize> = unknown.flat_map(|group| group.columns.clone()).collect();
    let columns = map.columns.iter().enumerate();
    let is_wanted = |(index, column): (usize, &MappedColumn)| {
        let is_known = column.role != ColumnRole::Nothing || !map.shape.has_header;
        is_known || unknown.contains(&index) || times.contains(&index)
    };
    columns.map(is_wanted).collect()
}

/// Meanings of a table's columns by names and values, with samples of all columns.
pub(super) struct ColumnGuesses {
    pub map: ColumnMap,
    pub samples: Vec<ColumnSample>,
    /// Share of the table's rows that are in the samples, about.
    pub share: f64,
    pub hints: Vec<Hint>,
    pub groups: Vec<ColumnGroup>,
}

/// Guesses the meanings of the columns of a table by names and values; `None` if it is no table. Of the only table that
/// there is (`is_alone`), what its file is called may add to them, and casts no doubt on them (`home.csv`, `nav.csv`).
pub(super) fn guess_with_samples(
    file: &str,
    bytes: &[u8],
    is_alone: bool,
) -> Option<ColumnGuesses> {
    let called = if is_alone && is_otherwise(&context(file)) {
        ""
    } else {
        file
    };
    let (shape, samples, share) = sampled(bytes)?;
    let (columns, hints, groups, told) = guess_columns(called, &samples, share);
    let map = ColumnMap {
        file: file.to_owned(),
        shape,
        rows_per_second: None,
        findings: long::told(&samples, &columns)
            .into_iter()
            .chain(told)
            .chain(above_ellipsoid(&columns, bytes))
            .collect(),
        questions: day_or_month(&samples, &columns).into_iter().collect(),
        columns,
    };
    Some(ColumnGuesses {
        map,
        samples,
        share,
        hints,
        groups,
    })
}

/// Question to ask where all dates could be read with day and month the other way round.
fn day_or_month(samples: &[ColumnSample], columns: &[MappedColumn]) -> Option<String> {
    let time = columns
        .iter()
        .position(|c| c.role == ColumnRole::Time && c.unit == super::time::DATE)?;
    let mut texts = samples[time].texts.iter();
    let first = texts.clone().find(|text| readings(text).is_some())?;
    // A single day beyond the twelfth tells.
    if !texts.all(|text| readings(text).is_some() || date_and_time(text).is_none()) {
        return None;
    }
    let [taken, other] = readings(first)?;
    Some(format!(
        "\"{first}\" may be {taken} or {other}; taken: {taken}. Only the date rests on it. Is that right?"
    ))
}

/// A column that may be the time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimeGuess {
    /// Index of the column.
    pub column: usize,
    /// Its unit.
    pub unit: &'static str,
    /// Confidence, 0 to 1.
    pub confidence: f64,
    /// Why, in words.
    pub reason: String,
}

/// The column that is the time.
pub(crate) fn guess_time(samples: &[ColumnSample], share: f64) -> Option<TimeGuess> {
    let candidates = times(samples, share).into_iter();
    // A clock that is coarser than the rows counts only where no other is; of equals the first.
    let rank = |guess: &TimeGuess| {
        let sample = &samples[guess.column];
        let is_fine = sample.grows() || !sample.goes_on();
        // Nor does one that stands in some rows only.
        let known = sample.numbers.len() + sample.texts.len();
        let is_in_most = known >= sample.empty;
        (is_fine, is_in_most, guess.confidence)
    };
    candidates.fold(None, |best: Option<TimeGuess>, found| match best {
        Some(best) if rank(&best) >= rank(&found) => Some(best),
        _ => Some(found),
    })
}

/// Every column that may be the time, in the order of the columns.
pub(super) fn times(samples: &[ColumnSample], share: f64) -> Vec<TimeGuess> {
    let has_names = samples.iter().any(|sample| !sample.name.starts_with('#'));
    let candidate = |(column, sample): (usize, &ColumnSample)| {
        if makers::is_clock_of_no_unit(&sample.name) {
            return None;
        }
        let parts = parts_of_name(&sample.name, &sample.unit);
        let named = meanings(&parts.words)
            .into_iter()
            .chain(meanings(parts.plain_words()));
        let named = named
            .filter(|guess| guess.role == ColumnRole::Time)
            .map(|g| g.confidence);
        let named = named.fold(0.0, f64::max);
        let is_number = parts
            .words
            .iter()
            .any(|word| NUMBERS.contains(&word.as_str()));
        let found = unit_of_time(sample, parts.time_unit(), share);
        let grows = sample.grows() || sample.goes_on();
        let is_called_time = named >= SURELY_TIME && sample.is_numeric() && grows;
        let in_seconds = || {
            let reason =
                "its name says that it is the time, and nothing its unit: taken in seconds";
            is_called_time.then(|| ("s", 0.6, reason.to_owned()))
        };
        let (unit, confidence, reason) = found.or_else(in_seconds)?;
        let is_date = unit == super::time::DATE;
        let by_name = match named {
            0.0 if is_date => 0.9,
            // `GPStime` has no seam before the word.
            0.0 if ends_in_time(&sample.name) => 0.7,
            // Among columns with names the time has one.
            0.0 if has_names || is_number => return None,
            0.0 => 0.6,
            named => named,
        };
        // Ticks of a processor count in a unit of its own.
        let are_ticks = parts.words.iter().any(|w| w == "tick" || w == "ticks");
        let by_name = by_name * if are_ticks { 0.3 } else { 1.0 };
        Some(TimeGuess {
            column,
            unit,
            confidence: by_name * confidence,
            reason,
        })
    };
    samples.iter().enumerate().filter_map(candidate).collect()
}

/// Whether a name ends in the word for times, without a seam before it.
fn ends_in_time(name: &str) -> bool {
    let name = name.trim().to_lowercase();
    name.ends_with("time") || name.ends_with("timestamp")
}

/// Meanings of the columns of which these are samples, `share` of all rows; also hints that their names give for
/// sure, groups of columns that belong together, and sentences about the unexpected.
fn guess_columns(
    file: &str,
    samples: &[ColumnSample],
    share: f64,
) -> (Vec<MappedColumn>, Vec<Hint>, Vec<ColumnGroup>, Vec<String>) {
    let time = guess_time(samples, share);
    let names = parts_without_hemispheres(samples);
    let is_numeric: Vec<bool> = samples.iter().map(ColumnSample::is_numeric).collect();
    let groups = groups(file, &names, &is_numeric);
    let mut guesses: Vec<Vec<NameGuess>> = names.iter().map(|p| by_name(file, p)).collect();
    makers::course_of_radio(&names, &mut guesses);
    makers::course_of_phone(&names, &mut guesses);
    makers::short_names(&names, &mut guesses);
    makers::roles(samples.iter().map(|s| s.name.as_str()), &mut guesses);
    let mut hints = vec![Hint::default(); samples.len()];
    for group in &groups {
        let names = group.columns.iter().map(|at| samples[*at].name.as_str());
        let roles = match group.kind {
            Some(GroupQuantity::Position) if is_of_ros(&names.collect::<String>()) => {
                GroupQuantity::POSITION_OF_ROS
            }
            kind => kind.map_or([None; 3], GroupQuantity::roles),
        };
        for (column, role) in group.columns.iter().zip(roles) {
            hints[*column].is_axis = true;
            if let Some((role, sign)) = role {
                guesses[*column] = vec![NameGuess {
                    role,
                    sign,
                    confidence: 0.85,
                }];
            } else if group.kind.is_some() {
                guesses[*column].clear();
            }
        }
    }
    let taken: Vec<(NameParts, Vec<NameGuess>)> = names.into_iter().zip(guesses).collect();
    let has_degrees = has_degrees(samples, &taken);
    let mut columns: Vec<MappedColumn> = samples
        .iter()
        .zip(&taken)
        .enumerate()
        .map(|(index, (sample, (parts, guesses)))| match &time {
            Some(time) if time.column == index => time_column(&sample.name, time),
            _ => column(sample, parts, guesses, has_degrees),
        })
        .collect();
    for (index, (parts, _)) in taken.iter().enumerate() {
        let dimension = columns[index].role.quantity().map(Dimension::of);
        hints[index].is_stated = match dimension {
            Some(dimension) => parts.unit(dimension).is_some(),
            None => columns[index].role == ColumnRole::Time && parts.time_unit().is_some(),
        };
    }
    for group in groups
        .iter()
        .filter(|g| g.kind == Some(GroupQuantity::Quaternion))
    {
        for (column, role) in group.columns.iter().zip(quaternion_roles(false)) {
            columns[*column] = MappedColumn {
                role,
                confidence: 0.7,
                reason: "four columns are called as the parts of a quaternion".to_owned(),
                ..unused(&columns[*column].name, "")
            };
        }
    }
    let told: Vec<String> = of_one_body(&mut columns).into_iter().collect();
    parts::angles(samples, &mut columns);
    degrees_and_minutes(samples, &mut columns);
    hemispheres(samples, &mut columns);
    places(samples, &mut columns);
    if !parts::calendar(samples, &mut columns) && !fraction_of_time(samples, &mut columns) {
        parts_of_time(samples, &mut columns);
    }
    parts::date(samples, &mut columns);
    let told = told
        .into_iter()
        .chain(two_heights::judge(samples, &mut columns));
    let told: Vec<String> = told.collect();
    settle(&mut columns);
    let told = told
        .into_iter()
        .chain(from_magnetic_north(&columns))
        .chain(supposed_date(&columns));
    let told = told.collect();
    // What is put together of several columns has the unit of its parts.
    let has = |columns: &[MappedColumn], role| columns.iter().any(|column| column.role == role);
    for (whole, rest) in [
        (ColumnRole::Time, ColumnRole::TimeRest),
        (ColumnRole::Latitude, ColumnRole::AngleRest),
        (ColumnRole::Longitude, ColumnRole::AngleRest),
    ] {
        if has(&columns, rest) {
            let wholes = columns.iter().zip(&mut hints);
            let wholes = wholes.filter(|(column, _)| column.role == whole);
            wholes.for_each(|(_, hint)| hint.is_stated = true);
        }
    }
    (columns, hints, groups, told)
}

/// Meanings that the name of a column may have; those of its file's name, where it says nothing itself.
fn by_name(file: &str, parts: &NameParts) -> Vec<NameGuess> {
    let told = telling(parts.plain_words());
    let context = context(file);
    if !told.is_empty() {
        let is_for = is_otherwise(&context) && !is_otherwise(&told);
        let mut guesses = meanings(parts.plain_words());
        for guess in &mut guesses {
            guess.confidence *= if is_for { 0.3 } else { 1.0 };
        }
        return guesses;
    }
    let mut guesses = meanings(&context);
    for guess in &mut guesses {
        guess.confidence *= 0.85;
    }
    guesses
}

/// Words about a heading whose name says that it counts from magnetic north.
fn from_magnetic_north(columns: &[MappedColumn]) -> Option<String> {
    let heading = ColumnRole::Channel(ChannelName::Heading);
    let heading = columns.iter().find(|column| column.role == heading)?;
    let words = parts_of_name(&heading.name, "").words;
    if words.ends_with(&["by".to_owned(), "variation".to_owned()]) {
        return Some(format!(
            "{} is made of the magnetic one and the variation beside it",
            heading.name
        ));
    }
    let is_magnetic = words.iter().any(|w| w == "mag" || w == "magnetic");
    is_magnetic.then(|| {
        format!(
            "{} counts from magnetic north by its name, and is taken for the true heading: it is wrong by the declination there",
            heading.name
        )
    })
}

/// Words about a date that is the receiver's, whose columns say no zone.
fn supposed_date(columns: &[MappedColumn]) -> Option<String> {
    let is_date = |column: &&MappedColumn| {
        matches!(column.role, ColumnRole::Date | ColumnRole::Time) && column.name == RECEIVER_DATE
    };
    columns.iter().find(is_date).map(|_| {
        "the date is that of the receiver's own columns, which say no zone: it is supposed to be universal time"
            .to_owned()
    })
}

/// Words about heights of a receiver that are above the ellipsoid, by their name or the head of their table.
fn above_ellipsoid(columns: &[MappedColumn], bytes: &[u8]) -> Option<String> {
    let height = ColumnRole::Channel(ChannelName::GpsHeight);
    let height = columns.iter().find(|column| column.role == height)?;
    let words = parts_of_name(&height.name, "").words;
    let says = |word: &String| ["ell", "ellipsoid", "ellipsoidal", "hae"].contains(&word.as_str());
    (words.iter().any(says) || are_above_ellipsoid(bytes)).then(|| {
        format!(
            "{} is above the ellipsoid of WGS 84, which lies up to 107 m from sea level",
            height.name
        )
    })
}

/// Whether some angle of the table is surely in degrees, or in radians.
fn has_degrees(samples: &[ColumnSample], taken: &[(NameParts, Vec<NameGuess>)]) -> Option<bool> {
    let angles = samples.iter().zip(taken).filter(|(_, (_, guesses))| {
        let angle = |role: ColumnRole| {
            matches!(Dimension::of(role.quantity()?), Dimension::Angle).then_some(())
        };
        let is_place = |role| matches!(role, ColumnRole::Latitude | ColumnRole::Longitude);
        guesses
            .first()
            .is_some_and(|g| !is_place(g.role) && angle(g.role).is_some())
    });
    let said: Vec<bool> = angles
        .filter_map(|(sample, (parts, _))| match parts.unit(Dimension::Angle) {
            Some(unit) => Some(unit != "rad"),
            None => are_degrees(sample),
        })
        .collect();
    said.iter().find(|said| **said).or(said.first()).copied()
}

/// Units of pressure, in small letters: a barometer's are no heights.
const PRESSURES: [&str; 8] = ["inch", "inhg", "hg", "hpa", "mbar", "kpa", "pa", "psi"];

/// The column called so as the time.
pub(super) fn time_column(name: &str, time: &TimeGuess) -> MappedColumn {
    MappedColumn {
        role: ColumnRole::Time,
        unit: time.unit.to_owned(),
        confidence: time.confidence,
        reason: time.reason.clone(),
        ..unused(name, "")
    }
}

fn column(
    sample: &ColumnSample,
    parts: &NameParts,
    guesses: &[NameGuess],
    has_degrees: Option<bool>,
) -> MappedColumn {
    if !sample.is_numeric() {
        let is_picture = |text: &String| {
            let name = text.to_lowercase();
            ENDINGS.iter().any(|ending| name.ends_with(ending))
        };
        let are_pictures = !sample.texts.is_empty() && sample.texts.iter().all(is_picture);
        let reason = if are_pictures {
            OF_PICTURES
        } else {
            "its cells are no numbers"
        };
        return unused(&sample.name, reason);
    }
    let is_of_receiver = parts
        .words
        .iter()
        .any(|word| word == "gps" || word == "gnss");
    if is_of_receiver
        && parts.words.iter().any(|word| word == "yaw")
        && sample.range() == Some((0.0, 0.0))
    {
        return unused(
            &sample.name,
            "a receiver without two antennas says no yaw: it is always 0",
        );
    }
    if PRESSURES.contains(&parts.unit.as_str()) {
        return unused(&sample.name, "its unit is one of pressure");
    }
    let measured = guesses
        .iter()
        .filter(|guess| guess.role != ColumnRole::Time);
    let units: Vec<(NameGuess, UnitGuess, bool)> = measured
        .filter_map(|guess| {
            let dimension = Dimension::of(guess.role.quantity()?);
            let stated = parts.unit(dimension).map(|unit| UnitGuess {
                unit,
                confidence: 1.0,
                reason: format!("the table says {unit}"),
            });
            let is_stated = stated.is_some();
            Some((
                *guess,
                stated.or_else(|| unit(guess.role, sample, has_degrees))?,
                is_stated,
            ))
        })
        .collect();
    let Some((best, unit, is_stated)) = units.first().filter(|(g, ..)| g.confidence >= LEAST)
    else {
        return unused(&sample.name, "not recognised by its name");
    };
    let mut confidence = best.confidence * unit.confidence;
    let mut reason = format!("it is called {}; {}", sample.name, unit.reason);
    if sample.is_constant() {
        confidence *= 0.7;
        reason += "; it never changes";
    }
    let mut alternatives: Vec<Alternative> = units[1..]
        .iter()
        .map(|(guess, unit, _)| Alternative {
            role: guess.role,
            unit: unit.unit.to_owned(),
            confidence: guess.confidence * unit.confidence,
        })
        .collect();
    if !is_stated {
        let others = best
            .role
            .units()
            .into_iter()
            .filter(|other| *other != unit.unit);
        alternatives.extend(others.take(2).map(|other| Alternative {
            role: best.role,
            unit: other.to_owned(),
            confidence: best.confidence * (1.0 - unit.confidence) / 2.0,
        }));
    }
    sort(&mut alternatives, &|a, b| {
        b.confidence.total_cmp(&a.confidence)
    });
    MappedColumn {
        role: best.role,
        unit: unit.unit.to_owned(),
        scale: best.sign,
        confidence,
        reason,
        alternatives,
        ..unused(&sample.name, "")
    }
}
