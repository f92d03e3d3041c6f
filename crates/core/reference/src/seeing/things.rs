//! Landmarks out of probabilities of classes.

use super::blobs::{Blob, blobs};
use crate::{GenericClass, GenericLandmark};
use pilotage_raster::raster::{Gray, IntegralImage, box_blur};
use pilotage_vision::ground_class::{CoverMap, GroundCover};

/// Probability from which on a cell belongs to a thing.
const LEAST_PROBABILITY: f32 = 0.5;
/// Radius over which probabilities are evened, cells.
const EVENED: usize = 1;
/// Half the side of a square that is paved nearly throughout where cars are parked, metres: wider than a road.
const WIDE: f64 = 6.75;
/// Share of that square.
const WIDELY_PAVED: f64 = 0.8;

/// Classes of which things are made, and how large they are, square metres: what is smaller is noise, what is larger
/// has no middle to speak of.
const KINDS: [(GroundCover, GenericClass, f64, f64); 4] = [
    (GroundCover::Building, GenericClass::Building, 20.0, 4000.0),
    (GroundCover::Tree, GenericClass::Tree, 16.0, 1200.0),
    (GroundCover::Water, GenericClass::Water, 20.0, 9000.0),
    (GroundCover::Paved, GenericClass::Parking, 30.0, 4000.0),
];

/// Buildings, trees, waters and paved places that lie whole in `map`. Their stability is one: a single look does not
/// tell of other days.
///
/// ```
/// use pilotage_raster::imagery::Window;
/// use pilotage_reference::seeing::landmarks_seen;
/// use pilotage_vision::ground_class::{CoverMap, GroundCover};
///
/// // Open ground of 30 m by 30 m with a building 8 m long from west to east and 6 m wide in its middle.
/// let window = Window { north_edge: 30.0, west_edge: 0.0, gsd: 1.0, width: 30, height: 30 };
/// let cover = |i| match (i % 30, i / 30) { (11..19, 12..18) => GroundCover::Building, _ => GroundCover::Open };
/// let told = |i| { let mut shares = [0.0; 5]; shares[cover(i).index()] = 1.0; shares };
/// let map = CoverMap { window, probabilities: (0..900).map(told).collect(), seen: vec![true; 900] };
/// let [barn] = &landmarks_seen(&map)[..] else { panic!("one building") };
/// assert_eq!((barn.place.north, barn.place.east), (15.0, 15.0));
/// assert!((barn.orientation.to_degrees() - 90.0).abs() < 1e-6);
/// ```
pub fn landmarks_seen(map: &CoverMap) -> Vec<GenericLandmark> {
    let window = &map.window;
    let cell = window.gsd * window.gsd;
    let mut seen = Vec::new();
    for (cover, class, least, most) in KINDS {
        let mut probabilities = map.of(cover);
        if class == GenericClass::Parking {
            probabilities = wide(&probabilities, window.gsd);
        } else {
            probabilities = box_blur(&probabilities, EVENED);
        }
        let is_thing =
            |blob: &Blob| blob.whole && (least..=most).contains(&(blob.cells as f64 * cell));
        let things = blobs(&probabilities, &map.seen, LEAST_PROBABILITY);
        seen.extend(
            things
                .iter()
                .filter(|blob| is_thing(blob))
                .map(|blob| GenericLandmark {
                    place: window.ground_at(blob.middle[0], blob.middle[1]),
                    class,
                    size: (blob.cells as f64 * cell).sqrt(),
                    orientation: blob.orientation(),
                    confidence: blob.weight / blob.cells as f64,
                    stability: 1.0,
                }),
        );
    }
    seen
}

/// The probabilities where they fill a wide square, zero elsewhere.
fn wide(probabilities: &Gray, gsd: f64) -> Gray {
    let reach = (WIDE / gsd).round() as usize;
    let side = 2 * reach + 1;
    let (width, height) = (probabilities.width(), probabilities.height());
    let sums = IntegralImage::new(probabilities);
    Gray::from_fn(width, height, |column, row| {
        let inside =
            column >= reach && row >= reach && column + reach < width && row + reach < height;
        let filled = inside && {
            let sum = sums.sum(column - reach, row - reach, side, side);
            sum >= WIDELY_PAVED * (side * side) as f64
        };
        if filled {
            probabilities.get(column, row)
        } else {
            0.0
        }
    })
}
