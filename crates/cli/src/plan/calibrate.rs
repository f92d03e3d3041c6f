//! `pilotage plan --calibrate`: whether landmarks are found as often as their assessment says.

use std::io::Write;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{
    Assessor, ExpectedDetection, Pass, Rehearsal, Reliability, Tally, random_places,
};
use pilotage_core::simulate::SensorSpec;

use super::arguments::Arguments;
use super::ground::Ground;
use super::landmarks::circumstances;

/// Passes over each place, each on a day of its own.
const PASSES: usize = 10;
/// Seed of the first held-out day, far from any that is rehearsed.
const FIRST_DAY: u64 = 550_000;

/// Flies about `passes` passes over places of every quality and compares what was found with what
/// their assessment on other days said.
///
/// What a place looks like is settled by the day, so each pass over it is on another, and the places
/// of a bin do not share theirs: passes count as independent only if nothing ties them together.
pub fn calibrate(
    arguments: &Arguments,
    ground: &Ground,
    passes: usize,
) -> (Reliability, Vec<Pass>) {
    let seed = arguments.seed;
    let places = random_places(passes.div_ceil(PASSES), seed);
    let begun = std::time::Instant::now();
    let said = in_parallel(places.len(), |i| said(ground, &places[i], seed));
    println!(
        "{} places rehearsed in {:.0} s",
        places.len(),
        begun.elapsed().as_secs_f64()
    );
    let flown = in_parallel(places.len(), |i| {
        let place = &places[i];
        said[i].map_or_else(Vec::new, |said| {
            (0..PASSES)
                .map(|number| pass(ground, place, &said, seed, number))
                .collect()
        })
    });
    let all: Vec<Pass> = flown.concat();
    let reliability = Reliability::of(&all);
    for bin in reliability.bins.iter().filter(|b| b.passes > 0) {
        println!(
            "said {:.3}, observed {:.3} ± {:.3} in {} frames of {} passes",
            bin.predicted, bin.observed, bin.uncertainty, bin.frames, bin.passes
        );
    }
    println!(
        "false matches in {:.4} of the frames; {:.0} s",
        reliability.false_matches,
        begun.elapsed().as_secs_f64()
    );
    (reliability, all)
}

/// Detection that is expected of a place.
///
/// Each is rehearsed on days of its own: with the same ones for all, their luck would be that of every bin.
fn said(ground: &Ground, place: &Landmark, seed: u64) -> Option<ExpectedDetection> {
    let map = Arc::clone(&ground.map);
    let seed = seed.wrapping_mul(1_000_003) + u64::from(place.id);
    let days = Rehearsal::days(ground.days.as_ref(), seed);
    let mut assessor = Assessor::new(place, map, &days, circumstances(ground), seed);
    assessor.rehearse();
    assessor.expected()
}

/// Pass over a place on a day.
fn pass(
    ground: &Ground,
    place: &Landmark,
    said: &ExpectedDetection,
    seed: u64,
    number: usize,
) -> Pass {
    let speed = ground.plan.as_ref().map_or(18.9, |p| p.airframe.cruise);
    let period = 1.0 / SensorSpec::default().frame_rate;
    let map = Arc::clone(&ground.map);
    let seed = FIRST_DAY + (seed * 1000 + u64::from(place.id)) * 100 + number as u64;
    let day = [ground.days.drawn(seed)];
    let mut assessor = Assessor::new(place, map, &day, circumstances(ground), !seed);
    let tally = Tally::of(&assessor.pass(speed, period));
    Pass {
        predicted: said.probability(),
        frames: tally.looks,
        found: tally.found,
        wrong: tally.wrong,
    }
}

/// `work` for 0 to `count`, on as many threads as there are processors, with a word on how far it is.
fn in_parallel<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, T)>> = Mutex::new(Vec::new());
    let worker = || {
        loop {
            let i = next.fetch_add(1, Ordering::Relaxed);
            if i >= count {
                return;
            }
            let result = work(i);
            let Ok(mut done) = done.lock() else { return };
            done.push((i, result));
            print!("\r{} of {count} ", done.len());
            let _ = std::io::stdout().flush();
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(worker);
        }
    });
    println!();
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, result)| result).collect()
}
