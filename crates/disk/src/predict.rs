//! The uncertainty along a planned route.

use pilotage_core::plan::RoutePrediction;
use pilotage_jobs::{FINE, PredictionOrder};

use crate::landmarks::{Say, expected};
use crate::planned_flight::PlannedFlight;

/// Order to predict without landmarks, in the worlds of the page or those of `seed`.
///
/// # Errors
/// A mission without a route.
pub fn prediction(
    ground: &PlannedFlight,
    seed: Option<u64>,
) -> Result<PredictionOrder, &'static str> {
    let plan = ground.plan.as_ref();
    let plan = plan.ok_or("the mission has no route to predict along")?;
    Ok(PredictionOrder {
        navigator: ground.mission.navigator.clone(),
        seed: seed.unwrap_or(PredictionOrder::SEED),
        ..plan.clone()
    })
}

/// Measures the landmarks and predicts, as the page does or on days and in worlds of `seed`, with stretches over `limit`
/// metres; what was predicted of comes with it.
pub fn predict(
    ground: &PlannedFlight,
    seed: Option<u64>,
    limit: f64,
    say: Say<'_>,
) -> Result<(PredictionOrder, RoutePrediction), Box<dyn std::error::Error>> {
    let order = PredictionOrder {
        worlds: FINE,
        limit,
        ..prediction(ground, seed)?
    };
    let order = PredictionOrder {
        landmarks: expected(ground, seed, say)?,
        ..order
    };
    let begun = std::time::Instant::now();
    let prediction = order.predict()?;
    let largest = prediction
        .samples
        .iter()
        .map(|s| s.corridor.sigma_major)
        .fold(0.0, f64::max);
    say(&format!(
        "{} frames, largest standard deviation {largest:.1} m, predicted in {:.2} s",
        prediction.samples.len(),
        begun.elapsed().as_secs_f64()
    ));
    for stretch in &prediction.over_limit {
        say(&format!(
            "over {:.0} m from {:.0} m to {:.0} m: up to {:.1} m at north {:.0} m east {:.0} m, after {:.0} s of dead reckoning",
            limit,
            stretch.begin,
            stretch.end,
            stretch.sigma,
            stretch.worst.north,
            stretch.worst.east,
            stretch.dead_reckoning
        ));
    }
    Ok((order, prediction))
}
