//! `pilotage plan --calibrate`: whether landmarks are found as often as their assessment says.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use pilotage_core::imagery::Imagery;
use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{Assessor, Pass, Reliability, Tally, random_places};
use pilotage_core::simulate::SensorSpec;

use super::{Arguments, Ground, VIEWS, circumstances};

/// Passes over each place.
const PASSES: usize = 10;
/// Days on which they are flown, none of them rehearsed.
const DAYS: u64 = 8;
/// Seed of the first of those days, far from any that is rehearsed.
const FIRST_DAY: u64 = 550_000;
/// Flies about `passes` passes over places of every quality and compares what was found with what
/// their assessment on other days said.
pub fn calibrate(
    arguments: &Arguments,
    ground: &Ground,
    passes: usize,
) -> (Reliability, Vec<Pass>) {
    let seed = arguments.seed;
    let days = |first: u64, count: u64| -> Vec<Arc<dyn Imagery>> {
        (first..first + count)
            .map(|day| ground.days.day(day))
            .collect()
    };
    let rehearsed = days(seed.wrapping_mul(2000), VIEWS.1 as u64);
    let held_out = days(FIRST_DAY + seed.wrapping_mul(100), DAYS);
    let places = random_places(passes.div_ceil(PASSES), seed);
    let speed = ground.plan.as_ref().map_or(18.9, |p| p.airframe.cruise);
    let period = 1.0 / SensorSpec::default().frame_rate;
    let fly = |landmark: &Landmark| -> Vec<Pass> {
        let over = |days: &[Arc<dyn Imagery>], seed: u64| {
            let map = Arc::clone(&ground.map);
            Assessor::over(landmark, map, days, circumstances(ground), seed)
        };
        let mut assessor = over(&rehearsed, seed.wrapping_mul(31) + u64::from(landmark.id));
        for _ in 0..VIEWS.0 {
            assessor.look();
        }
        let Some(expected) = assessor.expected() else {
            return Vec::new();
        };
        let mut flown = over(&held_out, !seed.wrapping_add(u64::from(landmark.id)));
        let pass = |_| {
            let tally = Tally::of(&flown.pass(speed, period));
            Pass {
                predicted: expected.probability(),
                frames: tally.looks,
                found: tally.found,
                wrong: tally.wrong,
            }
        };
        let passes: Vec<Pass> = (0..PASSES).map(pass).collect();
        let sum = |f: fn(&Pass) -> usize| passes.iter().map(f).sum::<usize>();
        println!(
            "{:10} said {:.2}, found in {} of {} frames, {} wrong",
            landmark.name,
            expected.probability(),
            sum(|p| p.found),
            sum(|p| p.frames),
            sum(|p| p.wrong)
        );
        passes
    };
    let next = AtomicUsize::new(0);
    let worker = || {
        let mut flown = Vec::new();
        while let Some(landmark) = places.get(next.fetch_add(1, Ordering::Relaxed)) {
            flown.extend(fly(landmark));
        }
        flown
    };
    let workers = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let all: Vec<Pass> = std::thread::scope(|scope| {
        let handles: Vec<_> = (0..workers).map(|_| scope.spawn(worker)).collect();
        handles
            .into_iter()
            .flat_map(|handle| handle.join().unwrap_or_default())
            .collect()
    });
    let reliability = Reliability::of(&all);
    for bin in reliability.bins.iter().filter(|b| b.passes > 0) {
        println!(
            "said {:.3}, observed {:.3} ± {:.3} in {} frames of {} passes",
            bin.predicted, bin.observed, bin.uncertainty, bin.frames, bin.passes
        );
    }
    println!(
        "false matches in {:.4} of the frames",
        reliability.false_matches
    );
    (reliability, all)
}
