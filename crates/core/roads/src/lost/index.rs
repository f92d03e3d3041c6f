//! A road map made ready for being found in.

use std::error::Error;
use std::fmt;

use pilotage_base::frames::{GroundPoint, GroundRect};

use super::field::DirectionField;
use super::junctions::{Junction, junctions};
use super::pairs::CrossingPairs;
use super::tiles::PieceTiles;
use crate::line::RoadClass;
use crate::map::RoadMap;
use crate::weave::RoadJoining;

/// Side of a cell of the field of distances, metres.
pub(super) const CELL: f64 = 5.0;
/// Ground around the outermost roads that belongs to the index, metres.
pub(super) const MARGIN: f64 = 40.0;

/// Most square kilometres within the bounds of the roads of one index; their field of distances takes 1.6 GB.
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
    /// The views and the ways between them reach too far for a map that is searched in parts.
    TooFarAlong {
        /// Distance that they reach from the last view, kilometres.
        reach: f64,
        /// The greatest one, kilometres.
        most: f64,
    },
    /// The roads lie too far apart to be laid on one plane.
    TooFarApart {
        /// Way from the northernmost to the southernmost, kilometres.
        north: f64,
        /// Way from the westernmost to the easternmost, kilometres.
        east: f64,
        /// The greatest one, kilometres.
        most: f64,
    },
    /// There is no road where places are sought.
    NoRoadAround,
}

impl fmt::Display for RoadIndexError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRoad => f.write_str("it has no road of that class; lower --least"),
            Self::TooWide { north, east } => write!(
                f,
                "its roads span {north:.0} km by {east:.0} km, and at most {MOST_AREA:.0} km² can be searched at once; search \
                 it in parts"
            ),
            Self::TooFarAlong { reach, most } => write!(
                f,
                "the views and the ways between them reach {reach:.0} km from the last of them, and around a place, or on a \
                 map of more than 100 km², at most {most:.0} km can be searched; leave out the first views"
            ),
            Self::TooFarApart { north, east, most } => write!(
                f,
                "its roads span {north:.0} km by {east:.0} km, and at most {most:.0} km lie on one plane; give --around, or the \
                 part that the views may show"
            ),
            Self::NoRoadAround => f.write_str(
                "it has no road around that place; give another --around, or a greater --within",
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
    /// Square kilometres that are searched: those within the bounds of the roads, or all of the parts.
    pub(super) area: f64,
    /// Places that are sought, the northern and eastern edge excluded; all where the map is searched as one.
    pub(super) core: Option<GroundRect>,
    /// Ground of the index over that on which places are sought.
    pub(super) share: f64,
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
        Ok(Self::over(map, &roads.grown(MARGIN), area))
    }

    /// The index of a part of a map: of all roads over `bounds`, among which places in `core` are sought, while `area` square
    /// kilometres are searched in all parts.
    pub(super) fn of_part(map: RoadMap, core: &GroundRect, bounds: &GroundRect, area: f64) -> Self {
        let grown = bounds.width() * bounds.height();
        Self {
            core: Some(*core),
            share: (grown / (core.width() * core.height()).max(1.0)).max(1.0),
            ..Self::over(map, bounds, area)
        }
    }

    fn over(map: RoadMap, bounds: &GroundRect, area: f64) -> Self {
        let tiles = PieceTiles::new(&map, bounds);
        let field = DirectionField::new(bounds, CELL, tiles.pieces());
        let junctions = junctions(&map, &tiles);
        let pairs = CrossingPairs::new(&junctions);
        Self {
            map,
            field,
            tiles,
            junctions,
            pairs,
            area,
            core: None,
            share: 1.0,
        }
    }

    /// Whether places `margin` metres beside those that are sought hold that one.
    pub(super) fn is_sought(&self, place: &GroundPoint, margin: f64) -> bool {
        self.core.is_none_or(|core| {
            let core = core.grown(margin);
            (core.south..core.north).contains(&place.north)
                && (core.west..core.east).contains(&place.east)
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
