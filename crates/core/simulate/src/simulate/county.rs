//! A county: squares of generated scenery side by side, some with a village and most without.

use std::f64::consts::FRAC_PI_2;
use std::sync::OnceLock;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::scenario::{LANDMARKS, picked};
use super::scenery::{Day, NATIVE_GSD, ROAD_JOINING, Scenery};
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_raster::raster::{Raster, Rgba};
use pilotage_roads::{RoadJoining, RoadLine};
use pilotage_vision::landmark::Landmark;

/// Side of a square, metres.
const SIDE: f64 = 2400.0;
/// Squares on a side of the county: 12 km.
const SQUARES: usize = 5;
/// Share of the squares that have a village.
const SETTLED: f64 = 0.36;

/// 12 km by 12 km of generated ground around the world's origin.
///
/// Every square has a seed and a quarter turn of its own, so that no two look alike; the sun stands in
/// the same place over all of them. Squares are laid out when something of them is first asked for.
pub struct County {
    day: Day,
    squares: Vec<Square>,
}

struct Square {
    seed: u64,
    settled: bool,
    /// Quarter turns, clockwise, from the ground to the square's own scenery.
    turns: usize,
    scenery: OnceLock<Scenery>,
}

impl Square {
    fn scenery(&self, day: &Day) -> &Scenery {
        self.scenery.get_or_init(|| {
            let day = Day {
                sun_azimuth: day.sun_azimuth + FRAC_PI_2 * self.turns as f64,
                ..*day
            };
            if self.settled {
                Scenery::new(self.seed, day)
            } else {
                Scenery::open_country(self.seed, day)
            }
        })
    }

    /// The place in the county of a place of the square's own scenery, for a square around `middle`.
    fn in_county(&self, place: GroundPoint, middle: GroundPoint) -> GroundPoint {
        let turned = turn(place, 4 - self.turns);
        GroundPoint::new(turned.north + middle.north, turned.east + middle.east)
    }

    /// Pixels of a window in metres from the middle of the square.
    fn window(&self, day: &Day, window: &Window) -> Raster<Rgba> {
        let scenery = self.scenery(day);
        let r = window.rect();
        let (w, h) = (window.width, window.height);
        let (north_edge, west_edge) = match self.turns {
            0 => return scenery.window(window),
            1 => (-r.west, r.south),
            2 => (-r.south, -r.east),
            _ => (r.east, -r.north),
        };
        let sideways = self.turns % 2 == 1;
        let (width, height) = if sideways { (h, w) } else { (w, h) };
        let turned = scenery.window(&Window {
            north_edge,
            west_edge,
            gsd: window.gsd,
            width,
            height,
        });
        Raster::from_fn(w, h, |column, row| match self.turns {
            1 => turned.get(h - 1 - row, column),
            2 => turned.get(w - 1 - column, h - 1 - row),
            _ => turned.get(row, w - 1 - column),
        })
    }
}

/// A point turned clockwise by quarter turns.
fn turn(p: GroundPoint, turns: usize) -> GroundPoint {
    match turns % 4 {
        0 => p,
        1 => GroundPoint::new(-p.east, p.north),
        2 => GroundPoint::new(-p.north, -p.east),
        _ => GroundPoint::new(p.east, -p.north),
    }
}

impl County {
    /// The county of `seed` under the light of `day`; laid out square by square as it is looked at.
    pub fn new(seed: u64, day: Day) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed ^ 0xc0_0917);
        let squares = (0..SQUARES * SQUARES)
            .map(|_| Square {
                settled: random.random::<f64>() < SETTLED,
                turns: random.random_range(0..4),
                seed: random.random::<u64>() >> 1,
                scenery: OnceLock::new(),
            })
            .collect();
        Self { day, squares }
    }

    fn middle(index: usize) -> GroundPoint {
        let half = 0.5 * (SQUARES as f64 - 1.0);
        GroundPoint::new(
            SIDE * (half - (index / SQUARES) as f64),
            SIDE * ((index % SQUARES) as f64 - half),
        )
    }

    /// Middles of the squares that have a village.
    pub fn villages(&self) -> Vec<GroundPoint> {
        let settled = self.squares.iter().enumerate().filter(|(_, s)| s.settled);
        settled.map(|(index, _)| Self::middle(index)).collect()
    }

    /// The landmarks of every village: the same ten as those of the built-in scenarios, by name and
    /// village.
    pub fn landmarks(&self) -> Vec<Landmark> {
        let mut landmarks = Vec::new();
        for (index, square) in self.squares.iter().enumerate() {
            if !square.settled {
                continue;
            }
            let middle = Self::middle(index);
            let features = square.scenery(&self.day).distinct_features();
            for feature in features.into_iter().take(LANDMARKS) {
                let bounds = picked(&feature);
                let center = square.in_county(bounds.center(), middle);
                let (height, width) = if square.turns % 2 == 1 {
                    (bounds.width(), bounds.height())
                } else {
                    (bounds.height(), bounds.width())
                };
                let id = landmarks.len() as u32 + 1;
                let name = format!("{} {index}", feature.name);
                let bounds = GroundRect::centered(center, height, width);
                landmarks.push(Landmark::new(id, name, bounds));
            }
        }
        landmarks
    }

    /// Centre lines and widths of the roads of every village, with the rule by which they meet.
    pub fn roads(&self) -> (Vec<RoadLine>, RoadJoining) {
        // Open country has no roads, and need not be laid out to be asked for them.
        let settled = (0..self.squares.len()).filter(|index| self.squares[*index].settled);
        let lines = settled.flat_map(|index| self.roads_of(index));
        (lines.collect(), ROAD_JOINING)
    }

    /// Roads of one square.
    fn roads_of(&self, index: usize) -> Vec<RoadLine> {
        let (square, middle) = (&self.squares[index], Self::middle(index));
        let (mut lines, _) = square.scenery(&self.day).roads();
        for place in lines.iter_mut().flat_map(|line| &mut line.course) {
            *place = square.in_county(*place, middle);
        }
        lines
    }
}

impl Imagery for County {
    fn name(&self) -> &'static str {
        "generated county"
    }

    fn bounds(&self) -> GroundRect {
        let side = SIDE * SQUARES as f64;
        GroundRect::centered(GroundPoint::default(), side, side)
    }

    fn native_gsd(&self) -> f64 {
        NATIVE_GSD
    }

    fn window(&self, window: &Window) -> Raster<Rgba> {
        let mut whole = Raster::from_fn(window.width, window.height, |_, _| [0; 4]);
        let rect = window.rect();
        for (index, square) in self.squares.iter().enumerate() {
            let middle = Self::middle(index);
            let ground = GroundRect::centered(middle, SIDE, SIDE);
            if !ground.overlaps(&rect) {
                continue;
            }
            // Pixels whose middle lies in the square.
            let first = |edge: f64| (edge / window.gsd - 0.5).ceil().max(0.0) as usize;
            let columns = first(ground.west - window.west_edge).min(window.width)
                ..first(ground.east - window.west_edge).min(window.width);
            let rows = first(window.north_edge - ground.north).min(window.height)
                ..first(window.north_edge - ground.south).min(window.height);
            if columns.is_empty() || rows.is_empty() {
                continue;
            }
            let part = square.window(
                &self.day,
                &Window {
                    north_edge: window.north_edge - rows.start as f64 * window.gsd - middle.north,
                    west_edge: window.west_edge + columns.start as f64 * window.gsd - middle.east,
                    gsd: window.gsd,
                    width: columns.len(),
                    height: rows.len(),
                },
            );
            for row in rows.clone() {
                for column in columns.clone() {
                    let pixel = part.get(column - columns.start, row - rows.start);
                    whole.set(column, row, pixel);
                }
            }
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_landmark_shows_what_its_village_shows_whatever_its_turn() {
        let county = County::new(3, Day::map_day());
        let landmarks = county.landmarks();
        assert_eq!(landmarks.len(), 10 * county.villages().len());
        for (index, square) in county.squares.iter().enumerate() {
            if !square.settled {
                continue;
            }
            let feature = &square.scenery(&county.day).distinct_features()[2];
            let own = picked(feature);
            let name = format!("{} {index}", feature.name);
            let landmark = landmarks.iter().find(|l| l.name == name).unwrap();
            let seen = county.window(&Window::covering(&landmark.bounds, 2.0));
            let there = square
                .scenery(&county.day)
                .window(&Window::covering(&own, 2.0));
            let mean = |picture: &Raster<Rgba>| {
                let sum: f64 = picture.pixels().iter().map(|p| f64::from(p[1])).sum();
                sum / picture.pixels().len() as f64
            };
            assert!((mean(&seen) - mean(&there)).abs() < 1.5, "{name}");
            assert!(seen.pixels().iter().all(|p| p[3] == 255));
        }
    }

    #[test]
    fn a_window_over_four_squares_has_every_pixel_of_each() {
        let county = County::new(1, Day::map_day());
        let corner = GroundPoint::new(1200.0, -1200.0);
        let rect = GroundRect::centered(corner, 41.0, 37.0);
        let whole = county.window(&Window::covering(&rect, 1.0));
        assert!(whole.pixels().iter().all(|p| p[3] == 255));
        // A part of it asked for alone is the same.
        let part = county.window(&Window {
            width: 12,
            height: 9,
            ..Window::covering(&rect, 1.0)
        });
        for row in 0..9 {
            for column in 0..12 {
                assert_eq!(whole.get(column, row), part.get(column, row));
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_county_and_some_of_it_is_open() {
        let (a, b) = (
            County::new(5, Day::map_day()),
            County::new(5, Day::other_day()),
        );
        assert_eq!(a.villages(), b.villages());
        assert!((3..18).contains(&a.villages().len()));
    }

    #[test]
    fn roads_lie_on_asphalt_in_a_square_that_is_turned() {
        let county = County::new(3, Day::map_day());
        let turned = |s: &Square| s.settled && s.turns % 2 == 1;
        let index = county.squares.iter().position(turned).unwrap();
        let lines = county.roads_of(index);
        let main: Vec<_> = lines.iter().filter(|line| line.width > 7.0).collect();
        let is_grey = |p: &&Rgba| p[..3].iter().max().unwrap() - p[..3].iter().min().unwrap() < 24;
        let lies_on_asphalt = |line: &&&RoadLine| {
            let place = line.course[line.course.len() / 2];
            let around = GroundRect::centered(place, 4.0, 4.0);
            let seen = county.window(&Window::covering(&around, 0.5));
            10 * seen.pixels().iter().filter(is_grey).count() > 7 * seen.pixels().len()
        };
        let count = main.iter().filter(lies_on_asphalt).count();
        assert!(
            main.len() >= 4 && count + 1 >= main.len(),
            "{count} of {}",
            main.len()
        );
    }
}
