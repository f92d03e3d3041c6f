//! Routes, landmarks and roads of other programs among dropped files.

use pilotage_core::exchange::labels::{FoundLabels, LabelFormat, read_labels};
use pilotage_core::exchange::{ExchangeError, Format, Imported, read_any};
use pilotage_core::flight::beside_log::PICTURE_TABLE;
use pilotage_core::flight::columns::{ColumnRole, GuessedTable};
use pilotage_core::flight::files::{FileSet, ZipFiles, file_of, has_ending, names_ending_in};
use pilotage_core::frames::{Geodetic, GroundPoint, LocalFrame};
use pilotage_core::mission::places_in_degrees;

use super::ImportedFile;
use super::far_away::{FARTHEST, too_far};
use super::file_pool::{contains, read_or_say};
use super::road_files::{OF_OSM, is_of_roads, roads_of};
use super::tables::columns_file;

/// Endings that formats of routes and landmarks share with flights, and with anything else.
const ANYBODYS: [&str; 5] = ["csv", "tsv", "geojson", "json", "txt"];

/// Reads the routes and landmarks of a file as [`read_any`] does, and control points in systems that only readers of maps
/// know; of a zip those of the only file in it that has any.
///
/// # Errors
/// As [`read_any`]; a zip with several such files, which are named.
pub fn read_exchange(
    name: &str,
    bytes: &[u8],
    frame: Option<LocalFrame>,
) -> Result<Imported, ExchangeError> {
    let is_zip = bytes.starts_with(b"PK\x03\x04") && Format::of(name, bytes).is_none();
    let within = if is_zip { packed(name, bytes)? } else { None };
    let Some((inner, content)) = within else {
        return read_unpacked(name, bytes, frame);
    };
    let mut imported = read_unpacked(&inner, &content, frame)?;
    imported
        .notes
        .insert(0, format!("{inner} is read, which is in it"));
    Ok(imported)
}

/// The only file in a zip that has routes or landmarks, if there is one.
fn packed(name: &str, bytes: &[u8]) -> Result<Option<(String, Vec<u8>)>, ExchangeError> {
    let Ok(files) = ZipFiles::open(bytes) else {
        return Ok(None);
    };
    let mut found = Vec::new();
    for inner in files.names() {
        if file_of(&inner).starts_with('.') {
            continue;
        }
        let content = files.read(&inner).unwrap_or_default();
        if !is_mission(&inner, &content) && Format::is_expected_in(&inner, &content) {
            found.push((inner, content));
        }
    }
    if found.len() > 1 {
        let names: Vec<&str> = found.iter().map(|(inner, _)| inner.as_str()).collect();
        return Err(ExchangeError::File {
            file: name.to_owned(),
            cause: format!(
                "several files with routes or landmarks are in it ({}): unpack it, and read them one by one",
                names.join(", ")
            ),
        });
    }
    Ok(found.pop())
}

fn read_unpacked(
    name: &str,
    bytes: &[u8],
    frame: Option<LocalFrame>,
) -> Result<Imported, ExchangeError> {
    let in_degrees = std::str::from_utf8(bytes).ok().and_then(places_in_degrees);
    let Some((text, told)) = in_degrees else {
        return read_any(name, bytes, frame);
    };
    let mut imported = read_any(name, text.as_bytes(), frame)?;
    imported.notes.splice(0..0, told);
    Ok(imported)
}

/// Whether a file is a mission of this program, which is opened instead of added.
pub fn is_mission(name: &str, bytes: &[u8]) -> bool {
    name.ends_with("mission.json")
        || has_ending(name, &["geojson", "json"]) && contains(bytes, b"\"pilotage_mission\"")
}

/// Whether any GeoJSON among the files is the flight's own: that of a flight folder, photos or what a receiver said
/// (`is_folder`), unless somebody said what the columns of its tables mean, which may have come with anything.
pub fn owns_geojson(pool: &dyn FileSet, is_folder: bool) -> bool {
    is_folder && columns_file(pool).is_none()
}

/// Whether a file is the table that says when pictures beside a log were taken: no table of places.
pub fn is_picture_table(name: &str) -> bool {
    name.rsplit('/').next() == Some(PICTURE_TABLE)
}

/// Reads every file that other programs write, placed around `origin`. `is_flight` says whether the
/// files are a flight, whose tables and JSON are its own, `is_told` whether they hold a flight or a mission in any other
/// form, beside which tables may be anything; `tables` are those among them that may be of a flight.
pub fn imports(
    pool: &dyn FileSet,
    origin: Geodetic,
    is_flight: bool,
    is_told: bool,
    tables: &[GuessedTable],
) -> Result<Vec<ImportedFile>, String> {
    let is_flown = tables.iter().any(|table| table.is_proposed);
    let is_placed = |table: &GuessedTable| table.map.column(ColumnRole::Latitude).is_some();
    let may_be_other = |name: &str| tables.iter().any(|t| t.map.file == name && !is_placed(t));
    let mut refused = None;
    let mut names = pool.names();
    names.sort();
    let mut found = Vec::new();
    for name in names {
        let is_of_program = Format::is_extension_of_one(&name) && !has_ending(&name, &ANYBODYS);
        let is_of_any = has_ending(&name, &ANYBODYS) && !is_flight;
        let plausible = is_of_program || is_of_any || has_ending(&name, &OF_OSM);
        let is_of_flight =
            is_flown && has_ending(&name, &["csv", "tsv", "txt"]) || is_picture_table(&name);
        if !plausible || is_of_flight {
            continue;
        }
        let bytes = if has_ending(&name, &OF_OSM) {
            let part = "give the part of it that is flown over, as \"osmium extract\" cuts it out";
            read_or_say(pool, &name).map_err(|why| format!("{name}: {why}; {part}"))?
        } else {
            pool.read(&name).unwrap_or_default()
        };
        if is_mission(&name, &bytes) || is_flight && is_the_flight(pool, &name, &bytes) {
            continue;
        }
        if is_of_roads(&name, &bytes) {
            found.push(roads_of(name, &bytes, &LocalFrame::new(origin))?);
            continue;
        }
        if !Format::is_expected_in(&name, &bytes) {
            continue;
        }
        match read_exchange(&name, &bytes, Some(LocalFrame::new(origin))) {
            Ok(imported) => found.push(placed(name, imported)?),
            Err(cause) if may_be_other(&name) => {
                refused.get_or_insert(cause.to_string());
            }
            Err(cause) => return Err(cause.to_string()),
        }
    }
    match refused {
        Some(cause) if !found.is_empty() && !is_told => Err(cause),
        _ => Ok(found),
    }
}

/// Whether the only file of a flight, which is made of it, is a track of GPX or KML and has nothing else: as a route it would
/// be there twice.
fn is_the_flight(pool: &dyn FileSet, name: &str, bytes: &[u8]) -> bool {
    let others: [&[u8]; 6] = [
        b"<wpt",
        b"<rtept",
        b"<Point",
        b"LineString",
        b"Polygon",
        b"GroundOverlay",
    ];
    has_ending(name, &["gpx", "kml"])
        && pool.names().len() == 1
        && !others.iter().any(|other| contains(bytes, other))
}

/// The labels in all files of them, in either format, and the format of the first.
///
/// # Errors
/// A file of labels that cannot be read, in words.
pub fn labels(files: &dyn FileSet) -> Result<Option<(LabelFormat, FoundLabels)>, String> {
    let mut all: Option<(LabelFormat, FoundLabels)> = None;
    for name in names_ending_in(files, &["xml", "json"]) {
        let bytes = files.read(&name).unwrap_or_default();
        let Some(format) = LabelFormat::of(&bytes) else {
            continue;
        };
        let found = read_labels(&name, &bytes).map_err(|cause| cause.to_string())?;
        let (_, all) = all.get_or_insert_with(|| (format, FoundLabels::default()));
        all.add(found);
    }
    Ok(all)
}

fn placed(name: String, imported: Imported) -> Result<ImportedFile, String> {
    let origin = GroundPoint::default();
    let places = imported.routes.iter().flat_map(|r| &r.way_points);
    let places = places.map(|w| w.position);
    let places = places.chain(imported.landmarks.iter().map(|l| l.reference));
    let places = places.chain(
        imported
            .no_fly
            .iter()
            .flat_map(|z| z.corners.iter().copied()),
    );
    let places = places.chain(imported.rally.iter().map(|r| r.position));
    let nearest = places
        .map(|p| p.distance(&origin))
        .fold(f64::INFINITY, f64::min);
    if nearest > FARTHEST {
        return Err(too_far(&name));
    }
    Ok(ImportedFile {
        name,
        format: imported.format.name().to_owned(),
        routes: imported.routes,
        landmarks: imported.landmarks,
        no_fly: imported.no_fly,
        rally: imported.rally,
        notes: imported.notes,
        ..ImportedFile::default()
    })
}

#[cfg(test)]
mod tests {
    use super::super::file_pool::FilePool;
    use super::super::{FileContent, LentFiles};
    use super::*;
    use pilotage_core::flight::files::{FileSink as _, MemoryFiles, ZipSink};
    use pilotage_core::imagery::ByteSource;

    const WAY_POINTS: &str = "QGC WPL 110\n\
        0\t1\t0\t16\t0\t0\t0\t0\t47.0\t8.0\t400\t1\n\
        1\t0\t3\t16\t0\t0\t0\t0\t47.001\t8.0\t80\t1\n\
        2\t0\t3\t16\t0\t0\t0\t0\t47.002\t8.001\t80\t1\n";

    #[test]
    fn a_track_alone_is_no_route_beside_its_flight_and_points_stay_landmarks() {
        let track = b"<gpx><trk><trkseg><trkpt lat='47' lon='8'/></trkseg></trk></gpx>".to_vec();
        let points = b"<kml><Placemark><Point/></Placemark></kml>".to_vec();
        for (names, bytes, is_flight) in [
            (&["a.gpx"][..], &track, true),
            (&["a.gpx", "b.csv"][..], &track, false),
            (&["a.kml"][..], &points, false),
        ] {
            let files = names.iter().map(|name| ((*name).to_owned(), bytes.clone()));
            let pool = MemoryFiles(files.collect());
            assert_eq!(
                is_the_flight(&pool, names[0], bytes),
                is_flight,
                "{names:?}"
            );
        }
    }

    #[test]
    fn the_only_mission_in_a_zip_is_read_and_several_are_named() {
        let zip = |files: &[(&str, &str)]| {
            let mut sink = ZipSink::default();
            for (name, text) in files {
                sink.write(name, text.as_bytes()).unwrap();
            }
            sink.finish().unwrap()
        };
        let packed = zip(&[("a/b.waypoints", WAY_POINTS), ("a/readme.txt", "words")]);
        let read = read_exchange("a.zip", &packed, None).unwrap();
        assert_eq!(read.routes[0].way_points.len(), 2);
        let is_told = |note: &String| note.starts_with("a/b.waypoints is read");
        assert!(read.notes.iter().any(is_told), "{:?}", read.notes);
        let packed = zip(&[("b.waypoints", WAY_POINTS), ("c.waypoints", WAY_POINTS)]);
        let why = read_exchange("a.zip", &packed, None)
            .unwrap_err()
            .to_string();
        assert!(why.contains("b.waypoints, c.waypoints"), "{why}");
        let packed = zip(&[("readme.txt", "words")]);
        let why = read_exchange("a.zip", &packed, None).unwrap_err();
        assert!(matches!(why, ExchangeError::Unknown { .. }), "{why}");
    }

    fn look(name: &str, text: &str, latitude: f64) -> Result<Vec<ImportedFile>, String> {
        let files = [(name.to_owned(), text.as_bytes().to_vec().into())];
        let pool = FilePool::new(&files, &LentFiles::default())?;
        imports(
            &pool,
            Geodetic::from_degrees(latitude, 8.0, 0.0),
            false,
            false,
            &[],
        )
    }

    #[test]
    fn way_points_are_placed_around_the_mission() {
        let found = look("trip.waypoints", WAY_POINTS, 47.0).unwrap();
        let first = &found[0].routes[0].way_points[0].position;
        assert!(
            (first.north - 111.2).abs() < 0.3 && first.east.abs() < 1e-6,
            "{first:?}"
        );
    }

    #[test]
    fn what_may_be_anything_is_read_where_its_words_or_its_name_say_that_it_is_of_places() {
        let point = "{\"type\": \"Feature\", \"properties\": {\"name\": \"barn\"},\
            \"geometry\": {\"type\": \"Point\", \"coordinates\": [8.0, 47.0]}}";
        assert_eq!(look("barn.geojson", point, 47.0).unwrap().len(), 1);
        for (name, text) in [
            ("barn.json", point),
            ("numbers.json", "[47.0, 8.0, 400]\n[47.1, 8.0, 400]\n"),
            (
                "letter.txt",
                "Dear Sir, the map\nis, as you said, too small.\n",
            ),
        ] {
            assert_eq!(look(name, text, 47.0).unwrap().len(), 0, "{name}");
        }
        let found = look("trip.txt", WAY_POINTS, 47.0).unwrap();
        assert_eq!(found.len(), 1);
    }

    #[test]
    fn control_points_of_a_national_system_are_placed_as_the_terminal_places_them() {
        // 9.2624835° E 60.2695103° N by pyproj 3.7.
        let table = "#CoordinateSystem: EPSG::25832\n#Label,X/Easting,Y/Northing,Z/Altitude\n\
                     924-01,514521.45,6681455.436,220.1\n";
        let files = [("marks.csv".to_owned(), table.as_bytes().to_vec().into())];
        let pool = FilePool::new(&files, &LentFiles::default()).unwrap();
        let near = Geodetic::from_degrees(60.26, 9.26, 0.0);
        let found = imports(&pool, near, false, false, &[]).unwrap();
        let frame = LocalFrame::new(near);
        let place = frame.geodetic_from_ground(&found[0].routes[0].way_points[0].position);
        let off = [place.latitude, place.longitude].map(f64::to_degrees);
        assert!((off[0] - 60.269_510_3).abs() < 1e-6, "{off:?}");
        assert!((off[1] - 9.262_483_5).abs() < 1e-6, "{off:?}");
        let terminal = read_exchange("marks.csv", table.as_bytes(), None).unwrap();
        assert_eq!(terminal.routes.len(), found[0].routes.len());
        assert!(
            found[0].notes[0].contains("read in"),
            "{:?}",
            found[0].notes
        );
    }

    #[test]
    fn a_file_from_far_away_is_refused_with_what_helps() {
        let cause = look("trip.waypoints", WAY_POINTS, 10.0).unwrap_err();
        assert!(
            cause.starts_with("trip.waypoints: ") && cause.contains("map of that place"),
            "{cause}"
        );
    }

    /// File that claims to have two gigabytes.
    struct Huge;

    impl ByteSource for Huge {
        fn name(&self) -> &'static str {
            "country.osm.pbf"
        }

        fn length(&self) -> u64 {
            2 << 30
        }

        fn read(&self, _: u64, _: usize) -> Result<Vec<u8>, String> {
            Err("nobody should read it".to_owned())
        }
    }

    #[test]
    fn roads_that_are_too_many_are_refused_by_their_size() {
        let mut lent = LentFiles::default();
        lent.files.insert(0, std::sync::Arc::new(Huge));
        let content = FileContent::Lent {
            number: 0,
            length: 2 << 30,
        };
        let pool = FilePool::new(&[("country.osm.pbf".to_owned(), content)], &lent).unwrap();
        let origin = Geodetic::from_degrees(47.0, 8.0, 0.0);
        let why = imports(&pool, origin, false, false, &[]).unwrap_err();
        assert!(
            why.starts_with("country.osm.pbf: 2.0 GiB are too many"),
            "{why}"
        );
    }

    #[test]
    fn any_text_and_missions_of_our_own_are_left_alone() {
        assert_eq!(look("notes.txt", "dear diary, today", 47.0), Ok(Vec::new()));
        assert_eq!(look("flight.json", "{ \"a\": 1 }", 47.0), Ok(Vec::new()));
        let times = "time,file\n0.5,0001.jpg\n";
        assert_eq!(look("film/frames.csv", times, 47.0), Ok(Vec::new()));
        let own = "{ \"type\": \"FeatureCollection\", \"pilotage_mission\": 1, \"features\": [] }";
        assert_eq!(look("own.geojson", own, 47.0), Ok(Vec::new()));
    }

    #[test]
    fn files_of_every_format_are_looked_into_by_its_own_endings() {
        for format in Format::all() {
            for ending in format.extensions() {
                let name = format!("trip.{ending}");
                let is_known = Format::is_extension_of_one(&name);
                assert!(is_known, "{name}");
                // A table of way-points is one under any ending that may be one.
                let found = look(&name, WAY_POINTS, 47.0);
                assert_ne!(found, Ok(Vec::new()), "{name} was not looked into");
            }
        }
    }

    #[test]
    fn a_broken_file_is_named_with_its_place() {
        let cause = look("trip.gpx", "<gpx>\n<rte>", 47.0).unwrap_err();
        assert!(cause.starts_with("trip.gpx, line 2"), "{cause}");
    }
}
