//! `pilotage reference-map locate`: a photo placed by the straight edges of a table.

use std::path::{Path, PathBuf};

use nalgebra::Point3;
use pilotage_core::frames::Pose;
use pilotage_core::raster::decode_picture;
use pilotage_core::reference::ReferenceTable;
use pilotage_core::reference::edges::{
    EDGE, EDGE_GSD, EDGES, PhotoBelief, PhotoEdges, edges_in_map,
};

use crate::CommandResult;
use crate::files::{MAP_CACHE, open_map_with_frame, write_whole};
use crate::numbers::numbers;
use crate::photo_camera::{LookingDown, camera_of};

/// Probability from which on a place is believed.
const BELIEVED: f64 = 0.9;
/// Ranges that people state, in standard deviations.
const WITHIN: f64 = 2.0;

/// Arguments of `pilotage reference-map locate`.
#[derive(clap::Args)]
pub struct Arguments {
    /// Table made by `pilotage reference-map --edges`.
    table: PathBuf,
    /// Photo (JPEG or PNG) of a camera that looks down.
    photo: PathBuf,
    /// Believed place below the camera, metres from the origin that was printed when the table was made.
    #[arg(long, value_name = "NORTH,EAST", allow_hyphen_values = true)]
    at: String,
    /// Range of the search to each side of it, metres.
    #[arg(long, value_name = "METRES", default_value_t = 20.0)]
    within: f64,
    /// Height above the ground, metres.
    #[arg(long, value_name = "METRES")]
    height: f64,
    /// Range of the search around the height, percent.
    #[arg(long, value_name = "PERCENT", default_value_t = 10.0)]
    height_within: f64,
    /// Heading of the picture's top, degrees from north.
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true)]
    heading: f64,
    /// Range of the search to each side of the heading, degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 15.0)]
    heading_within: f64,
    #[command(flatten)]
    looking: LookingDown,
    /// Focal length in pixels of the picture.
    #[arg(long, value_name = "PIXELS")]
    focal: f64,
    /// Metres in a pixel in which edges are sought, as when the table was made.
    #[arg(long, value_name = "METRES", default_value_t = EDGE_GSD)]
    gsd: f64,
    /// Stated accuracy of the map, standard deviation per axis in metres.
    #[arg(long, value_name = "METRES", default_value_t = 3.0)]
    map_accuracy: f64,
}

/// Makes the table of the straight edges of a map, sought in pixels of `gsd` metres.
pub fn make_table(map: &Path, out: &Path, gsd: f64) -> CommandResult {
    let (map, frame) = open_map_with_frame(map, MAP_CACHE)?;
    let edges = edges_in_map(map.as_ref(), gsd, EDGES);
    let table = ReferenceTable::new(edges, vec![EDGE.to_owned()]);
    let bytes = table.to_bytes();
    write_whole(out, &bytes)?;
    println!(
        "wrote {} ({} bytes): {} straight edges",
        out.display(),
        bytes.len(),
        table.landmarks().len()
    );
    if let Some(origin) = frame.map(|frame| frame.origin) {
        println!(
            "places are metres from {:.7}, {:.7}",
            origin.latitude.to_degrees(),
            origin.longitude.to_degrees()
        );
    }
    Ok(())
}

/// Places a photo.
pub fn run(arguments: &Arguments) -> CommandResult {
    let read = |path: &Path| std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()));
    let table = ReferenceTable::from_bytes(&read(&arguments.table)?)?;
    let photo = arguments.photo.display();
    let picture = decode_picture(&read(&arguments.photo)?).map_err(|e| format!("{photo}: {e}"))?;
    let [north, east] = numbers(&arguments.at, "--at")?;
    let camera = camera_of(&picture, arguments.focal);
    let belief = PhotoBelief {
        pose: Pose {
            position_in_world: Point3::new(north, east, -arguments.height),
            attitude: arguments.looking.attitude(arguments.heading.to_radians()),
        },
        ground_down: 0.0,
        deviation: arguments.within / WITHIN,
        tilt: 2_f64.to_radians(),
        turn: arguments.heading_within.to_radians(),
        log_height: 0.01 * arguments.height_within / WITHIN,
        map_deviation: arguments.map_accuracy,
        gsd: arguments.gsd,
    };
    let edges = PhotoEdges::of(&camera, &picture, &belief);
    let Some(found) = edges.and_then(|edges| edges.place(&table)) else {
        println!("{photo}: no place, the photo shows no straight edge");
        return Ok(());
    };
    let (probability, middle) = (100.0 * found.probability, found.middle);
    if found.probability < BELIEVED {
        println!("{photo}: no place; the likeliest has {probability:.1} %");
    } else {
        println!(
            "{photo}: middle of the picture {:.1} m north, {:.1} m east, ± {:.1} m; {probability:.1} %",
            middle.north,
            middle.east,
            (0.5 * found.covariance.trace()).sqrt()
        );
    }
    Ok(())
}
