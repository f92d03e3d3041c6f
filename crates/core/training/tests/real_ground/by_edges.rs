//! Photos placed by the straight edges of a map's table.

use nalgebra::Point2;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::locating::{LOG_HEIGHT, TILT, believed_pose};
use crate::photos::{RealPhoto, RealSite};
use crate::tally::FixTally;
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_raster::imagery::Imagery;
use pilotage_reference::ReferenceTable;
use pilotage_reference::edges::{EDGE, EDGES, EdgePlace, PhotoBelief, PhotoEdges, edges_in_map};

/// Probability from which on a place is a fix.
const BELIEVED: f64 = 0.9;
/// Deviation of the map's own places, metres, as of photos laid on maps of other dates.
const MAP: f64 = 3.0;
/// The table of the straight edges of a map, sought in pixels of `gsd` metres, as it comes back from its file.
pub fn table_of(map: &dyn Imagery, gsd: f64) -> ReferenceTable {
    let edges = edges_in_map(map, gsd, EDGES);
    let bytes = ReferenceTable::new(edges, vec![EDGE.to_owned()]).to_bytes();
    let table = ReferenceTable::from_bytes(&bytes).unwrap();
    let bounds = map.bounds();
    println!(
        "{} edges of {:.0} m by {:.0} m in {} bytes",
        table.landmarks().len(),
        bounds.height(),
        bounds.width(),
        bytes.len()
    );
    table
}

/// Ground that a pose has in the middle of a photo.
fn middle(photo: &RealPhoto, pose: &Pose) -> GroundPoint {
    let half = |pixels: usize| 0.5 * pixels as f64;
    let pixel = Point2::new(half(photo.picture.width()), half(photo.picture.height()));
    photo.camera.ground_at(pose, &pixel, 0.0).unwrap()
}

fn placed(
    photo: &RealPhoto,
    believed: Pose,
    (deviation, gsd): (f64, f64),
    table: &ReferenceTable,
) -> Option<EdgePlace> {
    let belief = PhotoBelief {
        pose: believed,
        ground_down: 0.0,
        deviation,
        tilt: TILT,
        turn: 15_f64.to_radians(),
        log_height: LOG_HEIGHT,
        map_deviation: MAP,
        gsd,
    };
    let edges = PhotoEdges::of(&photo.camera, &photo.picture, &belief).ok()?;
    edges.place(table)
}

/// Every `each`-th photo of a place by the edges of its map, sought in pixels of `gsd` metres, its position off by `deviation` metres per axis; looked
/// for `moved` metres north or south of that, where it is not.
pub fn locate(
    site: &RealSite,
    table: &ReferenceTable,
    (each, gsd): (usize, f64),
    (deviation, moved): (f64, f64),
) -> FixTally {
    let mut tally = FixTally::default();
    let mut before = 0;
    let away = |place: &GroundPoint| {
        let is_north = place.north > site.map.bounds().center().north;
        if is_north { -moved } else { moved }
    };
    for (number, photo) in site.photos.iter().enumerate().step_by(each) {
        let mut random = ChaCha8Rng::seed_from_u64(number as u64);
        let mut believed = believed_pose(photo, deviation, &mut random);
        before += usize::from(middle(photo, &believed).distance(&photo.middle) <= 15.0);
        believed.position_in_world.x += away(&photo.middle);
        let Some(found) = placed(photo, believed, (deviation, gsd), table) else {
            tally.add(&photo.name, 0.0, None);
            continue;
        };
        let error = found.middle.to_vector() - photo.middle.to_vector();
        let is_believed = found.probability >= BELIEVED;
        if !is_believed {
            println!("    would be {:.1} m off", error.norm());
        }
        let fix = is_believed.then_some((error, found.covariance));
        tally.add(&photo.name, found.probability, fix);
    }
    println!(
        "{}, {gsd} m a pixel, believed within {deviation} m, {before} of them within 15 m, looked for {moved} m away: {tally}",
        site.name
    );
    tally
}

/// Photos of one place looked for in the middle of the map of another: how many are believed, and the highest
/// probability.
pub fn believed_elsewhere(site: &RealSite, other: &RealSite, table: &ReferenceTable, gsd: f64) {
    let middle = other.map.bounds().center();
    let probabilities: Vec<f64> = (site.photos.iter().enumerate())
        .filter_map(|(number, photo)| {
            let mut random = ChaCha8Rng::seed_from_u64(number as u64);
            let mut believed = believed_pose(photo, 10.0, &mut random);
            believed.position_in_world.x = middle.north;
            believed.position_in_world.y = middle.east;
            Some(placed(photo, believed, (10.0, gsd), table)?.probability)
        })
        .collect();
    println!(
        "{} on the map of {}, {gsd} m a pixel: {} of {} believed, highest probability {:.3}",
        site.name,
        other.name,
        probabilities.iter().filter(|p| **p >= BELIEVED).count(),
        probabilities.len(),
        probabilities.iter().copied().fold(0.0, f64::max)
    );
}
