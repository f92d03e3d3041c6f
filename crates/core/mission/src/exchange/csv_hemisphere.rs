//! Letters of hemispheres in tables: in columns known by their cells, whatever they are called, and O for east or west.

use pilotage_base::angle_text::{hemisphere, meaning_of_o};

use super::angle::degrees;
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

/// An angle, the role of the letters beside it, and those.
const KINDS: [(CsvRole, CsvRole, [char; 2]); 2] = [
    (CsvRole::Latitude, CsvRole::NorthSouth, ['N', 'S']),
    (CsvRole::Longitude, CsvRole::EastWest, ['E', 'W']),
];

impl ReadCsvTable<'_> {
    /// Takes columns called after letters of hemispheres for the angles themselves where no others are, and their cells are
    /// numbers with such a letter: `LATITUDE N/S` above `33.8501S`.
    pub(super) fn take_angles_with_letters(&mut self, records: &Records) {
        for (angle, role, letters) in KINDS {
            let at = self.columns.iter().position(|c| c.role == Some(role));
            let Some(at) = at.filter(|_| !self.has(angle)) else {
                continue;
            };
            let is_angle = |cell: &str| {
                let has_letter = cell.to_uppercase().contains(letters);
                let plain = cell.replace(',', ".");
                has_letter && degrees(&plain, (letters[0], letters[1])).is_some()
            };
            let cells = records.iter().filter_map(|(_, row)| row.get(at));
            let mut cells = cells.filter(|cell| !cell.is_empty()).peekable();
            if cells.peek().is_some() && cells.all(is_angle) {
                self.columns[at].role = Some(angle);
            }
        }
    }

    /// Takes columns of nothing but letters or words of hemispheres for those of latitude and longitude: each stands beside
    /// its angle or is the only one of its letters, and its name says so or the other angle has one as well.
    pub(super) fn take_hemispheres(&mut self, records: &Records) {
        let found = KINDS.map(|(angle, role, letters)| {
            let at = self.columns.iter().position(|c| c.role == Some(angle))?;
            if self.has(role) || self.columns[at].hemisphere.is_some() {
                return None;
            }
            let is_o = |cell: &str| role == CsvRole::EastWest && cell.eq_ignore_ascii_case("o");
            let is_letter = |cell: &str| {
                let letter = hemisphere(&cell.to_lowercase());
                letter.is_some_and(|letter| letters.contains(&letter)) || is_o(cell)
            };
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

    /// The letter that an O at a longitude stands for; `None` where nothing tells.
    pub(super) fn meaning_of_o(&self, records: &Records) -> Option<char> {
        let is_of_longitude = |column: usize| {
            let role = self.columns.get(column).and_then(|column| column.role);
            role.is_some_and(|role| [CsvRole::Longitude, CsvRole::EastWest].contains(&role))
        };
        let cells = records.iter().flat_map(|(_, row)| row.iter().enumerate());
        let cells = cells.filter(|(column, _)| is_of_longitude(*column));
        let names = self.columns.iter().map(|column| column.name.as_str());
        meaning_of_o(names, &cells.map(|(_, cell)| cell))
    }
}
