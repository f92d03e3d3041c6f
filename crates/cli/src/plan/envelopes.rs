//! Heights and tilts of the camera from which landmarks are found.

use pilotage_core::landmark::Landmark;
use pilotage_core::plan::{Envelope, EnvelopeSurvey};
use pilotage_disk::landmarks::enabled;
use pilotage_jobs::{EnvelopeOrder, JobEvent};

use super::arguments::Arguments;
use super::planned_flight::PlannedFlight;
use crate::workers;

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
