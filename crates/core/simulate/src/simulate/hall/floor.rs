//! The floor of the hall: posters and taped roads on concrete, as drawn and as laid.

use nalgebra::{Matrix2, Vector2};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::super::scenery::noise::{fractal, value_noise};
use pilotage_base::frames::units::METRES_PER_FOOT;
use pilotage_base::frames::{GroundPoint, GroundRect};
use pilotage_base::georeference::GroundFromPixel;
use pilotage_raster::imagery::GeoreferencedPicture;
use pilotage_raster::raster::{Raster, Rgba};

/// Metres per pixel of the floor.
pub const FLOOR_GSD: f64 = 0.004;
/// Side of the floor, metres: 625 square feet.
pub const FLOOR_SIDE: f64 = 25.0 * METRES_PER_FOOT;
/// Side of a poster, metres.
const POSTER_SIDE: f64 = 0.6;
/// Posters from west to east, and from south to north.
const POSTERS_ACROSS: usize = 5;
/// Farthest that a poster lies from the middle of its part of the floor, along each axis, metres.
const POSTER_JITTER: f64 = 0.3;
/// Seed of the layout.
const LAYOUT_SEED: u64 = 625;
/// Width of a taped road, metres.
const ROAD_WIDTH: f64 = 0.2;
/// Width of its yellow line, metres.
const LINE_WIDTH: f64 = 0.03;

type Colour = [f32; 3];

/// Colours of the posters' figures: roofs, trees, fields, water.
const COLOURS: [Colour; 8] = [
    [178.0, 62.0, 48.0],
    [52.0, 104.0, 48.0],
    [214.0, 190.0, 92.0],
    [58.0, 112.0, 176.0],
    [232.0, 232.0, 226.0],
    [44.0, 44.0, 48.0],
    [132.0, 96.0, 60.0],
    [120.0, 168.0, 96.0],
];
const CONCRETE: Colour = [150.0, 148.0, 142.0];
const ROAD: Colour = [62.0, 62.0, 66.0];
const LINE: Colour = [236.0, 196.0, 40.0];

/// A figure on a poster, in metres east and north of the poster's middle.
#[derive(Clone, Copy, Debug)]
struct Figure {
    middle: Vector2<f64>,
    half: Vector2<f64>,
    into_own_axes: Matrix2<f64>,
    is_round: bool,
    colour: Colour,
}

impl Figure {
    fn covers(&self, point: &Vector2<f64>) -> bool {
        let own = (self.into_own_axes * (point - self.middle)).component_div(&self.half);
        if self.is_round {
            own.norm_squared() <= 1.0
        } else {
            own.amax() <= 1.0
        }
    }
}

/// A printed poster: a place of the make-believe country.
#[derive(Clone, Debug)]
struct Poster {
    middle: GroundPoint,
    ground: Colour,
    figures: Vec<Figure>,
}

impl Poster {
    fn drawn(random: &mut ChaCha8Rng, middle: GroundPoint) -> Self {
        let figures = (0..6).map(|_| {
            let turn: f64 = random.random_range(0.0..std::f64::consts::TAU);
            let (sin, cos) = turn.sin_cos();
            Figure {
                middle: Vector2::from_fn(|_, _| random.random_range(-0.22..0.22)),
                half: Vector2::from_fn(|_, _| random.random_range(0.03..0.12)),
                into_own_axes: Matrix2::new(cos, sin, -sin, cos),
                is_round: random.random_bool(0.4),
                colour: COLOURS[random.random_range(0..COLOURS.len())],
            }
        });
        Self {
            middle,
            figures: figures.collect(),
            ground: COLOURS[random.random_range(0..COLOURS.len())],
        }
    }

    fn bounds(&self) -> GroundRect {
        GroundRect::centered(self.middle, POSTER_SIDE, POSTER_SIDE)
    }

    fn colour(&self, place: &GroundPoint) -> Option<Colour> {
        let point = Vector2::new(
            place.east - self.middle.east,
            place.north - self.middle.north,
        );
        if point.amax() > 0.5 * POSTER_SIDE {
            return None;
        }
        let topmost = self.figures.iter().rev().find(|f| f.covers(&point));
        Some(topmost.map_or(self.ground, |figure| figure.colour))
    }
}

/// Floor of the hall with what lies on it; its origin is the middle of the hall.
#[derive(Clone, Debug)]
pub struct Floor {
    posters: Vec<Poster>,
}

/// Differences between the floor and its drawing.
#[derive(Clone, Copy, Debug)]
struct Wear {
    seed: u32,
}

impl Floor {
    /// The floor as drawn: the map.
    pub fn drawn() -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(LAYOUT_SEED);
        let part = FLOOR_SIDE / POSTERS_ACROSS as f64;
        let along = |i: usize| (i as f64 + 0.5) * part - 0.5 * FLOOR_SIDE;
        let posters = (0..POSTERS_ACROSS * POSTERS_ACROSS).map(|i| {
            let mut jitter = || random.random_range(-POSTER_JITTER..POSTER_JITTER);
            let middle = GroundPoint::new(
                along(i / POSTERS_ACROSS) + jitter(),
                along(i % POSTERS_ACROSS) + jitter(),
            );
            Poster::drawn(&mut random, middle)
        });
        Self {
            posters: posters.collect(),
        }
    }

    /// The same laid by hand, with this standard deviation per axis in metres.
    #[must_use]
    pub fn laid(&self, seed: u64, deviation: f64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut off = || -> f64 {
            let normal: f64 = StandardNormal.sample(&mut random);
            deviation * normal
        };
        let mut laid = self.clone();
        for poster in &mut laid.posters {
            poster.middle.north += off();
            poster.middle.east += off();
        }
        laid
    }

    /// Bounds of the posters.
    pub fn posters(&self) -> Vec<GroundRect> {
        self.posters.iter().map(Poster::bounds).collect()
    }

    /// Colour of the drawing at a place.
    fn colour(&self, place: &GroundPoint) -> Colour {
        let poster = self.posters.iter().find_map(|p| p.colour(place));
        poster.or_else(|| tape(place)).unwrap_or(CONCRETE)
    }

    /// The drawing as a map.
    pub fn map(&self) -> GeoreferencedPicture {
        picture("drawing of the hall", |place| self.colour(place))
    }

    /// The floor as a camera finds it: stained concrete, scuffs, lamps here and there.
    pub fn as_seen(&self, seed: u64) -> GeoreferencedPicture {
        let wear = Wear { seed: seed as u32 };
        picture("floor of the hall", |place| {
            wear.over(self.colour(place), place)
        })
    }
}

/// Colour of the tape at a place: two roads that cross, each with a line along its middle.
fn tape(place: &GroundPoint) -> Option<Colour> {
    let off = [
        place.north - 0.35 - 0.08 * place.east,
        place.east + 0.5 + 0.12 * place.north,
    ];
    let nearest = off.map(f64::abs).into_iter().fold(f64::MAX, f64::min);
    if nearest < 0.5 * LINE_WIDTH {
        Some(LINE)
    } else if nearest < 0.5 * ROAD_WIDTH {
        Some(ROAD)
    } else {
        None
    }
}

impl Wear {
    fn over(self, colour: Colour, place: &GroundPoint) -> Colour {
        let (x, y) = (place.east as f32, place.north as f32);
        let stains = 14.0 * fractal(x, y, 1.2, 5, FLOOR_GSD as f32, self.seed);
        // A shoe's width, where many walked.
        let scuff = value_noise(x / 0.05, y / 0.3, self.seed ^ 1).max(0.6) - 0.6;
        let lamps = 1.0 + 0.15 * value_noise(x / 3.0, y / 3.0, self.seed ^ 2);
        colour.map(|c| lamps * (c + stains - 60.0 * scuff))
    }
}

/// A picture of the whole floor.
fn picture(name: &str, colour: impl Fn(&GroundPoint) -> Colour) -> GeoreferencedPicture {
    let side = (FLOOR_SIDE / FLOOR_GSD).floor() as usize;
    let corner = Vector2::new(0.5, -0.5) * FLOOR_SIDE;
    let place = |i: usize| (i as f64 + 0.5) * FLOOR_GSD;
    let pixels: Raster<Rgba> = Raster::from_fn(side, side, |column, row| {
        let ground = GroundPoint::new(corner.x - place(row), corner.y + place(column));
        let [r, g, b] = colour(&ground).map(|c| c.round().clamp(0.0, 255.0) as u8);
        [r, g, b, 255]
    });
    let on_ground = GroundFromPixel {
        matrix: Matrix2::new(0.0, -FLOOR_GSD, FLOOR_GSD, 0.0),
        corner,
    };
    GeoreferencedPicture::new(name, pixels, on_ground)
        .expect("the floor has pixels, and they span an area")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_has_625_square_feet_and_posters_that_do_not_overlap() {
        let bounds = GroundRect::centered(GroundPoint::default(), FLOOR_SIDE, FLOOR_SIDE);
        assert!((bounds.width() * bounds.height() / METRES_PER_FOOT.powi(2) - 625.0).abs() < 1e-9);
        let posters = Floor::drawn().posters();
        for (i, one) in posters.iter().enumerate() {
            assert!(one.north <= bounds.north && one.south >= bounds.south);
            assert!(one.east <= bounds.east && one.west >= bounds.west);
            for other in &posters[..i] {
                let apart = one.center().to_vector() - other.center().to_vector();
                assert!(apart.amax() > POSTER_SIDE, "{one:?} {other:?}");
            }
        }
    }
}
