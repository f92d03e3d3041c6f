//! Writes a window of the generated scenery as a PNG.
//!
//! `cargo run -p pilotage-core --example scenery_picture -- OUT.png NORTH WEST GSD WIDTH HEIGHT [map|other] [SEED]`
//! (north-west corner in metres from the origin, metres per pixel, pixels)

use std::time::Instant;

use pilotage_core::imagery::{Imagery, Window};
use pilotage_core::simulate::scenery::{DEMO_SEED, Day, Scenery};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, north, west, gsd, width, height, rest @ ..] = arguments.as_slice() else {
        return Err("usage: OUT.png NORTH WEST GSD WIDTH HEIGHT [map|other] [SEED]".into());
    };
    let day = match rest.first().map(String::as_str) {
        Some("other") => Day::other_day(),
        _ => Day::map_day(),
    };
    let seed = rest.get(1).map_or(Ok(DEMO_SEED), |s| s.parse())?;
    let window = Window {
        north_edge: north.parse()?,
        west_edge: west.parse()?,
        gsd: gsd.parse()?,
        width: width.parse()?,
        height: height.parse()?,
    };
    let started = Instant::now();
    let scenery = Scenery::new(seed, day);
    let laid_out = started.elapsed();
    let started = Instant::now();
    let picture = scenery.window(&window);
    let painted = started.elapsed();
    let pixels = window.width * window.height;
    println!(
        "laid out in {:.0} ms, painted in {:.0} ms, {:.3} µs per pixel",
        laid_out.as_secs_f64() * 1e3,
        painted.as_secs_f64() * 1e3,
        painted.as_secs_f64() * 1e6 / pixels as f64
    );
    let bytes: Vec<u8> = picture.pixels().iter().flatten().copied().collect();
    image::save_buffer(
        out,
        &bytes,
        window.width as u32,
        window.height as u32,
        image::ColorType::Rgba8,
    )?;
    Ok(())
}
