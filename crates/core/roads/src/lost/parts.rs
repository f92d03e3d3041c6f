//! A map of any extent, parted into squares that are searched one by one.

use std::collections::{BTreeMap, BTreeSet};

use pilotage_base::frames::{GroundPoint, GroundRect};

use super::index::{CELL, MARGIN, RoadIndex, RoadIndexError};
use super::reach::reach_of_views;
use super::view::{RoadView, ViewMotion};
use crate::course::between;
use crate::line::{RoadClass, RoadLine};
use crate::map::RoadMap;
use crate::weave::RoadJoining;

/// Greatest reach of views over a map that is parted, metres: the squares grow with it, and their memory.
const FARTHEST: f64 = 10e3;
/// Greatest extent of a map, metres: 500 km from its middle a plane is 0.3 % too small or too large.
const WIDEST: f64 = 1000e3;
/// Half the way around the globe, metres.
const HALF_AROUND: f64 = 20e6;

/// Ground that is searched, and its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartSettings {
    /// The least class of road that is searched.
    pub least: RoadClass,
    /// Distance from a place within which all lies that is compared there, metres.
    pub reach: f64,
    /// Rectangle in which places are sought, metres in the world frame; all of the map if absent.
    pub around: Option<GroundRect>,
    /// Area that is searched at once, square metres: the number of poses that are tried, and of those that are kept, is
    /// that of 100 km².
    pub area: f64,
}

impl PartSettings {
    /// The search for the last of several views among roads of the class `least` or a greater one; `scale` is the standard
    /// deviation of their scale as a share.
    pub fn of_views(
        least: RoadClass,
        first: &RoadView,
        then: &[(ViewMotion, RoadView)],
        scale: f64,
    ) -> Self {
        Self {
            least,
            reach: reach_of_views(first, then, scale),
            around: None,
            area: 100e6,
        }
    }
}

/// Part of a map: places in it belong to no other.
#[derive(Clone, Debug)]
struct RoadPart {
    /// Places that are sought in it, the northern and eastern edge excluded.
    core: GroundRect,
    /// Lines within reach of it.
    lines: Vec<u32>,
}

/// Roads of a map of any extent, in parts that are made ready one by one. Ground without roads is no part.
///
/// ```
/// use pilotage_base::frames::GroundPoint;
/// use pilotage_roads::lost::{PartSettings, RoadParts};
/// use pilotage_roads::{RoadClass, RoadLine};
///
/// let road = |north: f64| RoadLine {
///     course: [(north, 0.0), (north, 900.0)].map(|(n, e)| GroundPoint::new(n, e)).to_vec(),
///     ..RoadLine::default()
/// };
/// let settings = PartSettings { least: RoadClass::Service, reach: 600.0, around: None, area: 100e6 };
/// let near = RoadParts::new(vec![road(0.0), road(500.0)], &settings)?;
/// assert_eq!(near.count(), 1);
/// // 300 km of empty ground between them.
/// let far = RoadParts::new(vec![road(0.0), road(300e3)], &settings)?;
/// assert_eq!(far.count(), 2);
/// # Ok::<(), pilotage_roads::lost::RoadIndexError>(())
/// ```
#[derive(Clone, Debug)]
pub struct RoadParts {
    lines: Vec<RoadLine>,
    least: RoadClass,
    reach: f64,
    /// Bounds of all roads.
    bounds: GroundRect,
    /// Area of the parts in which roads lie, square metres.
    area: f64,
    /// The parts; none where the map is searched as one.
    parts: Vec<RoadPart>,
}

impl RoadParts {
    /// Parts of the map of `lines`: one where it has at most the area that is searched at once, else squares of it.
    pub fn new(lines: Vec<RoadLine>, settings: &PartSettings) -> Result<Self, RoadIndexError> {
        let is_near = |line: &RoadLine| {
            (line.course.iter()).all(|p| p.north.is_finite() && p.east.is_finite())
        };
        let sought = |line: &&RoadLine| {
            line.class >= settings.least && line.course.len() > 1 && is_near(line)
        };
        let places = lines.iter().filter(sought).flat_map(|line| &line.course);
        let bounds: GroundRect =
            GroundRect::around(places.copied()).ok_or(RoadIndexError::NoRoad)?;
        let area = bounds.width() * bounds.height();
        let mut own = Self {
            lines,
            least: settings.least,
            reach: settings.reach,
            bounds,
            area,
            parts: Vec::new(),
        };
        // What lies on the other side of the globe has no place on the plane.
        let are_near = own.lines.iter().all(is_near);
        let extent = |own: f64| if are_near { own } else { HALF_AROUND };
        let (north, east) = (extent(bounds.height()), extent(bounds.width()));
        if settings.around.is_none() && north.max(east) > WIDEST {
            return Err(RoadIndexError::TooFarApart {
                north: 1e-3 * north,
                east: 1e-3 * east,
                most: 1e-3 * WIDEST,
            });
        }
        if settings.around.is_none() && area <= settings.area {
            return Ok(own);
        }
        if settings.reach > FARTHEST {
            return Err(RoadIndexError::TooFarAlong {
                reach: 1e-3 * settings.reach,
                most: 1e-3 * FARTHEST,
            });
        }
        own.lines.retain(|line| sought(&line));
        // Places beside the outermost roads show these as well.
        let around = settings.around.unwrap_or(bounds.grown(settings.reach));
        let within = common(&bounds.grown(settings.reach), &around);
        let grid = PartGrid::new(&within.ok_or(RoadIndexError::NoRoadAround)?, settings);
        own.part(&grid);
        if own.parts.is_empty() {
            return Err(RoadIndexError::NoRoadAround);
        }
        Ok(own)
    }

    fn part(&mut self, grid: &PartGrid) {
        let mut lines_of: BTreeMap<(usize, usize), Vec<u32>> = BTreeMap::new();
        let mut with_roads = BTreeSet::new();
        for (number, line) in self.lines.iter().enumerate() {
            for piece in grid.pieces(&line.course) {
                with_roads.extend(grid.cells(&piece));
                for cell in grid.cells(&piece.grown(self.reach)) {
                    let lines = lines_of.entry(cell).or_default();
                    if lines.last() != Some(&(number as u32)) {
                        lines.push(number as u32);
                    }
                }
            }
        }
        let of_cell = |cell: &(usize, usize)| common(&grid.core(*cell), &self.bounds);
        let areas = with_roads.iter().filter_map(of_cell);
        self.area = areas.map(|rect| rect.width() * rect.height()).sum();
        let parts = lines_of.into_iter().map(|(cell, lines)| RoadPart {
            core: grid.core(cell),
            lines,
        });
        self.parts = parts.collect();
    }

    /// Number of parts.
    pub fn count(&self) -> usize {
        self.parts.len().max(1)
    }

    /// Area that is searched, square kilometres: that of the parts in which roads lie.
    pub fn area(&self) -> f64 {
        1e-6 * self.area
    }

    /// Memory that the largest part takes once it is made ready, bytes, roughly: the distances to roads of its ground, and
    /// as much again six times for pairs of crossings where roads are as dense as in Aleppo (18.8 km per km²).
    pub fn bytes_at_once(&self) -> f64 {
        let whole = std::iter::once(self.bounds.grown(MARGIN));
        let parts = self.parts.iter().map(|part| part.core.grown(self.reach));
        let grounds = whole.filter(|_| self.parts.is_empty()).chain(parts);
        let area = |ground: GroundRect| ground.width() * ground.height();
        let largest = grounds.map(area).fold(0.0, f64::max);
        7.0 * 8.0 * largest / (CELL * CELL)
    }

    /// The part of that number made ready; `None` where its roads have no crossing, so that no place is found in it.
    ///
    /// # Panics
    /// If there is no part of that number.
    pub fn index(&self, number: usize) -> Option<RoadIndex> {
        if self.parts.is_empty() {
            let map = RoadMap::new(self.lines.clone(), RoadJoining::SHARED_POINTS);
            return RoadIndex::new(&map, self.least).ok();
        }
        let part = &self.parts[number];
        let ground = part.core.grown(self.reach);
        let cut = part.lines.iter();
        let cut = cut.flat_map(|line| self.lines[*line as usize].within(&ground));
        let map = RoadMap::new(cut.collect(), RoadJoining::SHARED_POINTS);
        if map.crossings().is_empty() {
            return None;
        }
        let all = self.bounds.grown(MARGIN);
        let ground = common(&ground, &all)?;
        // Cells lie as those of the whole map would.
        let cells = |from: f64, to: f64| from + CELL * ((to - from) / CELL).floor();
        let bounds = GroundRect {
            south: cells(all.south, ground.south),
            west: cells(all.west, ground.west),
            ..ground
        };
        Some(RoadIndex::of_part(map, &part.core, &bounds, self.area()))
    }
}

/// The rectangle that two share.
fn common(a: &GroundRect, b: &GroundRect) -> Option<GroundRect> {
    let rect = GroundRect {
        south: a.south.max(b.south),
        north: a.north.min(b.north),
        west: a.west.max(b.west),
        east: a.east.min(b.east),
    };
    (rect.south <= rect.north && rect.west <= rect.east).then_some(rect)
}

/// Rectangle divided into equal parts.
struct PartGrid {
    south: f64,
    west: f64,
    /// Extent of a part to the north and to the east, metres.
    sides: [f64; 2],
    counts: [usize; 2],
}

impl PartGrid {
    fn new(within: &GroundRect, settings: &PartSettings) -> Self {
        let side = settings.area.sqrt().max(2.0 * settings.reach);
        let extents = [within.height(), within.width()];
        let counts = extents.map(|extent| (extent / side).ceil().max(1.0) as usize);
        Self {
            south: within.south,
            west: within.west,
            sides: [0, 1].map(|k| extents[k] / counts[k] as f64),
            counts,
        }
    }

    /// The part of that row and column. Neighbours have their edge in common to the bit.
    fn core(&self, (row, column): (usize, usize)) -> GroundRect {
        let north = |row: usize| self.south + row as f64 * self.sides[0];
        let east = |column: usize| self.west + column as f64 * self.sides[1];
        GroundRect {
            south: north(row),
            north: north(row + 1),
            west: east(column),
            east: east(column + 1),
        }
    }

    /// Rows and columns of the parts that a rectangle touches.
    fn cells(&self, rect: &GroundRect) -> impl Iterator<Item = (usize, usize)> + use<> {
        let range = |low: f64, high: f64, axis: usize| {
            let at = |off: f64| (off / self.sides[axis].max(f64::MIN_POSITIVE)).floor();
            let (first, last) = (at(low).max(0.0), at(high) + 1.0);
            first as usize..(last.max(0.0) as usize).min(self.counts[axis])
        };
        let columns = range(rect.west - self.west, rect.east - self.west, 1);
        let rows = range(rect.south - self.south, rect.north - self.south, 0);
        rows.flat_map(move |row| columns.clone().map(move |column| (row, column)))
    }

    /// Rectangles around the pieces of a course, so short that a slanted one does not stand for all of its bounding box.
    fn pieces(&self, course: &[GroundPoint]) -> impl Iterator<Item = GroundRect> {
        let most = 0.5 * self.sides[0].min(self.sides[1]).max(1.0);
        course.windows(2).flat_map(move |pair| {
            let (from, to) = (pair[0], pair[1]);
            let count = (from.distance(&to) / most).ceil().max(1.0) as usize;
            (0..count).filter_map(move |k| {
                let at = |k: usize| between(from, to, k as f64 / count as f64);
                GroundRect::around([at(k), at(k + 1)])
            })
        })
    }
}
