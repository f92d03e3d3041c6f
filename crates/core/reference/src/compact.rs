//! The compact form of a table: six bytes for a landmark.
//!
//! Ground is cut into cells of 256 m; a landmark is its place within its cell to a quarter of a metre, its class, and
//! its other numbers in steps that are finer than what is known of them. 18,000 landmarks are 108 kB and some
//! hundred bytes for the cells. What the file says of its map stands in front of them.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::{GenericClass, GenericLandmark, ReferenceTable};
use pilotage_base::frames::{Geodetic, GroundPoint};
use pilotage_base::varint::{VarintError, put_varint, take_varint, unzigzag, zigzag};

/// First bytes: the format and its version.
const MAGIC: [u8; 4] = *b"PGT2";
/// Those of tables that say nothing of their map.
const BEFORE_ORIGINS: [u8; 4] = *b"PGT1";
/// Flags of what is said of the map: its origin (latitude and longitude in radians), the pixels in which things were
/// sought (metres).
const ORIGIN: u8 = 1;
const GSD: u8 = 2;
/// Side of a cell, metres.
const CELL: f64 = 256.0;
/// Steps of a place within a cell.
const PLACES: u64 = 1024;
/// Least size, metres.
const LEAST_SIZE: f64 = 0.5;
/// Steps of a size by which it grows e-fold: seven bits reach from 0.5 m to 1.4 km.
const SIZES: f64 = 16.0;
/// Steps of half a turn.
const ORIENTATIONS: u64 = 128;
/// Steps of a stability.
const STABILITIES: f64 = 31.0;
/// Steps of a confidence.
const CONFIDENCES: f64 = 15.0;
/// Bytes of a landmark.
const RECORD: usize = 6;
/// Most bytes of a number of variable length.
const LONGEST_NUMBER: usize = 9;
/// Most that a cell may lie from the origin, in cells: more than the globe has.
const FURTHEST: i64 = 1 << 20;

/// Refusal of bytes that are no table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CompactTableError {
    /// Other first bytes.
    #[error("the file is no table of generic landmarks; make one with `pilotage reference-map`")]
    NoTable,
    /// The end is missing.
    #[error("the table of generic landmarks ends early; make it again")]
    EndsEarly,
    /// Numbers that no table has.
    #[error("the table of generic landmarks is damaged at byte {at}; make it again")]
    Damaged {
        /// Place in the file.
        at: usize,
    },
}

impl ReferenceTable {
    /// The table as bytes. Places are kept to 0.18 m, sizes to 3 %, orientations to 0.7°, confidences to 0.034 and
    /// stabilities to 0.017.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut placed: Vec<((i64, i64), u64)> =
            self.landmarks().iter().filter_map(packed).collect();
        placed.sort_unstable();
        let mut bytes = MAGIC.to_vec();
        let flag = |is_told: bool, flag| if is_told { flag } else { 0 };
        bytes.push(flag(self.origin().is_some(), ORIGIN) | flag(self.gsd().is_some(), GSD));
        let origin = self.origin().map(|at| [at.latitude, at.longitude]);
        let numbers = origin.into_iter().flatten().chain(self.gsd());
        bytes.extend(numbers.flat_map(f64::to_le_bytes));
        put_varint(&mut bytes, self.others().len() as u64);
        for name in self.others() {
            put_varint(&mut bytes, name.len() as u64);
            bytes.extend_from_slice(name.as_bytes());
        }
        let cells: Vec<&[((i64, i64), u64)]> = placed.chunk_by(|a, b| a.0 == b.0).collect();
        put_varint(&mut bytes, cells.len() as u64);
        for cell in cells {
            let (row, column) = cell[0].0;
            put_varint(&mut bytes, zigzag(row));
            put_varint(&mut bytes, zigzag(column));
            put_varint(&mut bytes, cell.len() as u64);
            for (_, record) in cell {
                bytes.extend_from_slice(&record.to_le_bytes()[..RECORD]);
            }
        }
        bytes
    }

    /// The table of such bytes.
    ///
    /// ```
    /// use pilotage_base::frames::GroundPoint;
    /// use pilotage_reference::{CompactTableError, GenericClass, GenericLandmark, ReferenceTable};
    ///
    /// let pond = GenericLandmark {
    ///     place: GroundPoint::new(1234.5, -678.9),
    ///     class: GenericClass::Water,
    ///     size: 20.0, orientation: 1.0,
    ///     confidence: 0.9, stability: 0.8,
    /// };
    /// let read = ReferenceTable::from_bytes(&ReferenceTable::new(vec![pond], Vec::new()).to_bytes())?;
    /// let [kept] = read.landmarks() else { panic!("one pond") };
    /// assert!(kept.place.distance(&pond.place) < 0.18 && (kept.size / 20.0 - 1.0).abs() < 0.03);
    /// # Ok::<(), CompactTableError>(())
    /// ```
    ///
    /// # Errors
    /// The bytes are no table, or damaged.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CompactTableError> {
        let mut reader = Reader { bytes, at: 0 };
        let told = match reader.take(MAGIC.len()) {
            Ok(magic) if *magic == MAGIC => reader.take(1)?[0],
            Ok(magic) if *magic == BEFORE_ORIGINS => 0,
            _ => return Err(CompactTableError::NoTable),
        };
        if told & !(ORIGIN | GSD) != 0 {
            return Err(reader.damaged());
        }
        let mut origin = None;
        if told & ORIGIN != 0 {
            let (latitude, longitude) = (reader.real(FRAC_PI_2)?, reader.real(PI)?);
            origin = Some(Geodetic {
                latitude,
                longitude,
                height: 0.0,
            });
        }
        let gsd = if told & GSD != 0 {
            Some(reader.real(Self::WIDEST_PIXEL)?)
        } else {
            None
        };
        let mut others = Vec::new();
        let names = reader.number()?;
        if names > u64::from(GenericClass::MOST_OTHERS) {
            return Err(reader.damaged());
        }
        for _ in 0..names {
            let length = reader.number()? as usize;
            let name = std::str::from_utf8(reader.take(length)?);
            others.push(name.map_err(|_| reader.damaged())?.to_owned());
        }
        let mut landmarks = Vec::new();
        for _ in 0..reader.number()? {
            let (row, column) = (unzigzag(reader.number()?), unzigzag(reader.number()?));
            if row.abs() > FURTHEST || column.abs() > FURTHEST {
                return Err(reader.damaged());
            }
            let count = reader.number()? as usize;
            let records = reader.take(count.saturating_mul(RECORD))?;
            for record in records.chunks_exact(RECORD) {
                let mut word = [0; 8];
                word[..RECORD].copy_from_slice(record);
                let landmark = unpacked((row, column), u64::from_le_bytes(word));
                landmarks.push(landmark.ok_or(reader.damaged())?);
            }
        }
        let table = Self::new(landmarks, others).on_globe(origin);
        Ok(match gsd {
            Some(gsd) => table.sought_in(gsd),
            None => table,
        })
    }
}

/// Cell (row from the south, column from the west) and record of a landmark; `None` of one beyond the globe.
fn packed(landmark: &GenericLandmark) -> Option<((i64, i64), u64)> {
    let step = |metres: f64| (metres * PLACES as f64 / CELL).floor() as i64;
    let (north, east) = (step(landmark.place.north), step(landmark.place.east));
    let cell = (
        north.div_euclid(PLACES as i64),
        east.div_euclid(PLACES as i64),
    );
    let within = |steps: i64| steps.rem_euclid(PLACES as i64) as u64;
    let size = (SIZES * (landmark.size.max(LEAST_SIZE) / LEAST_SIZE).ln()).round();
    let turn = landmark.orientation.rem_euclid(PI) / PI * ORIENTATIONS as f64;
    let share = |p: f64, steps: f64| (p.clamp(0.0, 1.0) * steps).round() as u64;
    let fields = [
        (within(north), 10),
        (within(east), 10),
        (u64::from(landmark.class.number()), 5),
        (size.min(127.0) as u64, 7),
        (turn.round() as u64 % ORIENTATIONS, 7),
        (share(landmark.confidence, CONFIDENCES), 4),
        (share(landmark.stability, STABILITIES), 5),
    ];
    let mut record = 0;
    for (value, bits) in fields {
        record = (record << bits) | value;
    }
    (cell.0.abs() <= FURTHEST && cell.1.abs() <= FURTHEST).then_some((cell, record))
}

/// The landmark of a record; `None` if there is no such class.
fn unpacked(cell: (i64, i64), mut record: u64) -> Option<GenericLandmark> {
    let mut next = |bits: u32| {
        let value = record & ((1 << bits) - 1);
        record >>= bits;
        value as f64
    };
    let stability = next(5) / STABILITIES;
    let confidence = next(4) / CONFIDENCES;
    let orientation = next(7) * PI / ORIENTATIONS as f64;
    let size = LEAST_SIZE * (next(7) / SIZES).exp();
    let class = GenericClass::of_number(next(5) as u8)?;
    let (east, north) = (next(10), next(10));
    let metres = |cell: i64, steps: f64| CELL * (cell as f64 + (steps + 0.5) / PLACES as f64);
    Some(GenericLandmark {
        place: GroundPoint::new(metres(cell.0, north), metres(cell.1, east)),
        class,
        size,
        orientation,
        confidence,
        stability,
    })
}

/// Reads from the front.
struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], CompactTableError> {
        let end = self.at.checked_add(count);
        let taken = end.and_then(|end| self.bytes.get(self.at..end));
        self.at = self.at.saturating_add(count);
        taken.ok_or(CompactTableError::EndsEarly)
    }

    fn number(&mut self) -> Result<u64, CompactTableError> {
        let mut rest = self.bytes.get(self.at..).unwrap_or_default();
        let number = take_varint(&mut rest, LONGEST_NUMBER);
        self.at = self.bytes.len() - rest.len();
        number.map_err(|cause| match cause {
            VarintError::EndsEarly => CompactTableError::EndsEarly,
            VarintError::TooLong => self.damaged(),
        })
    }

    /// A number from `-most` to `most`.
    fn real(&mut self, most: f64) -> Result<f64, CompactTableError> {
        let mut bytes = [0; 8];
        bytes.copy_from_slice(self.take(8)?);
        let number = f64::from_le_bytes(bytes);
        if number.abs() <= most {
            Ok(number)
        } else {
            Err(self.damaged())
        }
    }

    fn damaged(&self) -> CompactTableError {
        CompactTableError::Damaged { at: self.at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn landmark() -> impl Strategy<Value = GenericLandmark> {
        let place = (-9e3..9e3, -9e3..9e3);
        let rest = (1_u8..=8, 0.6..900.0, 0.0..PI, 0.0..1.0, 0.0..1.0);
        (place, rest).prop_map(
            |((north, east), (class, size, orientation, confidence, stability))| GenericLandmark {
                place: GroundPoint::new(north, east),
                class: GenericClass::of_number(class).unwrap(),
                size,
                orientation,
                confidence,
                stability,
            },
        )
    }

    fn names() -> Vec<String> {
        vec!["haystack".to_owned(), "wind turbine".to_owned()]
    }

    proptest! {
        #[test]
        fn a_table_comes_back_as_exactly_as_its_steps_are_fine(one in landmark()) {
            let table = ReferenceTable::new(vec![one], names());
            let back = ReferenceTable::from_bytes(&table.to_bytes()).unwrap();
            prop_assert_eq!(back.others(), table.others());
            let again = back.landmarks()[0];
            prop_assert_eq!(again.class, one.class);
            prop_assert!(again.place.distance(&one.place) < 0.18);
            prop_assert!((again.size / one.size).ln().abs() < 0.032);
            let turned = (again.orientation - one.orientation).rem_euclid(PI);
            prop_assert!(turned.min(PI - turned) < 0.013);
            prop_assert!((again.confidence - one.confidence).abs() < 0.034);
            prop_assert!((again.stability - one.stability).abs() < 0.017);
            // What was rounded once stays.
            prop_assert_eq!(ReferenceTable::from_bytes(&back.to_bytes()).unwrap(), back);
        }

        #[test]
        fn damaged_bytes_are_refused_or_read_but_never_panic(
            all in prop::collection::vec(landmark(), 0..20),
            at in 0_usize..150,
            value in any::<u8>(),
            length in 0_usize..150,
        ) {
            let mut bytes = ReferenceTable::new(all, names()).to_bytes();
            let at = at % bytes.len();
            bytes[at] = value;
            let _ = ReferenceTable::from_bytes(&bytes);
            bytes.truncate(length);
            let _ = ReferenceTable::from_bytes(&bytes);
        }
    }

    #[test]
    fn a_table_tells_where_its_map_lies_and_older_ones_do_not() {
        let one = || GenericLandmark {
            place: GroundPoint::new(3.0, -7.0),
            class: GenericClass::Tree,
            size: 4.0,
            orientation: 0.0,
            confidence: 1.0,
            stability: 1.0,
        };
        let plain = ReferenceTable::new(vec![one()], names());
        let origin = Geodetic::from_degrees(-33.85, 18.42, 0.0);
        let told = plain.clone().on_globe(Some(origin)).sought_in(0.25);
        let bytes = told.to_bytes();
        let back = ReferenceTable::from_bytes(&bytes).unwrap();
        assert_eq!((back.origin(), back.gsd()), (Some(origin), Some(0.25)));
        assert_eq!(back.landmarks().len(), 1);
        // Tables of before: other first bytes, and nothing of the map.
        let mut older = plain.to_bytes();
        older.remove(MAGIC.len());
        older[..MAGIC.len()].copy_from_slice(&BEFORE_ORIGINS);
        let older = ReferenceTable::from_bytes(&older).unwrap();
        assert_eq!((older.origin(), older.gsd()), (None, None));
        assert_eq!(older.landmarks(), back.landmarks());
        // A place that no globe has.
        let mut wrong = bytes.clone();
        wrong[MAGIC.len() + 1..][..8].copy_from_slice(&f64::NAN.to_le_bytes());
        let refusal = ReferenceTable::from_bytes(&wrong).unwrap_err();
        assert!(matches!(refusal, CompactTableError::Damaged { .. }));
    }

    #[test]
    fn eighteen_thousand_landmarks_fit_into_150_kilobytes() {
        // One landmark per (53 m)², the density of the thesis' map: 22,167 × 25,100 pixels of 0.37 ft.
        let all = (0..18_000)
            .map(|i| GenericLandmark {
                place: GroundPoint::new(f64::from(i % 134) * 18.7, f64::from(i / 134) * 21.1),
                class: GenericClass::USUAL[i as usize % 6],
                size: 10.0,
                orientation: 1.0,
                confidence: 0.9,
                stability: 0.5,
            })
            .collect();
        let bytes = ReferenceTable::new(all, Vec::new()).to_bytes();
        println!("{} bytes", bytes.len());
        assert!(bytes.len() <= 150_000);
    }

    #[test]
    fn other_files_are_refused_with_what_to_do() {
        let refusal = ReferenceTable::from_bytes(b"II*\0 some picture").unwrap_err();
        assert_eq!(refusal, CompactTableError::NoTable);
        assert!(refusal.to_string().contains("reference-map"));
    }
}
