//! The columns of a flight's tables, by what they mean.

use super::evidence::TableEvidence;
use super::grid::{TimeCells, TimedNumbers, quantile};
use crate::cells::{Dimension, linear};
use crate::columns::settle::give_up;
use crate::columns::{ColumnMap, ColumnRole, MappedColumn};
use crate::times::{TimeVerdict, judge};

/// Fewer numbers do not tell which of them are damaged.
const ENOUGH: usize = 50;

/// A column: which table, which of its columns.
pub(super) type Id = (usize, usize);

/// Basis of the unit of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnitBasis {
    /// The table states it.
    Stated,
    /// Physics says it.
    Found,
    /// Nothing says anything else.
    Assumed,
}

/// The columns of a flight's tables.
pub(super) struct FlightColumns<'a, 'b> {
    pub maps: &'a mut [&'b mut ColumnMap],
    pub evidence: &'a [TableEvidence],
    times: Vec<Vec<f64>>,
    /// Least and greatest number of each column that is believed.
    bounds: Vec<Vec<(f64, f64)>>,
    bases: Vec<Vec<UnitBasis>>,
}

impl<'a, 'b> FlightColumns<'a, 'b> {
    /// Those of tables with these maps.
    pub fn new(maps: &'a mut [&'b mut ColumnMap], evidence: &'a [TableEvidence]) -> Self {
        let pairs = || maps.iter().zip(evidence);
        let times = pairs()
            .map(|(map, known)| sound_times(known, map))
            .collect();
        let basis = |is_stated| {
            if is_stated {
                UnitBasis::Stated
            } else {
                UnitBasis::Assumed
            }
        };
        let of_table =
            |known: &TableEvidence| known.hints.iter().map(|h| basis(h.is_stated)).collect();
        let of_columns =
            |known: &TableEvidence| known.rows.columns.iter().map(|c| bounds(c)).collect();
        Self {
            times,
            bounds: evidence.iter().map(of_columns).collect(),
            bases: evidence.iter().map(of_table).collect(),
            maps,
            evidence,
        }
    }

    /// The grid over all tables that have times.
    pub fn grid(&self) -> Option<TimeCells> {
        let with_times = |times: &&Vec<f64>| times.iter().filter(|t| t.is_finite()).count() > 8;
        let used = self.times.iter().enumerate().filter(|(index, times)| {
            let is_used =
                |c: &MappedColumn| !matches!(c.role, ColumnRole::Nothing | ColumnRole::Time);
            let map = &self.maps[*index];
            // Of columns without names nobody knows yet.
            with_times(times) && (map.columns.iter().any(is_used) || !map.shape.has_header)
        });
        let spans = used.map(|(_, times)| {
            // A time that leaps is none.
            let inner = (quantile(times, 0.01), quantile(times, 0.99));
            let margin = 0.02 * (inner.1 - inner.0);
            (
                quantile(times, 0.0).max(inner.0 - margin),
                quantile(times, 1.0).min(inner.1 + margin),
                quantile(&steps(times), 0.5),
            )
        });
        let whole = spans.fold(None, |whole: Option<(f64, f64, f64)>, (a, b, step)| {
            let (start, end, least) = whole.unwrap_or((a, b, step));
            Some((start.min(a), end.max(b), least.min(step)))
        });
        let (start, end, step) = whole?;
        TimeCells::new(start, end, 3.0 * step)
    }

    /// The first column of that role in a table with times.
    pub fn find(&self, role: ColumnRole) -> Option<Id> {
        (0..self.maps.len()).find_map(|table| self.find_in(table, role))
    }

    /// The column of that role in a table.
    pub fn find_in(&self, table: usize, role: ColumnRole) -> Option<Id> {
        if self.times[table].is_empty() {
            return None;
        }
        let mut columns = self.maps[table].columns.iter();
        columns
            .position(|column| column.role == role)
            .map(|column| (table, column))
    }

    pub fn column(&self, id: Id) -> &MappedColumn {
        &self.maps[id.0].columns[id.1]
    }

    fn column_mut(&mut self, id: Id) -> &mut MappedColumn {
        &mut self.maps[id.0].columns[id.1]
    }

    pub fn name(&self, id: Id) -> String {
        self.column(id).name.clone()
    }

    /// The names of several columns, as people write them.
    pub fn names(&self, ids: &[Id]) -> String {
        let names: Vec<String> = ids.iter().map(|id| self.name(*id)).collect();
        names.join(", ")
    }

    pub fn basis(&self, id: Id) -> UnitBasis {
        self.bases[id.0][id.1]
    }

    pub fn is_axis(&self, id: Id) -> bool {
        self.evidence[id.0].hints[id.1].is_axis
    }

    /// The numbers of a column as they stand in its cells, of degrees and minutes the degrees.
    pub fn raw(&self, id: Id) -> TimedNumbers {
        let values = &self.evidence[id.0].rows.columns;
        let values = values.get(id.1).map_or(&[][..], Vec::as_slice);
        let unit = &self.column(id).unit;
        let bounds = self.bounds[id.0].get(id.1).copied();
        let (least, greatest) = bounds.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let is_believed = |value: f64| (least..=greatest).contains(&value);
        let believed = |value: &f64| {
            if is_believed(*value) {
                *value
            } else {
                f64::NAN
            }
        };
        let numbers = values.iter().map(|value| linear(unit, believed(value)));
        TimedNumbers::new(&self.times[id.0], numbers)
    }

    /// The places in a column of two numbers a cell, latitude and longitude as they stand there.
    pub fn places(&self, id: Id) -> [TimedNumbers; 2] {
        let known = self.evidence[id.0].rows.places.get(&id.1);
        [0, 1].map(|part| {
            let values = known.map_or(&[][..], |both| both[part].as_slice());
            TimedNumbers::new(&self.times[id.0], values.iter().copied())
        })
    }

    /// The values of a column as its map reads them, SI and radians.
    pub fn values(&self, id: Id) -> TimedNumbers {
        let column = self.column(id);
        let factor = column.role.factor(&column.unit).unwrap_or(1.0);
        let (scale, offset) = (column.scale, column.offset);
        self.raw(id).map(|value| (value * scale + offset) * factor)
    }

    /// Physical dimension of the column's role; `None` where the role has no quantity.
    pub fn dimension(&self, id: Id) -> Option<Dimension> {
        self.column(id).role.quantity().map(Dimension::of)
    }

    /// Takes a column's unit as found, and says why.
    pub fn found(&mut self, id: Id, unit: &str, why: &str) {
        self.bases[id.0][id.1] = UnitBasis::Found;
        let column = self.column_mut(id);
        unit.clone_into(&mut column.unit);
        column.confidence = column.confidence.max(0.9);
        column.reason = format!("it is called {}; {why}", column.name);
    }

    /// Takes the unit that a column has as confirmed.
    pub fn confirm(&mut self, id: Id) {
        let basis = &mut self.bases[id.0][id.1];
        if *basis == UnitBasis::Assumed {
            *basis = UnitBasis::Found;
        }
    }

    /// Has a column mean something else, read with that sign and offset (in its unit).
    pub fn assign(&mut self, id: Id, role: ColumnRole, scale: f64, offset: f64) {
        let column = self.column_mut(id);
        column.role = role;
        column.scale = scale;
        column.offset = offset;
    }

    /// Gives a column a role that its name did not say.
    pub fn take(&mut self, id: Id, role: ColumnRole, unit: &str, reason: &str) {
        let column = self.column_mut(id);
        column.role = role;
        unit.clone_into(&mut column.unit);
        column.confidence = 0.7;
        reason.clone_into(&mut column.reason);
    }

    /// Takes its meaning from a column.
    pub fn drop(&mut self, id: Id, reason: &str) {
        give_up(self.column_mut(id), reason.to_owned());
    }

    /// Notes what was found out in a table, as a sentence.
    pub fn tell(&mut self, table: usize, sentence: String) {
        let findings = &mut self.maps[table].findings;
        if !findings.contains(&sentence) {
            findings.push(sentence);
        }
    }

    /// Counts the time of a table in another unit.
    pub fn set_time_unit(&mut self, table: usize, unit: &str) {
        let is_time = |column: &&mut MappedColumn| column.role == ColumnRole::Time;
        if let Some(column) = self.maps[table].columns.iter_mut().find(is_time) {
            unit.clone_into(&mut column.unit);
        }
        self.times[table] = sound_times(&self.evidence[table], self.maps[table]);
    }
}

/// The numbers of a column that may be measured: within ten times the span of most of them. One damaged cell says nothing
/// of the units of the rest.
fn bounds(values: &[f64]) -> (f64, f64) {
    let [least, greatest] = [0.02, 0.98].map(|share| quantile(values, share));
    let beyond = 10.0 * (greatest - least);
    if values.len() >= ENOUGH && beyond > 0.0 {
        (least - beyond, greatest + beyond)
    } else {
        (f64::NEG_INFINITY, f64::INFINITY)
    }
}

/// Times of the rows of a table, seconds, without the few that lie far from those around them: one damaged time says nothing
/// of the units of the rest.
fn sound_times(evidence: &TableEvidence, map: &ColumnMap) -> Vec<f64> {
    let mut times = evidence.rows.times(map);
    let verdicts = judge(&times).unwrap_or_default();
    let is_wrong = |verdict: &TimeVerdict| *verdict == TimeVerdict::Wrong;
    if 10 * verdicts.iter().copied().filter(is_wrong).count() <= times.len() {
        let wrong = times.iter_mut().zip(&verdicts).filter(|(_, v)| is_wrong(v));
        wrong.for_each(|(time, _)| *time = f64::NAN);
    }
    times
}

fn steps(times: &[f64]) -> Vec<f64> {
    times
        .windows(2)
        .map(|w| w[1] - w[0])
        .filter(|s| *s > 0.0)
        .collect()
}

/// The unit of a dimension whose factor is nearest to this, and how far it is off, as the logarithm of their ratio.
pub(super) fn nearest(dimension: Dimension, factor: f64) -> Option<(&'static str, f64)> {
    let off = |unit: &&'static str| {
        let known = dimension.factor(Some(unit)).unwrap_or(1.0);
        (factor / known).ln()
    };
    let units = dimension.names().into_iter();
    let found = units.map(|unit| (unit, off(&unit)));
    found.min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
}

impl FlightColumns<'_, '_> {
    /// Settles the unit of columns that are `factor` of SI by what they were held against: `what` says that, as in "the
    /// steps of the position". Where no unit is near, they mean nothing, and a sentence says by which factor they
    /// differ. `tolerance` is how far the factor may be off, as a logarithm. Returns whether a unit was found.
    pub fn settle_unit(&mut self, ids: &[Id], factor: f64, tolerance: f64, what: &str) -> bool {
        let Some((first, dimension)) = ids.first().and_then(|id| Some((*id, self.dimension(*id)?)))
        else {
            return false;
        };
        let unit = self.column(first).unit.clone();
        let present = dimension.factor(Some(&unit)).unwrap_or(1.0);
        let names = self.names(ids);
        let is_stated = ids.iter().any(|id| self.basis(*id) == UnitBasis::Stated);
        let near = nearest(dimension, factor);
        if is_stated && (factor / present).ln().abs() < tolerance.max(0.3) {
            for id in ids {
                self.maps[id.0].columns[id.1].unit.clone_from(&unit);
                self.confirm(*id);
            }
            return true;
        }
        if let Some((found, _)) = near.filter(|(_, off)| off.abs() < tolerance) {
            let times = amount(present / factor);
            for id in ids {
                self.found(*id, found, &format!("in {found} it agrees with {what}"));
            }
            if is_stated {
                self.tell(
                    first.0,
                    format!("{names}: the table says {unit}, but {what} differs by a factor of {times}; read in {found}"),
                );
            } else if found != dimension.names()[0] {
                self.tell(first.0, format!("{names}: read in {found}, as {what} says"));
            }
            return true;
        }
        let times = amount(present / factor);
        for id in ids {
            self.drop(*id, &format!("it contradicts {what}"));
        }
        self.tell(
            first.0,
            format!("{names}: {what} and this differ by a factor of {times}, which no unit explains; it is not used"),
        );
        false
    }
}

/// A factor in words: the larger over the smaller.
fn amount(factor: f64) -> String {
    let factor = if factor < 1.0 { 1.0 / factor } else { factor };
    if (factor / 10.0 - 1.0).abs() < 0.15 {
        "ten".to_owned()
    } else if (factor / 100.0 - 1.0).abs() < 0.15 {
        "a hundred".to_owned()
    } else if (factor / 1000.0 - 1.0).abs() < 0.15 {
        "a thousand".to_owned()
    } else if factor < 20.0 {
        format!("{factor:.1}")
    } else {
        format!("{factor:.0}")
    }
}
