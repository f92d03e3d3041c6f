//! The track: in which unit latitude and longitude are, and whether time is counted so that nothing flies too fast.

use pilotage_flight::ChannelName;

use super::Known;
use super::axes::EARTH;
use super::board::{FlightColumns, Id, UnitBasis, nearest};
use super::grid::{self, TimeCells, TimedNumbers, quantile};
use crate::cells::{DEGREES_AND_MINUTES, Dimension, SEMICIRCLES};
use crate::columns::ColumnRole;
use pilotage_base::frames::units::EARTH_RADIUS;

/// Units of places on the globe, and how likely each is before anything is known.
const UNITS: [(&str, f64); 7] = [
    ("deg", 1.0),
    ("deg1e7", 0.9),
    ("rad", 1.0),
    ("deg1e6", 0.4),
    ("deg1e5", 0.2),
    ("deg1e8", 0.2),
    (SEMICIRCLES, 0.4),
];
/// Likelihood of another unit of time than that which values alone said.
const OTHER_TIME: f64 = 0.2;

/// Likelihood that no reading in another unit of time reaches: four times [`OTHER_TIME`].
const LIKELY: f64 = 0.8;

/// Speeds over ground that are usual, m/s: a flight is hardly ever slower or faster for long.
const USUAL: std::ops::Range<f64> = 0.3..120.0;
/// Nothing that is meant here flies faster, m/s.
const FASTEST: f64 = 400.0;

/// A place is wrong by itself if the way to it and on is so many times the way past it, and so many usual steps.
const SPIKE: [f64; 2] = [100.0, 1000.0];

/// Cells over which a velocity that jumps is averaged.
const SMOOTHED: usize = 7;

/// Reading of places on the globe that may be right.
struct PlaceReading {
    unit: &'static str,
    time_unit: Option<&'static str>,
    likelihood: f64,
    velocity: [Vec<f64>; 2],
    grid: TimeCells,
}

/// Finds the track, settles its units, and keeps its velocity as what all else is held against.
pub(super) fn judge(board: &mut FlightColumns, known: &mut Known) {
    let latitude = board.find(ColumnRole::Latitude);
    let longitude = latitude.and_then(|id| board.find_in(id.0, ColumnRole::Longitude));
    match latitude.zip(longitude) {
        Some(pair) => on_globe(board, known, pair),
        None => match board.find(ColumnRole::Place) {
            Some(id) => in_pairs(board, known, id),
            None => in_metres(board, known),
        },
    }
    if known.is_of_track {
        calm(known);
    }
}

/// Places of two numbers in a cell are degrees.
fn in_pairs(board: &FlightColumns, known: &mut Known, id: Id) {
    let [latitude, longitude] = board.places(id);
    let degree = 1.0_f64.to_radians();
    if let Some(track) = track(&latitude, &longitude, degree) {
        let [north, east] = track.each_ref().map(|part| known.grid.rate(part));
        known.velocity[0] = north;
        known.velocity[1] = east;
        known.is_of_track = true;
    }
}

/// Averages the velocity over some cells where the places are so uncertain that it jumps: to and fro, whereas what turns in
/// steps that are as large turns on.
fn calm(known: &mut Known) {
    let [north, east, _] = &known.velocity;
    let jumps: Vec<[f64; 2]> = (1..north.len())
        .map(|i| [north[i] - north[i - 1], east[i] - east[i - 1]])
        .collect();
    let sizes: Vec<f64> = jumps.iter().map(|jump| jump[0].hypot(jump[1])).collect();
    let onward: Vec<f64> = jumps
        .windows(2)
        .map(|two| two[0][0] * two[1][0] + two[0][1] * two[1][1])
        .collect();
    let (jump, speed) = (quantile(&sizes, 0.5), quantile(&known.speed(), 0.9));
    let is_to_and_fro = quantile(&onward, 0.5) < 0.0;
    if is_to_and_fro && jump > 2.5 && jump > 0.3 * speed {
        for part in 0..2 {
            known.velocity[part] = grid::averaged(&known.velocity[part], SMOOTHED);
        }
    }
}

fn on_globe(board: &mut FlightColumns, known: &mut Known, (latitude, longitude): (Id, Id)) {
    let stated = board.basis(latitude) == UnitBasis::Stated;
    let present = board.column(latitude).unit.clone();
    let readings = readings(board, known, (latitude, longitude));
    let best = readings
        .into_iter()
        .max_by(|a, b| a.likelihood.total_cmp(&b.likelihood));
    let names = board.names(&[latitude, longitude]);
    let Some(best) = best else {
        board.tell(
            latitude.0,
            format!(
                "{names}: in no unit are these places on the globe that anything flies between"
            ),
        );
        return;
    };
    if let Some(unit) = best.time_unit {
        board.set_time_unit(latitude.0, unit);
        *known = Known::new(best.grid);
        board.tell(
            latitude.0,
            format!("times are counted in {unit}: in any other unit the track is flown too fast or too slowly"),
        );
    }
    if stated && best.unit != present {
        board.tell(
            latitude.0,
            format!(
                "{names}: the table says {present}, but they are places on the globe only in {}",
                best.unit
            ),
        );
    }
    let speed = quantile(&norms(&best.velocity), 0.9);
    let reason = if speed.is_finite() {
        format!(
            "in {} the track is flown at up to {speed:.1} m/s",
            best.unit
        )
    } else {
        // Rows too far apart in time tell no speed.
        format!("in {} these are places on the globe", best.unit)
    };
    for id in [latitude, longitude] {
        board.found(id, best.unit, &reason);
    }
    let [north, east] = best.velocity;
    known.velocity[0] = north;
    known.velocity[1] = east;
    known.is_of_track = true;
}

/// Every way to read places, with each unit of time where none is stated.
fn readings(board: &mut FlightColumns, known: &Known, pair: (Id, Id)) -> Vec<PlaceReading> {
    let (latitude, longitude) = pair;
    let stated = board.basis(latitude) == UnitBasis::Stated;
    let present = board.column(latitude).unit.clone();
    let reach = |id: Id| quantile(&board.raw(id).map(f64::abs).values, 0.9);
    let reach = (reach(latitude), reach(longitude));
    // Hardly any place on the globe has so few degrees that they could be radians.
    let is_small = reach.0 < std::f64::consts::FRAC_PI_2 && reach.1 < std::f64::consts::PI;
    let could_be_radians = is_small && reach.0.min(reach.1) > 0.01;
    let time = board.find_in(latitude.0, ColumnRole::Time);
    let time_unit = time.map(|id| board.column(id).unit.clone());
    let is_date = time_unit.as_deref() == Some(crate::columns::time::DATE);
    let is_time_told = is_date || time.is_none_or(|id| board.basis(id) == UnitBasis::Stated);
    let mut time_units = vec![None];
    if !is_time_told {
        let others = ["s", "ms", "us", "ns", "min", "h"].into_iter();
        let others = others.filter(|unit| time_unit.as_deref() != Some(*unit));
        time_units.extend(others.map(Some));
    }
    // Parts of degrees are counted in whole numbers.
    let are_broken = {
        let raw = board.raw(latitude).values;
        2 * raw.iter().filter(|value| value.fract() != 0.0).count() > raw.len()
    };
    let mut readings = Vec::new();
    for unit_of_time in time_units {
        // No other unit of time outweighs a reading that is likely by itself.
        if readings
            .iter()
            .any(|reading: &PlaceReading| reading.likelihood >= LIKELY)
        {
            break;
        }
        if let Some(unit) = unit_of_time {
            board.set_time_unit(latitude.0, unit);
        }
        let other_grid = || board.grid();
        let grid = unit_of_time.map_or(Some(known.grid), |_| other_grid());
        let Some(grid) = grid else { continue };
        let by_time = if unit_of_time.is_some() {
            OTHER_TIME
        } else {
            1.0
        };
        let units = match present.as_str() {
            // What stands there was read as degrees already.
            DEGREES_AND_MINUTES => &[(DEGREES_AND_MINUTES, 1.0)],
            _ => &UNITS[..],
        };
        for (unit, prior) in units.iter().copied() {
            let is_counted = unit.starts_with("deg1e") || unit == SEMICIRCLES;
            if are_broken && is_counted && unit != present {
                continue;
            }
            let is_of_fit = unit == SEMICIRCLES && unit == present;
            let prior = if is_of_fit { 1.0 } else { prior };
            let by_range = if could_be_radians && unit != "rad" {
                0.1
            } else {
                1.0
            };
            let by_name = if stated && unit != present { 0.05 } else { 1.0 };
            let found = reading(board, &grid, pair, unit);
            readings.extend(found.map(|(velocity, likelihood)| PlaceReading {
                unit,
                time_unit: unit_of_time,
                likelihood: prior * by_time * by_range * by_name * likelihood,
                velocity,
                grid,
            }));
        }
    }
    if let Some(unit) = time_unit.filter(|_| !is_time_told) {
        board.set_time_unit(latitude.0, &unit);
    }
    readings
}

fn norms([north, east]: &[Vec<f64>; 2]) -> Vec<f64> {
    north.iter().zip(east).map(|(n, e)| n.hypot(*e)).collect()
}

/// The velocity of the track in a unit, and how likely it is; `None` if these are no places.
fn reading(
    board: &FlightColumns,
    grid: &TimeCells,
    pair: (Id, Id),
    unit: &str,
) -> Option<([Vec<f64>; 2], f64)> {
    let factor = Dimension::Angle.factor(Some(unit)).ok()?;
    // A hemisphere in a column of its own turns the sign.
    let read = |id: Id| {
        let scale = board.column(id).scale;
        board.raw(id).map(|value| value * scale)
    };
    let track = track(&read(pair.0), &read(pair.1), factor)?;
    let velocity = track.each_ref().map(|part| grid.rate(part));
    let speed = quantile(&norms(&velocity), 0.9);
    if speed > FASTEST {
        return None;
    }
    let usual = if USUAL.contains(&speed) { 1.0 } else { 0.3 };
    let by_speed = match against_speed(board, grid, &velocity) {
        Some(off) if off < 0.05 => 4.0,
        Some(off) if off < 0.15 => 1.5,
        Some(_) => 0.5,
        None => 1.0,
    };
    Some((velocity, usual * by_speed))
}

/// North and east of the first place, metres, where places change; `None` if they are none.
fn track(
    latitude: &TimedNumbers,
    longitude: &TimedNumbers,
    factor: f64,
) -> Option<[TimedNumbers; 2]> {
    let mut places: Vec<(f64, f64, f64)> = Vec::new();
    for (time, raw) in latitude.times.iter().zip(&latitude.values) {
        let (a, b) = (raw * factor, longitude.at(*time) * factor);
        let is_new = places.last().is_none_or(|last| (last.1, last.2) != (a, b));
        if b.is_finite() && (a, b) != (0.0, 0.0) && is_new {
            places.push((*time, a, b));
        }
    }
    leave_out_spikes(&mut places);
    let reach = |part: fn(&(f64, f64, f64)) -> f64| {
        let sizes: Vec<f64> = places.iter().map(|place| part(place).abs()).collect();
        quantile(&sizes, 0.99)
    };
    let is_globe = reach(|p| p.1) <= std::f64::consts::FRAC_PI_2 + 1e-9
        && reach(|p| p.2) <= std::f64::consts::TAU + 1e-9;
    let first = *places.first().filter(|_| is_globe && places.len() > 3)?;
    let times: Vec<f64> = places.iter().map(|place| place.0).collect();
    let north = places
        .iter()
        .map(|place| (place.1 - first.1) * EARTH_RADIUS);
    let turn = |place: &(f64, f64, f64)| pilotage_base::frames::wrap_pi(place.2 - first.2);
    let east = places
        .iter()
        .map(|place| turn(place) * EARTH_RADIUS * first.1.cos());
    Some([
        TimedNumbers::new(&times, north),
        TimedNumbers::new(&times, east),
    ])
}

/// Leaves out places from which the track comes back at once: one damaged digit says nothing of the unit of the rest.
fn leave_out_spikes(places: &mut Vec<(f64, f64, f64)>) {
    let apart = |a: (f64, f64, f64), b: (f64, f64, f64)| (a.1 - b.1).abs() + (a.2 - b.2).abs();
    let steps: Vec<f64> = places.windows(2).map(|w| apart(w[0], w[1])).collect();
    let usual = quantile(&steps, 0.5);
    let is_spike = |i: usize| {
        let (way, past) = match (i.checked_sub(1), i + 1 < places.len()) {
            (Some(before), true) => (
                steps[before] + steps[i],
                apart(places[before], places[i + 1]),
            ),
            (Some(before), false) => (steps[before], usual),
            (None, true) => (steps[i], usual),
            (None, false) => return false,
        };
        way > SPIKE[0] * past && way > SPIKE[1] * usual
    };
    let mut spikes = (0..places.len())
        .map(is_spike)
        .collect::<Vec<_>>()
        .into_iter();
    places.retain(|_| !spikes.next().unwrap_or(false));
}

/// Distance of the ratio of the columns' speed and the track's from a unit, as a logarithm; `None` without either.
fn against_speed(board: &FlightColumns, grid: &TimeCells, velocity: &[Vec<f64>; 2]) -> Option<f64> {
    let speed = norms(velocity);
    let told = board
        .find(ColumnRole::SpeedOverGround)
        .map(|id| grid.mean(&board.raw(id)));
    let of_axes = || {
        let channel = |name| board.find(ColumnRole::Channel(name));
        let north = channel(ChannelName::GpsVelocityNorth)?;
        let east = channel(ChannelName::GpsVelocityEast)?;
        let [north, east] = [north, east].map(|id| grid.mean(&board.raw(id)));
        Some(norms(&[north, east]))
    };
    let told = told.or_else(of_axes)?;
    let (ratio, _) = super::velocity::ratio(&speed, &told)?;
    nearest(Dimension::Speed, ratio).map(|(_, off)| off.abs())
}

/// Places in metres of a frame of their own: north first, or east first where the accelerometer says that up is up.
fn in_metres(board: &mut FlightColumns, known: &mut Known) {
    let channel = |board: &FlightColumns, name| board.find(ColumnRole::Channel(name));
    let Some(first) = channel(board, ChannelName::GpsNorth) else {
        return;
    };
    let Some(second) = board.find_in(first.0, ColumnRole::Channel(ChannelName::GpsEast)) else {
        return;
    };
    if board.is_axis(first) && super::inertial::is_up_positive(board) == Some(true) {
        board.assign(first, ColumnRole::Channel(ChannelName::GpsEast), 1.0, 0.0);
        board.assign(second, ColumnRole::Channel(ChannelName::GpsNorth), 1.0, 0.0);
        let up = board.find_in(first.0, ColumnRole::Channel(ChannelName::GpsHeight));
        if let Some(up) = up.filter(|id| board.is_axis(*id)) {
            board.assign(up, ColumnRole::Channel(ChannelName::GpsHeight), 1.0, 0.0);
        }
        let names = board.names(&[first, second]);
        board.tell(
            first.0,
            format!(
                "{names}: taken for {}, as accelerations have up positive",
                EARTH[1].name
            ),
        );
    }
    let north = board.find_in(first.0, ColumnRole::Channel(ChannelName::GpsNorth));
    let east = board.find_in(first.0, ColumnRole::Channel(ChannelName::GpsEast));
    let Some((north, east)) = north.zip(east) else {
        return;
    };
    let velocity = [north, east].map(|id| known.grid.rate(&board.values(id)));
    let speed = norms(&velocity);
    // Metres cannot be told from the steps alone: by the speed that columns tell, if their unit is sure.
    let told = board.find(ColumnRole::SpeedOverGround);
    let told = told.filter(|id| board.basis(*id) == UnitBasis::Stated);
    if let Some(id) = told {
        let told = known.grid.mean(&board.values(id));
        if let Some((ratio, _)) = super::velocity::ratio(&told, &speed) {
            let present = board.column(north).role.factor(&board.column(north).unit);
            let factor = ratio * present.unwrap_or(1.0);
            board.settle_unit(&[north, east], factor, 0.2, "the speed over ground");
        }
    }
    let velocity = [north, east].map(|id| known.grid.rate(&board.values(id)));
    let [north, east] = velocity;
    known.velocity[0] = north;
    known.velocity[1] = east;
    known.is_of_track = true;
}
