//! Variables of a MATLAB file.

use super::element::{ARRAY, MatElement, elements, inside};

/// Depth to which structures and cells are looked into.
const DEEPEST: usize = 8;
/// Class of tables, dates and other objects, which MATLAB stores in ways of its own.
const OBJECT: u32 = 17;

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

/// The variables of a file by their names.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MatVariables {
    pub all: Vec<(String, MatValue)>,
    /// Names of those that were left out, as they are too large once they are unpacked.
    pub too_large: Vec<String>,
    /// Whether the file is cut off or damaged behind them.
    pub is_damaged: bool,
}

/// The variables of a file of version 5 to 7, without those of `most` bytes or more once they are unpacked; `None` if it is
/// no such file.
pub fn variables(bytes: &[u8], most: u64) -> Option<MatVariables> {
    let elements = elements(bytes, most)?;
    let matrices = (elements.all.iter()).filter(|element| element.kind == ARRAY);
    let name = |element: &MatElement<'_>| {
        let parts = inside(element);
        parts
            .get(2)
            .map_or_else(|| "a variable".to_owned(), MatElement::text)
    };
    Some(MatVariables {
        all: matrices.filter_map(|element| array(element, 0)).collect(),
        too_large: elements.too_large.iter().map(name).collect(),
        is_damaged: elements.is_damaged,
    })
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
    if class == OBJECT {
        return Some((dimensions.text(), MatValue::Other));
    }
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
            let cells = rest.iter().filter(|part| part.kind == ARRAY);
            let cell = |part| array(part, depth + 1).map_or(MatValue::Other, |(_, value)| value);
            MatValue::Cells(cells.map(cell).collect())
        }
        2 => fields(rest, depth, rows.checked_mul(columns)?).unwrap_or(MatValue::Other),
        4 => text_of(rest.first()?.text().chars().collect(), rows),
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

/// The text of letters that are stored column by column; of several rows a cell for each.
pub fn text_of(letters: Vec<char>, rows: usize) -> MatValue {
    let row = |row: usize| MatValue::Text(letters.iter().skip(row).step_by(rows).collect());
    if rows > 1 && rows <= letters.len() {
        return MatValue::Cells((0..rows).map(row).collect());
    }
    MatValue::Text(letters.into_iter().collect())
}

/// The fields of `count` structures. Of several, numbers one a structure are a column, and all else stands in a structure
/// for each, by its label or its number.
fn fields(parts: &[MatElement<'_>], depth: usize, count: usize) -> Option<MatValue> {
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
    if names.is_empty() || Some(values.len()) != names.len().checked_mul(count) {
        return None;
    }
    let value = |part| array(part, depth + 1).map_or(MatValue::Other, |(_, value)| value);
    let mut each: Vec<Vec<(String, MatValue)>> = (values.chunks_exact(names.len()))
        .map(|values| {
            names
                .iter()
                .cloned()
                .zip(values.iter().map(value))
                .collect()
        })
        .collect();
    if count == 1 {
        return each.pop().map(MatValue::Fields);
    }
    let mut found = Vec::new();
    for (place, name) in names.iter().enumerate() {
        let single = |fields: &Vec<(String, MatValue)>| match &fields[place].1 {
            MatValue::Numbers { values, .. } if values.len() == 1 => Some(values[0]),
            _ => None,
        };
        if let Some(values) = each.iter().map(single).collect::<Option<Vec<f64>>>() {
            found.push((
                name.clone(),
                MatValue::Numbers {
                    rows: count,
                    columns: 1,
                    values,
                },
            ));
        }
    }
    for (number, fields) in each.into_iter().enumerate() {
        let label = fields.iter().find_map(|(name, value)| match value {
            MatValue::Text(text) if name == "label" || name == "name" => {
                Some(text.trim().to_owned())
            }
            _ => None,
        });
        let label = label.filter(|label| !label.is_empty());
        let label = label.unwrap_or_else(|| (number + 1).to_string());
        let is_given = |label: &str| found.iter().any(|(given, _)| given == label);
        let mut own = label.clone();
        let mut next = 2;
        while is_given(&own) {
            own = format!("{label}_{next}");
            next += 1;
        }
        found.push((own, MatValue::Fields(fields)));
    }
    Some(MatValue::Fields(found))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An element with its tag, filled up to eight bytes.
    fn element(kind: u32, data: &[u8]) -> Vec<u8> {
        let mut bytes = [kind.to_le_bytes(), (data.len() as u32).to_le_bytes()].concat();
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    }

    fn letters(text: &str) -> Vec<u8> {
        let rows = [1_i32.to_le_bytes(), (text.len() as i32).to_le_bytes()].concat();
        let parts = [
            element(6, &[4, 0, 0, 0, 0, 0, 0, 0]),
            element(5, &rows),
            element(1, &[]),
            element(16, text.as_bytes()),
        ];
        element(ARRAY, &parts.concat())
    }

    #[test]
    fn structures_of_an_array_with_the_same_label_keep_names_of_their_own() {
        let mut parts = element(5, &8_i32.to_le_bytes());
        parts.extend(element(1, b"label\0\0\0"));
        let labels = ["GPS", "IMU", "GPS", "GPS_2", "GPS"];
        parts.extend(labels.iter().flat_map(|label| letters(label)));
        let array = MatElement {
            kind: ARRAY,
            data: parts.into(),
            is_big: false,
        };
        let Some(MatValue::Fields(found)) = fields(&inside(&array), 0, labels.len()) else {
            panic!("no structures");
        };
        let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["GPS", "IMU", "GPS_2", "GPS_2_2", "GPS_3"]);
    }
}
