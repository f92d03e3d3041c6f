//! Recognition of dropped files: a flight, a map, a mission, a run.

use std::sync::Arc;

use pilotage_core::exchange::Format;
use pilotage_core::flight::columns::GuessedTable;
use pilotage_core::flight::files::{FileSet, has_ending, names_ending_in};
use pilotage_core::flight::log::LogFormat;
use pilotage_core::flight::photo::read_photo;
use pilotage_core::flight::{FLIGHT_FILE, FlightFolder};
use pilotage_core::frames::{Geodetic, LocalFrame};
use pilotage_core::imagery::terrain::{Dem, Terrain as _};
use pilotage_core::imagery::{ByteSource, GeoTiffError, GeoTiffFile};
use pilotage_core::mission::package::{PACKAGE_HEAD, read_head};
use pilotage_core::mission::{
    MapFileError, MapOptions, Mission, OpenMap, open_dem, open_map_with, read_mission,
    with_world_file,
};
use pilotage_core::navigator::{Run, decode_run};

use super::flight_among::flown_in_words;
use super::flights::OpenFlight;
use super::imports::{imports, is_mission, is_picture_table, labels, owns_geojson, read_exchange};
use super::log_flights::{flight_of_log, foreign_kind, head, log_among};
use super::photo_places::places_of_photos;
use super::table_names::tables_among;
use super::tables::flight_folder;
use super::worker_state::{MAP_MEMORY, describe};
use super::{Beside, MapInfo, OpenedFiles, TerrainInfo, Unplaced};

/// Endings of picture files.
const PICTURES: [&str; 3] = ["jpg", "jpeg", "png"];
/// Endings of files that hold a map, heights, or a photo.
const TIFF: [&str; 2] = ["tif", "tiff"];
/// Endings of maps that say themselves where they lie.
const MAPS: [&str; 3] = ["tif", "tiff", "pmtiles"];
/// Files of a drop that are named for what they are, where none can be opened.
const MOST_TOLD: usize = 3;
/// Farthest from the world that is open that a map joins it, metres; others make a world of their
/// own, because a plane that touches the globe there would bend them.
const WORLD_REACH: f64 = 60_000.0;

/// Looks at every file of a drop; the first that is broken ends it, with its name and the cause.
/// A map without a flight is put into the world around `near`, if it is not far from there.
/// Files of other programs are placed in the world around `origin`.
pub fn look_through(
    key: String,
    files: &Arc<dyn FileSet>,
    near: Option<Geodetic>,
    origin: Geodetic,
) -> Result<OpenedFiles, String> {
    let flight = flight_folder(files)?;
    let pool = files.as_ref();
    let frame = flight.as_ref().and_then(|f| f.flight.frame_on_globe);
    let options = MapOptions {
        frame,
        near: near.map(|origin| (LocalFrame::new(origin), WORLD_REACH)),
        memory: MAP_MEMORY,
        ..MapOptions::default()
    };
    let map = map(pool, &options)?;
    let terrain = terrain(pool, None)?;
    let mission = mission_beside_flight(pool, flight.is_some())?;
    let run = run(pool)?;
    let mut remarks = foreign_geojson(pool, flight.is_some());
    let log = flight.is_none().then(|| log_among(pool)).flatten();
    let is_told = flight.is_some() || log.is_some() || mission.is_some() || run.is_some();
    let mut tables = if flight.is_some() {
        Vec::new()
    } else {
        tables_among(pool)
    };
    let imports = imports(pool, origin, flight.is_some(), is_told, &tables)?;
    let labels = labels(pool)?.map(|(_, labels)| labels);
    let nothing = !is_told && map.is_none() && labels.is_none() && imports.is_empty();
    // Tables that may be anything are asked about where there is nothing else.
    if is_told || !nothing && !tables.iter().any(|table| table.is_proposed) {
        let is_other = |table: &GuessedTable| {
            !is_picture_table(&table.map.file) && imports.iter().all(|i| i.name != table.map.file)
        };
        let others = tables.drain(..).filter(is_other);
        remarks.extend(others.map(|table| format!("{} was left out.", table.map.file)));
    }
    let nothing = nothing && tables.is_empty();
    let is_photo_flight = flight.as_ref().is_some_and(FlightFolder::is_of_photos);
    let is_other = flight.is_some() && !is_photo_flight || log.is_some() || labels.is_some();
    let mut photos = if is_other || mission.is_some() || run.is_some() || !tables.is_empty() {
        Vec::new()
    } else {
        photos_among(pool, map.as_ref().map(|(name, _)| name.as_str()))
    };
    let placed = match &map {
        Some(_) => with_world_file(&pool.names(), &photos),
        None => Vec::new(),
    };
    // A flight may have a world file beside every one of its photos.
    if !is_photo_flight || placed.len() < photos.len() {
        photos.retain(|name| !placed.contains(name));
        remarks.extend(placed.iter().map(|name| {
            format!(
                "{name} was left out: it lies on the ground by itself, and one map opens at a time."
            )
        }));
    }
    if !photos.is_empty() && log.is_none() {
        let mut unread = pool.names();
        unread.retain(|name| is_picture_table(name));
        if !unread.is_empty() {
            let heeded = places_of_photos(pool).tables;
            unread.retain(|name| !heeded.contains(name));
        }
        remarks.extend(unread.into_iter().map(|name| {
            format!("{name} was left out: only beside a log does it say when pictures were taken.")
        }));
    }
    let unplaced = if nothing && terrain.is_none() && !are_to_be_laid(pool, &photos) {
        Some(unplaced(pool).ok_or_else(|| unknown(pool))?)
    } else {
        None
    };
    let head = pool.read(PACKAGE_HEAD);
    let beside = head.and_then(|head| Beside::of_head(&read_head(&head).ok()?));
    let flight = flight.map(|folder| {
        remarks.extend(folder.notes);
        folder.flight
    });
    remarks.extend(terrain.iter().flat_map(Dem::notes));
    remarks.extend(map.iter().flat_map(|(_, map)| map.notes()));
    let map = map.map(|(_, map)| MapInfo {
        origin: map.frame().map(|frame| frame.origin),
        ..describe(&map)
    });
    Ok(OpenedFiles {
        key,
        flight,
        log,
        map,
        terrain: terrain.as_ref().map(describe_terrain),
        mission,
        run,
        unplaced,
        photos,
        imports,
        tables,
        labels,
        beside,
        remarks,
    })
}

/// The pictures among the files, apart from that of the map.
fn photos_among(pool: &dyn FileSet, map: Option<&str>) -> Vec<String> {
    let mut names = names_ending_in(pool, &PICTURES);
    names.extend(names_ending_in(pool, &TIFF).into_iter().filter(|name| {
        pool.source(name)
            .is_some_and(|source| !Dem::is_one(Arc::clone(&source)) && is_without_place(source))
    }));
    names.retain(|name| Some(name.as_str()) != map);
    names
}

/// Whether a TIFF is a picture that does not say itself where it lies.
fn is_without_place(source: Arc<dyn ByteSource>) -> bool {
    let opened = GeoTiffFile::open(source, None, None);
    matches!(
        opened,
        Err(GeoTiffError::NoPlace { .. } | GeoTiffError::ByCamera { .. })
    )
}

/// Whether pictures are photos for a map that is open: several, or one that says where it was taken.
fn are_to_be_laid(pool: &dyn FileSet, names: &[String]) -> bool {
    match names {
        [] => false,
        [name] => pool.source(name).is_some_and(|source| {
            read_photo(source.as_ref()).is_ok_and(|photo| photo.place.is_some())
        }),
        _ => true,
    }
}

/// The one picture among the files, which does not say where it lies, with a file of control points
/// beside it.
fn unplaced(pool: &dyn FileSet) -> Option<Unplaced> {
    let mut pictures = names_ending_in(pool, &TIFF);
    pictures.extend(names_ending_in(pool, &PICTURES));
    if pictures.is_empty() {
        // A picture by any other name.
        let is_picture =
            |name: &String| pool.source(name).is_some_and(|it| is_picture(it.as_ref()));
        pictures.extend(pool.names().into_iter().filter(is_picture));
    }
    let [name] = pictures.as_slice() else {
        return None;
    };
    Some(Unplaced {
        name: name.clone(),
        points: names_ending_in(pool, &["points"]).into_iter().next(),
    })
}

/// Whether a file is a JPEG or a PNG by its first bytes.
fn is_picture(source: &dyn ByteSource) -> bool {
    let begins =
        |bytes: &[u8]| bytes.starts_with(&[0xff, 0xd8, 0xff]) || bytes.starts_with(b"\x89PNG");
    head(source).is_some_and(|bytes| begins(&bytes))
}

/// The named places in the files of routes and landmarks: reference points of landmarks, way-points.
pub fn places(pool: &dyn FileSet) -> Result<Vec<(String, Geodetic)>, String> {
    let mut places = Vec::new();
    for name in pool.names() {
        let bytes = pool.read(&name).unwrap_or_default();
        let found = read_exchange(&name, &bytes, None).map_err(|cause| cause.to_string())?;
        let frame = found.frame;
        places.extend(found.landmarks.iter().map(|landmark| {
            let at = frame.geodetic_from_ground(&landmark.reference);
            (landmark.name.clone(), at)
        }));
        for route in &found.routes {
            let numbered = route.way_points.iter().enumerate();
            places.extend(numbered.map(|(number, point)| {
                let at = frame.geodetic_from_ground(&point.position);
                (format!("{}, way-point {}", route.name, number + 1), at)
            }));
        }
    }
    Ok(places)
}

/// A folder's flight with its pictures and its mission, if one lies in it.
pub fn open_folder(pool: &Arc<dyn FileSet>, folder: FlightFolder) -> Result<OpenFlight, String> {
    let mission = mission_beside_flight(pool.as_ref(), true)?;
    Ok(OpenFlight::of_folder(folder, mission))
}

/// The mission among the files: the first that says itself that it is one, or any GeoJSON of a flight whose own that is
/// (`is_folder`, as `owns_geojson` has it). Beside a log, and beside tables, a fence or roads of other programs are none.
///
/// ```
/// use pilotage_core::flight::files::MemoryFiles;
/// use pilotage_jobs::mission_beside_flight;
///
/// let fence = br#"{"type": "FeatureCollection", "features": []}"#;
/// let files = MemoryFiles([("fence.geojson".to_owned(), fence.to_vec())].into());
/// assert!(mission_beside_flight(&files, false)?.is_none());
/// # Ok::<(), String>(())
/// ```
///
/// # Errors
/// A mission that cannot be read, with the file's name.
pub fn mission_beside_flight(
    pool: &dyn FileSet,
    is_folder: bool,
) -> Result<Option<Mission>, String> {
    mission(pool, owns_geojson(pool, is_folder))
}

/// That GeoJSON beside the tables of a flight (`is_folder`), which may be of anything, is left out: a sentence a file.
fn foreign_geojson(pool: &dyn FileSet, is_folder: bool) -> Vec<String> {
    if !is_folder || owns_geojson(pool, is_folder) {
        return Vec::new();
    }
    let mut names = names_ending_in(pool, &["geojson"]);
    names.retain(|name| !is_mission(name, &pool.read(name).unwrap_or_default()));
    let told = |name| format!("{name} was left out: it does not say that it is a mission.");
    names.into_iter().map(told).collect()
}

/// The flight among the files: a folder of one, else what a log tells of, all of which is read.
pub fn flight(pool: &Arc<dyn FileSet>) -> Result<Option<OpenFlight>, String> {
    match flight_folder(pool)? {
        Some(folder) => open_folder(pool, folder).map(Some),
        None => flight_of_log(pool),
    }
}

/// The map among the files: one that says where it lies, or a picture with a file beside it that
/// does; beside its name.
///
/// # Errors
/// A map that cannot be read, in words.
pub fn map(pool: &dyn FileSet, options: &MapOptions) -> Result<Option<(String, OpenMap)>, String> {
    let names = names_ending_in(pool, &MAPS).into_iter();
    let names = names.chain(names_ending_in(pool, &PICTURES));
    // Most of these hold places and routes only.
    for name in names.chain(names_ending_in(pool, &["kmz", "kml"])) {
        if has_ending(&name, &MAPS) && pool.source(&name).is_some_and(Dem::is_one) {
            continue;
        }
        match open_map_with(pool, &name, options) {
            Ok(map) => return Ok(Some((name, map))),
            Err(
                MapFileError::NoGeoreference { .. }
                | MapFileError::NoPicture { .. }
                | MapFileError::NoOverlay { .. }
                | MapFileError::Overlay { .. }
                | MapFileError::GeoTiff(GeoTiffError::NoPlace { .. } | GeoTiffError::ByCamera { .. }),
            ) => {}
            Err(other) => return Err(other.to_string()),
        }
    }
    Ok(None)
}

/// Endings of files that are elevation models and nothing else.
const HEIGHTS: [&str; 2] = ["hgt", "asc"];

/// The elevation model among the files, in the world frame `frame` or else its own.
pub fn terrain(pool: &dyn FileSet, frame: Option<LocalFrame>) -> Result<Option<Dem>, String> {
    let of_maps = ["tif", "tiff"];
    let endings = HEIGHTS.iter().chain(&of_maps).copied();
    let mut names = names_ending_in(pool, &endings.collect::<Vec<_>>()).into_iter();
    let Some(name) = names.find(|name| pool.source(name).is_some_and(Dem::is_one)) else {
        return Ok(None);
    };
    let dem = open_dem(pool, &name, frame, None).map_err(|cause| cause.to_string())?;
    Ok(Some(dem))
}

/// The mission among the files: one that says so, or else any GeoJSON if `is_any`.
fn mission(pool: &dyn FileSet, is_any: bool) -> Result<Option<Mission>, String> {
    let names = names_ending_in(pool, &["json", "geojson"]);
    let mut found = None;
    for name in names {
        let bytes = pool.read(&name).unwrap_or_default();
        if is_mission(&name, &bytes) {
            found = Some((name, bytes));
            break;
        }
        if is_any && found.is_none() && has_ending(&name, &["geojson"]) {
            found = Some((name, bytes));
        }
    }
    let Some((name, bytes)) = found else {
        return Ok(None);
    };
    if let Some(head) = pool.read(PACKAGE_HEAD) {
        read_head(&head).map_err(|cause| cause.to_string())?;
    }
    let mission = read_mission(&bytes).map_err(|cause| format!("{name}: {cause}"))?;
    Ok(Some(mission))
}

fn run(pool: &dyn FileSet) -> Result<Option<Run>, String> {
    let Some(name) = names_ending_in(pool, &["run"]).into_iter().next() else {
        return Ok(None);
    };
    let bytes = pool.read(&name).unwrap_or_default();
    let run = decode_run(&name, &bytes).map_err(|cause| cause.to_string())?;
    Ok(Some(run))
}

/// Why nothing of the drop can be opened, and what would help.
fn unknown(pool: &dyn FileSet) -> String {
    let mut names = pool.names();
    names.sort();
    let told: Vec<String> = names
        .iter()
        .filter_map(|name| {
            let source = pool.source(name)?;
            Some(foreign_kind(source.as_ref())?.sentence(name))
        })
        .take(MOST_TOLD)
        .collect();
    if !told.is_empty() {
        return told.join(" ");
    }
    let first = names.first().map_or("", String::as_str);
    let more = match names.len() {
        0 | 1 => String::new(),
        n => format!(" and {} more", n - 1),
    };
    format!(
        "{first}{more}: of no kind that opens here. These do: flight logs ({}), {}, MATLAB's variables (.mat), tables of a flight as CSV, a \
         flight folder with its {FLIGHT_FILE}, a zip of any of these, a film beside its log or its subtitles, a map \
         picture with its world file, a GeoTIFF, PMTiles, an elevation model (.{}), a mission or a run saved here, \
         roads of OpenStreetMap (.osm, .pbf), and routes and landmarks as {}.",
        LogFormat::ENDINGS.join(", "),
        flown_in_words(),
        HEIGHTS.join(", ."),
        exchange_names().join(", ")
    )
}

/// Names of the formats of routes and landmarks.
fn exchange_names() -> Vec<&'static str> {
    Format::all().map(Format::name).collect()
}

/// Description of an elevation model in its own frame.
fn describe_terrain(dem: &Dem) -> TerrainInfo {
    TerrainInfo {
        name: dem.name().to_owned(),
        datum: dem.datum().clone(),
        spacing: dem.spacing(),
        middle: dem.frame().geodetic_from_ground(&dem.bounds().center()),
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::flight::files::MemoryFiles;
    use pilotage_core::mission::write_mission;
    use pilotage_core::raster::Picture;
    use pilotage_tests::pmtiles::archive_of_one_tile;

    use super::super::LentFiles;
    use super::super::file_pool::FilePool;
    use super::super::flight_among::FLOWN;
    use super::super::photo_picture::tests::tiff;
    use super::*;

    fn look(files: &[(&str, &[u8])]) -> Result<OpenedFiles, String> {
        let files: Vec<_> = (files.iter())
            .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec().into()))
            .collect();
        let pool = FilePool::new(&files, &LentFiles::default())?;
        let origin = Geodetic::from_degrees(47.0, 8.0, 0.0);
        let pool: Arc<dyn FileSet> = Arc::new(pool);
        look_through("drop".to_owned(), &pool, None, origin)
    }

    fn picture() -> Vec<u8> {
        let picture = pilotage_core::raster::Picture::filled(40, 20, [90, 120, 60]);
        pilotage_core::raster::encode_png(&picture).unwrap()
    }

    #[test]
    fn a_mission_that_says_so_comes_before_other_geojson_whatever_their_names() {
        let origin = Geodetic::from_degrees(47.0, 8.0, 0.0);
        let ours = write_mission(&Mission::new("ours".to_owned(), origin));
        let fence = br#"{"type": "FeatureCollection", "features": []}"#.to_vec();
        let files = MemoryFiles(
            [
                ("fence.geojson".to_owned(), fence),
                ("mission.geojson".to_owned(), ours.into_bytes()),
            ]
            .into(),
        );
        for is_folder in [false, true] {
            let found = mission_beside_flight(&files, is_folder).unwrap();
            assert_eq!(found.unwrap().name, "ours");
        }
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
    fn an_archive_of_tiles_is_a_map_that_says_where_it_lies_and_who_made_it() {
        let archive = archive_of_one_tile(&picture());
        let opened = look(&[("a/area.pmtiles", &archive)]).unwrap();
        let map = opened.map.unwrap();
        assert_eq!(map.attribution.as_deref(), Some("© Whoever"));
        let origin = map.origin.unwrap();
        assert!((origin.latitude.to_degrees() - 46.855).abs() < 1e-6);
        assert!((map.bounds.north - map.bounds.south - 3335.0).abs() < 5.0);
        let cause = look(&[("area.pmtiles", &archive[..140])]).unwrap_err();
        assert!(cause.starts_with("area.pmtiles, tile: "), "{cause}");
    }

    #[test]
    fn a_picture_alone_waits_for_its_place_and_several_are_photos() {
        let points = b"mapX,mapY,sourceX,sourceY,enable\n1,2,3,-4,1\n";
        let opened = look(&[("map.png", &picture()), ("map.points", points)]).unwrap();
        let unplaced = opened.unplaced.unwrap();
        assert_eq!(unplaced.name, "map.png");
        assert_eq!(unplaced.points.as_deref(), Some("map.points"));
        let opened = look(&[("a.png", &picture()), ("b.png", &picture())]).unwrap();
        assert_eq!(opened.photos, ["a.png", "b.png"]);
        assert!(opened.unplaced.is_none());
    }

    #[test]
    fn photos_may_be_tiff() {
        let stored = Picture::from_fn(20, 10, |x, y| [(5 * x) as u8, (8 * y) as u8, 77]);
        let bytes = tiff(&stored);
        let opened = look(&[("a.tif", &bytes), ("b.TIFF", &bytes)]).unwrap();
        assert_eq!(opened.photos, ["a.tif", "b.TIFF"]);
        assert!(opened.map.is_none() && opened.unplaced.is_none());
        let opened = look(&[("a.tif", &bytes)]).unwrap();
        assert_eq!(opened.unplaced.map(|it| it.name).as_deref(), Some("a.tif"));
    }

    #[test]
    fn what_lies_beside_photos_and_their_map_is_no_photo_and_is_told_to_be_left_out() {
        let (place, png) = (b"0.5\n0\n0\n-0.5\n100.25\n199.75\n", picture());
        let opened = look(&[
            ("a.png", &png),
            ("b.png", &png),
            ("january.png", &png),
            ("january.pgw", place),
            ("march.PNG", &png),
            ("march.png.wld", place),
            // Of other photos.
            (
                "frames.csv",
                b"file,lat,lon,heading\nc.png,47.0,8.0,3\nd.png,47.001,8.0,4\n",
            ),
        ]);
        let opened = opened.unwrap();
        assert!(opened.map.is_some());
        assert_eq!(opened.photos, ["a.png", "b.png"]);
        let told = opened.remarks.join(" ");
        assert!(told.contains("march.PNG was left out: it lies"), "{told}");
        assert!(told.contains("frames.csv was left out: only"), "{told}");
    }

    #[test]
    fn photos_with_a_table_of_their_places_are_their_flight_and_laid_on_the_map_beside_them() {
        let (place, png) = (b"0.5\n0\n0\n-0.5\n100.25\n199.75\n", picture());
        let pix4d: &[u8] = b"a.png,47.0001,8.0001,520\nb.png,47.0009,8.0001,521\n";
        let ours: &[u8] = b"file,lat,lon,heading\na.png,47.0,8.0,3\nb.png,47.001,8.0,4\n";
        let open_drone_map: &[u8] =
            b"EPSG:4326\na.png 8.0001 47.0001 520\nb.png 8.0001 47.0009 521\n";
        for (name, table) in [
            ("frames.csv", ours),
            ("pix4d.csv", pix4d),
            ("geo.txt", open_drone_map),
        ] {
            let photos = [("a.png", &png[..]), ("b.png", &png), (name, table)];
            let map = [("map.png", &png[..]), ("map.pgw", place)];
            for files in [photos.to_vec(), [&photos[..], &map].concat()] {
                let opened = look(&files).expect(name);
                let flight = opened.flight.expect(name);
                assert_eq!(flight.frames.len(), 2, "{name}");
                assert_eq!(opened.photos, ["a.png", "b.png"], "{name}");
                assert_eq!(opened.map.is_some(), files.len() > 3, "{name}");
                assert!(opened.imports.is_empty() && opened.tables.is_empty());
                let told = opened.remarks.join(" ");
                assert!(told.contains("a table beside them tells"), "{told}");
                assert!(!told.contains("left out"), "{told}");
            }
        }
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

    const AIR: &[u8] = b"t,airspeed [kt],roll_deg\n0,40,1\n1,41,2\n2,42,3\n3,40,4\n";
    const NUMBERS: &[u8] = b"a,b,c\n1,2,3\n4,5,7\n7,8,9\n";
    const ROUTE: &[u8] = b"lat,lon,alt\n47.0,8.0,80\n47.001,8.0,80\n47.002,8.001,80\n";

    #[test]
    fn tables_of_a_flight_are_asked_about_and_those_of_a_route_are_not() {
        let opened = look(&[("x/air.csv", AIR), ("x/odd.csv", NUMBERS)]).unwrap();
        let names: Vec<_> = opened.tables.iter().map(|t| t.map.file.as_str()).collect();
        assert_eq!(names, ["x/air.csv", "x/odd.csv"]);
        let proposed: Vec<_> = opened.tables.iter().map(|t| t.is_proposed).collect();
        assert_eq!(proposed, [true, false]);
        let opened = look(&[("route.csv", ROUTE)]).unwrap();
        assert!(opened.tables.is_empty());
        assert_eq!(opened.imports.len(), 1);
    }

    #[test]
    fn a_table_of_anything_is_asked_about_if_there_is_nothing_else() {
        let opened = look(&[("odd.csv", NUMBERS)]).unwrap();
        assert_eq!(opened.tables.len(), 1);
        assert!(!opened.tables[0].is_proposed);
        let opened = look(&[("odd.csv", NUMBERS), ("route.csv", ROUTE)]).unwrap_err();
        assert!(opened.starts_with("odd.csv"), "{opened}");
    }

    #[test]
    fn tables_beside_a_log_are_left_out_and_said_so_and_routes_are_added() {
        let log: &[u8] = b"ULog\x01\x12\x35\x01\0\0\0\0\0\0\0\0";
        let files = [("a.ulg", log), ("odd.csv", NUMBERS), ("air.csv", AIR)];
        let opened = look(&files).unwrap();
        assert_eq!(opened.log.as_deref(), Some("a.ulg"));
        assert!(opened.tables.is_empty() && opened.imports.is_empty());
        let said = opened.remarks.join(" ");
        assert!(said.contains("odd.csv was left out"), "{said}");
        assert!(said.contains("air.csv was left out"), "{said}");
        let opened = look(&[files[0], files[1], ("route.csv", ROUTE)]).unwrap();
        assert_eq!(opened.imports.len(), 1);
        assert_eq!(opened.remarks, ["odd.csv was left out."]);
        let opened = look(&[files[0], ("frames.csv", b"file,time_s\nIMG_1.jpg,3\n")]).unwrap();
        assert!(opened.remarks.is_empty(), "{:?}", opened.remarks);
    }

    /// A fence as any program writes it.
    const FENCE: &[u8] = br#"{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {},
        "geometry": {"type": "Polygon", "coordinates": [[[8.0, 47.0], [8.001, 47.0], [8.001, 47.001], [8.0, 47.0]]]}}]}"#;

    #[test]
    fn a_fence_is_the_mission_of_a_flight_folder_alone() {
        let pool = |files: &[(&str, &[u8])]| {
            let files: Vec<_> = (files.iter())
                .map(|(name, bytes)| ((*name).to_owned(), bytes.to_vec().into()))
                .collect();
            FilePool::new(&files, &LentFiles::default()).unwrap()
        };
        let folder = pool(&[("fence.geojson", FENCE)]);
        assert!(mission_beside_flight(&folder, true).unwrap().is_some());
        assert!(mission_beside_flight(&folder, false).unwrap().is_none());
        let tables = pool(&[("fence.geojson", FENCE), ("columns.json", b"[]")]);
        assert!(mission_beside_flight(&tables, true).unwrap().is_none());
        assert_eq!(foreign_geojson(&tables, true).len(), 1);
        // Ours says so itself, and is one beside anything.
        let ours = write_mission(&Mission::new(
            "m".to_owned(),
            Geodetic::from_degrees(47.0, 8.0, 0.0),
        ));
        for is_folder in [true, false] {
            let files = pool(&[("m.geojson", ours.as_bytes()), ("columns.json", b"[]")]);
            assert!(mission_beside_flight(&files, is_folder).unwrap().is_some());
            assert!(foreign_geojson(&files, is_folder).is_empty());
        }
    }

    #[test]
    fn files_of_no_known_kind_are_refused_with_what_would_help() {
        let cause = look(&[("notes.txt", b"dear"), ("table.xls", b"1")]).unwrap_err();
        assert!(cause.starts_with("notes.txt and 1 more"), "{cause}");
        assert!(cause.contains("flight.json"), "{cause}");
    }

    #[test]
    fn files_of_other_kinds_are_refused_by_their_own_names_whatever_they_are_called() {
        let refused = |name: &str, bytes: &[u8]| look(&[(name, bytes)]).unwrap_err();
        let bag = refused("flight.bin", b"#ROSBAG V2.0\nE\0\0\0op=\x03");
        assert!(bag.starts_with("flight.bin: it is a bag of ROS 1"), "{bag}");
        assert!(bag.contains("Make an MCAP of it"), "{bag}");
        let empty = refused("flight.ulg", b"");
        assert!(empty.contains("an empty file"), "{empty}");
    }

    #[test]
    fn a_picture_by_any_name_may_be_put_on_the_ground() {
        let opened = look(&[("fake.bin", &picture())]).unwrap();
        assert_eq!(opened.unplaced.unwrap().name, "fake.bin");
    }

    #[test]
    fn subtitles_of_a_film_are_a_flight() {
        let cue = |i: usize| {
            format!(
                "{}\n00:00:{i:02},000 --> 00:00:{:02},000\n[latitude: {:.6}] [longitude: 8.5] [rel_alt: 20.0 abs_alt: 440.0]\n\n",
                i + 1,
                i + 1,
                47.0 + 1e-5 * i as f64
            )
        };
        let text: String = (0..30).map(cue).collect();
        let opened = look(&[("DJI_0001.SRT", text.as_bytes())]).unwrap();
        let (first, last) = opened.flight.unwrap().span();
        assert!((last - first - 29.0).abs() < 1e-9);
    }

    #[test]
    fn what_opens_is_named_where_something_else_is_refused() {
        let refused = look(&[("letter.xyz", &b"Dear all"[..])]).unwrap_err();
        for ending in LogFormat::ENDINGS {
            assert!(refused.contains(ending), "{refused}");
        }
        assert!(
            refused.contains("QGroundControl plan, QGC WPL 110, KML"),
            "{refused}"
        );
        for ending in FLOWN.iter().flat_map(|kind| kind.endings).chain(&HEIGHTS) {
            assert!(
                refused.contains(&format!(".{ending}")),
                "{ending}: {refused}"
            );
        }
    }
}
