//! Missions saved over opened maps, and read back.

use std::sync::Arc;

use nalgebra::Matrix3;
use pilotage_core::flight::files::MemoryFiles;
use pilotage_core::frames::{Geodetic, GroundPoint, LocalFrame, ReferenceSystem};
use pilotage_core::imagery::web_tiles::TileTemplate;
use pilotage_core::imagery::{Georeference, Imagery as _, MemoryBytes, WorldFile};
use pilotage_core::mission::package::read_package;
use pilotage_core::mission::{Mission, open_map};
use pilotage_core::raster::{Picture, encode_png};

use super::*;
use crate::Beside;
use crate::{Abilities, FileContent, WebMap};

const WORLD_FILE: &[u8] = b"0.5\n0\n0\n-0.5\n570000.25\n5189999.75\n";

fn picture() -> Vec<u8> {
    let shade = |x: usize, y: usize| [(5 * x) as u8, (9 * y) as u8, 60];
    encode_png(&Picture::from_fn(40, 20, shade)).unwrap()
}

fn prj() -> Vec<u8> {
    let utm = ReferenceSystem::from_epsg(32_615).unwrap();
    utm.well_known_text().into_bytes()
}

fn origin() -> Geodetic {
    let utm = ReferenceSystem::from_epsg(32_615).unwrap();
    utm.geodetic(570_000.0, 5_190_000.0).unwrap()
}

/// The mission file over a map among `files`, and what is said to lack.
fn packed(files: &[(&str, FileContent)], map: MapSource) -> (Vec<u8>, Option<String>) {
    let mut worker = WorkerState::new(Abilities::WHOLE.opens);
    let big = MemoryBytes::new("big", vec![0; 70 << 20]);
    worker.lend(1, Arc::new(big));
    let files: Vec<_> = files
        .iter()
        .map(|(n, c)| ((*n).to_owned(), c.clone()))
        .collect();
    worker.provide("drop".to_owned(), &files);
    let order = PackOrder {
        mission: Mission::new("New mission", origin()),
        beside: Beside::default(),
        map,
    };
    pack(&worker, &order).unwrap()
}

/// Ground of the picture's corner, as the map in a mission file has it.
fn corner(bytes: &[u8]) -> GroundPoint {
    let package = read_package(bytes).unwrap();
    let files = MemoryFiles(package.files.into_iter().collect());
    let frame = LocalFrame::new(package.mission.origin);
    let map = open_map(&files, "area.png", Some(frame)).unwrap();
    assert!(
        (map.native_gsd() - 0.5).abs() < 0.01,
        "{}",
        map.native_gsd()
    );
    GroundPoint::new(map.bounds().north, map.bounds().west)
}

fn near_origin(place: GroundPoint) -> bool {
    place.north.abs() < 0.3 && place.east.abs() < 0.3
}

#[test]
fn a_mission_over_a_map_that_was_dropped_holds_it_and_nothing_else_of_the_drop() {
    let files: [(&str, FileContent); 5] = [
        ("trip/area.png", picture().into()),
        ("trip/area.pgw", WORLD_FILE.to_vec().into()),
        ("trip/area.prj", prj().into()),
        ("trip/notes.txt", vec![1].into()),
        ("trip/area_2.png", vec![1].into()),
    ];
    let map = MapSource::Placed {
        key: "drop".to_owned(),
        origin: origin(),
    };
    let (bytes, lacks) = packed(&files, map.clone());
    assert_eq!(lacks, None);
    let names: Vec<_> = read_package(&bytes).unwrap().files;
    let names: Vec<_> = names.iter().map(|f| f.0.as_str()).collect();
    assert_eq!(names, ["area.pgw", "area.png", "area.prj"]);
    assert!(near_origin(corner(&bytes)), "{:?}", corner(&bytes));
    // Saved again from the file itself, it is the same.
    let (again, _) = packed(&[("plan.pilotage.zip", bytes.clone().into())], map);
    assert_eq!(
        read_package(&again).unwrap().files,
        read_package(&bytes).unwrap().files
    );
}

#[test]
fn a_picture_that_was_put_on_the_ground_takes_its_place_along() {
    let system = ReferenceSystem::from_epsg(32_615).unwrap();
    let file = WorldFile {
        a: 0.5,
        d: 0.0,
        b: 0.0,
        e: -0.5,
        c: 570_000.25,
        f: 5_189_999.75,
    };
    let askew = Matrix3::new(0.5, 0.0, 570_000.0, 0.0, -0.5, 5_190_000.0, 0.0, 1e-12, 1.0);
    let places = [
        (Georeference::Projected { system, file }, "area.pgw"),
        (
            Georeference::Projective {
                system,
                plane_from_pixel: askew,
            },
            "area_georef.json",
        ),
    ];
    for (place, beside) in places {
        let map = MapSource::Picture {
            key: "drop".to_owned(),
            name: "scans/area.png".to_owned(),
            origin: Some(origin()),
            place,
        };
        // The world file that lay beside it is another's.
        let wrong: FileContent = b"9\n0\n0\n-9\n1\n2\n".to_vec().into();
        let files = [
            ("scans/area.png", picture().into()),
            ("scans/area.pgw", wrong),
        ];
        let (bytes, lacks) = packed(&files, map);
        assert_eq!(lacks, None);
        let names: Vec<_> = read_package(&bytes).unwrap().files;
        assert!(names.iter().any(|f| f.0 == beside), "{beside}");
        assert!(
            near_origin(corner(&bytes)),
            "{beside}: {:?}",
            corner(&bytes)
        );
    }
}

#[test]
fn what_a_mission_file_lacks_is_said_with_where_to_have_it() {
    let map = || MapSource::Placed {
        key: "drop".to_owned(),
        origin: origin(),
    };
    let lent = FileContent::Lent {
        number: 1,
        length: 70 << 20,
    };
    let files = [
        ("area.png", picture().into()),
        (
            "area.pgw",
            b"0.5\n0\n0\n-0.5\n0.25\n-0.25\n".to_vec().into(),
        ),
        ("area.aux", lent),
    ];
    let (bytes, lacks) = packed(&files, map());
    let lacks = lacks.unwrap();
    assert!(
        lacks.contains("area.aux has 70 MB") && lacks.contains("beside"),
        "{lacks}"
    );
    assert!(read_package(&bytes).unwrap().files.is_empty());

    let (_, lacks) = packed(&[("notes.txt", vec![1].into())], map());
    assert!(lacks.is_some_and(|l| l.contains("there is none among the files")));

    let template = TileTemplate {
        name: "Some tiles".to_owned(),
        address: "http://127.0.0.1/{z}/{x}/{y}.png".to_owned(),
        attribution: String::new(),
        least_zoom: 10,
        most_zoom: 17,
        side: 256,
    };
    let web = WebMap {
        template,
        origin: origin(),
    };
    let (_, lacks) = packed(&[], MapSource::Web(web));
    assert!(lacks.is_some_and(|l| l.contains("Some tiles")));

    let (bytes, lacks) = packed(&[], MapSource::world("countryside"));
    assert_eq!(lacks, None);
    assert!(read_package(&bytes).unwrap().files.is_empty());
}
