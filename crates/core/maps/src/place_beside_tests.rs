//! World files and `.prj` files beside pictures.

use pilotage_base::files::{FileSet, MemoryFiles};
use pilotage_base::frames::{Geodetic, LocalFrame, ReferenceSystem};
use pilotage_raster::imagery::Imagery as _;
use pilotage_raster::raster::{Picture, encode_png};

use crate::place_beside::{mask_beside, with_world_file};
use crate::{MapOptions, OpenMap, open_map_with};

/// Half a metre a pixel around the central meridian of a UTM zone.
const UTM: &str = "0.5\n0\n0\n-0.5\n500000.25\n4000000.0\n";

fn open(files: &[(&str, &str)], picture: &str, options: &MapOptions) -> Result<OpenMap, String> {
    let bytes = encode_png(&Picture::filled(40, 20, [90, 120, 60])).unwrap();
    let mut all = MemoryFiles::default();
    all.0.insert(picture.to_owned(), bytes);
    for (name, text) in files {
        all.0.insert((*name).to_owned(), text.as_bytes().to_vec());
    }
    open_map_with(&all, picture, options).map_err(|error| error.to_string())
}

fn in_zone_17() -> MapOptions {
    MapOptions {
        system: ReferenceSystem::from_epsg(32_617),
        ..MapOptions::default()
    }
}

#[test]
fn side_files_are_found_in_capitals_and_in_any_letters() {
    for (picture, world, prj) in [
        ("a/map.png", "a/map.PGW", "a/map.PRJ"),
        ("a/map.PNG", "a/map.PGW", "a/map.prj"),
        ("MAP.PNG", "map.pgw", "Map.Prj"),
        ("map.jpg", "map.JGW", "map.PRJ"),
        ("map.png", "map.WLD", "map.PRJ"),
    ] {
        let map = open(
            &[(world, UTM), (prj, "EPSG:32617")],
            picture,
            &MapOptions::default(),
        );
        let map = map.unwrap_or_else(|error| panic!("{picture}: {error}"));
        // The zone's middle is 81° W; a metre of the grid is 1 / 0.9996 m there.
        let origin = map.frame().unwrap().origin;
        assert!(
            (origin.longitude.to_degrees() + 81.0).abs() < 1e-3,
            "{picture}"
        );
        assert!((map.native_gsd() - 0.5 / 0.9996).abs() < 1e-6, "{picture}");
    }
}

/// As GDAL 3.9 places them: the whole map and a copy of a quarter of its size, each with a world file.
#[test]
fn a_picture_is_placed_by_the_world_file_of_its_own_kind() {
    const REDUCED: &str = "2\n0\n0\n-2\n500001\n3999999.25\n";
    let beside = [("map.pgw", UTM), ("map.jgw", REDUCED), ("map.wld", REDUCED)];
    let map = open(&beside, "map.png", &in_zone_17()).unwrap();
    assert!((map.native_gsd() - 0.5 / 0.9996).abs() < 1e-6);
    let map = open(&beside, "map.jpg", &in_zone_17()).unwrap();
    assert!((map.native_gsd() - 2.0 / 0.9996).abs() < 1e-6);
    let beside = [("map.JGW", REDUCED), ("map.PNGW", UTM)];
    let map = open(&beside, "map.PNG", &in_zone_17()).unwrap();
    assert!((map.native_gsd() - 0.5 / 0.9996).abs() < 1e-6);
    // One of another kind will do, unless it is that of another picture.
    let map = open(&[("map.jgw", REDUCED)], "map.png", &in_zone_17()).unwrap();
    assert!((map.native_gsd() - 2.0 / 0.9996).abs() < 1e-6);
    let beside = [("map.jgw", REDUCED), ("map.JPG", "")];
    let error = open(&beside, "map.png", &in_zone_17()).err().unwrap();
    assert!(error.contains("does not say where it lies"), "{error}");
    // Behind the whole name it can be that of no other; and there are pictures without an ending.
    let beside = [("map.png.jgw", REDUCED), ("map.jpg", "")];
    for (picture, beside) in [("map.png", &beside[..]), ("scan", &[("scan.wld", REDUCED)])] {
        let map = open(beside, picture, &in_zone_17()).unwrap();
        assert!((map.native_gsd() - 2.0 / 0.9996).abs() < 1e-6);
    }
}

#[test]
fn pictures_with_a_world_file_are_those_that_it_places() {
    let names = |list: &[&str]| {
        list.iter()
            .map(|name| (*name).to_owned())
            .collect::<Vec<_>>()
    };
    let all = names(&[
        "a.jpg",
        "a.png",
        "a.jgw",
        "b.PNG",
        "b.wld",
        "c.jpg",
        "c.pgw",
        "d.jpeg",
        "d.jpeg.jgw",
        "e.jpg",
        "f.jpg",
        "f.png",
        "f.png.jgw",
        "scan",
        "scan.wld",
    ]);
    let pictures = [
        "a.jpg", "a.png", "b.PNG", "c.jpg", "d.jpeg", "e.jpg", "f.jpg", "f.png", "scan",
    ];
    let placed = with_world_file(&all, &names(&pictures));
    let right = ["a.jpg", "b.PNG", "c.jpg", "d.jpeg", "f.png", "scan"];
    assert_eq!(placed, names(&right));
}

#[test]
fn a_world_file_in_metres_without_a_system_is_asked_for_its_system() {
    let error = open(&[("map.pgw", UTM)], "map.png", &MapOptions::default());
    let error = error.err().unwrap();
    for word in [
        "map.png",
        "500000.25",
        "4000000",
        "which is it?",
        "--system",
        "map.prj",
    ] {
        assert!(error.contains(word), "{word}: {error}");
    }
    // In the world that is open its UTM zone is offered: 81.5° W lies in zone 17.
    let frame = LocalFrame::new(Geodetic::from_degrees(36.0, -81.5, 0.0));
    for options in [
        MapOptions {
            frame: Some(frame),
            ..MapOptions::default()
        },
        MapOptions {
            near: Some((frame, 1e4)),
            ..MapOptions::default()
        },
    ] {
        let error = open(&[("map.pgw", UTM)], "map.png", &options)
            .err()
            .unwrap();
        assert!(error.contains("EPSG:32617"), "{error}");
    }
    // Near the equator only the easting is large.
    let equator = "0.5\n0\n0\n-0.5\n166021.0\n12.0\n";
    assert!(open(&[("map.pgw", equator)], "map.png", &MapOptions::default()).is_err());
}

#[test]
fn a_system_that_is_asked_for_stands_in_for_a_missing_prj() {
    let map = open(&[("map.pgw", UTM)], "map.png", &in_zone_17()).unwrap();
    assert!(map.bounds().west.abs() < 20.0);
}

#[test]
fn metres_of_the_world_itself_need_no_system() {
    let own = "0.5\n0\n0\n-0.5\n1000.25\n-2000.25\n";
    let map = open(&[("map.pgw", own)], "map.png", &MapOptions::default()).unwrap();
    assert!(map.frame().is_none());
    let bounds = map.bounds();
    assert!((bounds.west - 1000.0).abs() < 1e-9 && (bounds.north + 2000.0).abs() < 1e-9);
}

#[test]
fn what_services_say_of_a_photo_is_no_place_and_an_unreadable_system_of_gdal_none() {
    let takeout = "{\"title\": \"map.png\", \"geoData\": {}}";
    for name in ["map.png.json", "map.png.georef.json"] {
        let error = open(&[(name, takeout)], "map.png", &MapOptions::default());
        assert!(error.err().unwrap().contains("does not say where it lies"));
    }
    let local = "<PAMDataset><SRS>LOCAL_CS[&quot;a&quot;]</SRS></PAMDataset>";
    let files = [("map.pgw", UTM), ("map.png.aux.xml", local)];
    assert!(open(&files, "map.png", &in_zone_17()).is_ok());
    let error = open(&files, "map.png", &MapOptions::default()).err();
    assert!(error.unwrap().contains("which is it?"));
}

#[test]
fn a_system_of_gdal_that_is_not_known_is_refused_by_name_as_that_of_a_prj_is() {
    let unknown = r#"PROJCS["Timbalai_1948_RSO_Borneo_m","#;
    let aux = format!("<PAMDataset><SRS>{unknown}</SRS></PAMDataset>");
    // Small numbers would be metres of the world that is open.
    let own = "0.5\n0\n0\n-0.5\n1000.25\n-2000.25\n";
    for world in [UTM, own] {
        let files = [("map.pgw", world), ("map.png.aux.xml", &aux)];
        let error = open(&files, "map.png", &MapOptions::default()).err();
        let error = error.unwrap();
        assert!(
            error.starts_with("map.png.aux.xml") && error.contains("Timbalai"),
            "{error}"
        );
        assert!(open(&files, "map.png", &in_zone_17()).is_ok());
    }
}

#[test]
fn world_files_and_systems_are_found_by_all_names_that_programs_give_them() {
    let commas = UTM.replace('.', ",");
    let proj = "+proj=utm +zone=17 +datum=WGS84 +units=m +no_defs";
    let aux = |place: &str| format!("<PAMDataset><SRS>EPSG:32617</SRS>{place}</PAMDataset>");
    let transform = "<GeoTransform>500000.0,0.5,0,4000000.25,0,-0.5</GeoTransform>";
    let (system, whole) = (aux(""), aux(transform));
    for (picture, files) in [
        (
            "map.jpeg",
            vec![("map.jpegw", UTM), ("map.prj", "EPSG:32617")],
        ),
        (
            "map.jpg",
            vec![("map.jpg.wld", UTM), ("map.prj", "EPSG:32617")],
        ),
        (
            "map.png",
            vec![("map.png.pgw", UTM), ("map.png.prj", "WGS84 UTM 17N")],
        ),
        ("map.png", vec![("map.pgw", UTM), ("map.qpj", proj)]),
        ("map.png", vec![("map.pgw", &commas), ("map.prj", proj)]),
        (
            "map.png",
            vec![("map.pgw", UTM), ("map.png.aux.xml", &system)],
        ),
        ("map.png", vec![("map.png.aux.xml", &whole)]),
        ("map.png", vec![("map.aux.xml", &whole)]),
    ] {
        let map = open(&files, picture, &MapOptions::default());
        let map = map.unwrap_or_else(|error| panic!("{files:?}: {error}"));
        let origin = map.frame().unwrap().origin;
        let is_there = (origin.longitude.to_degrees() + 81.0).abs() < 1e-3;
        // 4,000 km of the grid north of the equator.
        let latitude = origin.latitude.to_degrees();
        assert!(
            is_there && (latitude - 36.144).abs() < 0.01,
            "{files:?}: {latitude}"
        );
        assert!((map.native_gsd() - 0.5 / 0.9996).abs() < 1e-6, "{files:?}");
    }
}

#[test]
fn json_of_another_kind_is_no_georeference_and_a_damaged_one_is_told() {
    let error = |text: &str| {
        let opened = open(&[("map.json", text)], "map.png", &MapOptions::default());
        opened.err().unwrap()
    };
    for other in ["{}", "{\"type\": \"Feature\", \"stac_version\": \"1.0.0\"}"] {
        let told = error(other);
        assert!(told.contains("does not say where it lies"), "{told}");
    }
    for damaged in ["{", "{\"origin_lat\": 47.0}"] {
        let told = error(damaged);
        assert!(told.starts_with("map.json"), "{told}");
    }
}

/// Files of which a mask must not be read.
struct Unread(MemoryFiles);

impl FileSet for Unread {
    fn names(&self) -> Vec<String> {
        self.0.names()
    }

    fn read(&self, name: &str) -> Option<Vec<u8>> {
        assert!(!name.to_lowercase().ends_with(".msk"), "{name} is read");
        self.0.read(name)
    }
}

#[test]
fn a_mask_is_found_by_its_name_alone() {
    let mask = |name: &str| {
        let files = [name, "a/map.tif"].map(|name| (name.to_owned(), vec![0]));
        let files = MemoryFiles(files.into());
        mask_beside(&Unread(files), "a/map.tif")
    };
    for name in ["a/map.tif.msk", "a/map.tif.MSK", "a/MAP.tif.msk"] {
        assert_eq!(mask(name).as_deref(), Some(name));
    }
    assert_eq!(mask("map.tif.msk"), None);
}
