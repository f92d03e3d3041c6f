//! Tests of `overlay`.

use nalgebra::Point2;
use pilotage_base::files::{FileSet, FileSink, MemoryFiles, ZipSink};
use pilotage_base::frames::{Geodetic, LocalFrame};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Picture, encode_png};

use crate::open_map;

/// A picture with a red top left quarter on green.
fn picture() -> Vec<u8> {
    let picture = Picture::from_fn(40, 20, |x, y| {
        if x < 20 && y < 10 {
            [200, 0, 0]
        } else {
            [0, 200, 0]
        }
    });
    encode_png(&picture).unwrap()
}

const PLACE: &str =
    "<LatLonBox><north>47.002</north><south>47</south><east>8.004</east><west>8</west></LatLonBox>";

fn kmz(place: &str) -> MemoryFiles {
    let mut zip = ZipSink::default();
    let linked = "<kml><NetworkLink><Link><href>maps/ortho.kml</href></Link></NetworkLink></kml>";
    let overlay = format!(
        "<kml xmlns:gx=\"g\"><Document><GroundOverlay><Icon><href>../files/ortho.png</href></Icon>{place}</GroundOverlay></Document></kml>"
    );
    zip.write("doc.kml", linked.as_bytes()).unwrap();
    zip.write("maps/ortho.kml", overlay.as_bytes()).unwrap();
    zip.write("files/ortho.png", &picture()).unwrap();
    let mut files = MemoryFiles::default();
    files
        .0
        .insert("ortho.kmz".to_owned(), zip.finish().unwrap());
    files
}

/// Colour of the map at a place in degrees.
fn colour(files: &dyn FileSet, latitude: f64, longitude: f64) -> [u8; 4] {
    let map = open_map(files, "ortho.kmz", None).unwrap();
    let place = Geodetic::from_degrees(latitude, longitude, 0.0);
    let ground = map.frame().unwrap().ground_from_geodetic(&place);
    let window = Window {
        west_edge: ground.east - 0.5,
        north_edge: ground.north + 0.5,
        gsd: 1.0,
        width: 1,
        height: 1,
    };
    map.window(&window).get(0, 0)
}

#[test]
fn an_orthophoto_in_a_kmz_is_a_map_where_its_box_says() {
    let files = kmz(PLACE);
    assert_eq!(colour(&files, 47.0015, 8.001), [200, 0, 0, 255]);
    assert_eq!(colour(&files, 47.0015, 8.003), [0, 200, 0, 255]);
    assert_eq!(colour(&files, 47.0005, 8.001), [0, 200, 0, 255]);
    assert_eq!(colour(&files, 47.0025, 8.001), [0, 0, 0, 0]);
}

#[test]
fn a_turned_box_and_a_quad_turn_the_picture() {
    // Half a turn: the red quarter lies in the south-east.
    let turned = PLACE.replace("</LatLonBox>", "<rotation>180</rotation></LatLonBox>");
    assert_eq!(colour(&kmz(&turned), 47.0005, 8.003), [200, 0, 0, 255]);
    let quad = "<gx:LatLonQuad><coordinates>8.004,47.002 8,47.002 8,47 8.004,47</coordinates></gx:LatLonQuad>";
    assert_eq!(colour(&kmz(quad), 47.0005, 8.003), [200, 0, 0, 255]);
}

#[test]
fn a_kmz_without_pictures_or_with_those_of_others_is_named() {
    let error = |place: &str, name: &str| {
        let mut zip = ZipSink::default();
        let text = format!("<kml><Document>{place}</Document></kml>");
        zip.write("doc.kml", text.as_bytes()).unwrap();
        let mut files = MemoryFiles::default();
        files.0.insert(name.to_owned(), zip.finish().unwrap());
        open_map(&files, name, None).err().unwrap().to_string()
    };
    assert!(error("", "a.kmz").starts_with("a.kmz: no map"));
    let far = format!(
        "<GroundOverlay><Icon><href>https://there/a.png</href></Icon>{PLACE}</GroundOverlay>"
    );
    let told = error(&far, "a.kmz");
    assert!(told.contains("https://there/a.png"), "{told}");
}

#[test]
fn a_map_keeps_its_corners_to_a_hair() {
    let map = open_map(&kmz(PLACE), "ortho.kmz", None).unwrap();
    let frame: &LocalFrame = map.frame().unwrap();
    let corner = frame.ground_from_geodetic(&Geodetic::from_degrees(47.002, 8.0, 0.0));
    let bounds = map.bounds();
    let off = Point2::new(bounds.north - corner.north, bounds.west - corner.east);
    assert!(off.coords.norm() < 0.01, "{off}");
}
