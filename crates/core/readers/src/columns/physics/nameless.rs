//! Tables whose columns have no names: what they mean, told by how their values go together.

use pilotage_flight::ChannelName;

use super::Known;
use super::angles::{self, Convention};
use super::axes::{centred, compare};
use super::board::{FlightColumns, Id};
use super::grid::{TimedNumbers, quantile};
use super::inertial::course_rate;
use crate::cells::Dimension;
use crate::columns::ColumnRole;
use pilotage_base::frames::units::EARTH_RADIUS;

const GRAVITY: f64 = 9.806_65;
/// Speeds that a track reaches, m/s: something that flies, and nothing faster.
const FLOWN: std::ops::Range<f64> = 1.5..200.0;
/// Steps of a track over which it goes somewhere, and the least share of their lengths that it gets away by: noise goes
/// nowhere.
const STEPS: usize = 10;
const AWAY: f64 = 0.5;
/// Fastest climb, m/s.
const CLIMB: f64 = 40.0;

/// Tables without names that have a time.
fn tables(board: &FlightColumns) -> Vec<usize> {
    let all = 0..board.maps.len();
    all.filter(|table| {
        !board.maps[*table].shape.has_header && board.find_in(*table, ColumnRole::Time).is_some()
    })
    .collect()
}

fn is_free(board: &FlightColumns, id: Id) -> bool {
    board.column(id).role == ColumnRole::Nothing
}

/// Columns one beside the other, all free.
pub(super) fn windows<const N: usize>(board: &FlightColumns) -> Vec<[Id; N]> {
    let of_table = |table: usize| {
        let count = board.maps[table].columns.len();
        let begins = 0..(count + 1).saturating_sub(N);
        begins.map(move |begin| std::array::from_fn(|part| (table, begin + part)))
    };
    let all = tables(board).into_iter().flat_map(of_table);
    all.filter(|ids: &[Id; N]| ids.iter().all(|id| is_free(board, *id)))
        .collect()
}

/// Latitude and longitude, which stand side by side: degrees between which something flies.
pub(super) fn place(board: &mut FlightColumns) {
    for ids in windows::<2>(board) {
        let has_place = board.find_in(ids[0].0, ColumnRole::Latitude).is_some();
        if has_place || !ids.iter().all(|id| is_free(board, *id)) {
            continue;
        }
        let [first, second] = ids.map(|id| board.raw(id));
        // What goes on and on is a time or a count.
        if [&first, &second].into_iter().any(grows) {
            continue;
        }
        let is_whole =
            |series: &TimedNumbers| series.values.iter().all(|value| value.fract() == 0.0);
        for (unit, factor) in [("deg", 1.0), ("deg1e7", 1e-7)] {
            if factor < 1.0 && !(is_whole(&first) && is_whole(&second)) {
                continue;
            }
            let degrees = |series: &TimedNumbers| series.map(|value| value * factor);
            let (a, b) = (degrees(&first), degrees(&second));
            let reach = |series: &TimedNumbers| quantile(&series.map(f64::abs).values, 1.0);
            // Where the first cannot be a latitude the second may be one.
            let turned = reach(&a) > 90.0;
            let (latitude, longitude) = if turned { (&b, &a) } else { (&a, &b) };
            if reach(latitude) > 90.0 || reach(longitude) > 180.0 || !is_flown(latitude, longitude)
            {
                continue;
            }
            let why = "with the column beside it, it makes a track that can be flown";
            let (latitude, longitude) = if turned {
                (ids[1], ids[0])
            } else {
                (ids[0], ids[1])
            };
            board.take(latitude, ColumnRole::Latitude, unit, why);
            board.take(longitude, ColumnRole::Longitude, unit, why);
            break;
        }
    }
}

/// Whether values never fall.
fn grows(series: &TimedNumbers) -> bool {
    series.values.windows(2).all(|pair| pair[0] <= pair[1])
}

/// Whether degrees of latitude and longitude are a way that something flies.
fn is_flown(latitude: &TimedNumbers, longitude: &TimedNumbers) -> bool {
    let mut places: Vec<(f64, f64, f64)> = Vec::new();
    for (time, degrees) in latitude.times.iter().zip(&latitude.values) {
        let beside = longitude.at(*time);
        let (north, east) = (degrees.to_radians(), beside.to_radians());
        let place = (
            *time,
            north * EARTH_RADIUS,
            east * EARTH_RADIUS * north.cos(),
        );
        let is_new = |last: &(f64, f64, f64)| (last.1, last.2) != (place.1, place.2);
        // A receiver without a fix says zero.
        if (*degrees, beside) != (0.0, 0.0)
            && beside.is_finite()
            && places.last().is_none_or(is_new)
        {
            places.push(place);
        }
    }
    if places.len() < 5 * STEPS {
        return false;
    }
    let way = |a: &(f64, f64, f64), b: &(f64, f64, f64)| (b.1 - a.1).hypot(b.2 - a.2);
    let steps: Vec<f64> = places.windows(2).map(|w| way(&w[0], &w[1])).collect();
    let pairs = places.windows(STEPS + 1);
    let speeds: Vec<f64> = pairs
        .clone()
        .map(|w| way(&w[0], &w[STEPS]) / (w[STEPS].0 - w[0].0))
        .collect();
    let gained: f64 = pairs.map(|w| way(&w[0], &w[STEPS])).sum();
    let walked: f64 = steps.windows(STEPS).map(|w| w.iter().sum::<f64>()).sum();
    FLOWN.contains(&quantile(&speeds, 0.9)) && gained > AWAY * walked
}

/// Heights: by satellites beside a longitude, by air pressure what goes up and down with them.
pub(super) fn heights(board: &mut FlightColumns, known: &Known) {
    for table in tables(board) {
        let Some(longitude) = board.find_in(table, ColumnRole::Longitude) else {
            continue;
        };
        let id = (table, longitude.1 + 1);
        let is_there = id.1 < board.maps[table].columns.len() && is_free(board, id);
        if is_there && is_height(board, known, id) {
            let why = "it stands beside latitude and longitude, and climbs as aircraft do";
            board.take(id, ColumnRole::Channel(ChannelName::GpsHeight), "m", why);
        }
    }
    let Some(height) = board.find(ColumnRole::Channel(ChannelName::GpsHeight)) else {
        return;
    };
    if board
        .find(ColumnRole::Channel(ChannelName::BarometricHeight))
        .is_some()
    {
        return;
    }
    let reference = known.grid.mean(&board.values(height));
    for [id] in windows::<1>(board) {
        if board.find_in(id.0, ColumnRole::Longitude).is_some() {
            continue;
        }
        let beside = known.grid.mean(&board.raw(id));
        let alike = compare(&centred(&reference), &centred(&beside));
        let is_alike = alike.is_some_and(|(c, factor, _)| c > 0.9 && factor.ln().abs() < 0.2);
        if is_alike && is_height(board, known, id) {
            let why = "it goes up and down as the height by satellites does";
            board.take(
                id,
                ColumnRole::Channel(ChannelName::BarometricHeight),
                "m",
                why,
            );
            return;
        }
    }
}

fn is_height(board: &FlightColumns, known: &Known, id: Id) -> bool {
    let raw = board.raw(id);
    let (low, high) = (quantile(&raw.values, 0.01), quantile(&raw.values, 0.99));
    let climbs: Vec<f64> = known
        .grid
        .rate(&raw)
        .iter()
        .map(|rate| rate.abs())
        .collect();
    low > -500.0 && high < 12_000.0 && high - low > 2.0 && quantile(&climbs, 0.95) < CLIMB
}

/// Roll, pitch and heading, which stand side by side: the third goes with the course, the first with its turns.
pub(super) fn attitude(board: &mut FlightColumns, known: &Known) {
    if !known.is_of_track || quantile(&known.speed(), 0.9) < FLOWN.start {
        return;
    }
    let (course, speed) = (known.course(), known.speed());
    let turns = course_rate(known);
    let turns: Vec<f64> = turns
        .iter()
        .zip(&speed)
        .map(|(r, s)| (r * s / GRAVITY).atan())
        .collect();
    let conventions = [Convention::Compass, Convention::FromEast];
    let mut best: Option<(f64, [Id; 3], &'static str)> = None;
    for ids in windows::<3>(board) {
        let readings = angles::readings(board, &known.grid, ids[2], &course, &conventions);
        let Some(heading) = readings.first().filter(|reading| reading.score > 0.7) else {
            continue;
        };
        let factor = Dimension::Angle.factor(Some(heading.unit)).unwrap_or(1.0);
        let reach = |id: Id| factor * quantile(&board.raw(id).map(f64::abs).values, 0.99);
        let rolls = known.grid.mean(&board.raw(ids[0]));
        let Some((with_turns, ..)) = compare(&turns, &rolls) else {
            continue;
        };
        let is_attitude = with_turns.abs() > 0.5 && reach(ids[0]) < 3.2 && reach(ids[1]) < 1.6;
        let score = heading.score + with_turns.abs();
        if is_attitude && best.is_none_or(|best| score > best.0) {
            best = Some((score, ids, heading.unit));
        }
    }
    let Some((_, ids, unit)) = best else { return };
    let names = [ChannelName::Roll, ChannelName::Pitch, ChannelName::Heading];
    for (id, name) in ids.into_iter().zip(names) {
        let why = "side by side, the first goes with the turns of the track and the third with its direction";
        board.take(id, ColumnRole::Channel(name), unit, why);
    }
}

/// An airspeed: with it and the heading the velocity is explained better than with the heading alone.
pub(super) fn airspeed(board: &mut FlightColumns, known: &Known) {
    const BETTER: f64 = 0.92;
    let is_told = board
        .find(ColumnRole::Channel(ChannelName::Airspeed))
        .is_some();
    let heading = &known.attitude[2];
    if is_told || heading.iter().all(|heading| !heading.is_finite()) {
        return;
    }
    let mut best: Option<(f64, Id)> = None;
    for [id] in windows::<1>(board) {
        let raw = known.grid.mean(&board.raw(id));
        let over_ground = super::velocity::ratio(&known.speed(), &raw);
        // What is the speed over ground to the last percent is no airspeed.
        if over_ground.is_some_and(|(_, scatter)| scatter < 0.04) {
            continue;
        }
        let explained = |airspeed: &dyn Fn(f64) -> f64| unexplained(known, &raw, airspeed);
        let Some(((alone, _), (left, factor))) =
            explained(&|_| 1.0).zip(explained(&|airspeed| airspeed))
        else {
            continue;
        };
        let share = left / alone;
        if share < BETTER && factor.ln().abs() < 0.4 && best.is_none_or(|best| share < best.0) {
            best = Some((share, id));
        }
    }
    if let Some((_, id)) = best {
        let why = "along the heading it explains the velocity better than any one speed";
        board.take(id, ColumnRole::Channel(ChannelName::Airspeed), "m/s", why);
    }
}

/// Residual sum of squares of velocity = factor · airspeed · heading + wind where the aircraft flies, m²/s², and the
/// factor.
fn unexplained(known: &Known, raw: &[f64], airspeed: &dyn Fn(f64) -> f64) -> Option<(f64, f64)> {
    let [north, east, _] = &known.velocity;
    let mut rows = Vec::new();
    for (index, raw) in raw.iter().enumerate() {
        let heading = known.attitude[2][index];
        let row = [
            airspeed(*raw) * heading.cos(),
            airspeed(*raw) * heading.sin(),
            north[index],
            east[index],
        ];
        if raw.is_finite() && row.iter().all(|v| v.is_finite()) && row[2].hypot(row[3]) > 3.0 {
            rows.push(row);
        }
    }
    if rows.len() < 20 {
        return None;
    }
    let mean = |part: usize| rows.iter().map(|row| row[part]).sum::<f64>() / rows.len() as f64;
    let means = [0, 1, 2, 3].map(mean);
    let (mut xx, mut xv, mut vv) = (0.0, 0.0, 0.0);
    for row in &rows {
        let d = [0, 1, 2, 3].map(|part| row[part] - means[part]);
        xx += d[0] * d[0] + d[1] * d[1];
        xv += d[0] * d[2] + d[1] * d[3];
        vv += d[2] * d[2] + d[3] * d[3];
    }
    (xx > 0.0 && xv > 0.0).then(|| (vv - xv * xv / xx, xv / xx))
}

/// Says of tables without names what became of them.
pub(super) fn tell(board: &mut FlightColumns) {
    for table in 0..board.maps.len() {
        if board.maps[table].shape.has_header {
            continue;
        }
        let used = board.maps[table]
            .columns
            .iter()
            .filter(|column| !matches!(column.role, ColumnRole::Nothing | ColumnRole::Time));
        let sentence = if used.count() > 0 {
            "its columns have no names: what they mean was told by how their values go together; look them over"
        } else {
            "its columns have no names, and nothing tells what their values mean: write names into its first line (time, \
             lat, lon, …) or say it in a column map (`pilotage columns --save`)"
        };
        board.tell(table, sentence.to_owned());
    }
}
