//! Trains a detector for one landmark out of the map alone, and evaluates it on days that it was not trained on.
//!
//! `cargo run -p pilotage-core --example 06_train_a_detector`
//!
//! The plan is small, so that it takes seconds; `TrainingPlan::default()` is what is used in earnest.

use std::{error::Error, sync::Arc};

use pilotage_core::imagery::{CachedImagery, Imagery};
use pilotage_core::plan::SceneryDays;
use pilotage_core::simulate::Scenario;
use pilotage_core::training::evaluation::{Evaluation, EvaluationSettings};
use pilotage_core::training::{DetectorTraining, FlightEnvelope, TrainingPlan};

fn main() -> Result<(), Box<dyn Error>> {
    let scenario = Scenario::named("distinct-400ft-calm").ok_or("no such scenario")?;
    let scenery = Scenario::map();
    let mission = scenario.mission_over(&scenery);
    let landmark = mission.landmarks.last().ok_or("no landmarks")?;
    let map: Arc<dyn Imagery> = Arc::new(CachedImagery::new(Arc::new(scenery.clone()), 64));

    // Photos from all over the flights that are planned, on drawn days.
    let sensors = mission.navigator.sensors;
    let envelope = FlightEnvelope::around(&Scenario::camera(), scenario.height, sensors);
    let days = SceneryDays { scenery };
    let plan = TrainingPlan {
        photos: 16,
        shown: 2,
        negatives: 200,
        days: 4,
        most_stages: 4,
        last_votes: 20,
        held_out: 16,
        seed: 3,
        ..TrainingPlan::default()
    };
    let mut training = DetectorTraining::new(landmark, &map, &days, &envelope, plan);
    let mut told = 0;
    while training.advance()? {
        for report in &training.reports()[told..] {
            let (votes, hits, alarms) = (
                report.row.votes,
                100.0 * report.row.hit_rate,
                100.0 * report.row.false_alarm_rate,
            );
            println!("stage of {votes} votes: {hits:.1} % found, {alarms:.1} % false alarms");
        }
        told = training.reports().len();
    }
    let trained = training.trained().ok_or("the training is not done")?;
    let window = trained.window;
    println!(
        "{}: a window of {} × {} pixels of {:.2} m",
        landmark.name, window.width, window.height, window.gsd
    );

    // Judged by photos on other days.
    let settings = EvaluationSettings {
        replicates: 200,
        ..EvaluationSettings::default()
    };
    let evaluation = Evaluation::of(training.looks(), &settings)?;
    let found = evaluation.operating.here.found;
    let share = 100.0 * found.share().ok_or("no look")?;
    let (low, high) = (100.0 * found.low, 100.0 * found.high);
    println!(
        "found in {share:.0} % ({low:.0} % to {high:.0} %) of {} photos",
        found.of
    );
    println!(
        "average precision {:.2}",
        evaluation.average_precision.value
    );
    if share < 60.0 {
        return Err("even a small training should find a pool in most photos".into());
    }
    Ok(())
}
