//! Whether a prediction is honest: flies the plan again and again and counts.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use pilotage_core::flight::Flight;
use pilotage_core::imagery::CachedImagery;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Navigator, Run};
use pilotage_core::plan::Prediction;
use pilotage_core::simulate::{FlightDay, FlightPlan, Overrides, Scenario, SimulatedFrames};
use serde::Serialize;

use super::Ground;

/// Moments of the plan that a flight may be ahead of the one compared last: a tail wind, a cut corner.
const AHEAD: usize = 20;

/// How the flights lay in the predicted corridor.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Verification {
    /// Flights flown.
    pub flights: usize,
    /// Frames compared.
    pub frames: usize,
    /// Share of them inside the 95 % ellipse.
    pub inside_ellipse: f64,
    /// Share of them inside the 95 % strip across the course.
    pub inside_corridor: f64,
    /// Root mean square error, metres.
    pub rms_m: f64,
    /// What was predicted for it, metres.
    pub predicted_rms_m: f64,
    /// Largest error, metres.
    pub largest_m: f64,
}

/// Flies seeds `first..end` on another day and compares their errors with `prediction`.
///
/// Each flight has a wind of its own, drawn from what the filter is told to expect: a prediction is a
/// statement about all of them, and one wind over and over would be one sample of it.
pub fn verify(
    ground: &Ground,
    plan: &FlightPlan,
    prediction: &Prediction,
    (first, end): (u64, u64),
) -> Result<Verification, Box<dyn std::error::Error>> {
    let seen = Scenario::all()[0]
        .simulate(0, &Overrides::default())
        .frames
        .imagery();
    let next = AtomicU64::new(first);
    let worker = || -> Result<Vec<Comparison>, String> {
        let mut all = Vec::new();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= end {
                return Ok(all);
            }
            let (flight, run) = fly(ground, plan, &seen, seed)?;
            all.extend(compare(&flight, &run, prediction));
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
    let n = all.len().max(1) as f64;
    let share =
        |inside: fn(&Comparison) -> bool| all.iter().filter(|c| inside(c)).count() as f64 / n;
    Ok(Verification {
        flights: (end - first) as usize,
        frames: all.len(),
        inside_ellipse: share(|c| c.ellipse),
        inside_corridor: share(|c| c.corridor),
        rms_m: (all.iter().map(|c| c.squared).sum::<f64>() / n).sqrt(),
        predicted_rms_m: (all.iter().map(|c| c.predicted).sum::<f64>() / n).sqrt(),
        largest_m: all.iter().map(|c| c.squared).fold(0.0, f64::max).sqrt(),
    })
}

/// One frame beside the plan.
struct Comparison {
    ellipse: bool,
    corridor: bool,
    squared: f64,
    predicted: f64,
}

fn fly(
    ground: &Ground,
    plan: &FlightPlan,
    seen: &Arc<CachedImagery>,
    seed: u64,
) -> Result<(Flight, Run), String> {
    let named = |e: &dyn std::fmt::Display| format!("seed {seed}: {e}");
    let flight = plan
        .in_wind_of(seed, ground.mission.navigator.start.wind)
        .simulate(seed)
        .ok_or_else(|| named(&"the route needs two way-points"))?;
    let mut frames = SimulatedFrames::new(&flight, FlightDay::Other, seed).over(Arc::clone(seen));
    let flight = Arc::new(flight);
    let Mission {
        landmarks,
        navigator: settings,
        ..
    } = &ground.mission;
    let map = Arc::clone(&ground.map);
    let mut navigator =
        Navigator::new(Arc::clone(&flight), landmarks, map, settings).map_err(|e| named(&e))?;
    let mut run = navigator.run_head();
    while let Some(step) = navigator.advance(&mut frames, &|| 0.0) {
        run.steps.push(step.map_err(|e| named(&e))?);
    }
    drop(navigator);
    Ok((Arc::unwrap_or_clone(flight), run))
}

fn compare(flight: &Flight, run: &Run, prediction: &Prediction) -> Vec<Comparison> {
    let with_frames = run.steps.iter().filter(|s| s.frame.is_some());
    let mut last = 0;
    with_frames
        .filter_map(|step| {
            let truth = flight.truth.as_ref()?.position(step.time)?;
            last = nearest(prediction, last, truth.x, truth.y)?;
            let planned = &prediction.samples[last];
            let estimate = step.after.position();
            let (north, east) = (estimate.north - truth.x, estimate.east - truth.y);
            let c = &planned.corridor;
            let (sin, cos) = c.heading_of_major.sin_cos();
            let (major, minor) = (cos * north + sin * east, cos * east - sin * north);
            let distance = (major / c.sigma_major).hypot(minor / c.sigma_minor);
            let across = planned.course.cos() * east - planned.course.sin() * north;
            Some(Comparison {
                ellipse: distance <= c.scale,
                corridor: across.abs() <= c.across,
                squared: north * north + east * east,
                predicted: c.covariance.trace(),
            })
        })
        .collect()
}

/// Index of the planned moment whose place lies nearest, from the one compared last onward.
fn nearest(prediction: &Prediction, last: usize, north: f64, east: f64) -> Option<usize> {
    let distance = |i: &usize| {
        let place = prediction.samples[*i].position;
        (place.north - north).hypot(place.east - east)
    };
    let end = (last + AHEAD).min(prediction.samples.len());
    (last..end).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
