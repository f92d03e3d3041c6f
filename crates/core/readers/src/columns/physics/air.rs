//! Airspeed and wind columns against the wind that velocity, airspeed and heading make together.

use nalgebra::{DMatrix, DVector, Vector2};
use pilotage_flight::ChannelName;

use super::Known;
use super::board::{FlightColumns, Id, UnitBasis, nearest};
use super::grid::quantile;
use crate::cells::Dimension;
use crate::columns::ColumnRole;

/// Airspeeds are off by up to this factor, as a logarithm, and no more.
const SCALE: f64 = 0.32;
/// Nothing flies in a wind stronger than this, m/s.
const STRONGEST: f64 = 45.0;

/// Judges airspeed and wind.
pub(super) fn judge(board: &mut FlightColumns, known: &Known) {
    let channel = |board: &FlightColumns, name| board.find(ColumnRole::Channel(name));
    let airspeeds = [ChannelName::Airspeed, ChannelName::EquivalentAirspeed];
    let mut wind = None;
    for name in airspeeds {
        if let Some(id) = channel(board, name) {
            let found = airspeed(board, known, id);
            wind = wind.or(found);
        }
    }
    let wind = wind.or_else(|| constant(known));
    if let (Some(speed), Some(from)) = (
        board.find(ColumnRole::WindSpeed),
        board.find(ColumnRole::WindFrom),
    ) {
        polar(board, known, wind, speed, from);
    }
    let north = channel(board, ChannelName::WindNorth);
    let east = north.and_then(|id| board.find_in(id.0, ColumnRole::Channel(ChannelName::WindEast)));
    if let Some((north, east)) = north.zip(east) {
        components(board, wind, north, east);
    }
}

/// The wind that a fit of airspeed and heading, or of airspeed alone, makes of the velocity over ground.
struct WindFit {
    wind: Vector2<f64>,
    /// Factor from the airspeed's numbers to m/s.
    factor: f64,
}

/// By heading: velocity = factor · airspeed · heading + wind, linear in all three unknowns.
fn by_heading(known: &Known, airspeed: &[f64], heading: &[f64]) -> Option<WindFit> {
    let [north, east, _] = &known.velocity;
    let mut rows = Vec::new();
    for index in 0..airspeed.len() {
        let (a, h, n, e) = (airspeed[index], heading[index], north[index], east[index]);
        if [a, h, n, e].iter().all(|v| v.is_finite()) && n.hypot(e) > 3.0 {
            rows.push((a * h.cos(), a * h.sin(), n, e));
        }
    }
    if rows.len() < 20 {
        return None;
    }
    let count = rows.len() as f64;
    let mean = |part: fn(&(f64, f64, f64, f64)) -> f64| rows.iter().map(part).sum::<f64>() / count;
    let (x, y, n, e) = (mean(|r| r.0), mean(|r| r.1), mean(|r| r.2), mean(|r| r.3));
    let (mut xx, mut xv, mut vv) = (0.0, 0.0, 0.0);
    for row in &rows {
        let (dx, dy, dn, de) = (row.0 - x, row.1 - y, row.2 - n, row.3 - e);
        xx += dx * dx + dy * dy;
        vv += dn * dn + de * de;
        xv += dx * dn + dy * de;
    }
    let correlation = xv / (xx * vv).sqrt();
    // Turns are needed to tell the wind from the airspeed.
    let spread = (xx / count).sqrt() / x.hypot(y).max((xx / count).sqrt());
    if correlation.is_nan() || correlation <= 0.8 || spread < 0.3 {
        return None;
    }
    let factor = xv / xx;
    Some(WindFit {
        wind: Vector2::new(n - factor * x, e - factor * y),
        factor,
    })
}

/// By airspeed alone: |velocity - wind|² = (factor · airspeed)², linear in the wind, its square and the factor's.
fn by_circles(known: &Known, airspeed: &[f64]) -> Option<WindFit> {
    let [north, east, _] = &known.velocity;
    let cells = airspeed.iter().zip(north).zip(east);
    let cells: Vec<[f64; 3]> = cells
        .map(|((a, n), e)| [*a, *n, *e])
        .filter(|[a, n, e]| a.is_finite() && n.hypot(*e) > 3.0)
        .collect();
    if cells.len() < 40 || super::angles::spread(&known.course()) < 0.5 {
        return None;
    }
    let size = quantile(&cells.iter().map(|cell| cell[0]).collect::<Vec<_>>(), 0.5);
    let design = DMatrix::from_fn(cells.len(), 4, |row, column| {
        let [a, n, e] = cells[row];
        match column {
            0 => 2.0 * n,
            1 => 2.0 * e,
            2 => -1.0,
            _ => (a / size).powi(2),
        }
    });
    let squares = DVector::from_fn(cells.len(), |row, _| {
        let [_, n, e] = cells[row];
        n * n + e * e
    });
    let normal = design.transpose() * &design;
    let solution = normal.lu().solve(&(design.transpose() * &squares))?;
    let wind = Vector2::new(solution[0], solution[1]);
    let left: f64 = (&design * &solution - &squares).norm() / squares.norm();
    let is_wind = wind.norm() < STRONGEST && solution[3] > 0.0 && left < 0.4;
    is_wind.then(|| WindFit {
        wind,
        factor: solution[3].sqrt() / size,
    })
}

/// Finds the unit of an airspeed; returns the wind that goes with it.
fn airspeed(board: &mut FlightColumns, known: &Known, id: Id) -> Option<Vector2<f64>> {
    let raw = known.grid.mean(&board.raw(id));
    let fit = by_heading(known, &raw, &known.attitude[2]).or_else(|| by_circles(known, &raw));
    let fit = fit.or_else(|| {
        // Without turns: the airspeed is about the ground speed.
        let (factor, scatter) = super::velocity::ratio(&known.speed(), &raw)?;
        (scatter < 0.5).then_some(WindFit {
            wind: Vector2::new(f64::NAN, f64::NAN),
            factor,
        })
    })?;
    let has_wind = fit.wind.x.is_finite();
    let tolerance = if has_wind { SCALE } else { 0.6 };
    let present = board
        .column(id)
        .role
        .factor(&board.column(id).unit)
        .unwrap_or(1.0);
    if (fit.factor / present).ln().abs() < tolerance {
        if has_wind || board.basis(id) == UnitBasis::Stated {
            board.confirm(id);
        }
    } else if nearest(Dimension::Speed, fit.factor).is_some_and(|(_, off)| off.abs() < 0.3) {
        unit_of_airspeed(board, id, fit.factor, tolerance);
    } else {
        let name = board.name(id);
        let times = (fit.factor / present).max(present / fit.factor);
        board.tell(
            id.0,
            format!("{name}: airspeed and velocity over ground differ by a factor of {times:.1}"),
        );
        return None;
    }
    has_wind.then_some(fit.wind)
}

/// The wind of a flight whose airspeed is not told: as if it had been the same all the time.
fn constant(known: &Known) -> Option<Vector2<f64>> {
    let same = vec![1.0; known.grid.count];
    let fit = by_heading(known, &same, &known.attitude[2]).or_else(|| by_circles(known, &same))?;
    (fit.wind.norm() < 0.7 * fit.factor).then_some(fit.wind)
}

/// Asks whether a wind is that which blows or where it comes from, where nothing tells.
fn ask(board: &mut FlightColumns, ids: &[Id], is_from: bool) {
    let names = board.names(ids);
    let taken = if is_from {
        "where it comes from"
    } else {
        "where it blows to"
    };
    super::questions::add(
        board,
        ids[0].0,
        format!("Does {names} say where the wind comes from or where it blows to? Taken: {taken}"),
    );
}

/// Settles the unit of an airspeed that is this factor of SI: airspeeds are off by more than some units differ.
fn unit_of_airspeed(board: &mut FlightColumns, id: Id, factor: f64, tolerance: f64) {
    let off = |unit: &str| {
        let known = Dimension::Speed.factor(Some(unit)).unwrap_or(1.0);
        (factor / known).ln().abs()
    };
    let what = "the velocity over ground";
    let beside = board.find(ColumnRole::SpeedOverGround);
    let beside = beside.filter(|other| board.basis(*other) == UnitBasis::Found);
    let beside = beside.map(|other| board.column(other).unit.clone());
    if let Some(unit) = beside.filter(|unit| off(unit) < tolerance) {
        let known = Dimension::Speed.factor(Some(&unit)).unwrap_or(1.0);
        board.settle_unit(&[id], known, 0.1, what);
        return;
    }
    let usual = ["m/s", "kt", "km/h", "cm/s", "mm/s"].into_iter();
    let nearest = usual.min_by(|a, b| off(a).total_cmp(&off(b)));
    let Some(unit) = nearest.filter(|unit| off(unit) < 0.3) else {
        board.settle_unit(&[id], factor, 0.3, what);
        return;
    };
    let rival = ["mph", "ft/s"].into_iter().find(|other| off(other) < 0.2);
    let known = Dimension::Speed.factor(Some(unit)).unwrap_or(1.0);
    board.settle_unit(&[id], known, 0.1, what);
    if let Some(rival) = rival {
        let name = board.name(id);
        super::questions::add(
            board,
            id.0,
            format!(
                "Is {name} in {unit} or in {rival}? An airspeed may be off by more than these differ; taken: {unit}"
            ),
        );
    }
}

/// Strength and direction: from where, or where to.
fn polar(
    board: &mut FlightColumns,
    known: &Known,
    wind: Option<Vector2<f64>>,
    speed: Id,
    from: Id,
) {
    let strength = known.grid.mean(&board.values(speed));
    let middle = quantile(&strength, 0.5);
    let mut is_told = false;
    if let Some(wind) = wind.filter(|wind| wind.norm() > 1.0) {
        let blows = wind.y.atan2(wind.x);
        let reference = vec![blows; known.grid.count];
        let conventions = [
            super::angles::Convention::Reverse,
            super::angles::Convention::Compass,
        ];
        let readings = super::angles::readings(board, &known.grid, from, &reference, &conventions);
        if let Some(best) = readings.first().filter(|best| best.score > 0.6) {
            is_told = true;
            let name = board.name(from);
            let is_from = best.convention == super::angles::Convention::Reverse;
            let factor = Dimension::Angle.factor(Some(best.unit)).unwrap_or(1.0);
            let role = board.column(from).role;
            let half = super::angles::tidy(std::f64::consts::PI / factor);
            board.assign(from, role, 1.0, if is_from { 0.0 } else { half });
            board.found(
                from,
                best.unit,
                if is_from {
                    "the wind comes from there"
                } else {
                    "the wind blows there"
                },
            );
            board.tell(
                from.0,
                format!(
                    "{name}: {}, as airspeed and track say",
                    if is_from {
                        "where the wind comes from"
                    } else {
                        "where the wind blows to"
                    }
                ),
            );
        }
        amount(board, &[speed], wind.norm(), middle);
    }
    if !is_told {
        ask(board, &[from], true);
    }
    as_beside(board, &[speed]);
    let middle = quantile(&board.values(speed).values, 0.5);
    if middle > STRONGEST {
        let name = board.name(speed);
        for id in [speed, from] {
            board.drop(id, "nothing flies in such a wind");
        }
        board.tell(
            speed.0,
            format!(
                "{name}: a wind of {middle:.0} m/s is none that anything flies in; it is not used"
            ),
        );
    }
}

/// Takes for a wind whose unit nothing else tells the unit of the speeds beside it.
fn as_beside(board: &mut FlightColumns, ids: &[Id]) {
    let unit = unit_beside(board, ids[0]);
    for id in ids {
        if let Some(unit) = unit
            .as_ref()
            .filter(|_| board.basis(*id) == UnitBasis::Assumed)
        {
            board.found(
                *id,
                unit,
                &format!("in {unit}, as the speeds beside it are"),
            );
        }
    }
}

/// The unit of a speed in the same table that is sure.
fn unit_beside(board: &FlightColumns, id: Id) -> Option<String> {
    let roles = [
        ColumnRole::Channel(ChannelName::Airspeed),
        ColumnRole::SpeedOverGround,
        ColumnRole::Channel(ChannelName::GpsVelocityNorth),
    ];
    let mut others = roles
        .into_iter()
        .filter_map(|role| board.find_in(id.0, role));
    let beside = others.find(|other| board.basis(*other) == UnitBasis::Found);
    beside.map(|other| board.column(other).unit.clone())
}

/// The unit of a wind's strength: that of the fit within a factor of two, that of other speeds beside it before others.
fn amount(board: &mut FlightColumns, ids: &[Id], wind: f64, middle: f64) {
    let id = ids[0];
    if board.basis(id) == UnitBasis::Stated || middle.is_nan() || middle <= 0.5 {
        return;
    }
    let present = board
        .column(id)
        .role
        .factor(&board.column(id).unit)
        .unwrap_or(1.0);
    let beside = unit_beside(board, id);
    let off = |unit: &str| {
        let factor = Dimension::Speed.factor(Some(unit)).unwrap_or(1.0);
        (wind * present / (middle * factor)).ln().abs()
    };
    let names = board.names(ids);
    let known = beside
        .into_iter()
        .chain(["m/s", "kt", "km/h", "cm/s"].map(str::to_owned));
    if let Some(unit) = known.into_iter().find(|unit| off(unit) < 0.33) {
        if unit != "m/s" {
            board.tell(
                id.0,
                format!("{names}: read in {unit}, as airspeed and track say"),
            );
        }
        for id in ids {
            board.found(*id, &unit, "so it agrees with airspeed and track");
        }
    }
}

fn components(board: &mut FlightColumns, wind: Option<Vector2<f64>>, north: Id, east: Id) {
    let ids = [north, east];
    let names = board.names(&ids);
    let middle = ids.map(|id| quantile(&board.values(id).values, 0.5));
    let told = Vector2::new(middle[0], middle[1]);
    let mut is_told = told.norm() == 0.0;
    if let Some(wind) = wind.filter(|wind| wind.norm() > 1.0 && told.norm() > 0.0) {
        // North first or east first, blowing to or coming from.
        let is_axis = board.is_axis(north);
        let ways: &[(bool, f64)] = if is_axis {
            &[(false, 1.0), (false, -1.0), (true, 1.0), (true, -1.0)]
        } else {
            &[(false, 1.0), (false, -1.0)]
        };
        let read = |(is_swapped, sign): (bool, f64)| {
            let (n, e) = if is_swapped {
                (told.y, told.x)
            } else {
                (told.x, told.y)
            };
            Vector2::new(n, e) * sign
        };
        let agreement = |way: &(bool, f64)| read(*way).dot(&wind) / (told.norm() * wind.norm());
        let best = ways
            .iter()
            .copied()
            .max_by(|a, b| agreement(a).total_cmp(&agreement(b)));
        if let Some(way) = best.filter(|way| agreement(way) > 0.5) {
            is_told = true;
            let names_of = [ChannelName::WindNorth, ChannelName::WindEast];
            for (index, id) in ids.into_iter().enumerate() {
                let name = names_of[if way.0 { 1 - index } else { index }];
                board.assign(id, ColumnRole::Channel(name), way.1, 0.0);
            }
            if way.1 < 0.0 {
                board.tell(north.0, format!("{names}: where the wind comes from, as airspeed and track say; turned around"));
            }
            if way.0 {
                board.tell(
                    north.0,
                    format!("{names}: east first, as airspeed and track say"),
                );
            }
            amount(board, &ids, wind.norm(), told.norm());
        }
    }
    if !is_told {
        ask(board, &ids, false);
    }
    as_beside(board, &ids);
    let told = Vector2::new(
        quantile(&board.values(north).values, 0.5),
        quantile(&board.values(east).values, 0.5),
    );
    if told.norm() > STRONGEST {
        for id in ids {
            board.drop(id, "nothing flies in such a wind");
        }
        board.tell(
            north.0,
            format!(
                "{names}: a wind of {:.0} m/s is none that anything flies in; it is not used",
                told.norm()
            ),
        );
    }
}
