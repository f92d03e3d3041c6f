//! Tables out of the variables of a MATLAB file.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::value::MatValue;
use pilotage_base::text::in_quotes;

/// Endings of the variable that has the names of a matrix' columns, behind the name of the matrix.
const LABELS: [&str; 6] = [
    "_label", "_labels", "_names", "_columns", "_header", "_fields",
];
/// Rows below which numbers are no table.
const LEAST: usize = 3;

/// Columns of one length with their names.
type NamedColumns = Vec<(String, Vec<f64>)>;

/// Tables as text, by the names of files that they stand for: `stem/variable.csv`.
///
/// A matrix whose columns another variable names (`GPS` by `GPS_label`, as Mission Planner writes them) is a table, and
/// so is a structure whose fields are columns. Vectors of one length are a table together, matrices of as many rows
/// without names join them.
pub fn of(stem: &str, variables: &[(String, MatValue)]) -> BTreeMap<String, Vec<u8>> {
    let mut found: BTreeMap<String, NamedColumns> = BTreeMap::new();
    let mut loose: NamedColumns = Vec::new();
    for (name, value) in variables {
        match value {
            MatValue::Numbers { .. } => match labels(name, variables) {
                Some(labels) => {
                    let columns = named(value, &labels);
                    found.entry(name.clone()).or_default().extend(columns);
                }
                None => loose.extend(columns(name, value)),
            },
            MatValue::Fields(fields) => {
                let mut columns = Vec::new();
                flatten(name, "", fields, &mut columns, &mut found);
                by_length(name, columns, &mut found);
            }
            _ => {}
        }
    }
    by_length("variables", loose, &mut found);
    let tables = found.into_iter().filter(|(_, columns)| columns.len() > 1);
    let file =
        |(name, columns): (String, NamedColumns)| (format!("{stem}/{name}.csv"), text(&columns));
    tables.map(file).collect()
}

/// The names of a matrix' columns that another variable has.
fn labels(name: &str, variables: &[(String, MatValue)]) -> Option<Vec<String>> {
    let is_label = |other: &str| {
        let ending = other.strip_prefix(name);
        ending.is_some_and(|ending| LABELS.iter().any(|l| ending.eq_ignore_ascii_case(l)))
    };
    let (_, value) = variables.iter().find(|(other, _)| is_label(other))?;
    let MatValue::Cells(cells) = value else {
        return None;
    };
    let text = |cell: &MatValue| match cell {
        MatValue::Text(text) => text.trim().to_owned(),
        _ => String::new(),
    };
    Some(cells.iter().map(text).collect())
}

/// A matrix, column after column.
struct MatMatrix<'a> {
    rows: usize,
    columns: usize,
    values: &'a [f64],
}

impl<'a> MatMatrix<'a> {
    fn of(value: &'a MatValue) -> Option<Self> {
        match value {
            MatValue::Numbers {
                rows,
                columns,
                values,
            } => Some(Self {
                rows: *rows,
                columns: *columns,
                values,
            }),
            _ => None,
        }
    }

    fn column(&self, index: usize) -> Vec<f64> {
        self.values[index * self.rows..(index + 1) * self.rows].to_vec()
    }

    fn row(&self, index: usize) -> Vec<f64> {
        let values = self.values.iter().skip(index).step_by(self.rows);
        values.copied().collect()
    }
}

/// The columns of a matrix by these names; of one that is turned its rows.
fn named(value: &MatValue, labels: &[String]) -> NamedColumns {
    let Some(matrix) = MatMatrix::of(value) else {
        return Vec::new();
    };
    let MatMatrix { rows, columns, .. } = matrix;
    let cut = |index: usize| -> Vec<f64> {
        if columns == labels.len() {
            matrix.column(index)
        } else {
            matrix.row(index)
        }
    };
    if columns != labels.len() && rows != labels.len() {
        return self::columns("", value);
    }
    labels
        .iter()
        .enumerate()
        .map(|(index, label)| (label.clone(), cut(index)))
        .collect()
}

/// The columns of numbers: one of a vector, `name_1` and so on of a matrix, the longer side of which are its rows.
fn columns(name: &str, value: &MatValue) -> NamedColumns {
    let Some(matrix) = MatMatrix::of(value) else {
        return Vec::new();
    };
    let MatMatrix { rows, columns, .. } = matrix;
    let (length, count) = (rows.max(columns), rows.min(columns));
    if length < LEAST || count == 0 || count > 64 {
        return Vec::new();
    }
    let cut = |index: usize| -> Vec<f64> {
        if rows >= columns {
            matrix.column(index)
        } else {
            matrix.row(index)
        }
    };
    let called = |index: usize| {
        if count == 1 {
            name.to_owned()
        } else {
            format!("{name}_{}", index + 1)
        }
    };
    (0..count)
        .map(|index| (called(index), cut(index)))
        .collect()
}

/// The columns that the fields of the structure `table` are, and those of structures in it; structures that have times of
/// their own are tables of their own.
fn flatten(
    table: &str,
    prefix: &str,
    fields: &[(String, MatValue)],
    columns: &mut NamedColumns,
    found: &mut BTreeMap<String, NamedColumns>,
) {
    for (name, value) in fields {
        let full = match name.as_str() {
            _ if prefix.is_empty() => name.clone(),
            // What Simulink and time series call the values of a signal that has a name.
            "values" | "Values" | "data" | "Data" => prefix.to_owned(),
            _ => format!("{prefix}.{name}"),
        };
        match value {
            MatValue::Numbers { .. } => match labels(name.as_str(), fields) {
                Some(labels) => columns.extend(named(value, &labels)),
                None => columns.extend(self::columns(&full, value)),
            },
            MatValue::Fields(inner) if inner.iter().any(is_time) => {
                let table = format!("{table}.{name}");
                let mut own = Vec::new();
                flatten(&table, "", inner, &mut own, found);
                by_length(&table, own, found);
            }
            MatValue::Fields(inner) => flatten(table, &full, inner, columns, found),
            _ => {}
        }
    }
}

/// Whether a field is a column of times by its name.
fn is_time((name, value): &(String, MatValue)) -> bool {
    let name = name.to_ascii_lowercase();
    let is_column = matches!(value, MatValue::Numbers { values, .. } if values.len() >= LEAST);
    is_column && (name == "t" || name.starts_with("time"))
}

/// Puts columns of each length into a table of their own, called `name`, or `name_2` and so on.
fn by_length(name: &str, columns: NamedColumns, found: &mut BTreeMap<String, NamedColumns>) {
    let mut lengths: Vec<usize> = Vec::new();
    for (column, values) in columns {
        if values.len() < LEAST {
            continue;
        }
        let known = lengths.iter().position(|length| *length == values.len());
        let number = known.unwrap_or_else(|| {
            lengths.push(values.len());
            lengths.len() - 1
        });
        let table = match number {
            0 => name.to_owned(),
            number => format!("{name}_{}", number + 1),
        };
        found.entry(table).or_default().push((column, values));
    }
}

/// The columns as a table separated by commas.
fn text(columns: &NamedColumns) -> Vec<u8> {
    let mut text = String::new();
    for (index, (name, _)) in columns.iter().enumerate() {
        let comma = if index > 0 { "," } else { "" };
        let _ = write!(text, "{comma}{}", in_quotes(name));
    }
    text.push('\n');
    let rows = columns
        .iter()
        .map(|(_, values)| values.len())
        .max()
        .unwrap_or(0);
    for row in 0..rows {
        for (index, (_, values)) in columns.iter().enumerate() {
            if index > 0 {
                text.push(',');
            }
            if let Some(value) = values.get(row).filter(|value| value.is_finite()) {
                let _ = write!(text, "{value}");
            }
        }
        text.push('\n');
    }
    text.into_bytes()
}
