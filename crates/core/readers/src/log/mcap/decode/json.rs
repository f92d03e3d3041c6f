//! Messages that are JSON.

use serde_json::{Number, Value};

use crate::log::FieldKind;
use crate::log::growing::{FieldStep, GrowingTable, MOST_ELEMENTS, Path, ValuePlace};

/// Largest whole number up to which every one is a double, too.
const WHOLE: u64 = 1 << 53;

/// Names of the places of values that are no object. The names cannot be those of members: a control
/// character begins them.
const NUMBER: &str = "\u{1}number";
const NATURAL: &str = "\u{1}natural";
const WHOLE_NUMBER: &str = "\u{1}whole";
const TRUTH: &str = "\u{1}truth";
const LETTERS: &str = "\u{1}text";
const LIST: &str = "\u{1}list";

/// Puts what a message says into the row.
pub(super) fn decode(
    data: &[u8],
    root: &mut ValuePlace,
    table: &mut GrowingTable,
) -> Result<(), &'static str> {
    let value = serde_json::from_slice(data).map_err(|_| "a message is no JSON")?;
    put(&value, root, &Path::default(), table);
    Ok(())
}

fn put(value: &Value, place: &mut ValuePlace, path: &Path, table: &mut GrowingTable) {
    match value {
        Value::Null => {}
        Value::Bool(truth) => {
            put_bytes(
                TRUTH,
                FieldKind::Bool,
                &[u8::from(*truth)],
                place,
                path,
                table,
            );
        }
        Value::Number(number) => put_number(number, place, path, table),
        Value::String(letters) => leaf(LETTERS, place, path, table, |place, path, table| {
            table.text(place, path, letters.as_bytes());
        }),
        Value::Array(list) => {
            let kept = list.len().min(MOST_ELEMENTS);
            let places = table.named(place, LIST, 0);
            let Some([length, places @ ..]) = places.and_then(|p| table.parts(p, 1 + kept)) else {
                return;
            };
            table.length(length, path, list.len());
            if kept < list.len() {
                table.cut_list(path, kept);
            }
            for (index, (value, place)) in list.iter().zip(places).enumerate() {
                put(value, place, &path.then(FieldStep::Index(index)), table);
            }
        }
        Value::Object(members) => {
            for (index, (name, value)) in members.iter().enumerate() {
                if let Some(place) = table.named(place, name, index) {
                    put(value, place, &path.then(FieldStep::Name(name)), table);
                }
            }
        }
    }
}

fn put_number(number: &Number, place: &mut ValuePlace, path: &Path, table: &mut GrowingTable) {
    let (kind, name, bytes) = match (number.as_u64(), number.as_i64()) {
        (Some(natural), _) if natural > WHOLE => (FieldKind::U64, NATURAL, natural.to_le_bytes()),
        (None, Some(whole)) if whole.unsigned_abs() > WHOLE => {
            (FieldKind::I64, WHOLE_NUMBER, whole.to_le_bytes())
        }
        _ => {
            let number = number.as_f64().unwrap_or(f64::NAN);
            (FieldKind::F64, NUMBER, number.to_le_bytes())
        }
    };
    put_bytes(name, kind, &bytes, place, path, table);
}

fn put_bytes(
    name: &str,
    kind: FieldKind,
    bytes: &[u8],
    place: &mut ValuePlace,
    path: &Path,
    table: &mut GrowingTable,
) {
    leaf(name, place, path, table, |place, path, table| {
        table.number(place, path, kind, bytes);
    });
}

/// Calls `put` with the place of what is a `name` there. What comes at the same path as something else before
/// has its name behind it.
fn leaf(
    name: &str,
    place: &mut ValuePlace,
    path: &Path,
    table: &mut GrowingTable,
    put: impl FnOnce(&mut ValuePlace, &Path, &mut GrowingTable),
) {
    let is_second =
        matches!(place, ValuePlace::Named(names) if names.first().is_some_and(|(n, _)| n != name));
    let Some(place) = table.named(place, name, 0) else {
        return;
    };
    if is_second {
        put(place, &path.then(FieldStep::Name(&name[1..])), table);
    } else {
        put(place, path, table);
    }
}
