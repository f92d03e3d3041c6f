//! Detection of landmarks over the map of a plan.

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{DetectionStatistics, Envelope, EnvelopeSurvey, Rehearsal};
use pilotage_jobs::{EnvelopeOrder, JobEvent};

use super::arguments::Arguments;
use super::ground::PlannedFlight;
use crate::workers;

/// Printer of lines about a plan.
pub type Say = fn(&str);

fn enabled(ground: &PlannedFlight) -> Vec<&Landmark> {
    let landmarks = ground.mission.landmarks.iter();
    landmarks.filter(|landmark| landmark.enabled).collect()
}

/// From which heights and with which tilts each landmark is found.
pub fn envelopes(arguments: &Arguments, ground: &PlannedFlight) -> Result<Vec<Envelope>, String> {
    let landmarks = enabled(ground);
    let order = |l: &&Landmark| EnvelopeOrder(Box::new(ground.assessment(l, arguments.seed)));
    let orders = landmarks.iter().map(order).collect();
    let mut envelopes: Vec<Envelope> = Vec::new();
    workers::run(orders, &ground.lent(), &mut |number, event| {
        match event {
            JobEvent::Envelope(known) => {
                envelopes.truncate(number);
                envelopes.push(*known);
            }
            JobEvent::Finished => {
                if let Some(envelope) = envelopes.get(number) {
                    print(&landmarks[number].name, envelope);
                }
            }
            JobEvent::Failed(why) => return Err(why),
            _ => {}
        }
        Ok(())
    })?;
    Ok(envelopes)
}

fn print(name: &str, envelope: &Envelope) {
    println!(
        "{name}: height, then found of looks at tilts of {:?} degrees",
        EnvelopeSurvey::TILTS
    );
    for (row, height) in envelope.heights.iter().enumerate() {
        let cells = (0..envelope.tilts.len()).filter_map(|tilt| envelope.at(row, tilt));
        let cells: Vec<String> = cells.map(|c| format!("{}/{}", c.found, c.looks)).collect();
        println!("{height:8.0} m  {}", cells.join("  "));
    }
}

/// Measures each landmark over the map on the days of `seed`.
pub fn expected(
    ground: &PlannedFlight,
    seed: u64,
    say: Say,
) -> Result<Vec<(Landmark, DetectionStatistics)>, String> {
    let landmarks = enabled(ground);
    let order = |l: &&Landmark| ground.assessment(l, seed);
    let orders = landmarks.iter().map(order).collect();
    let mut measured = Vec::new();
    let begun = std::time::Instant::now();
    workers::run(orders, &ground.lent(), &mut |number, event| {
        let landmark = landmarks[number];
        let (told, false_matches, statistics) = match event {
            JobEvent::Assessment(found) => (
                format!("{:.2}", found.expected.probability()),
                found.false_matches,
                found.statistics(),
            ),
            // The ground is open already: nothing but its size can be wrong.
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
