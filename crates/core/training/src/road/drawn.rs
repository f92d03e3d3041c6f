//! Pictures of ground with roads that never were: every kind of surface, plan and surrounding, drawn by a seed.
//!
//! The generated world has one road network and one way of looking; a network that is to know the roads of any place
//! has to see that colour, width, edges and neighbours of a road are anything.

use pilotage_raster::raster::Raster;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::example::{RoadExample, RoadTruth};
use super::painter::{Paint, PaintedSlab, Painter, mixed, noise, scaled};

/// Pixels between the points of a road's course.
const STEP: f32 = 6.0;

struct Course {
    points: Vec<[f32; 2]>,
    half_width: f32,
    is_dirt: bool,
}

struct Draw {
    random: ChaCha8Rng,
    side: f32,
    seed: u32,
}

impl Draw {
    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.random.random::<f32>()
    }

    fn chance(&mut self, share: f32) -> bool {
        self.random.random::<f32>() < share
    }

    /// A count up to and without `most`.
    fn count(&mut self, most: usize) -> usize {
        self.random.random_range(0..most)
    }

    fn place(&mut self) -> [f32; 2] {
        [self.between(0.0, self.side), self.between(0.0, self.side)]
    }

    /// A colour near one of the list.
    fn near(&mut self, list: &[Paint], by: f32) -> Paint {
        let paint = list[self.count(list.len())];
        let level = self.between(-by, by);
        paint.map(|value| (value + level + self.between(-0.3 * by, 0.3 * by)).clamp(8.0, 250.0))
    }

    /// A course from a place on: heading in radians, turning by up to `bend` per step.
    fn course(
        &mut self,
        mut at: [f32; 2],
        mut heading: f32,
        steps: usize,
        bend: f32,
    ) -> Vec<[f32; 2]> {
        let mut turn = 0.0;
        let mut points = vec![at];
        for _ in 0..steps {
            turn = 0.85 * turn + self.between(-bend, bend);
            heading += turn;
            at = [at[0] + STEP * heading.cos(), at[1] + STEP * heading.sin()];
            points.push(at);
        }
        points
    }
}

const GROUND: [Paint; 10] = [
    [88.0, 104.0, 66.0],
    [70.0, 92.0, 58.0],
    [150.0, 142.0, 104.0],
    [128.0, 122.0, 84.0],
    [146.0, 116.0, 88.0],
    [188.0, 172.0, 142.0],
    [48.0, 62.0, 44.0],
    [104.0, 118.0, 74.0],
    [120.0, 108.0, 92.0],
    [164.0, 156.0, 128.0],
];
const SEALED: [Paint; 5] = [
    [78.0, 78.0, 82.0],
    [104.0, 104.0, 106.0],
    [132.0, 130.0, 128.0],
    [160.0, 158.0, 154.0],
    [182.0, 180.0, 174.0],
];
const DIRT: [Paint; 4] = [
    [170.0, 148.0, 118.0],
    [196.0, 180.0, 152.0],
    [150.0, 116.0, 88.0],
    [176.0, 170.0, 158.0],
];
const ROOFS: [Paint; 8] = [
    [120.0, 118.0, 118.0],
    [84.0, 80.0, 80.0],
    [170.0, 110.0, 88.0],
    [150.0, 92.0, 72.0],
    [200.0, 198.0, 192.0],
    [228.0, 226.0, 222.0],
    [112.0, 92.0, 78.0],
    [96.0, 112.0, 140.0],
];
const CROWNS: [Paint; 4] = [
    [46.0, 62.0, 36.0],
    [62.0, 78.0, 46.0],
    [82.0, 92.0, 58.0],
    [96.0, 84.0, 60.0],
];

/// A square picture of `side` pixels (a multiple of 4) at half a metre each, with its roads.
pub fn drawn_roads(seed: u64, side: usize) -> RoadExample {
    drawn(seed, side, plan)
}

/// The same around roads that are given: points of the middle (pixels, x right, y down, some 6 apart) and half the
/// width (pixels) of each.
pub fn drawn_over(seed: u64, side: usize, roads: Vec<(Vec<[f32; 2]>, f32)>) -> RoadExample {
    let course = |(points, half_width): (Vec<[f32; 2]>, f32)| Course {
        points,
        half_width,
        is_dirt: false,
    };
    drawn(seed, side, |_| roads.into_iter().map(course).collect())
}

fn drawn(seed: u64, side: usize, plan: impl FnOnce(&mut Draw) -> Vec<Course>) -> RoadExample {
    let mut draw = Draw {
        random: ChaCha8Rng::seed_from_u64(seed ^ 0x0a0d_5eed),
        side: side as f32,
        seed: seed as u32,
    };
    let mut painter = Painter::new(side, draw.seed);
    ground(&mut painter, &mut draw);
    let sun = draw.between(0.0, std::f32::consts::TAU);
    let length = draw.between(3.0, 14.0);
    let shadow = [length * sun.cos(), length * sun.sin()];
    if draw.chance(0.12) {
        stream(&mut painter, &mut draw);
    }
    let roads = plan(&mut draw);
    for _ in 0..draw.count(4) {
        car_park(&mut painter, &mut draw);
    }
    for _ in 0..draw.count(5) {
        hall(&mut painter, &mut draw, &roads, shadow);
    }
    let town = draw.chance(0.65);
    let drives = if town {
        houses(&mut painter, &mut draw, &roads, shadow)
    } else {
        0
    };
    lay(&mut painter, &mut draw, &roads);
    crowns(&mut painter, &mut draw, &roads, shadow, town && drives > 0);
    painter.finished()
}

/// Parcels of different ground, some with rows.
fn ground(painter: &mut Painter, draw: &mut Draw) {
    let heading = draw.between(0.0, std::f32::consts::PI);
    let (sin, cos) = heading.sin_cos();
    let size = [draw.between(40.0, 260.0), draw.between(40.0, 260.0)];
    let is_even = draw.chance(0.3);
    let kinds: Vec<(Paint, f32, f32, f32)> = (0..24)
        .map(|_| {
            let paint = draw.near(&GROUND, 22.0);
            let rows = if draw.chance(0.25) {
                draw.between(3.0, 12.0)
            } else {
                0.0
            };
            (
                paint,
                draw.between(0.02, 0.14),
                rows,
                draw.between(0.03, 0.14),
            )
        })
        .collect();
    let (hedge, hedge_width) = (draw.near(&CROWNS, 15.0), draw.between(-2.0, 3.0));
    let seed = draw.seed;
    let side = painter.colours.width();
    painter.colours = Raster::from_fn(side, side, |column, row| {
        let p = [column as f32, row as f32];
        let (u, v) = (p[0] * cos + p[1] * sin, p[1] * cos - p[0] * sin);
        let (a, b) = ((u / size[0]).floor(), (v / size[1]).floor());
        let index = (a as i32)
            .wrapping_mul(7)
            .wrapping_add((b as i32).wrapping_mul(13));
        let kind = if is_even {
            0
        } else {
            index.rem_euclid(24) as usize
        };
        let (paint, rough, rows, depth) = kinds[kind];
        let stripes = if rows > 0.0 {
            depth * ((if index % 2 == 0 { u } else { v }) * std::f32::consts::TAU / rows).sin()
        } else {
            0.0
        };
        let grain = noise(p, 1.5, seed) + noise(p, 5.0, seed ^ 1) + 1.4 * noise(p, 30.0, seed ^ 2);
        let paint = scaled(paint, 1.0 + rough * grain + stripes);
        let from_edge = (u - a * size[0]).min(v - b * size[1]);
        if !is_even && from_edge < hedge_width {
            scaled(hedge, 1.0 + 0.3 * noise(p, 2.0, seed ^ 3))
        } else {
            paint
        }
    });
}

/// Water, which is no road.
fn stream(painter: &mut Painter, draw: &mut Draw) {
    let (start, heading) = (draw.place(), draw.between(0.0, std::f32::consts::TAU));
    let points = draw.course(start, heading, 140, 0.06);
    let half = draw.between(2.0, 16.0);
    let water = draw.near(
        &[
            [44.0, 52.0, 50.0],
            [90.0, 104.0, 96.0],
            [130.0, 120.0, 96.0],
        ],
        15.0,
    );
    let seed = draw.seed;
    for at in points {
        let depth = |p: [f32; 2]| half + noise(p, 9.0, seed) - (p[0] - at[0]).hypot(p[1] - at[1]);
        let paint = |p: [f32; 2], _: Paint| scaled(water, 1.0 + 0.04 * noise(p, 4.0, seed ^ 9));
        painter.shape(at, half + 3.0, depth, paint, Some(RoadTruth::Open));
    }
}

/// Courses of the roads: a grid of streets, or through roads with side roads.
fn plan(draw: &mut Draw) -> Vec<Course> {
    let mut roads = Vec::new();
    let dirt = if draw.chance(0.3) { 0.8 } else { 0.08 };
    let long = (2.2 * draw.side / STEP) as usize;
    let bend = [0.0, 0.008, 0.02, 0.045][draw.count(4)];
    if draw.chance(0.35) {
        let heading = draw.between(0.0, std::f32::consts::PI);
        let half_width = draw.between(4.5, 9.5);
        for quarter in 0..2 {
            let heading = heading + quarter as f32 * std::f32::consts::FRAC_PI_2;
            let (sin, cos) = heading.sin_cos();
            let spacing = draw.between(90.0, 260.0);
            let mut offset = -draw.side + draw.between(0.0, spacing);
            while offset < draw.side {
                if draw.chance(0.85) {
                    let middle = 0.5 * draw.side;
                    let start = [
                        middle - offset * sin - 1.1 * draw.side * cos,
                        middle + offset * cos - 1.1 * draw.side * sin,
                    ];
                    roads.push(Course {
                        points: draw.course(start, heading, long, 0.2 * bend),
                        half_width: half_width * draw.between(0.8, 1.25),
                        is_dirt: draw.chance(0.5 * dirt),
                    });
                }
                offset += spacing * draw.between(0.7, 1.3);
            }
        }
        return roads;
    }
    for _ in 0..=draw.count(2) {
        let through = draw.place();
        let heading = draw.between(0.0, std::f32::consts::TAU);
        let wide = if draw.chance(0.15) { 24.0 } else { 11.0 };
        let half_width = draw.between(3.0, wide);
        let is_dirt = draw.chance(dirt);
        // Both ways from a place inside.
        let mut points = draw.course(through, heading + std::f32::consts::PI, long / 2, bend);
        points.reverse();
        points.extend(draw.course(through, heading, long / 2, bend));
        roads.push(Course {
            points,
            half_width,
            is_dirt,
        });
    }
    for _ in 0..draw.count(9) {
        let from = &roads[draw.count(roads.len())];
        let (wide, at) = (from.half_width, draw.count(from.points.len() - 1));
        let ([ax, ay], [bx, by]) = (from.points[at], from.points[at + 1]);
        let way = if draw.chance(0.5) { 1.0 } else { -1.0 };
        let turn = way * std::f32::consts::FRAC_PI_2 + draw.between(-0.3, 0.3);
        let (heading, steps) = ((by - ay).atan2(bx - ax) + turn, 8 + draw.count(60));
        roads.push(Course {
            points: draw.course([ax, ay], heading, steps, bend),
            half_width: (wide * draw.between(0.5, 1.0)).max(2.6),
            is_dirt: draw.chance(dirt),
        });
    }
    roads
}

/// A sealed yard with rows of cars: whether that is a road is a matter of taste.
fn car_park(painter: &mut Painter, draw: &mut Draw) {
    if draw.chance(0.5) {
        return;
    }
    let heading = draw.between(0.0, std::f32::consts::TAU);
    let slab = PaintedSlab {
        middle: draw.place(),
        along: [heading.cos(), heading.sin()],
        half: [draw.between(20.0, 60.0), draw.between(14.0, 40.0)],
    };
    let paint = draw.near(&SEALED, 15.0);
    painter.slab(&slab, paint, 0.05, Some(RoadTruth::Unknown));
    let mut row = -slab.half[1] + 6.0;
    while row < slab.half[1] - 5.0 {
        let mut stall = -slab.half[0] + 3.0;
        while stall < slab.half[0] - 3.0 {
            if draw.chance(0.5) {
                car(painter, draw, &slab, [stall, row], true);
            }
            stall += 5.2;
        }
        row += 14.0;
    }
}

/// A long building with a flat roof, where no road is.
fn hall(painter: &mut Painter, draw: &mut Draw, roads: &[Course], shadow: [f32; 2]) {
    let heading = draw.between(0.0, std::f32::consts::TAU);
    let slab = PaintedSlab {
        middle: draw.place(),
        along: [heading.cos(), heading.sin()],
        half: [draw.between(14.0, 90.0), draw.between(6.0, 40.0)],
    };
    let reach = slab.half[0].hypot(slab.half[1]);
    let is_free = roads.iter().all(|road| {
        let mut points = road.points.iter();
        points.all(|p| {
            let away = (p[0] - slab.middle[0]).hypot(p[1] - slab.middle[1]);
            away > reach + road.half_width
        })
    });
    if !is_free {
        return;
    }
    for i in 1..=4 {
        let share = 0.4 * i as f32;
        painter.shade_slab(&slab.moved([share * shadow[0], share * shadow[1]]), 0.8);
    }
    let roof = draw.near(&[ROOFS[0], ROOFS[1], ROOFS[4], ROOFS[5], SEALED[2]], 22.0);
    painter.slab(&slab, roof, 0.03, Some(RoadTruth::Open));
    for _ in 0..draw.count(14) {
        let (u, v) = (draw.between(-0.9, 0.9), draw.between(-0.9, 0.9));
        let [ax, ay] = slab.along;
        let (u, v) = (u * slab.half[0], v * slab.half[1]);
        let part = PaintedSlab {
            middle: [
                slab.middle[0] + u * ax - v * ay,
                slab.middle[1] + u * ay + v * ax,
            ],
            along: slab.along,
            half: [draw.between(1.0, 3.0), draw.between(1.0, 3.0)],
        };
        let paint = scaled(roof, draw.between(0.6, 1.3));
        painter.slab(&part, paint, 0.05, None);
    }
}

/// A car at a place of a slab, across or along it.
fn car(painter: &mut Painter, draw: &mut Draw, on: &PaintedSlab, [u, v]: [f32; 2], across: bool) {
    let [ax, ay] = on.along;
    let paint = draw.near(
        &[
            [225.0; 3],
            [150.0; 3],
            [40.0; 3],
            [130.0, 40.0, 36.0],
            [50.0, 66.0, 110.0],
        ],
        20.0,
    );
    let body = PaintedSlab {
        middle: [
            on.middle[0] + u * ax - v * ay,
            on.middle[1] + u * ay + v * ax,
        ],
        along: if across { [-ay, ax] } else { [ax, ay] },
        half: [4.4, 1.8],
    };
    painter.shade_slab(&body.moved([0.8, 0.8]), 0.6);
    painter.slab(&body, paint, 0.05, None);
}

/// Houses with their drives along the roads; gives their number.
fn houses(painter: &mut Painter, draw: &mut Draw, roads: &[Course], shadow: [f32; 2]) -> usize {
    let mut count = 0;
    let (density, near, drives) = (
        draw.between(0.2, 0.95),
        draw.between(8.0, 26.0),
        draw.between(0.0, 0.9),
    );
    for road in roads {
        for pair in road.points.windows(2).step_by(4 + draw.count(3)) {
            for way in [-1.0, 1.0] {
                if !draw.chance(density) {
                    continue;
                }
                let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
                let along = [(bx - ax) / STEP, (by - ay) / STEP];
                let half = [draw.between(7.0, 14.0), draw.between(6.0, 12.0)];
                let away = way * (road.half_width + near + half[1] + draw.between(0.0, 10.0));
                let middle = [ax - away * along[1], ay + away * along[0]];
                let is_free = roads.iter().all(|other| {
                    let mut points = other.points.iter();
                    points.all(|p| {
                        (p[0] - middle[0]).hypot(p[1] - middle[1]) > other.half_width + 13.0
                    })
                });
                if !is_free {
                    continue;
                }
                count += 1;
                if draw.chance(drives) {
                    let drive =
                        draw.near(&[SEALED[2], SEALED[3], DIRT[0], DIRT[1], GROUND[5]], 20.0);
                    let reach = 0.5 * (away.abs() - half[1]);
                    let beside = draw.between(-6.0, 6.0);
                    let slab = PaintedSlab {
                        middle: [
                            ax - way * reach * along[1] + beside * along[0],
                            ay + way * reach * along[0] + beside * along[1],
                        ],
                        along: [-along[1], along[0]],
                        half: [reach, draw.between(2.2, 4.5)],
                    };
                    painter.slab(&slab, drive, 0.05, None);
                }
                let house = PaintedSlab {
                    middle,
                    along,
                    half,
                };
                let steps = 4;
                for i in 1..=steps {
                    let share = i as f32 / steps as f32;
                    let moved = house.moved([share * shadow[0], share * shadow[1]]);
                    painter.shade_slab(&moved, 0.82);
                }
                let roof = draw.near(&ROOFS, 18.0);
                painter.slab(&house, roof, 0.05, None);
                let half_roof = PaintedSlab {
                    middle: [
                        middle[0] - 0.5 * half[1] * along[1],
                        middle[1] + 0.5 * half[1] * along[0],
                    ],
                    along,
                    half: [half[0], 0.5 * half[1]],
                };
                painter.shade_slab(&half_roof, draw.between(0.7, 1.0));
            }
        }
    }
    count
}

/// Distance to the nearest road's middle less its half width, by pixel, of the roads of a kind.
fn distances(roads: &[&Course], side: usize, reach: f32) -> Raster<f32> {
    let mut out = Raster::filled(side, side, f32::INFINITY);
    for road in roads {
        for pair in road.points.windows(2) {
            let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
            let far = road.half_width + reach;
            let range = |a: f32, b: f32| {
                let low = (a.min(b) - far).floor().clamp(0.0, side as f32) as usize;
                low..(a.max(b) + far).ceil().clamp(0.0, side as f32) as usize
            };
            for row in range(ay, by) {
                for column in range(ax, bx) {
                    let (x, y) = (column as f32 + 0.5 - ax, row as f32 + 0.5 - ay);
                    let (dx, dy) = (bx - ax, by - ay);
                    let t = ((x * dx + y * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
                    let distance = (x - t * dx).hypot(y - t * dy) - road.half_width;
                    if distance < out.get(column, row) {
                        out.set(column, row, distance);
                    }
                }
            }
        }
    }
    out
}

/// The roads themselves: shoulders, surface, wear, paint, cars.
fn lay(painter: &mut Painter, draw: &mut Draw, roads: &[Course]) {
    let side = painter.colours.width();
    let seed = draw.seed ^ 0x51de;
    let (sealed, dirt) = (draw.near(&SEALED, 14.0), draw.near(&DIRT, 20.0));
    let has_shoulder = draw.chance(0.55);
    let (shoulder, beside) = (
        draw.near(&[SEALED[3], SEALED[4], DIRT[0], DIRT[1], GROUND[2]], 20.0),
        draw.between(1.5, 6.0),
    );
    let wear = draw.between(0.0, 0.12);
    for is_dirt in [true, false] {
        let of_kind: Vec<&Course> = roads.iter().filter(|r| r.is_dirt == is_dirt).collect();
        if of_kind.is_empty() {
            continue;
        }
        let surface = if is_dirt { dirt } else { sealed };
        let ragged = if is_dirt {
            draw.between(0.5, 2.5)
        } else {
            draw.between(0.0, 0.8)
        };
        let distance = distances(&of_kind, side, 12.0);
        for row in 0..side {
            for column in 0..side {
                let d = distance.get(column, row);
                if d > 10.0 {
                    continue;
                }
                let p = [column as f32, row as f32];
                let fray = d + ragged * noise(p, 6.0, seed);
                let under = painter.colours.get(column, row);
                let verge = scaled(shoulder, 1.0 + 0.08 * noise(p, 3.0, seed ^ 1));
                let edge = if has_shoulder {
                    (beside - fray + 0.5).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let grain = 0.03 * noise(p, 1.2, seed ^ 2) + wear * noise(p, 14.0, seed ^ 3);
                let tracks = if is_dirt {
                    0.07 * noise(p, 3.0, seed ^ 4)
                } else {
                    0.0
                };
                let top = scaled(surface, 1.0 + grain + tracks);
                let share = (0.5 - fray).clamp(0.0, 1.0);
                painter
                    .colours
                    .set(column, row, mixed(mixed(under, verge, edge), top, share));
                if d <= 0.0 {
                    painter.truth.set(column, row, RoadTruth::Road);
                }
            }
        }
    }
    let lines = draw.count(5);
    let paint = if lines == 0 {
        [230.0, 184.0, 60.0]
    } else {
        [226.0, 226.0, 222.0]
    };
    for road in roads.iter().filter(|r| !r.is_dirt) {
        for (i, pair) in road.points.windows(2).enumerate() {
            let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
            let slab = PaintedSlab {
                middle: [0.5 * (ax + bx), 0.5 * (ay + by)],
                along: [(bx - ax) / STEP, (by - ay) / STEP],
                half: [0.5 * STEP, 0.3],
            };
            if lines < 2 && (lines == 0 || i % 2 == 0) {
                painter.slab(&slab, paint, 0.1, None);
            }
            if draw.chance(0.06) && road.half_width > 4.0 {
                let lane = if draw.chance(0.5) { 0.5 } else { -0.5 };
                car(painter, draw, &slab, [0.0, lane * road.half_width], false);
            }
        }
    }
}

/// Trees, alone and in groups, with their shadows; in towns some stand along the roads.
fn crowns(painter: &mut Painter, draw: &mut Draw, roads: &[Course], shadow: [f32; 2], town: bool) {
    let kinds: Vec<Paint> = (0..3).map(|_| draw.near(&CROWNS, 14.0)).collect();
    let mut places = Vec::new();
    let amount = draw.between(0.0, 1.0).powi(2);
    for _ in 0..(60.0 * amount) as usize {
        let (middle, spread) = (draw.place(), draw.between(0.0, 26.0));
        for _ in 0..=draw.count(14) {
            let offset = [draw.between(-spread, spread), draw.between(-spread, spread)];
            places.push([middle[0] + offset[0], middle[1] + offset[1]]);
        }
    }
    // Woods: crowns side by side all over a part of the picture.
    for _ in 0..draw.count(3) {
        let (middle, spread) = (draw.place(), draw.between(30.0, 130.0));
        let count = (spread * spread / draw.between(25.0, 60.0)) as usize;
        for _ in 0..count {
            let (angle, share) = (
                draw.between(0.0, std::f32::consts::TAU),
                draw.between(0.0, 1.0).sqrt(),
            );
            places.push([
                middle[0] + share * spread * angle.cos(),
                middle[1] + share * spread * angle.sin(),
            ]);
        }
    }
    if draw.chance(if town { 0.5 } else { 0.25 }) {
        for road in roads {
            let away = road.half_width + draw.between(0.0, 7.0);
            for pair in road.points.windows(2).step_by(2) {
                let [[ax, ay], [bx, by]] = [pair[0], pair[1]];
                let way = if draw.chance(0.5) { away } else { -away };
                if draw.chance(0.5) {
                    places.push([ax - way * (by - ay) / STEP, ay + way * (bx - ax) / STEP]);
                }
            }
        }
    }
    let seed = draw.seed ^ 0x7ee;
    for middle in places {
        let radius = draw.between(2.5, 9.0);
        // Most trees keep off the road.
        let on_road = roads.iter().any(|road| {
            let mut points = road.points.iter();
            points.any(|p| {
                (p[0] - middle[0]).hypot(p[1] - middle[1]) < road.half_width + 0.3 * radius
            })
        });
        if on_road && draw.chance(0.9) {
            continue;
        }
        let fallen = [middle[0] + 0.6 * shadow[0], middle[1] + 0.6 * shadow[1]];
        painter.disc(fallen, radius, |_, under| scaled(under, 0.6));
        let paint = kinds[draw.count(kinds.len())];
        painter.disc(middle, radius, |p, _| {
            let light = (p[0] - middle[0]) * shadow[0] + (p[1] - middle[1]) * shadow[1];
            scaled(
                paint,
                1.0 - 0.02 * light / radius + 0.3 * noise(p, 2.2, seed),
            )
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_draws_one_picture_with_some_road_in_it() {
        let mut road = 0;
        for seed in 0..6 {
            let example = drawn_roads(seed, 128);
            let of = |truth| {
                example
                    .truth
                    .pixels()
                    .iter()
                    .filter(|t| **t == truth)
                    .count()
            };
            road += of(RoadTruth::Road);
            assert!(of(RoadTruth::Open) > 0);
            assert_eq!(example, drawn_roads(seed, 128));
        }
        let share = road as f64 / (6.0 * 128.0 * 128.0);
        assert!((0.03..0.6).contains(&share), "{share}");
    }
}
