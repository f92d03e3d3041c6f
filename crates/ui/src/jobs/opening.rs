//! What dropped files are: a flight, a map, a mission, a run.

use std::sync::Arc;

use pilotage_core::flight::files::FileSet as _;
use pilotage_core::flight::{FLIGHT_FILE, FolderError, read_flight};
use pilotage_core::frames::LocalFrame;
use pilotage_core::imagery::Imagery;
use pilotage_core::mission::{MapError, Mission, open_map, read_mission};
use pilotage_core::navigator::Run;

use super::Opened;
use super::file_pool::FilePool;
use super::flights::{KeptFrames, OpenFlight};
use super::workshop::describe;
use crate::documents::decode_run;

/// Endings of picture files.
const PICTURES: [&str; 3] = ["jpg", "jpeg", "png"];
/// Looks at every file of a drop; the first that is broken ends it, with its name and the cause.
pub fn look_through(key: String, pool: &Arc<FilePool>) -> Result<Opened, String> {
    let flight = flight(pool)?;
    let frame = flight
        .as_ref()
        .and_then(|(open, _)| open.flight.frame_on_globe);
    let map = map(pool, frame)?;
    let mission = mission(pool)?;
    let run = run(pool)?;
    let mut remarks = Vec::new();
    let nothing = flight.is_none() && map.is_none() && mission.is_none() && run.is_none();
    if nothing {
        return Err(unknown(pool));
    }
    let flight = flight.map(|(open, notes)| {
        remarks.extend(notes);
        Arc::unwrap_or_clone(open.flight)
    });
    Ok(Opened {
        key,
        flight,
        map: map.map(|map| describe(map.as_ref())),
        mission,
        run,
        remarks,
    })
}

/// The flight among the files, and what was skipped, in words.
pub fn flight(pool: &Arc<FilePool>) -> Result<Option<(OpenFlight, Vec<String>)>, String> {
    let folder = match read_flight(pool.clone()) {
        Ok(folder) => folder,
        Err(FolderError::NoFlightFile) => return Ok(None),
        Err(cause) => return Err(cause.to_string()),
    };
    let open = OpenFlight {
        frames: KeptFrames::stored(&folder.flight, Box::new(folder.frames)),
        flight: Arc::new(folder.flight),
        mission: mission(pool)?,
    };
    Ok(Some((open, folder.notes)))
}

/// The picture among the files that has a file beside it saying where it lies, as a map in `frame`
/// (around its own origin without one).
pub fn map(pool: &FilePool, frame: Option<LocalFrame>) -> Result<Option<Arc<dyn Imagery>>, String> {
    for name in pool.ending_in(&PICTURES) {
        match open_map(pool, &name, frame) {
            Ok(map) => return Ok(Some(Arc::new(map))),
            Err(MapError::NoGeoreference { .. }) => {}
            Err(other) => return Err(other.to_string()),
        }
    }
    Ok(None)
}

fn mission(pool: &FilePool) -> Result<Option<Mission>, String> {
    let named = |n: &String| n.ends_with("mission.json") || n.ends_with(".geojson");
    let Some(name) = pool.names().into_iter().find(named) else {
        return Ok(None);
    };
    let bytes = pool.read(&name).unwrap_or_default();
    let mission = read_mission(&bytes).map_err(|cause| format!("{name}: {cause}"))?;
    Ok(Some(mission))
}

fn run(pool: &FilePool) -> Result<Option<Run>, String> {
    let Some(name) = pool.ending_in(&["run"]).into_iter().next() else {
        return Ok(None);
    };
    let bytes = pool.read(&name).unwrap_or_default();
    let run = decode_run(&name, &bytes).map_err(|cause| cause.to_string())?;
    Ok(Some(run))
}

/// Why nothing of the drop can be opened, and what would help.
fn unknown(pool: &FilePool) -> String {
    let mut names = pool.names();
    names.sort();
    let pictures = pool.ending_in(&PICTURES);
    if let Some(picture) = pictures.first().filter(|_| pictures.len() == names.len()) {
        return format!(
            "{picture}: a picture that does not say where it lies. Drop it together with its world \
             file (.jgw, .pgw, .wld) or a georeference in JSON."
        );
    }
    let first = names.first().map_or("", String::as_str);
    let more = match names.len() {
        0 | 1 => String::new(),
        n => format!(" and {} more", n - 1),
    };
    format!(
        "{first}{more}: no {FLIGHT_FILE}, no map with its georeference, no mission and no run among \
         them. Drop a flight folder or a zip of one, a map picture with its world file, a mission \
         or a run saved here."
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn look(files: &[(&str, &[u8])]) -> Result<Opened, String> {
        let files: Vec<_> = (files.iter())
            .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec()))
            .collect();
        look_through("drop".to_owned(), &Arc::new(FilePool::new(&files)?))
    }

    fn picture() -> Vec<u8> {
        let picture = pilotage_core::raster::Picture::filled(40, 20, [90, 120, 60]);
        pilotage_core::raster::encode_png(&picture).unwrap()
    }

    #[test]
    fn a_picture_with_its_world_file_is_a_map() {
        let world_file = b"0.5\n0\n0\n-0.5\n100.25\n199.75\n";
        let opened = look(&[("a/map.png", &picture()), ("a/map.pgw", world_file)]).unwrap();
        let map = opened.map.unwrap();
        assert!((map.native_gsd - 0.5).abs() < 1e-9);
        assert!((map.bounds.west - 100.0).abs() < 1e-6, "{:?}", map.bounds);
        assert!((map.bounds.north - 200.0).abs() < 1e-6, "{:?}", map.bounds);
    }

    #[test]
    fn a_picture_alone_is_refused_with_what_it_lacks() {
        let cause = look(&[("map.png", &picture())]).unwrap_err();
        assert!(
            cause.starts_with("map.png") && cause.contains("world file"),
            "{cause}"
        );
    }

    #[test]
    fn a_broken_world_file_is_named_with_its_line() {
        let cause = look(&[("map.png", &picture()), ("map.pgw", b"0.5\nzero\n")]).unwrap_err();
        assert!(cause.starts_with("map.pgw: line 2"), "{cause}");
    }

    #[test]
    fn a_broken_flight_file_is_named_with_line_and_column() {
        let cause = look(&[("f/flight.json", b"{\n \"pilotage_flight\": one }")]).unwrap_err();
        assert!(
            cause.contains("flight.json") && cause.contains("line 2"),
            "{cause}"
        );
    }

    #[test]
    fn files_of_no_known_kind_are_refused_with_what_would_help() {
        let cause = look(&[("notes.txt", b"dear"), ("table.xls", b"1")]).unwrap_err();
        assert!(cause.starts_with("notes.txt and 1 more"), "{cause}");
        assert!(cause.contains("flight.json"), "{cause}");
    }
}
