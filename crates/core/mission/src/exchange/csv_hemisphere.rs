//! Columns of letters of hemispheres, known by their cells, whatever they are called.

use super::csv_columns::CsvRole;
use super::csv_table::{ReadCsvTable, Records};

/// Words of names of columns of such letters.
const WORDS: [&str; 20] = [
    "lat",
    "latitude",
    "lon",
    "lng",
    "long",
    "longitude",
    "hem",
    "hemi",
    "hemis",
    "hemisphere",
    "dir",
    "direction",
    "ref",
    "ind",
    "indicator",
    "sign",
    "ns",
    "ew",
    "quadrant",
    "cardinal",
];

/// An angle, the role of the letters beside it, and those as cells and words.
const KINDS: [(CsvRole, CsvRole, [&str; 4]); 2] = [
    (
        CsvRole::Latitude,
        CsvRole::NorthSouth,
        ["N", "S", "NORTH", "SOUTH"],
    ),
    (
        CsvRole::Longitude,
        CsvRole::EastWest,
        ["E", "W", "EAST", "WEST"],
    ),
];

impl ReadCsvTable<'_> {
    /// Takes columns of nothing but letters or words of hemispheres for those of latitude and longitude: each stands beside
    /// its angle or is the only one of its letters, and its name says so or the other angle has one as well.
    pub(super) fn take_hemispheres(&mut self, records: &Records) {
        let found = KINDS.map(|(angle, role, letters)| {
            let at = self.columns.iter().position(|c| c.role == Some(angle))?;
            if self.has(role) || self.columns[at].hemisphere.is_some() {
                return None;
            }
            let is_letter = |cell: &str| letters.contains(&cell.to_uppercase().as_str());
            let all = self.columns_of(records, is_letter);
            let is_beside = |column: &&usize| column.abs_diff(at) == 1;
            let only = all.first().filter(|_| all.len() == 1);
            all.iter()
                .find(is_beside)
                .or(only)
                .map(|column| (*column, role))
        });
        let are_both = found.iter().all(Option::is_some);
        for (column, role) in found.into_iter().flatten() {
            let name = self.columns[column].name.to_lowercase();
            let mut words = name.split(|c: char| !c.is_alphabetic());
            if are_both || words.any(|word| WORDS.contains(&word)) {
                self.columns[column].role = Some(role);
            }
        }
    }
}
