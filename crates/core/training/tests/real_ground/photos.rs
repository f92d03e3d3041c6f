//! Photos of real ground with the map over which they were taken, and where their middle truly is.

#[path = "../../../vision/tests/across_dates/photos.rs"]
mod dates;

use std::path::Path;
use std::sync::Arc;

use nalgebra::Point3;
use pilotage_base::frames::{Attitude, GroundPoint, LocalFrame, Pose};
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
    /// Turn of the columns' north, degrees, and height for a unit of their scale, metres.
    const COLUMNS: (f64, f64) = (2.09, 152.35);
    over_its_own("caliterra", "ortho.png", 875.2, |columns| {
        let number = |index: usize| columns[index].parse::<f64>().ok();
        let (turn, scale) = (number(7)? + COLUMNS.0, number(8)?);
        Some(([number(5)?, number(6)?], turn, COLUMNS.1 * scale))
    })
}

/// A shore over the orthophoto of its own flight.
pub fn brighton_beach() -> Option<RealSite> {
    /// First and last of the frames that are stored upside down.
    const TURNED: (&str, &str) = ("DJI_0024.jpg", "DJI_0029.jpg");
    over_its_own("brighton_beach", "ortho.jpg", 966.4, |columns| {
        let number = |index: usize| columns[index].parse::<f64>().ok();
        let is_turned = (TURNED.0..=TURNED.1).contains(&columns[0]);
        let turn = number(8)? + if is_turned { 180.0 } else { 0.0 };
        Some(([number(12)?, number(13)?], turn, number(5)?))
    })
}

/// Pixel of the map in the middle of a frame, heading in degrees and height in metres, of the columns of its row.
type OfColumns = fn(&[&str]) -> Option<([f64; 2], f64, f64)>;

/// Photos over the map that was made of them.
fn over_its_own(
    name: &'static str,
    map: &str,
    focal: f64,
    of_columns: OfColumns,
) -> Option<RealSite> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../../shared/data");
    let folder = folder.join(name);
    if !folder.exists() {
        println!("skipped: no shared data ({name})");
        return None;
    }
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let text = String::from_utf8(read("ortho_georef.json")).unwrap();
    let place = Georeference::from_json(&text).unwrap();
    let ortho = decode_map(&read(map), true).unwrap();
    let origin = place.origin(ortho.width(), ortho.height()).unwrap();
    let world = LocalFrame::new(origin);
    let on_ground = place
        .in_world(&world, ortho.width(), ortho.height())
        .unwrap();
    let table = String::from_utf8(read("frames.csv")).unwrap();
    let rows = table.lines().skip(1).filter_map(|line| {
        let columns: Vec<&str> = line.split(',').collect();
        let ([x, y], turn, height) = of_columns(&columns)?;
        let picture = decode_picture(&read(&format!("frames/{}", columns[0]))).unwrap();
        let middle = place.ground_at(&world, x, y);
        let (width, rows) = (picture.width(), picture.height());
        Some(RealPhoto {
            name: columns[0].to_owned(),
            camera: CameraModel::of_focal(width, rows, focal),
            picture,
            pose: Pose {
                position_in_world: Point3::new(middle.north, middle.east, -height),
                attitude: Attitude::level(turn.to_radians()),
            },
            middle,
        })
    });
    Some(RealSite {
        name,
        photos: rows.collect(),
        map: Arc::new(GeoreferencedPicture::new(name, ortho, on_ground).unwrap()),
    })
}
