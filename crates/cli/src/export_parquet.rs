//! Values of a topic as a Parquet table: a column `time_s`, then one for each field. Units stand among the properties
//! of the file, as `unit of FIELD`.

use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;
use pilotage_core::flight::log::{FieldLayout, Topic};

use crate::export_value::{ExportValue, column_names, value};

/// Values of a field, `None` where a row has none.
enum ParquetColumn {
    /// Whole numbers, and whether they have no sign.
    Whole(Vec<Option<i64>>, bool),
    Real(Vec<Option<f64>>),
    Text(Vec<Option<String>>),
}

impl ParquetColumn {
    /// The values of a field in all rows. Whole numbers that do not fit into 64 bits are null.
    fn of(topic: &Topic, field: &FieldLayout) -> Self {
        let values: Vec<Option<ExportValue>> =
            topic.rows.iter().map(|row| value(field, row)).collect();
        let is_text = values
            .iter()
            .flatten()
            .any(|v| matches!(v, ExportValue::Text(_)));
        let is_real = values
            .iter()
            .flatten()
            .any(|v| matches!(v, ExportValue::Real(_)));
        if is_text {
            let text = |value| match value {
                ExportValue::Whole(whole) => whole.to_string(),
                ExportValue::Real(real) => real.to_string(),
                ExportValue::Text(text) => text,
            };
            return Self::Text(values.into_iter().map(|value| value.map(text)).collect());
        }
        if is_real {
            let real = |value| match value {
                ExportValue::Whole(whole) => Some(whole as f64),
                ExportValue::Real(real) => Some(real),
                ExportValue::Text(_) => None,
            };
            return Self::Real(
                values
                    .into_iter()
                    .map(|value| value.and_then(real))
                    .collect(),
            );
        }
        let large = |value: &ExportValue| matches!(value, ExportValue::Whole(whole) if i64::try_from(*whole).is_err());
        let is_unsigned = values.iter().flatten().any(large);
        let whole = |value| match value {
            ExportValue::Whole(whole) if is_unsigned => {
                u64::try_from(whole).ok().map(u64::cast_signed)
            }
            ExportValue::Whole(whole) => i64::try_from(whole).ok(),
            _ => None,
        };
        Self::Whole(
            values
                .into_iter()
                .map(|value| value.and_then(whole))
                .collect(),
            is_unsigned,
        )
    }

    fn kind(&self, name: &str) -> Result<Type, ParquetError> {
        let (physical, logical) = match self {
            Self::Whole(_, is_unsigned) => {
                let logical = is_unsigned.then(|| LogicalType::integer(64, false));
                (Physical::INT64, logical)
            }
            Self::Real(_) => (Physical::DOUBLE, None),
            Self::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        Type::primitive_type_builder(name, physical)
            .with_repetition(Repetition::OPTIONAL)
            .with_logical_type(logical)
            .build()
    }

    fn write(&self, group: &mut SerializedRowGroupWriter<'_, Vec<u8>>) -> Result<(), ParquetError> {
        match self {
            Self::Whole(values, _) => put::<Int64Type>(group, values.iter().copied()),
            Self::Real(values) => put::<DoubleType>(group, values.iter().copied()),
            Self::Text(values) => {
                let bytes = |text: &Option<String>| text.as_deref().map(ByteArray::from);
                put::<ByteArrayType>(group, values.iter().map(bytes))
            }
        }
    }
}

/// Writes the next column of a group of rows.
fn put<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Ok(());
    };
    let (mut levels, mut there) = (Vec::new(), Vec::new());
    for value in values {
        levels.push(i16::from(value.is_some()));
        there.extend(value);
    }
    column
        .typed::<T>()
        .write_batch(&there, Some(&levels), None)?;
    column.close()
}

/// The table as the bytes of a file.
///
/// # Errors
/// In words, where the format has no such table.
pub fn parquet(topic: &Topic) -> Result<Vec<u8>, String> {
    write(topic).map_err(|cause| format!("{}: {cause}", topic.name))
}

fn write(topic: &Topic) -> Result<Vec<u8>, ParquetError> {
    let times = ParquetColumn::Real(topic.times.iter().copied().map(Some).collect());
    let names = column_names(topic);
    let names = names.iter().map(String::as_str);
    let fields = (topic.fields.iter()).map(|field| ParquetColumn::of(topic, field));
    let columns: Vec<(&str, ParquetColumn)> = std::iter::once(("time_s", times))
        .chain(names.clone().zip(fields))
        .collect();
    let kinds = columns
        .iter()
        .map(|(name, column)| Ok(Arc::new(column.kind(name)?)));
    let kinds = kinds.collect::<Result<Vec<_>, ParquetError>>()?;
    let schema = Type::group_type_builder("topic")
        .with_fields(kinds)
        .build()?;
    let units = topic.fields.iter().zip(names);
    let units = units.filter(|(field, _)| !field.unit.is_empty());
    let units =
        units.map(|(field, name)| KeyValue::new(format!("unit of {name}"), field.unit.clone()));
    let properties = WriterProperties::builder()
        .set_compression(Compression::SNAPPY)
        .set_key_value_metadata(Some(units.collect()))
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), Arc::new(properties))?;
    let mut group = writer.next_row_group()?;
    for (_, column) in &columns {
        column.write(&mut group)?;
    }
    group.close()?;
    writer.into_inner()
}
