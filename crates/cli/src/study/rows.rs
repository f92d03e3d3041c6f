//! Rows of a study as Parquet tables: number of the run, of its draw and of its cell, the settings that vary, what was
//! measured.

use std::io::Write;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::Field;
use parquet::schema::types::Type;
use pilotage_study::{SettingValue, StudyDesign, StudyRow, StudyRun};

/// Rows of a group, so that little memory is needed for any number of them.
const GROUP: usize = 8192;

/// Tables of a study's rows, written group by group.
pub struct RowWriter<'a, W: Write + Send> {
    design: &'a StudyDesign,
    writer: SerializedFileWriter<W>,
    /// Whether each setting is a name.
    is_text: Vec<bool>,
    waiting: Vec<StudyRow>,
}

fn column(name: &str, physical: Physical, is_there: bool) -> Result<Arc<Type>, ParquetError> {
    let logical = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
    let repetition = if is_there {
        Repetition::REQUIRED
    } else {
        Repetition::OPTIONAL
    };
    Type::primitive_type_builder(name, physical)
        .with_repetition(repetition)
        .with_logical_type(logical)
        .build()
        .map(Arc::new)
}

impl<'a, W: Write + Send> RowWriter<'a, W> {
    /// A table of rows of that study.
    pub fn new(design: &'a StudyDesign, to: W) -> Result<Self, String> {
        Self::begin(design, to).map_err(|cause| cause.to_string())
    }

    fn begin(design: &'a StudyDesign, to: W) -> Result<Self, ParquetError> {
        let plan = design.plan();
        let numbers = ["run", "draw", "cell"].map(|name| column(name, Physical::INT64, true));
        let mut columns = Vec::from(numbers);
        let first = design
            .run(0)
            .map_err(|cause| ParquetError::General(cause.to_string()))?;
        let is_text: Vec<bool> = first
            .values
            .iter()
            .map(|value| matches!(value, SettingValue::Text(_)))
            .collect();
        for (name, is_text) in design.setting_names().into_iter().zip(&is_text) {
            let physical = if *is_text {
                Physical::BYTE_ARRAY
            } else {
                Physical::DOUBLE
            };
            columns.push(column(name, physical, true));
        }
        let measures = plan.measure.iter();
        columns.extend(measures.map(|measure| column(measure.name(), Physical::DOUBLE, false)));
        let schema = Type::group_type_builder("run")
            .with_fields(columns.into_iter().collect::<Result<_, _>>()?)
            .build()?;
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .build();
        Ok(Self {
            design,
            writer: SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties))?,
            is_text,
            waiting: Vec::new(),
        })
    }

    /// Writes a row.
    pub fn push(&mut self, row: StudyRow) -> Result<(), String> {
        self.waiting.push(row);
        if self.waiting.len() == GROUP {
            self.write_group()?;
        }
        Ok(())
    }

    /// Ends the table.
    pub fn finish(mut self) -> Result<W, String> {
        self.write_group()?;
        self.writer.into_inner().map_err(|cause| cause.to_string())
    }

    fn write_group(&mut self) -> Result<(), String> {
        let rows = std::mem::take(&mut self.waiting);
        if rows.is_empty() {
            return Ok(());
        }
        let runs = rows.iter().map(|row| self.design.run(row.run));
        let runs: Vec<StudyRun> = runs
            .collect::<Result<_, _>>()
            .map_err(|cause| cause.to_string())?;
        self.write(&runs, &rows).map_err(|cause| cause.to_string())
    }

    fn write(&mut self, runs: &[StudyRun], rows: &[StudyRow]) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        let number = |of: fn(&StudyRun) -> u64| -> Vec<i64> {
            runs.iter().map(|run| of(run).cast_signed()).collect()
        };
        put::<Int64Type>(&mut group, &number(|run| run.number), None)?;
        put::<Int64Type>(&mut group, &number(|run| run.draw), None)?;
        put::<Int64Type>(&mut group, &number(|run| run.cell), None)?;
        for (index, is_text) in self.is_text.iter().enumerate() {
            let values = runs.iter().map(|run| &run.values[index]);
            if *is_text {
                let texts = values.map(|value| ByteArray::from(value.to_string().as_str()));
                put::<ByteArrayType>(&mut group, &texts.collect::<Vec<_>>(), None)?;
            } else {
                let numbers = values.map(|value| match value {
                    SettingValue::Number(number) => *number,
                    SettingValue::Text(_) => f64::NAN,
                });
                put::<DoubleType>(&mut group, &numbers.collect::<Vec<_>>(), None)?;
            }
        }
        for index in 0..self.design.plan().measure.len() {
            let values = rows.iter().map(|row| row.measured[index]);
            let levels: Vec<i16> = values
                .clone()
                .map(|value| i16::from(value.is_some()))
                .collect();
            let there: Vec<f64> = values.flatten().collect();
            put::<DoubleType>(&mut group, &there, Some(&levels))?;
        }
        group.close()?;
        Ok(())
    }
}

/// Writes the next column of a group of rows.
fn put<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, impl Write + Send>,
    values: &[T::T],
    levels: Option<&[i16]>,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Ok(());
    };
    column.typed::<T>().write_batch(values, levels, None)?;
    column.close()
}

/// The rows of a whole table as bytes.
pub fn encode(design: &StudyDesign, rows: Vec<StudyRow>) -> Result<Vec<u8>, String> {
    let mut writer = RowWriter::new(design, Vec::new())?;
    for row in rows {
        writer.push(row)?;
    }
    writer.finish()
}

/// The rows of a table that [`encode`] made.
///
/// # Errors
/// In words, where it is no such table.
pub fn decode(design: &StudyDesign, bytes: Vec<u8>) -> Result<Vec<StudyRow>, String> {
    let reader = SerializedFileReader::new(parquet_bytes(bytes)).map_err(|why| why.to_string())?;
    let measures = &design.plan().measure;
    let first = 3 + design.setting_names().len();
    let rows = reader.get_row_iter(None).map_err(|why| why.to_string())?;
    rows.map(|row| {
        let row = row.map_err(|why| why.to_string())?;
        let columns: Vec<(&String, &Field)> = row.get_column_iter().collect();
        let run = match columns.first() {
            Some((_, Field::Long(run))) => u64::try_from(*run).ok(),
            _ => None,
        };
        let measured =
            measures
                .iter()
                .enumerate()
                .map(|(index, measure)| match columns.get(first + index) {
                    Some((name, Field::Double(number))) if *name == measure.name() => {
                        Ok(Some(*number))
                    }
                    Some((name, Field::Null)) if *name == measure.name() => Ok(None),
                    _ => Err(format!(
                        "it has no column \"{}\" of numbers",
                        measure.name()
                    )),
                });
        Ok(StudyRow {
            run: run.ok_or("it has no numbers of runs")?,
            measured: measured.collect::<Result<_, String>>()?,
        })
    })
    .collect()
}

/// Bytes as the reader wants them.
fn parquet_bytes(bytes: Vec<u8>) -> bytes::Bytes {
    bytes.into()
}

#[cfg(test)]
mod tests {
    use pilotage_study::StudyPlan;

    use super::*;

    #[test]
    fn rows_survive_being_written_with_what_they_lack() {
        let plan = StudyPlan::read(
            r#"
            name = "test"
            question = "?"
            draws = 10
            cross.vehicle = ["airplane-wind", "airplane-full"]
            draw.wind-speed = { uniform = [0, 8] }
            measure = [{ of = "error-rms" }, { of = "wind-error-rms" }]
            "#,
        );
        let design = StudyDesign::new(plan.unwrap());
        let rows: Vec<StudyRow> = (5..12)
            .map(|run| StudyRow {
                run,
                measured: vec![Some(run as f64 / 3.0), (run != 7).then_some(1e-300)],
            })
            .collect();
        let bytes = encode(&design, rows.clone()).unwrap();
        assert_eq!(bytes, encode(&design, rows.clone()).unwrap());
        assert_eq!(decode(&design, bytes.clone()), Ok(rows));
        assert!(decode(&design, bytes[..bytes.len() - 9].to_vec()).is_err());
    }
}
