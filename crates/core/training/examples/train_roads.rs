//! Trains the network that sees roads.
//!
//! `cargo run --release -p pilotage-training --example train_roads -- OUT STEPS SEED [PICTURE MASK METRES_X METRES_Y]`
//! writes the weights, goes on from those that OUT has, and prints how they do on pictures that were not learned from.
//! Steps and seed settle what comes out. PICTURE and MASK are a real one and the middles of its roads (white), of so many
//! metres per pixel; that of the repository's weights is `SpaceNet`'s road chip of Las Vegas (CC BY-SA 4.0, imagery
//! courtesy of Maxar). They were trained for a time on seeds of the clock, so that they cannot be made again to the bit.
//!
//! `… -- judge` prints how thresholds do on pictures that were not learned from, in changed colours, blur and noise.
//! `… -- look FOLDER` writes examples as pictures.

use std::path::Path;
use std::time::Instant;

use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Picture, Raster, decode_picture, encode_png};
use pilotage_simulate::other_days::any_day;
use pilotage_simulate::simulate::scenery::Scenery;
use pilotage_training::road::{
    GradientSteps, RoadExample, RoadTruth, changed, drawn_roads, first_weights, loss_gradient,
    scenery_roads, turned,
};
use pilotage_vision::road::network::{RoadNetwork, network_input};
use pilotage_vision::road::{probability_by, road_mask};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Pixels on a side of what is learned from at a time.
const SIDE: usize = 160;
/// Examples of one step.
const BATCH: usize = 8;
const THREADS: usize = 2;

/// Pictures by where they come from.
struct Pool {
    drawn: Vec<RoadExample>,
    scenery: Vec<RoadExample>,
    real: Vec<RoadExample>,
}

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words.as_slice() {
        ["judge"] => {
            judge();
            Ok(())
        }
        ["look", folder] => look(Path::new(folder)),
        [out, steps, seed] => train(out, steps.parse()?, seed.parse()?, Vec::new()),
        [out, steps, seed, picture, mask, x, y] => {
            let real = real(picture, mask, [x.parse()?, y.parse()?])?;
            train(out, steps.parse()?, seed.parse()?, vec![real])
        }
        _ => Err(
            "usage: OUT STEPS SEED [PICTURE MASK METRES_X METRES_Y], judge, or look FOLDER".into(),
        ),
    }
}

/// Runs `make` for numbers on all threads.
fn many<T: Send>(numbers: std::ops::Range<u64>, make: impl Fn(u64) -> T + Sync) -> Vec<T> {
    let numbers: Vec<u64> = numbers.collect();
    let shares = numbers.chunks(numbers.len().div_ceil(THREADS).max(1));
    std::thread::scope(|scope| {
        let make = &make;
        let threads: Vec<_> = shares
            .map(|share| scope.spawn(move || share.iter().map(|n| make(*n)).collect::<Vec<T>>()))
            .collect();
        let all = threads
            .into_iter()
            .flat_map(|t| t.join().expect("a thread ends"));
        all.collect()
    })
}

/// Windows of a generated world on one day, those with some road in them.
fn world(seed: u64) -> Vec<RoadExample> {
    let scenery = Scenery::new(seed, any_day(seed));
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut found = Vec::new();
    for _ in 0..10 {
        let window = Window {
            north_edge: random.random_range(-900.0..1100.0),
            west_edge: random.random_range(-1100.0..900.0),
            gsd: 0.5,
            width: 400,
            height: 400,
        };
        let example = scenery_roads(&scenery, &window);
        let road = example
            .truth
            .pixels()
            .iter()
            .filter(|t| **t == RoadTruth::Road);
        if road.count() > 1600 {
            found.push(example);
        }
    }
    found
}

/// A real picture, with the surroundings of the marked middles unknown.
fn real(picture: &str, mask: &str, metres: [f64; 2]) -> Outcome<RoadExample> {
    let picture = decode_picture(&std::fs::read(picture)?)?;
    let mask = decode_picture(&std::fs::read(mask)?)?;
    let size = |pixels: usize, metres: f64| (pixels as f64 * metres / 0.5) as usize / 4 * 4;
    let (width, height) = (
        size(picture.width(), metres[0]),
        size(picture.height(), metres[1]),
    );
    let at = |column: f64, row: f64| {
        let (x, y) = (column * 0.5 / metres[0], row * 0.5 / metres[1]);
        (
            (x as usize).min(picture.width() - 1),
            (y as usize).min(picture.height() - 1),
        )
    };
    let colours = Raster::from_fn(width, height, |c, r| {
        let parts = [
            (0.17, 0.17),
            (0.5, 0.17),
            (0.83, 0.17),
            (0.17, 0.5),
            (0.5, 0.5),
            (0.83, 0.5),
            (0.17, 0.83),
            (0.5, 0.83),
            (0.83, 0.83),
        ];
        let mut sum = [0_u32; 3];
        for (x, y) in parts {
            let (x, y) = at(c as f64 + x, r as f64 + y);
            for (sum, value) in sum.iter_mut().zip(picture.get(x, y)) {
                *sum += u32::from(value);
            }
        }
        let [red, green, blue] = sum.map(|s| (s / 9) as u8);
        [red, green, blue, 255]
    });
    let marked = Raster::from_fn(width, height, |c, r| {
        let (x, y) = at(c as f64 + 0.5, r as f64 + 0.5);
        mask.get(x, y)[0] > 127
    });
    // Roads are wider than their marked middles, by how much is not said.
    let near = 9;
    let truth = Raster::from_fn(width, height, |c, r| {
        let rows = r.saturating_sub(near)..(r + near + 1).min(height);
        let columns = c.saturating_sub(near)..(c + near + 1).min(width);
        if marked.get(c, r) {
            RoadTruth::Road
        } else if rows
            .into_iter()
            .any(|row| marked.row(row)[columns.clone()].contains(&true))
        {
            RoadTruth::Unknown
        } else {
            RoadTruth::Open
        }
    });
    Ok(RoadExample {
        picture: colours,
        truth,
    })
}

impl Pool {
    fn new(
        drawn: std::ops::Range<u64>,
        worlds: std::ops::Range<u64>,
        real: Vec<RoadExample>,
    ) -> Self {
        Self {
            drawn: many(drawn, |seed| drawn_roads(seed, 384)),
            scenery: many(worlds, world).into_iter().flatten().collect(),
            real,
        }
    }

    /// A part of some picture, as another camera might show it.
    fn example(&self, random: &mut ChaCha8Rng) -> RoadExample {
        let share: f64 = random.random();
        let kind = if share < 0.6 || self.scenery.is_empty() {
            &self.drawn
        } else if share < 0.8 || self.real.is_empty() {
            &self.scenery
        } else {
            &self.real
        };
        let source = &kind[random.random_range(0..kind.len())];
        let margin = 70.0;
        let x = random.random_range(margin..source.truth.width() as f64 - margin);
        let y = random.random_range(margin..source.truth.height() as f64 - margin);
        let angle = random.random_range(0.0..std::f64::consts::TAU);
        let scale = random.random_range(-0.35_f64..0.45).exp();
        let mut part = turned(source, [x, y], angle, scale, SIDE);
        if random.random::<f64>() < 0.5 {
            part.picture = Raster::from_fn(SIDE, SIDE, |c, r| part.picture.get(SIDE - 1 - c, r));
            part.truth = Raster::from_fn(SIDE, SIDE, |c, r| part.truth.get(SIDE - 1 - c, r));
        }
        changed(&part, random)
    }
}

fn train(out: &str, steps: u64, seed: u64, real: Vec<RoadExample>) -> Outcome<()> {
    let started = Instant::now();
    let pool = Pool::new(0..320, 1000..1010, real);
    let judge = Pool::new(900_000..900_024, 2000..2002, Vec::new());
    let counts = (pool.drawn.len(), pool.scenery.len(), pool.real.len());
    println!(
        "pictures {counts:?} after {:.0} s",
        started.elapsed().as_secs_f64()
    );
    let started = Instant::now();
    let begun = std::fs::read(out)
        .ok()
        .and_then(|bytes| RoadNetwork::from_bytes(&bytes));
    let begun_anew = begun.is_none();
    let first = begun.map_or_else(|| first_weights(26), |network| network.weights().to_vec());
    let most = if begun_anew { 0.004 } else { 0.0025 };
    let mut descent = GradientSteps::new(first);
    let mut sum = 0.0;
    for step in 0..steps {
        let share = step as f64 / steps as f64;
        let network = descent.network().ok_or("not a network")?;
        let results = many(0..BATCH as u64, |i| {
            let mut random = ChaCha8Rng::seed_from_u64((seed << 32) + step * BATCH as u64 + i);
            loss_gradient(&network, &pool.example(&mut random))
        });
        let mut gradient = vec![0.0; network.weights().len()];
        for result in &results {
            sum += result.loss / BATCH as f64;
            for (total, slope) in gradient.iter_mut().zip(&result.weights) {
                *total += slope / BATCH as f32;
            }
        }
        let norm = gradient.iter().map(|g| g * g).sum::<f32>().sqrt();
        let limit = (1.0 / norm).min(1.0);
        for slope in &mut gradient {
            *slope *= limit;
        }
        let warm = (step as f64 / 100.0).min(1.0);
        let rate = warm * most * (0.5 + 0.5 * (std::f64::consts::PI * share).cos()) + 2e-5;
        descent.step(&gradient, rate as f32, 1e-4);
        if step % 100 == 99 {
            println!(
                "{:6.0} s, step {}, loss {:.4}",
                started.elapsed().as_secs_f64(),
                step + 1,
                sum / 100.0
            );
            sum = 0.0;
        }
        if step % 500 == 499 {
            std::fs::write(out, network.to_bytes())?;
        }
    }
    let network = descent.network().ok_or("not a network")?;
    std::fs::write(out, network.to_bytes())?;
    for (name, examples) in [("drawn", &judge.drawn), ("generated world", &judge.scenery)] {
        report(name, &network, examples);
    }
    Ok(())
}

/// Prints the loss and, at some thresholds, precision and recall by pixels.
fn report(name: &str, network: &RoadNetwork, examples: &[RoadExample]) {
    let (mut loss, mut table) = (0.0, [[0_u64; 3]; 5]);
    let limits = [-1.4, -0.8, -0.4, 0.0, 0.8];
    for example in examples {
        loss += loss_gradient(network, example).loss / examples.len() as f64;
        let odds = network.log_odds(network_input(&example.picture));
        for (odds, truth) in odds.values.iter().zip(example.truth.pixels()) {
            for (limit, counts) in limits.iter().zip(&mut table) {
                match (odds > limit, truth) {
                    (true, RoadTruth::Road) => counts[0] += 1,
                    (true, RoadTruth::Open) => counts[1] += 1,
                    (false, RoadTruth::Road) => counts[2] += 1,
                    _ => {}
                }
            }
        }
    }
    println!("{name}: {} pictures, loss {loss:.4}", examples.len());
    for (limit, [hit, false_hit, missed]) in limits.iter().zip(table) {
        let share = |of: u64| hit as f64 / (hit + of).max(1) as f64;
        let iou = hit as f64 / (hit + false_hit + missed).max(1) as f64;
        println!(
            "  log odds > {limit}: precision {:.3}, recall {:.3}, IoU {iou:.3}",
            share(false_hit),
            share(missed)
        );
    }
}

/// Prints precision, recall and their mean of the built-in network by likely and sure probabilities.
fn judge() {
    let network = RoadNetwork::built_in();
    let pool = Pool::new(900_000..900_120, 2000..2006, Vec::new());
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let sources = pool.drawn.iter().chain(&pool.scenery);
    let examples: Vec<RoadExample> = sources.map(|source| changed(source, &mut random)).collect();
    let seen: Vec<_> = (examples.iter())
        .map(|example| probability_by(&network, &example.picture, 0.5).probability)
        .collect();
    let limits = [
        (0.4, 0.4),
        (0.3, 0.3),
        (0.3, 0.5),
        (0.25, 0.5),
        (0.2, 0.5),
        (0.3, 0.6),
        (0.2, 0.6),
        (0.15, 0.6),
        (0.25, 0.4),
        (0.2, 0.4),
    ];
    for (likely, sure) in limits {
        let [mut hit, mut false_hit, mut missed] = [0_u64; 3];
        for (example, probability) in examples.iter().zip(&seen) {
            let mask = road_mask(probability, likely, sure);
            for (seen, truth) in mask.pixels().iter().zip(example.truth.pixels()) {
                match (seen, truth) {
                    (true, RoadTruth::Road) => hit += 1,
                    (true, RoadTruth::Open) => false_hit += 1,
                    (false, RoadTruth::Road) => missed += 1,
                    _ => {}
                }
            }
        }
        let share = |of: u64| hit as f64 / (hit + of).max(1) as f64;
        let (precision, recall) = (share(false_hit), share(missed));
        let mean = 2.0 * precision * recall / (precision + recall);
        println!(
            "likely {likely}, sure {sure}: precision {precision:.3}, recall {recall:.3}, F1 {mean:.3}"
        );
    }
}

/// Writes examples beside their truth.
fn look(folder: &Path) -> Outcome<()> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let drawn: Vec<RoadExample> = (0..9).map(|seed| drawn_roads(seed, 384)).collect();
    let started = Instant::now();
    let worlds = world(1000);
    println!(
        "{} windows of a world: {:.1} s",
        worlds.len(),
        started.elapsed().as_secs_f64()
    );
    for (i, example) in drawn.iter().chain(&worlds).enumerate() {
        let shown: Picture = Raster::from_fn(768, 384, |c, r| {
            let [red, green, blue, _] = example.picture.get(c % 384, r);
            match (c < 384, example.truth.get(c % 384, r)) {
                (false, RoadTruth::Road) => [255, green, blue],
                (false, RoadTruth::Unknown) => [red, green, 255],
                _ => [red, green, blue],
            }
        });
        std::fs::write(folder.join(format!("{i}.png")), encode_png(&shown)?)?;
    }
    let pool = Pool {
        drawn,
        scenery: worlds,
        real: Vec::new(),
    };
    for i in 0..4 {
        let example = pool.example(&mut random);
        let shown = example.picture.map(|[r, g, b, _]| [r, g, b]);
        std::fs::write(folder.join(format!("part{i}.png")), encode_png(&shown)?)?;
    }
    Ok(())
}
