//! A road map made ready for being found in.

use std::error::Error;
use std::fmt;

use pilotage_base::frames::GroundRect;

use super::field::DirectionField;
use super::junctions::{Junction, junctions};
use super::pairs::CrossingPairs;
use super::tiles::PieceTiles;
use crate::line::RoadClass;
use crate::map::RoadMap;
use crate::weave::RoadJoining;

/// Side of a cell of the field of distances, metres.
const CELL: f64 = 5.0;
/// Ground around the outermost roads that belongs to the index, metres.
const MARGIN: f64 = 40.0;

/// Most square kilometres within the bounds of the roads; their field of distances takes 1.6 GB.
const MOST_AREA: f64 = 5000.0;

/// Reason why roads cannot be searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RoadIndexError {
    /// There is no road of the class or a greater one.
    NoRoad,
    /// The roads lie too far apart.
    TooWide {
        /// Way from the northernmost to the southernmost, kilometres.
        north: f64,
        /// Way from the westernmost to the easternmost, kilometres.
        east: f64,
    },
}

impl fmt::Display for RoadIndexError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRoad => f.write_str("it has no road of that class; lower --least"),
            Self::TooWide { north, east } => write!(
                f,
                "its roads span {north:.0} km by {east:.0} km, and at most {MOST_AREA:.0} km² can be searched; give the part \
                 that the views may show, without roads that lie elsewhere"
            ),
        }
    }
}

impl Error for RoadIndexError {}

/// Road map in which views are found: distances to roads by direction, crossings, pairs of crossings.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::lost::RoadIndex;
/// use pilotage_roads::{RoadClass, RoadJoining, RoadLine, RoadMap};
///
/// let road = |from: (f64, f64), to: (f64, f64)| RoadLine {
///     course: [from, to].map(|(north, east)| GroundPoint::new(north, east)).to_vec(),
///     ..RoadLine::default()
/// };
/// let lines = vec![
///     road((0.0, -200.0), (0.0, 200.0)),
///     road((-200.0, 0.0), (200.0, 0.0)),
///     road((-200.0, 120.0), (200.0, 120.0)),
/// ];
/// let joining = RoadJoining { snap: 0.1, crossings: true, reach: 0.0 };
/// let index = RoadIndex::new(&RoadMap::new(lines, joining), RoadClass::Service)?;
/// assert_eq!((index.crossings(), index.pairs()), (2, 1));
/// # Ok::<(), pilotage_roads::lost::RoadIndexError>(())
/// ```
#[derive(Clone, Debug)]
pub struct RoadIndex {
    pub(super) map: RoadMap,
    pub(super) field: DirectionField,
    pub(super) tiles: PieceTiles,
    pub(super) junctions: Vec<Junction>,
    pub(super) pairs: CrossingPairs,
    /// Square kilometres within the bounds of the roads.
    pub(super) area: f64,
}

impl RoadIndex {
    /// The index of the roads of the class `least` or a greater one.
    pub fn new(map: &RoadMap, least: RoadClass) -> Result<Self, RoadIndexError> {
        let lines = map.lines().iter().filter(|line| line.class >= least);
        let map = RoadMap::new(lines.cloned().collect(), RoadJoining::SHARED_POINTS);
        let roads = map.bounds().ok_or(RoadIndexError::NoRoad)?;
        let area = 1e-6 * roads.width() * roads.height();
        if area.is_nan() || area > MOST_AREA {
            return Err(RoadIndexError::TooWide {
                north: 1e-3 * roads.height(),
                east: 1e-3 * roads.width(),
            });
        }
        let bounds: GroundRect = roads.grown(MARGIN);
        let tiles = PieceTiles::new(&map, &bounds);
        let field = DirectionField::new(&bounds, CELL, tiles.pieces());
        let junctions = junctions(&map, &tiles);
        let pairs = CrossingPairs::new(&junctions);
        Ok(Self {
            map,
            field,
            tiles,
            junctions,
            pairs,
            area,
        })
    }

    /// The roads in it.
    pub fn map(&self) -> &RoadMap {
        &self.map
    }

    /// Number of crossings, the two carriageways of a street as one.
    pub fn crossings(&self) -> usize {
        self.junctions.len()
    }

    /// Number of pairs of crossings.
    pub fn pairs(&self) -> usize {
        self.pairs.len()
    }

    /// Memory beside the map itself, bytes.
    pub fn bytes(&self) -> usize {
        let arms: usize = self.junctions.iter().map(|j| 32 + 8 * j.arms.len()).sum();
        self.field.bytes() + self.tiles.bytes() + self.pairs.bytes() + arms
    }
}
