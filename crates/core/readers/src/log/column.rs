//! Topics made of columns: what tables and photos tell, row by row.

use super::{FieldKind, FieldLayout, Log, TopicName};

/// Longest text of a cell that is kept, bytes.
const LONGEST: usize = 255;

/// Cells of a column, row by row.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Numbers; NaN where there is none.
    Numbers(Vec<f64>),
    /// Texts; empty where there is none.
    Texts(Vec<String>),
}

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name as the table has it.
    pub name: String,
    /// Unit of its numbers as they stand there, or empty.
    pub unit: String,
    /// Its cells.
    pub cells: Cells,
}

impl Column {
    /// Layout of the column's field in a row, from byte `offset` on.
    fn layout(&self, offset: usize) -> FieldLayout {
        let kind = match &self.cells {
            Cells::Numbers(_) => FieldKind::F64,
            Cells::Texts(texts) => {
                let longest = texts.iter().map(String::len).max().unwrap_or(0);
                FieldKind::Text(longest.clamp(1, LONGEST) as u16)
            }
        };
        FieldLayout {
            unit: self.unit.clone(),
            ..FieldLayout::plain(&self.name, kind, offset)
        }
    }

    /// Appends the cell of a row as `size` bytes.
    fn append(&self, index: usize, size: usize, row: &mut Vec<u8>) {
        match &self.cells {
            Cells::Numbers(numbers) => {
                let number = numbers.get(index).copied().unwrap_or(f64::NAN);
                row.extend_from_slice(&number.to_le_bytes());
            }
            Cells::Texts(texts) => {
                let end = row.len() + size;
                let text = texts.get(index).map_or("", String::as_str);
                row.extend_from_slice(&text.as_bytes()[..text.floor_char_boundary(size)]);
                row.resize(end, 0);
            }
        }
    }
}

impl Log {
    /// Adds the rows of a table as a topic called `name`, which has to be new. `times` are those of its rows, seconds
    /// in the log's time base; rows without one are left out.
    pub fn add_columns(&mut self, name: &str, times: &[Option<f64>], columns: &[Column]) {
        let mut layouts: Vec<FieldLayout> = Vec::with_capacity(columns.len());
        for column in columns {
            let offset = layouts.last().map_or(0, |l| l.offset + l.kind.size());
            layouts.push(column.layout(offset));
        }
        let sizes: Vec<usize> = layouts.iter().map(|layout| layout.kind.size()).collect();
        let place = self.topic_or_new(&TopicName::single(name), || layouts);
        let mut row = Vec::new();
        for (index, time) in times.iter().enumerate() {
            let Some(time) = time else { continue };
            row.clear();
            for (column, size) in columns.iter().zip(&sizes) {
                column.append(index, *size, &mut row);
            }
            self.topics[place].push(*time, &row);
            self.report.messages += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::LogFormat;
    use super::*;

    #[test]
    fn numbers_and_texts_come_back_beside_the_times_of_their_rows() {
        let numbers = Column {
            name: "Alt".to_owned(),
            unit: "m".to_owned(),
            cells: Cells::Numbers(vec![1.5, f64::NAN, 1e-300]),
        };
        let texts = ["a.jpg", "", "übung.jpg"].map(str::to_owned).to_vec();
        let texts = Column {
            name: "file".to_owned(),
            unit: String::new(),
            cells: Cells::Texts(texts),
        };
        let mut log = Log::new("flight", LogFormat::Tables);
        let times = [Some(0.25), None, Some(3.0)];
        log.add_columns("frames", &times, &[numbers, texts]);
        let topic = log.first("frames").unwrap();
        assert_eq!(topic.times, [0.25, 3.0]);
        assert_eq!(topic.values("Alt"), Some(vec![1.5, 1e-300]));
        assert_eq!(topic.field("Alt").map(|f| f.unit.as_str()), Some("m"));
        assert_eq!(topic.texts("file").unwrap(), ["a.jpg", "übung.jpg"]);
        assert_eq!(log.report.messages, 2);
    }

    #[test]
    fn a_long_text_is_cut_between_letters() {
        let text = "é".repeat(200);
        let column = Column {
            name: "remark".to_owned(),
            unit: String::new(),
            cells: Cells::Texts(vec![text.clone()]),
        };
        let mut log = Log::new("flight", LogFormat::Tables);
        log.add_columns("t", &[Some(0.0)], &[column]);
        let kept = log.first("t").unwrap().texts("remark").unwrap().remove(0);
        assert_eq!(kept.len(), 254);
        assert!(text.starts_with(&kept));
    }
}
