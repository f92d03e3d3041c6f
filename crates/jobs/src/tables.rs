//! Tables of a flight: what their columns mean, and the flight that they tell of by their maps.

use std::sync::Arc;

use pilotage_core::flight::FlightFolder;
use pilotage_core::flight::columns::{ColumnMap, flight_of_tables};
use pilotage_core::flight::files::{FileSet, file_of};

use serde::{Deserialize, Serialize};

use super::flight_among::{flight_among, with_films_told};
use super::flights::OpenFlight;
use super::order::{Order, Urgency, WorkerRole};
use super::running::once;
use super::table_names::table_names;
use super::{JobEvent, MadeFlight, RunningJob, WorkerState};

/// Name of the file, beside the tables, that says what their columns mean.
pub const COLUMNS_FILE: &str = "columns.json";

/// Encodes the meanings that people gave to the columns, as the file [`COLUMNS_FILE`] has them.
pub fn write_columns(maps: &[ColumnMap]) -> Vec<u8> {
    serde_json::to_vec_pretty(maps).unwrap_or_default()
}

/// File that says what columns of tables mean, its name and its contents: one called [`COLUMNS_FILE`], or else the only
/// one of that name in a folder among the files.
pub fn columns_file(pool: &dyn FileSet) -> Option<(String, Vec<u8>)> {
    if let Some(bytes) = pool.read(COLUMNS_FILE) {
        return Some((COLUMNS_FILE.to_owned(), bytes));
    }
    let mut found = pool.names();
    found.retain(|name| file_of(name) == COLUMNS_FILE);
    let only = found.pop().filter(|_| found.is_empty())?;
    let bytes = pool.read(&only)?;
    Some((only, bytes))
}

/// Gives maps the names that their tables have among the files: those of the same name, whatever folder they lie in. A
/// map of one table is taken for the only table, whatever that is called. Maps of other tables stay as they are.
fn name_as_tables(maps: &mut [ColumnMap], tables: &[String]) {
    if let ([map], [table]) = (&mut *maps, tables) {
        map.file.clone_from(table);
    }
    for map in maps {
        let is_it = |table: &&String| file_of(table) == file_of(&map.file);
        if !tables.contains(&map.file)
            && let Some(table) = tables.iter().find(is_it)
        {
            map.file.clone_from(table);
        }
    }
}

/// Meanings of columns that a file states.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedColumns {
    /// Those of tables that are there, by the names that these have.
    pub maps: Vec<ColumnMap>,
    /// Tables of which it tells and that are not there.
    pub lost: Vec<String>,
}

impl StatedColumns {
    /// Reads the text of `file` for the tables that are there.
    ///
    /// # Errors
    /// A text that is none of column maps, with the file's name.
    pub fn read(file: &str, text: &[u8], tables: &[String]) -> Result<Self, String> {
        let mut maps: Vec<ColumnMap> =
            serde_json::from_slice(text).map_err(|cause| format!("{file}: {cause}"))?;
        name_as_tables(&mut maps, tables);
        let (maps, lost): (Vec<_>, Vec<_>) =
            maps.into_iter().partition(|map| tables.contains(&map.file));
        let lost = lost.into_iter().map(|map| map.file).collect();
        Ok(Self { maps, lost })
    }
}

/// The maps of columns that lie beside tables, of those of the names `tables`; `None` where there are none.
///
/// # Errors
/// A file of them that cannot be read, or that is all there is.
pub fn maps_beside(
    pool: &dyn FileSet,
    tables: &[String],
) -> Result<Option<Vec<ColumnMap>>, String> {
    let Some((file, text)) = columns_file(pool) else {
        return Ok(None);
    };
    let stated = StatedColumns::read(&file, &text, tables)
        .map_err(|cause| format!("{cause}. Leave it out to be asked again."))?;
    if pool.names().len() == 1 {
        let lost = stated.lost.join(", ");
        return Err(format!(
            "{file}: the tables of which it tells are not among the files: {lost}"
        ));
    }
    Ok(Some(stated.maps).filter(|maps| !maps.is_empty()))
}

/// The flight among files, tables by the maps beside them; `None` beside a log.
pub(super) fn flight_folder(pool: &Arc<dyn FileSet>) -> Result<Option<FlightFolder>, String> {
    let maps = maps_beside(pool.as_ref(), &table_names(pool.as_ref()))?;
    flight_among(pool, maps.as_deref())
}

/// Makes the flight of the tables under a key and keeps it: event `FlightMade`.
fn make_flight(
    worker: &mut WorkerState,
    key: &str,
    emit: &mut dyn FnMut(JobEvent),
) -> Result<(), String> {
    let pool = worker.files(key)?;
    let maps = maps_beside(pool.as_ref(), &table_names(pool.as_ref()))?;
    let maps = maps.ok_or("nobody said what the columns of the tables mean")?;
    let folder = flight_of_tables(&pool, &maps).map_err(|cause| cause.to_string())?;
    let folder = with_films_told(folder, pool.as_ref());
    let (flight, notes) = (folder.flight.clone(), folder.notes.clone());
    worker.keep_flight(key, OpenFlight::of_folder(folder, None));
    emit(JobEvent::FlightMade(Box::new(MadeFlight { flight, notes })));
    Ok(())
}

/// Flight to be made of tables among provided files by the maps beside them: event `FlightMade`. Kept by the worker for
/// [`super::FlyOrder`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MakeFlightOrder {
    /// Key of the files.
    pub key: String,
}

impl Order for MakeFlightOrder {
    const URGENCY: Urgency = Urgency::Awaited;

    fn role(&self) -> WorkerRole {
        WorkerRole::Flight
    }

    fn files(&self) -> Vec<&str> {
        vec![&self.key]
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        once(move |worker, emit| make_flight(worker, &self.key, emit))
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::ChannelName;
    use pilotage_core::flight::columns::guess_table;

    use super::super::LentFiles;
    use super::super::file_pool::FilePool;
    use super::*;

    const AIR: &str = "t,airspeed [kt],roll_deg\n0,40,1\n1,41,2\n2,42,3\n3,40,4\n";

    fn pool(files: &[(&str, Vec<u8>)]) -> Arc<dyn FileSet> {
        let files: Vec<_> = (files.iter())
            .map(|(name, bytes)| ((*name).to_owned(), bytes.clone().into()))
            .collect();
        Arc::new(FilePool::new(&files, &LentFiles::default()).unwrap())
    }

    #[test]
    fn maps_beside_tables_make_them_a_flight_at_every_reading() {
        let map = guess_table("a/air.csv", AIR.as_bytes()).unwrap();
        let maps = write_columns(&[map]);
        let pool = pool(&[("a/air.csv", AIR.into()), (COLUMNS_FILE, maps)]);
        let folder = flight_folder(&pool).unwrap().unwrap();
        let airspeed = folder.flight.value(ChannelName::Airspeed, 1.0).unwrap();
        assert!((airspeed - 41.0 * 1852.0 / 3600.0).abs() < 1e-9);
        assert_eq!(folder.notes.len(), 1, "{:?}", folder.notes);
    }

    #[test]
    fn maps_are_found_in_the_folder_that_was_dropped_and_of_tables_in_it() {
        let map = guess_table("air.csv", AIR.as_bytes()).unwrap();
        let maps = write_columns(&[map]);
        let pool = pool(&[
            ("flight/air.csv", AIR.into()),
            ("flight/notes.txt", b"x".to_vec()),
            ("flight/columns.json", maps),
        ]);
        let folder = flight_folder(&pool).unwrap().unwrap();
        assert!(folder.flight.value(ChannelName::Airspeed, 1.0).is_some());
    }

    #[test]
    fn damaged_maps_and_lost_tables_are_named() {
        let damaged = pool(&[("air.csv", AIR.into()), (COLUMNS_FILE, b"[{]".to_vec())]);
        let cause = flight_folder(&damaged).err().unwrap();
        assert!(cause.starts_with("columns.json: "), "{cause}");
        let map = guess_table("air.csv", AIR.as_bytes()).unwrap();
        let lost = pool(&[(COLUMNS_FILE, write_columns(&[map]))]);
        let cause = flight_folder(&lost).err().unwrap();
        assert!(cause.contains("air.csv"), "{cause}");
        // A folder of a flight may hold what is said of tables that lie elsewhere.
        let map = guess_table("air.csv", AIR.as_bytes()).unwrap();
        let mut other = map.clone();
        other.file = "lost.csv".to_owned();
        let maps = write_columns(&[map, other.clone()]);
        let some = pool(&[("air.csv", AIR.into()), (COLUMNS_FILE, maps)]);
        let folder = flight_folder(&some).unwrap().unwrap();
        assert!(folder.flight.value(ChannelName::Airspeed, 1.0).is_some());
        let maps = write_columns(&[other.clone(), other]);
        let none = pool(&[("notes.txt", b"x".to_vec()), (COLUMNS_FILE, maps)]);
        assert!(flight_folder(&none).unwrap().is_none());
        assert!(flight_folder(&pool(&[])).unwrap().is_none());
    }
}
