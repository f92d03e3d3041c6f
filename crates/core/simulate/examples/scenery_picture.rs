//! Writes a window of the generated scenery as a PNG.
//!
//! `cargo run -p pilotage-simulate --example scenery_picture -- OUT.png NORTH WEST GSD WIDTH HEIGHT [map|other] [SEED]`
//! (north-west corner in metres from the origin, metres per pixel, pixels)
//!
//! `… -- OUT.png features GSD SIDE [map|other] [SEED]` writes a sheet of the distinct features.

use std::time::Instant;

use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};
use pilotage_simulate::simulate::scenery::{DEMO_SEED, Day, Scenery};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.as_slice() {
        [out, word, gsd, side, rest @ ..] if word == "features" => {
            let scenery = scenery(rest)?;
            save(out, &features(&scenery, gsd.parse()?, side.parse()?))
        }
        [out, north, west, gsd, width, height, rest @ ..] => {
            let window = Window {
                north_edge: north.parse()?,
                west_edge: west.parse()?,
                gsd: gsd.parse()?,
                width: width.parse()?,
                height: height.parse()?,
            };
            let scenery = scenery(rest)?;
            let started = Instant::now();
            let picture = scenery.window(&window);
            let seconds = started.elapsed().as_secs_f64();
            let pixels = (window.width * window.height) as f64;
            println!("painted: {:.3} µs per pixel", seconds * 1e6 / pixels);
            save(out, &picture)
        }
        _ => Err("usage: OUT.png NORTH WEST GSD WIDTH HEIGHT [map|other] [SEED]".into()),
    }
}

fn scenery(rest: &[String]) -> Result<Scenery, Box<dyn std::error::Error>> {
    let day = match rest.first().map(String::as_str) {
        Some("other") => Day::other_day(),
        _ => Day::map_day(),
    };
    let seed = rest.get(1).map_or(Ok(DEMO_SEED), |s| s.parse())?;
    let started = Instant::now();
    let scenery = Scenery::new(seed, day);
    println!("laid out: {:.0} ms", started.elapsed().as_secs_f64() * 1e3);
    Ok(scenery)
}

/// A sheet of square windows around the distinct features, four in a row.
fn features(scenery: &Scenery, gsd: f64, side: usize) -> Raster<Rgba> {
    let all = scenery.distinct_features();
    let mut sheet = Raster::filled(4 * side, all.len().div_ceil(4) * side, [0, 0, 0, 255]);
    for (i, feature) in all.iter().enumerate() {
        let c = feature.landmark_box.center();
        let half = 0.5 * gsd * side as f64;
        let tile = scenery.window(&Window {
            north_edge: c.north + half,
            west_edge: c.east - half,
            gsd,
            width: side,
            height: side,
        });
        for row in 0..side {
            let start = (i % 4) * side;
            sheet.row_mut(i / 4 * side + row)[start..start + side].copy_from_slice(tile.row(row));
        }
    }
    sheet
}

fn save(out: &str, picture: &Raster<Rgba>) -> Result<(), Box<dyn std::error::Error>> {
    let bytes: Vec<u8> = picture.pixels().iter().flatten().copied().collect();
    let (width, height) = (picture.width() as u32, picture.height() as u32);
    image::save_buffer(out, &bytes, width, height, image::ColorType::Rgba8)?;
    Ok(())
}
