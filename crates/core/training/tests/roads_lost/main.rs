//! Drawn pictures of real road maps, seen by the road network and found among all roads of a map.
//!
//! `PILOTAGE_ROAD_MAPS=FOLDER cargo test -p pilotage-training --test roads_lost -- --ignored --nocapture`, with road maps
//! as GeoJSON in the folder (`tests/oracles/road_maps.py` makes some). `PILOTAGE_LOST_MAPS` names those that are searched,
//! `PILOTAGE_VIEWS` the number of views over each; `PILOTAGE_LOST_TABLE` a file for what was seen, from which
//! `tests/oracles/lost_weights.py` learns the weights.

#![allow(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "helpers of tests, which may panic"
)]

mod seeing;
mod sites;
mod tally;

use std::f64::consts::PI;
use std::fmt::Write;

use nalgebra::Vector2;
use pilotage_base::frames::{GroundPoint, wrap_pi};
use pilotage_roads::RoadClass;
use pilotage_roads::lost::{LostBelief, LostSettings, RoadIndex, ViewMotion, ViewPose};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use seeing::{agreement, seen};
use sites::{Site, sites};
use tally::{Tally, processor_time};

/// Farthest that a place may be off and be right, metres and radians.
const RIGHT: (f64, f64) = (20.0, 5.0 * PI / 180.0);

fn views() -> u64 {
    std::env::var("PILOTAGE_VIEWS").map_or(100, |text| text.parse().unwrap())
}

fn is_searched(name: &str) -> bool {
    std::env::var("PILOTAGE_LOST_MAPS").map_or(true, |names| names.split(' ').any(|n| n == name))
}

/// Pose anywhere over a site, with any heading, and a height that is known to 2 %.
fn truth(site: &Site, seed: u64) -> (ViewPose, ChaCha8Rng) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let within = site.within;
    let pose = ViewPose {
        place: GroundPoint::new(
            random.random_range(within.south..within.north),
            random.random_range(within.west..within.east),
        ),
        turn: random.random_range(-PI..PI),
        scale: 1.0 + 0.02 * gauss(&mut random),
    };
    (pose, random)
}

fn gauss(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

fn is_right(found: &ViewPose, truth: &ViewPose) -> bool {
    let turn = wrap_pi(found.turn - truth.turn).abs();
    found.place.distance(&truth.place) < RIGHT.0 && turn < RIGHT.1
}

/// Line of the table of what was seen.
fn row(searched: &str, of: &str, right: Option<usize>, belief: &LostBelief) -> String {
    let mut line = format!(
        "{{\"map\":\"{searched}\",\"of\":\"{of}\",\"right\":{},\"places\":[",
        right.map_or(-1, |r| r as i64)
    );
    for (index, place) in belief.places.iter().enumerate() {
        let comma = if index > 0 { "," } else { "" };
        let evidence = place.evidence;
        write!(line, "{comma}[{:?},{:?}]", evidence.seen, evidence.known).unwrap();
    }
    line + "]}\n"
}

#[test]
#[ignore = "a study of half an hour"]
fn drawn_pictures_of_real_maps_are_found_again() {
    let sites = sites();
    let settings = LostSettings::default();
    let mut table = String::new();
    let mut total = Tally::default();
    for site in sites.iter().filter(|site| is_searched(&site.name)) {
        let index = RoadIndex::new(&site.map, RoadClass::Service).unwrap();
        let mut tally = Tally::default();
        for other in &sites {
            let is_own = site.name == other.name;
            // Helsinki lies amid the roads of another site.
            let is_part = [&site.name, &other.name]
                .iter()
                .all(|n| ["helsinki", "liege"].contains(&n.as_str()));
            let count = match (is_own, is_part) {
                (true, _) => views(),
                (false, true) => 0,
                (false, false) => views().div_ceil(7),
            };
            for seed in 0..count {
                let (truth, _) = truth(other, seed + 5000);
                let view = seen(&other.map, &truth, 7 * seed + 11);
                let start = processor_time();
                let belief = index.locate(&view, &settings).unwrap();
                let seconds = processor_time() - start;
                let same =
                    |p: &pilotage_roads::lost::LostPlace| is_own && is_right(&p.pose, &truth);
                let right = belief.places.iter().position(same);
                tally.count(&belief, right, is_own, seconds);
                if is_own {
                    tally.agree(agreement(&site.map, &truth, &view));
                }
                table += &row(&site.name, &other.name, right, &belief);
            }
        }
        println!("{}: {tally}", site.name);
        total.add(&tally);
    }
    println!("all: {total}");
    total.print_reliability();
    if let Ok(path) = std::env::var("PILOTAGE_LOST_TABLE") {
        std::fs::write(path, table).unwrap();
    }
}

#[test]
#[ignore = "a study of a quarter of an hour"]
fn three_views_on_one_way_are_surer_than_one() {
    let settings = LostSettings::default();
    for site in sites().iter().filter(|site| is_searched(&site.name)) {
        let index = RoadIndex::new(&site.map, RoadClass::Service).unwrap();
        let (mut single, mut along) = (Tally::default(), Tally::default());
        for seed in 0..views() {
            let (mut truth, mut random) = truth(site, seed + 9000);
            let first = seen(&site.map, &truth, 7 * seed + 3);
            let mut then = Vec::new();
            for step in 1..3 {
                let true_motion = ViewMotion {
                    way: Vector2::new(300.0, random.random_range(-60.0..60.0)),
                    turn: random.random_range(-0.5..0.5),
                    way_deviation: 9.0,
                    turn_deviation: 0.02,
                };
                truth = truth.after(&true_motion);
                let off = Vector2::new(gauss(&mut random), gauss(&mut random));
                let told = ViewMotion {
                    way: true_motion.way + 9.0 * off,
                    turn: true_motion.turn + 0.02 * gauss(&mut random),
                    ..true_motion
                };
                then.push((told, seen(&site.map, &truth, 7 * seed + 3 + step)));
            }
            let start = processor_time();
            let alone = index.locate(&then[1].1, &settings).unwrap();
            let one = processor_time() - start;
            let belief = index.locate_along(&first, &then, &settings).unwrap();
            let three = processor_time() - start - one;
            let right =
                |belief: &LostBelief| belief.places.iter().position(|p| is_right(&p.pose, &truth));
            single.count(&alone, right(&alone), true, one);
            along.count(&belief, right(&belief), true, three);
        }
        println!("{}, the last view alone: {single}", site.name);
        println!("{}, three views: {along}", site.name);
    }
}
