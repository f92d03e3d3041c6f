//! Photos without a place that a table beside them tells of.

use std::collections::{BTreeMap, HashSet};

use serde::{Deserialize, Serialize};

use super::place::{PhotoPlace, PhotoPlaceSource};
use super::read::Photo;
use pilotage_base::files::{FileSet, file_of, names_ending_in};
use pilotage_base::frames::Attitude;
use pilotage_base::text::by_count;

/// Endings of tables.
const TABLES: [&str; 3] = ["csv", "tsv", "txt"];

/// Row of a table that tells where a photo was taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PhotoRow {
    /// Place of the photo.
    pub place: PhotoPlace,
    /// Height above take-off, metres.
    pub height_above_take_off: Option<f64>,
    /// Heading, radians clockwise from true north.
    pub heading: Option<f64>,
    /// Roll and pitch, radians: pitch 0 looks straight down.
    pub tilt: Option<(f64, f64)>,
    /// Whether the pitch is that of a gimbal: 0 looks level, -π/2 straight down.
    pub is_gimbal: bool,
}

/// Rows of tables by the names of the photos among the files.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PhotoRows(pub BTreeMap<String, PhotoRow>);

impl PhotoRow {
    /// Tells a photo that says no place of itself what the row says, and angles and height where it says none; whether it
    /// was told.
    pub(super) fn tell(&self, photo: &mut Photo) -> bool {
        if photo.place.is_some() {
            return false;
        }
        photo.place = Some(self.place);
        photo.placed_by = PhotoPlaceSource::Table;
        photo.height_above_take_off = photo.height_above_take_off.or(self.height_above_take_off);
        if photo.gimbal.is_some() || photo.aircraft.is_some() {
            return true;
        }
        photo.direction = photo.direction.or(self.heading);
        if let Some((heading, (roll, pitch))) = self.heading.zip(self.tilt) {
            let told = Some(Attitude {
                roll,
                pitch,
                yaw: heading,
            });
            if self.is_gimbal {
                photo.gimbal = told;
            } else {
                photo.aircraft = told;
            }
        }
        true
    }
}

/// Tells photos that say no place of themselves what the rows of tables say.
pub(super) fn fill(photos: &mut [Photo], rows: &PhotoRows, notes: &mut Vec<String>) {
    let mut placed = 0;
    for photo in photos.iter_mut() {
        let row = rows.0.get(&photo.name);
        placed += usize::from(row.is_some_and(|row| row.tell(photo)));
    }
    if placed > 0 {
        notes.push(format!(
            "a table beside them tells where {placed} {} taken",
            by_count(placed, "photo was", "photos were")
        ));
    }
}

/// Whether a table among `files` names more of the `pictures` that are no photo with a place than there are such photos: the
/// flight is that of the table then, beside whose frames some originals lie.
pub(super) fn are_of_a_table(pictures: &[String], photos: &[Photo], files: &dyn FileSet) -> bool {
    let placed = photos.iter().filter(|photo| photo.place.is_some());
    let placed: HashSet<&str> = placed.map(|photo| &*photo.name).collect();
    let others = pictures.iter().filter(|name| !placed.contains(&***name));
    let others: Vec<&str> = others.map(|name| file_of(name)).collect();
    if others.len() <= placed.len() {
        return false;
    }
    let names = names_ending_in(files, &TABLES);
    names
        .iter()
        .filter_map(|name| files.read(name))
        .any(|table| {
            let table = String::from_utf8_lossy(&table);
            let is_between = |c: char| matches!(c, ',' | ';' | '\t' | '|' | '"' | '\r' | '\n');
            let cells: HashSet<&str> = table
                .split(is_between)
                .map(|cell| file_of(cell.rsplit('\\').next().unwrap_or(cell).trim()))
                .collect();
            others.iter().filter(|name| cells.contains(*name)).count() > placed.len()
        })
}
