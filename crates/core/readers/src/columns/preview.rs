//! The beginning of a table, as people are shown it.

use serde::{Deserialize, Serialize};

use super::ColumnMap;
use crate::folder::decoded_table;

/// Bytes of the beginning that are looked at.
const HEAD: usize = 1 << 18;

/// The first rows of a table, read as a map says.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TablePreview {
    /// Cells of the first rows, as many as there are columns in the map; empty where a row is short.
    pub rows: Vec<Vec<String>>,
    /// Smallest and largest value of each column among them, in the unit of the map; `None` without numbers.
    pub ranges: Vec<Option<(f64, f64)>>,
    /// Lines before the first row, as they stand in the file.
    pub before: Vec<String>,
}

/// The first `count` rows of a table as `map` reads them: after the map's shape was changed, it shows what that does.
pub fn preview(bytes: &[u8], map: &ColumnMap, count: usize) -> TablePreview {
    let decoded = decoded_table(&bytes[..bytes.len().min(HEAD)]);
    let text = String::from_utf8_lossy(&decoded);
    let shape = &map.shape;
    let mut lines = text.lines();
    let before: Vec<String> = lines
        .by_ref()
        .take(shape.skipped_lines + shape.head_lines())
        .map(str::to_owned)
        .collect();
    let rows: Vec<Vec<String>> = lines
        .filter(|line| !line.trim().is_empty() && !line.starts_with('#'))
        .take(count)
        .map(|line| {
            let mut cells: Vec<String> = shape
                .separator
                .cells(line)
                .into_iter()
                .map(std::borrow::Cow::into_owned)
                .collect();
            cells.resize(map.columns.len(), String::new());
            cells
        })
        .collect();
    let ranges = map.columns.iter().enumerate().map(|(index, column)| {
        let cells = rows.iter().filter_map(|row| shape.number(row.get(index)?));
        let values = cells.map(|cell| cell * column.scale + column.offset);
        values.fold(None, |range: Option<(f64, f64)>, value| {
            let (low, high) = range.unwrap_or((value, value));
            Some((low.min(value), high.max(value)))
        })
    });
    TablePreview {
        ranges: ranges.collect(),
        rows,
        before,
    }
}
