//! The choice of one of several vehicles in a telemetry log, as a file beside the log, so that it is there
//! again wherever the log is.

use pilotage_core::flight::files::FileSet;
use pilotage_core::flight::log::Log;

/// Name of the file, beside the log, that says which vehicle flies.
pub const VEHICLE_FILE: &str = "vehicle.json";

/// The number of a system, as the file [`VEHICLE_FILE`] has it.
pub fn write_vehicle(system: u32) -> Vec<u8> {
    system.to_string().into_bytes()
}

/// Has the vehicle fly in a log that was read to its end that the files beside it name, if they do.
///
/// # Errors
/// A file of another kind, or a system that does not fly in the log.
pub fn choose_vehicle(pool: &dyn FileSet, log: &mut Log) -> Result<(), String> {
    let Some(bytes) = pool.read(VEHICLE_FILE) else {
        return Ok(());
    };
    let system: u32 =
        serde_json::from_slice(&bytes).map_err(|cause| format!("{VEHICLE_FILE}: {cause}"))?;
    log.choose_vehicle(system)
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::log::LogFormat;

    use super::super::LentFiles;
    use super::super::file_pool::FilePool;
    use super::*;

    fn chosen(beside: &[u8]) -> Result<Option<u32>, String> {
        let mut log = Log::new("two.tlog", LogFormat::Tlog);
        log.vehicles = vec![7, 9];
        let files = [(VEHICLE_FILE.to_owned(), beside.to_vec().into())];
        let pool = FilePool::new(&files, &LentFiles::default()).unwrap();
        choose_vehicle(&pool, &mut log)?;
        Ok(log.chosen_vehicle())
    }

    #[test]
    fn the_vehicle_that_the_file_names_flies_and_what_it_cannot_name_is_told() {
        assert_eq!(chosen(&write_vehicle(9)), Ok(Some(9)));
        assert_eq!(chosen(&write_vehicle(7)), Ok(Some(7)));
        let unknown = chosen(&write_vehicle(8)).unwrap_err();
        assert!(unknown.contains("system 7, system 9"), "{unknown}");
        let damaged = chosen(b"{").unwrap_err();
        assert!(damaged.starts_with("vehicle.json: "), "{damaged}");
    }
}
