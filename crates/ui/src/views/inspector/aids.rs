//! Aids beside pictures: what each measured last, and what the filter made of it.

use egui::{RichText, Ui};
use pilotage_core::navigator::{AidInfo, Run, UpdateReport};

use super::super::parts::{self, NumberReadout, figures};
use super::super::sighted;
use crate::context::ViewContext;

/// Steps in which the last reading of an aid is looked for.
const LOOKED_BACK: usize = 2000;

/// Draws a section for the last readings up to step `index`, if the run has any.
pub(super) fn show(ui: &mut Ui, context: &ViewContext<'_>, run: &Run, index: usize) {
    let tokens = context.tokens;
    let sightings = sighted::last(run, run.steps[index].time);
    for chosen in &run.settings.aids {
        let Ok(info) = AidInfo::named(&chosen.key) else {
            continue;
        };
        let update = last_of(run, index, info.key);
        let seen = sightings.iter().find(|sighting| sighting.aid == info.key);
        if update.is_none() && seen.is_none() {
            continue;
        }
        parts::section(ui, tokens, &info.label.to_uppercase(), true, |ui| {
            if let Some(seen) = seen {
                sighted::show(ui, context, seen);
            }
            let Some((time, update)) = update else {
                return;
            };
            let verdict = if update.is_accepted() {
                "accepted"
            } else {
                "refused: too far from what was expected"
            };
            let color = if update.is_accepted() {
                tokens.muted
            } else {
                tokens.refused
            };
            let text = format!("{verdict}, {:.2} s ago", context.time - time);
            ui.label(RichText::new(text).size(tokens.text_sizes[0]).color(color));
            let nis = NumberReadout::new(
                format!(
                    "NIS ({} numbers, gate {})",
                    update.degrees_of_freedom,
                    figures(update.threshold)
                ),
                figures(update.nis),
                "",
            );
            parts::reading(ui, tokens, &nis.color(color));
            parts::gauge(ui, tokens, update.nis, update.threshold, true);
            // What pictures show does not always tell all of them.
            let told = update.innovation.len();
            for (i, (name, unit)) in info.components.iter().take(told).enumerate() {
                let (factor, unit) = context.units.of_si(unit);
                let sigma = update.innovation_covariance[(i, i)].max(0.0).sqrt();
                let innovation = parts::brief(factor * update.innovation[i]);
                let label = format!("{name}, measured less expected");
                let reading = NumberReadout::new(label, innovation, unit);
                parts::reading(ui, tokens, &reading.deviation(figures(factor * sigma)));
            }
        });
    }
}

/// Time and report of the last reading of an aid up to step `index`.
fn last_of<'r>(run: &'r Run, index: usize, aid: &str) -> Option<(f64, &'r UpdateReport)> {
    let first = (index + 1).saturating_sub(LOOKED_BACK);
    let steps = run.steps.get(first..=index)?.iter().rev();
    let mut found = steps.filter_map(|step| {
        let update = step.updates.iter().rfind(|update| update.aid == aid)?;
        Some((step.time, update))
    });
    found.next()
}

#[cfg(test)]
mod tests {
    use super::super::super::fixture::{Fixture, reading_of_gps};
    use super::*;

    #[test]
    fn the_last_reading_up_to_the_cursor_is_shown() {
        let mut run = Fixture::lasting(15.0).run;
        for (step, nis) in [(3, 1.0), (8, 2.0), (20, 3.0)] {
            run.steps[step].updates.push(reading_of_gps(nis, None));
        }
        let nis = |index| last_of(&run, index, "gps-position").map(|(_, update)| update.nis);
        assert_eq!(
            [nis(2), nis(3), nis(19), nis(20)],
            [None, Some(1.0), Some(2.0), Some(3.0)]
        );
        assert!(last_of(&run, 20, "gps-velocity").is_none());
    }
}
