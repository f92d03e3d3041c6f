//! Variables of a MATLAB file.

use super::element::{MatElement, elements, inside};

/// Depth to which structures and cells are looked into.
const DEEPEST: usize = 8;
/// Type of an element that is an array.
const MATRIX: u32 = 14;

/// Value of a variable.
#[derive(Clone, Debug, PartialEq)]
pub enum MatValue {
    /// Numbers, column by column, and how many rows and columns there are.
    Numbers {
        rows: usize,
        columns: usize,
        values: Vec<f64>,
    },
    /// Letters.
    Text(String),
    /// Cells.
    Cells(Vec<MatValue>),
    /// Fields of one structure.
    Fields(Vec<(String, MatValue)>),
    /// Something else.
    Other,
}

/// The variables of a file by their names; `None` if it is no such file.
pub fn variables(bytes: &[u8]) -> Option<Vec<(String, MatValue)>> {
    let elements = elements(bytes)?;
    let matrices = elements.iter().filter(|element| element.kind == MATRIX);
    Some(matrices.filter_map(|element| array(element, 0)).collect())
}

/// The array that an element is, with its name.
fn array(element: &MatElement<'_>, depth: usize) -> Option<(String, MatValue)> {
    if depth > DEEPEST {
        return None;
    }
    let parts = inside(element);
    let [flags, dimensions, name, rest @ ..] = parts.as_slice() else {
        return None;
    };
    let class = flags.numbers()?.first().copied()? as u32 & 0xff;
    let dimensions: Vec<usize> = dimensions
        .numbers()?
        .iter()
        .map(|size| *size as usize)
        .collect();
    let rows = *dimensions.first()?;
    let columns = dimensions[1..]
        .iter()
        .try_fold(1_usize, |all, size| all.checked_mul(*size))?;
    let value = match class {
        1 => {
            let cells = rest.iter().filter(|part| part.kind == MATRIX);
            let cell = |part| array(part, depth + 1).map_or(MatValue::Other, |(_, value)| value);
            MatValue::Cells(cells.map(cell).collect())
        }
        2 => fields(rest, depth).unwrap_or(MatValue::Other),
        4 => MatValue::Text(letters(rest.first()?, rows)),
        6..=15 => {
            let values = rest.first()?.numbers()?;
            if rows.checked_mul(columns)? == values.len() {
                MatValue::Numbers {
                    rows,
                    columns,
                    values,
                }
            } else {
                MatValue::Other
            }
        }
        _ => MatValue::Other,
    };
    Some((name.text(), value))
}

/// The text of letters that are stored column by column, of one row.
fn letters(element: &MatElement<'_>, rows: usize) -> String {
    let text = element.text();
    if rows > 1 {
        let every = text.chars().step_by(rows);
        return every.collect();
    }
    text
}

/// The fields of a structure; `None` of several structures.
fn fields(parts: &[MatElement<'_>], depth: usize) -> Option<MatValue> {
    let [length, names, values @ ..] = parts else {
        return None;
    };
    let length = *length.numbers()?.first()? as usize;
    let names = names.data.chunks_exact(length.max(1)).map(|name| {
        let end = name
            .iter()
            .position(|byte| *byte == 0)
            .unwrap_or(name.len());
        String::from_utf8_lossy(&name[..end]).into_owned()
    });
    let names: Vec<String> = names.collect();
    if values.len() != names.len() {
        return None;
    }
    let value = |part| array(part, depth + 1).map_or(MatValue::Other, |(_, value)| value);
    let values = values.iter().map(value);
    Some(MatValue::Fields(names.into_iter().zip(values).collect()))
}
