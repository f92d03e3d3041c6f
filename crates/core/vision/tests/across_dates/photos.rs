//! Photos of other people over maps of other dates.
#![allow(dead_code, reason = "each of the tests that read them uses a part")]

#[path = "../../../../../tests/src/studies.rs"]
pub mod studies;

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use pilotage_base::frames::{Geodetic, GroundPoint, LocalFrame};
use pilotage_base::georeference::Georeference;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{GeoreferencedPicture, Imagery, decode_map};
use pilotage_raster::raster::{PYRAMID_LEVELS, Pyramid, decode_picture};

/// A photo and what its file says of it.
pub struct Photo {
    pub name: String,
    pub file: PathBuf,
    /// Seconds.
    pub time: f64,
    pub camera: CameraModel,
    pub luminance: Pyramid,
    /// Place below the camera by its own receiver or navigation.
    pub below: GroundPoint,
    /// Ground in the middle of the picture by that.
    pub centre: GroundPoint,
    pub height: f64,
    pub heading: f64,
    pub pitch: f64,
}

/// Photos and a map.
pub struct Site {
    pub world: LocalFrame,
    pub map: GeoreferencedPicture,
    pub photos: Vec<Photo>,
}

impl Site {
    /// Middle of the map.
    pub fn map_middle(&self) -> GroundPoint {
        self.map.bounds().center()
    }
}

fn shared(name: &str) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data");
    let place = root.join(name);
    if place.exists() {
        return Some(place);
    }
    println!("skipped: no shared data ({name})");
    None
}

/// Rows of a table with their columns by name.
fn rows(text: &str) -> impl Iterator<Item = HashMap<&str, &str>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines.map(move |line| names.iter().copied().zip(line.split(',')).collect())
}

/// The number in a column of a row.
type Columns<'a> = dyn Fn(&str) -> f64 + 'a;

/// Differences from one set to the next.
struct Set {
    folder: &'static str,
    map: &'static str,
    /// Pixels.
    focal: f64,
    /// Height above the ground, heading and pitch of the camera, and the time, all of a row.
    pose: fn(&Columns<'_>) -> [f64; 4],
}

/// A consumer drone over a town, 120 m high, on a satellite map: the receiver is good to some 5 m together with
/// the map.
pub fn fengyuan() -> Option<Site> {
    site(&Set {
        folder: "fengyuan",
        map: "map",
        focal: 728.0,
        pose: |value| {
            let ahead = value("camera_ahead_deg");
            [
                value("height_above_takeoff_m"),
                value("flight_yaw_deg"),
                ahead,
                value("time_s"),
            ]
        },
    })
}

/// Another aircraft over town, fields and river, on the map of `month` (january, march). Its focal length is
/// not known: heights are as much too small or too great as it is assumed to be.
pub fn adm(month: &'static str) -> Option<Site> {
    const FOCAL: f64 = 500.0;
    site(&Set {
        folder: "adm2014",
        map: month,
        focal: FOCAL,
        pose: |value| {
            let metres_per_pixel = value("metres_per_frame_pixel");
            // Its frames have numbers and no times: one a second.
            [
                FOCAL * metres_per_pixel,
                value("heading_deg"),
                0.0,
                value("frame"),
            ]
        },
    })
}

fn site(set: &Set) -> Option<Site> {
    let folder = shared(set.folder)?;
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let table = String::from_utf8(read("frames.csv")).unwrap();
    let number = |row: &HashMap<&str, &str>, name: &str| row[name].parse::<f64>().unwrap();
    let place = |row: &HashMap<&str, &str>| {
        Geodetic::from_degrees(
            number(row, "latitude_deg"),
            number(row, "longitude_deg"),
            0.0,
        )
    };
    let world = LocalFrame::new(place(&rows(&table).next().unwrap()));
    let picture = decode_map(&read(&format!("{}.jpg", set.map)), false).unwrap();
    let georeference = String::from_utf8(read(&format!("{}.jgw", set.map))).unwrap();
    let on_ground = Georeference::from_world_file(&georeference)
        .and_then(|g| g.in_world(&world, picture.width(), picture.height()))
        .unwrap();
    let photo = |row: &HashMap<&str, &str>| {
        let [height, heading, pitch, time] = (set.pose)(&|name| number(row, name));
        let (heading, pitch) = (heading.to_radians(), pitch.to_radians());
        let below = world.ground_from_geodetic(&place(row));
        let ahead = height * pitch.tan();
        let file = folder.join("frames").join(row["file"]);
        let picture = decode_picture(&std::fs::read(&file).unwrap()).unwrap();
        Photo {
            name: row["file"].to_owned(),
            file,
            time,
            camera: CameraModel::of_focal(picture.width(), picture.height(), set.focal),
            luminance: Pyramid::new(picture.to_gray(), PYRAMID_LEVELS),
            below,
            centre: GroundPoint::new(
                below.north + ahead * heading.cos(),
                below.east + ahead * heading.sin(),
            ),
            height,
            heading,
            pitch,
        }
    };
    Some(Site {
        world,
        map: GeoreferencedPicture::new(set.map, picture, on_ground).unwrap(),
        photos: rows(&table).map(|row| photo(&row)).collect(),
    })
}
