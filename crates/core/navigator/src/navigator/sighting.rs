//! Report of what an aid saw in a picture, and of what on the map it took that for.

use nalgebra::Point2;
use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;
use pilotage_reference::GenericClass;

/// Things that an aid saw in a picture, those of the map that they may be, and the pairs of the two.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SightingReport {
    /// Name of the aid in files.
    pub aid: String,
    /// Things in the picture.
    pub seen: Vec<SeenReport>,
    /// Things of the map around the view.
    pub known: Vec<KnownReport>,
    /// Probability that the place at which the pairs agree is the right one, from an aid that says one.
    pub probability: Option<f64>,
}

impl SightingReport {
    /// Number of things of the picture that told something of the place.
    pub fn accepted(&self) -> usize {
        let pairs = self.seen.iter().filter_map(|seen| seen.pair.as_ref());
        pairs.filter(|pair| pair.accepted).count()
    }
}

/// Thing in a picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeenReport {
    /// Kind of thing.
    pub kind: SightedKind,
    /// Its middle, pixels.
    pub pixel: Point2<f64>,
    /// Its middle on the map by the pose that was believed, metres.
    pub place: GroundPoint,
    /// Side of a square of its area, or width of a road, metres.
    pub size: f64,
    /// Number of things of the map that it may be by kind, size and place.
    pub similar: usize,
    /// Thing of the map that it was paired with.
    pub pair: Option<PairReport>,
}

/// Thing of the map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct KnownReport {
    /// Kind of thing.
    pub kind: SightedKind,
    /// Its middle, or the place of a road's centre line, metres.
    pub place: GroundPoint,
    /// Side of a square of its area, or width of a road, metres.
    pub size: f64,
}

/// Pair of a thing in the picture with one of the map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PairReport {
    /// Index of the thing of the map.
    pub known: usize,
    /// Probability that the two are the same, from an aid that says one.
    pub probability: Option<f64>,
    /// Whether it told something of the place.
    pub accepted: bool,
}

/// Kind of thing that aids see.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum SightedKind {
    /// A generic landmark.
    Landmark(GenericClass),
    /// A point of a road.
    Road,
}
