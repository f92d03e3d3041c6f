//! Flies a plan again and again, over ground that looks otherwise every time, beside its prediction.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use pilotage_core::flight::{Flight, FrameSource};
use pilotage_core::imagery::CachedImagery;
use pilotage_core::landmark::{ChosenDetector, Detector};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Navigator, Run};
use pilotage_core::plan::{
    Comparison, PlannedLandmark, Prediction, Verification, any_day, as_stated, compare,
};
use pilotage_core::simulate::{FlightDay, FlightPlan, Scenario, SimulatedFrames};

use super::ground::Ground;

/// Seed of the day of the first flight, which was not rehearsed; that of another follows from its own.
const FIRST_DAY: u64 = 770_001;
/// Memory for tiles of one day, megabytes.
const CACHE: usize = 256;

/// Flies seeds `first..end` and compares their errors with `prediction`.
///
/// Each flight has a wind and a day of its own, drawn from what was predicted for: a prediction is a
/// statement about all of them, and one over and over would be one sample of it. Where
/// landmarks are `stated` there are no pictures: they are found as often and as well as that says.
pub fn verify(
    ground: &Ground,
    plan: &FlightPlan,
    prediction: &Prediction,
    (first, end): (u64, u64),
    stated: Option<&[PlannedLandmark]>,
) -> Result<Verification, Box<dyn std::error::Error>> {
    let map = Scenario::map();
    let next = AtomicU64::new(first);
    let worker = || -> Result<Vec<Vec<Comparison>>, String> {
        let mut all = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= end {
                return Ok(all);
            }
            let day = || map.on_day(any_day(FIRST_DAY + seed));
            let day = || Seen::Day(Arc::new(CachedImagery::new(Arc::new(day()), CACHE)));
            let seen = stated.map_or_else(day, Seen::AsStated);
            let (flight, run) = fly(ground, plan, seen, seed)?;
            let compared = compare(&flight, &run, prediction);
            let of = Verification::of(std::slice::from_ref(&compared));
            eprintln!(
                "seed {seed}: {} frames, {} updated, {:.1} % inside the corridor, error {:.2} m RMS, \
                 at most {:.1} m, where the filter believed {:.2} m (NEES {:.2})",
                of.frames,
                run.steps.iter().filter(|s| s.corrected()).count(),
                100.0 * of.inside_corridor,
                of.rms_m,
                of.largest_m,
                of.believed_rms_m,
                of.mean_nees
            );
            all.push(compared);
        }
    };
    let workers = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let mut all = Vec::new();
    std::thread::scope(|scope| -> Result<(), String> {
        let handles: Vec<_> = (0..workers).map(|_| scope.spawn(worker)).collect();
        for handle in handles {
            all.extend(
                handle
                    .join()
                    .map_err(|_| "a flight panicked".to_owned())??,
            );
        }
        Ok(())
    })?;
    Ok(Verification::of(&all))
}

/// Sight of a flight: pictures of a day, or nothing but what is stated of its landmarks.
enum Seen<'a> {
    Day(Arc<CachedImagery>),
    AsStated(&'a [PlannedLandmark]),
}

fn fly(
    ground: &Ground,
    plan: &FlightPlan,
    seen: Seen<'_>,
    seed: u64,
) -> Result<(Flight, Run), String> {
    let named = |e: &dyn std::fmt::Display| format!("seed {seed}: {e}");
    let flight = plan
        .in_wind_of(seed, ground.mission.navigator.start.wind)
        .simulate(seed)
        .ok_or_else(|| named(&"the route needs two way-points"))?;
    let Mission {
        landmarks,
        navigator: settings,
        ..
    } = &ground.mission;
    let (detector, mut frames): (Box<dyn Detector>, Box<dyn FrameSource>) = match seen {
        Seen::Day(day) => {
            let frames = SimulatedFrames::new(&flight, FlightDay::Other, seed);
            let map = Arc::clone(&ground.map);
            (
                Box::new(ChosenDetector::new(map, settings.detector, landmarks)),
                Box::new(frames.over(day)),
            )
        }
        Seen::AsStated(landmarks) => {
            let stated = as_stated(&flight, landmarks, seed);
            let (detector, frames) = stated.ok_or_else(|| named(&"there is no truth"))?;
            (Box::new(detector), Box::new(frames))
        }
    };
    let flight = Arc::new(flight);
    let mut navigator =
        Navigator::with_detector(Arc::clone(&flight), landmarks, detector, settings)
            .map_err(|e| named(&e))?
            .sparing();
    let mut run = navigator.run_head();
    while let Some(step) = navigator.advance(frames.as_mut(), &|| 0.0) {
        let step = step.map_err(|e| named(&e))?;
        if step.frame.is_some() {
            run.steps.push(step);
        }
    }
    drop(navigator);
    Ok((Arc::unwrap_or_clone(flight), run))
}
