//! Puts a picture on the ground by points that are known in both, writes the files beside it that say so, and
//! opens the map by them.
//!
//! `cargo run -p pilotage-core --example 09_put_a_picture_on_the_ground`

use std::error::Error;

use nalgebra::Point2;
use pilotage_core::flight::files::{FileSink, MemoryFiles};
use pilotage_core::frames::{Geodetic, ReferenceSystem};
use pilotage_core::imagery::Imagery;
use pilotage_core::imagery::georeferencer::{ControlPoint, TransformKind, fit};
use pilotage_core::mission::{open_map, place_files};
use pilotage_core::raster::{Raster, encode_png};

fn main() -> Result<(), Box<dyn Error>> {
    // Somebody picked five places in a picture of 400 × 300 pixels and found them on a map of UTM zone 15;
    // the picture is turned by 10°, with pixels of 0.25 m, and every hand is off by a pixel or so.
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let truly = |x: f64, y: f64| {
        let (east, north) = (0.25 * (cos * x + sin * y), 0.25 * (sin * x - cos * y));
        Point2::new(577_000.0 + east, 5_188_000.0 + north)
    };
    let picked = [
        (20.0, 15.0, 0.8, -0.3),
        (380.0, 30.0, -0.6, 0.5),
        (370.0, 280.0, 0.2, 0.9),
        (25.0, 290.0, -0.4, -0.7),
        (200.0, 150.0, 0.5, 0.1),
    ];
    let points = picked.map(|(x, y, off_x, off_y)| ControlPoint {
        pixel: Point2::new(x + off_x, y + off_y),
        place: truly(x, y),
        enabled: true,
    });
    for kind in TransformKind::ALL {
        let fit = fit(&points, kind)?;
        let left_out = fit
            .rms_left_out
            .map_or("-".to_owned(), |m| format!("{m:.2}"));
        println!(
            "{}: {:.2} pixels, {:.2} m; {left_out} m where a point is left out",
            kind.name(),
            fit.rms_in_pixels,
            fit.rms_in_plane
        );
    }

    // The stiffest transform that explains the points is the one to believe.
    let zone = ReferenceSystem::utm_around(&Geodetic::from_degrees(46.8, -92.0, 0.0));
    let place = fit(&points, TransformKind::Similarity)?.georeference(zone);
    let mut files = MemoryFiles::default();
    let picture = Raster::from_fn(400, 300, |x, y| [(x / 2) as u8, (y / 2) as u8, 90]);
    files.write("area.png", &encode_png(&picture)?)?;
    for (name, bytes) in place_files("area.png", &place) {
        println!("{name}: {} bytes", bytes.len());
        files.write(&name, &bytes)?;
    }

    let map = open_map(&files, "area.png", None)?;
    let placement = map.placement().ok_or("a picture has a place")?;
    let middle = placement.place_at(&Point2::new(200.0, 150.0));
    let middle = middle.ok_or("the middle is on the globe")?;
    let (east, north) = zone.coordinates(&middle).ok_or("the zone reaches")?;
    let error = (Point2::new(east, north) - truly(200.0, 150.0)).norm();
    println!(
        "{} covers {:.0} m² of ground",
        map.name(),
        map.bounds().width() * map.bounds().height()
    );
    println!("the middle of the picture is {error:.2} m from where it truly is");
    if error > 0.25 {
        return Err("five points of a pixel each should place the middle to a pixel".into());
    }
    Ok(())
}
