//! `pilotage plan --predict`: the uncertainty along the route.

use pilotage_core::plan::RoutePrediction;
use pilotage_jobs::PredictionOrder;

use super::arguments::Arguments;
use super::ground::PlannedFlight;
use super::landmarks::expected;

/// Worlds of a prediction.
const WORLDS: usize = 100;

/// Measures the landmarks and predicts; what was predicted of comes with it.
pub fn predict(
    arguments: &Arguments,
    ground: &PlannedFlight,
) -> Result<(PredictionOrder, RoutePrediction), Box<dyn std::error::Error>> {
    let plan = ground
        .plan
        .as_ref()
        .ok_or("the mission has no route to predict along")?;
    let order = PredictionOrder {
        landmarks: expected(arguments, ground)?,
        navigator: ground.mission.navigator.clone(),
        worlds: WORLDS,
        seed: arguments.seed,
        limit: arguments.limit,
        ..plan.clone()
    };
    let begun = std::time::Instant::now();
    let prediction = order.predict()?;
    let largest = prediction
        .samples
        .iter()
        .map(|s| s.corridor.sigma_major)
        .fold(0.0, f64::max);
    println!(
        "{} frames, largest standard deviation {largest:.1} m, predicted in {:.2} s",
        prediction.samples.len(),
        begun.elapsed().as_secs_f64()
    );
    for stretch in &prediction.over_limit {
        println!(
            "over {:.0} m from {:.0} m to {:.0} m: up to {:.1} m at north {:.0} m east {:.0} m, after {:.0} s of dead reckoning",
            arguments.limit,
            stretch.begin,
            stretch.end,
            stretch.sigma,
            stretch.worst.north,
            stretch.worst.east,
            stretch.dead_reckoning
        );
    }
    Ok((order, prediction))
}
