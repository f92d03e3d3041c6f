//! Photos of real ground with the map over which they were taken, and where their middle truly is.

#[path = "../../../vision/tests/across_dates/photos.rs"]
mod dates;

use std::path::Path;
use std::sync::Arc;

use nalgebra::Point3;
use pilotage_base::frames::{Attitude, Geodetic, GroundPoint, LocalFrame, Pose};
use pilotage_base::georeference::Georeference;
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::{GeoreferencedPicture, Imagery, decode_map};
use pilotage_raster::raster::{Picture, decode_picture};

/// A photo, its pose as far as it is known, and its truth.
pub struct RealPhoto {
    pub name: String,
    pub picture: Picture,
    pub camera: CameraModel,
    /// Pose by the photo's own instruments, north-east-down of the map.
    pub pose: Pose,
    /// Ground in the middle of the picture.
    pub middle: GroundPoint,
}

/// A map and photos over it.
pub struct RealSite {
    pub name: &'static str,
    pub map: Arc<dyn Imagery>,
    pub photos: Vec<RealPhoto>,
}

/// A town from a small drone, over a satellite map.
pub fn fengyuan() -> Option<RealSite> {
    Some(of_dates("fengyuan", dates::fengyuan()?))
}

/// Fields and villages from a small aircraft, over the map of a month.
pub fn adm(month: &'static str) -> Option<RealSite> {
    Some(of_dates(month, dates::adm(month)?))
}

fn of_dates(name: &'static str, site: dates::Site) -> RealSite {
    let photos = site.photos.into_iter().map(|photo| RealPhoto {
        picture: decode_picture(&std::fs::read(&photo.file).unwrap()).unwrap(),
        pose: Pose {
            position_in_world: Point3::new(photo.below.north, photo.below.east, -photo.height),
            attitude: Attitude {
                pitch: photo.pitch,
                ..Attitude::level(photo.heading)
            },
        },
        name: photo.name,
        camera: photo.camera,
        middle: photo.centre,
    });
    RealSite {
        name,
        photos: photos.collect(),
        map: Arc::new(site.map),
    }
}

/// A building site over the orthophoto of its own flight.
pub fn caliterra() -> Option<RealSite> {
    const FOCAL: f64 = 875.2;
    /// Turn of the columns' north, degrees, and height for a unit of their scale, metres.
    const COLUMNS: (f64, f64) = (2.09, 152.35);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data/caliterra");
    if !folder.exists() {
        println!("skipped: no shared data (caliterra)");
        return None;
    }
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let text = String::from_utf8(read("ortho_georef.json")).unwrap();
    let place = Georeference::from_json(&text).unwrap();
    let world = LocalFrame::new(Geodetic::from_degrees(30.171_208, -98.089_669, 0.0));
    let ortho = decode_map(&read("ortho.png"), true).unwrap();
    let on_ground = place
        .in_world(&world, ortho.width(), ortho.height())
        .unwrap();
    let table = String::from_utf8(read("frames.csv")).unwrap();
    let mut photos = Vec::new();
    for line in table.lines().skip(1) {
        let columns: Vec<&str> = line.split(',').collect();
        let number = |index: usize| columns[index].parse::<f64>().ok();
        let Some((x, y, turn, scale)) =
            (|| Some((number(5)?, number(6)?, number(7)?, number(8)?)))()
        else {
            continue;
        };
        let picture = decode_picture(&read(&format!("frames/{}", columns[0]))).unwrap();
        let middle = place.ground_at(&world, x, y);
        let half = 0.5 * picture.width() as f64;
        photos.push(RealPhoto {
            name: columns[0].to_owned(),
            camera: CameraModel::pinhole(
                picture.width(),
                picture.height(),
                2.0 * (half / FOCAL).atan(),
            ),
            picture,
            pose: Pose {
                position_in_world: Point3::new(middle.north, middle.east, -COLUMNS.1 * scale),
                attitude: Attitude::level((turn + COLUMNS.0).to_radians()),
            },
            middle,
        });
    }
    Some(RealSite {
        name: "caliterra",
        map: Arc::new(GeoreferencedPicture::new("ortho", ortho, on_ground).unwrap()),
        photos,
    })
}
