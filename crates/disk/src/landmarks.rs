//! Detection of landmarks over the map of a plan.

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{DetectionStatistics, Rehearsal};
use pilotage_jobs::{AssessmentOrder, JobEvent};

use crate::planned_flight::PlannedFlight;
use crate::workers::{self, GoesOn};

/// Printer of lines about a plan.
pub type Say<'a> = &'a dyn Fn(&str);

/// The landmarks that are switched on.
pub fn enabled(ground: &PlannedFlight) -> Vec<&Landmark> {
    let landmarks = ground.mission.landmarks.iter();
    landmarks.filter(|landmark| landmark.enabled).collect()
}

/// Measures each landmark over the map, on the days of the page or those of `seed`.
///
/// # Errors
/// Why none can be measured, in words.
pub fn expected(
    ground: &PlannedFlight,
    seed: Option<u64>,
    say: Say<'_>,
) -> Result<Vec<(Landmark, DetectionStatistics)>, String> {
    expected_while(ground, seed, say, &mut || Ok(()))
}

/// As [`expected`], as long as `goes_on`, which is asked after every few views, does not refuse.
///
/// # Errors
/// Why none can be measured, in words, or the refusal.
pub fn expected_while(
    ground: &PlannedFlight,
    seed: Option<u64>,
    say: Say<'_>,
    goes_on: GoesOn<'_>,
) -> Result<Vec<(Landmark, DetectionStatistics)>, String> {
    let landmarks = enabled(ground);
    let order = |l: &&Landmark| ground.assessment(l, seed);
    let orders: Vec<AssessmentOrder> = landmarks.iter().map(order).collect();
    let (mut measured, mut fits) = (Vec::new(), true);
    let begun = std::time::Instant::now();
    workers::run(orders, &ground.lent(), &mut |number, event| {
        goes_on()?;
        let landmark = landmarks[number];
        let (told, false_matches, statistics) = match event {
            JobEvent::Assessment(found) => (
                format!("{:.2}", found.expected.probability()),
                found.false_matches,
                found.statistics(),
            ),
            JobEvent::Misfit => {
                fits = false;
                return Ok(());
            }
            JobEvent::Failed(why) if std::mem::replace(&mut fits, true) => return Err(why),
            JobEvent::Failed(_) => (
                "never: it does not fit into the picture".to_owned(),
                Rehearsal::false_matches(&[]),
                DetectionStatistics::default(),
            ),
            _ => return Ok(()),
        };
        say(&format!(
            "{:24} found {told}, false {false_matches:.3}",
            landmark.name
        ));
        measured.push((landmark.clone(), statistics));
        Ok(())
    })?;
    let took = begun.elapsed().as_secs_f64();
    say(&format!("measured in {took:.1} s"));
    Ok(measured)
}
