//! Prints the corners of a GeoTIFF on the globe and its ground sample distance.
//!
//! `cargo run -p pilotage-maps --example geotiff_corners -- MAP.tif`

use std::sync::Arc;

use nalgebra::Point2;
use pilotage_maps::GeoTiffFile;
use pilotage_maps::bytes::MemoryBytes;
use pilotage_maps::frames::LocalFrame;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("which map?")?;
    let source = Arc::new(MemoryBytes::new(&path, std::fs::read(&path)?));
    let file = GeoTiffFile::open(source, None, None)?;
    let origin = file.origin().ok_or("the map has no place on the globe")?;
    let frame = LocalFrame::new(origin);
    let placement = file.placement(&frame)?;
    let (width, height) = file.size();
    println!("{width} x {height} pixels, {:.3} m each", placement.gsd());
    let (right, bottom) = (width as f64, height as f64);
    let corners = [
        ("top left", 0.0, 0.0),
        ("top right", right, 0.0),
        ("bottom right", right, bottom),
        ("bottom left", 0.0, bottom),
    ];
    for (name, x, y) in corners {
        let corner = placement
            .place_at(&Point2::new(x, y))
            .ok_or("a corner beyond the pole")?;
        let (latitude, longitude) = (corner.latitude.to_degrees(), corner.longitude.to_degrees());
        println!("{name}: {latitude:.7}° latitude, {longitude:.7}° longitude");
    }
    Ok(())
}
