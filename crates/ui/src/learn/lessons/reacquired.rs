//! The landmark that ends the longest stretch without one.

use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run};

use super::super::candidates::best_accepted;
use super::super::figure::Figure;
use super::super::found;
use super::super::gap::longest_gap;
use super::super::lesson::Lesson;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::inspector::sentence::sigma;
use crate::views::parts::figures;
use crate::views::picking;

/// The landmark after the longest stretch without one.
#[derive(Default)]
pub(super) struct Reacquired;

impl Lesson for Reacquired {
    fn title(&self) -> &'static str {
        "Found again"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let (from, to) = longest_gap(run)?;
        let step = &run.steps[to];
        if !step.corrected() {
            return None;
        }
        let name =
            best_accepted(step).map(|c| (c.landmark, picking::landmark_name(run, c.landmark)));
        let (factor, unit) = units.length();
        let shift = factor * step.after.position().distance(&step.predicted.position());
        let text = format!(
            "After {:.1} seconds {} comes into view where the widened search expects it, and the estimate jumps {} {unit} back. \
             The 1σ falls from {} to {} {unit}, and the wind that was believed in meanwhile is corrected as well.",
            step.time - run.steps[from].time,
            name.as_ref()
                .map_or_else(|| "a landmark".to_owned(), |n| format!("“{}”", n.1)),
            figures(shift),
            figures(factor * sigma(&step.predicted)),
            figures(factor * sigma(&step.after))
        );
        Some(
            TourMoment::new(run, to, text)
                .from(run.steps[from].time)
                .landmark(name.map(|n| n.0)),
        )
    }

    fn draw(&self, figure: &Figure<'_>) {
        found::draw(figure);
    }

    fn trial(&self, moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::play("Watch the last two seconds before", moment.time - 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn after_the_gap_a_landmark_is_found_again() {
        let fixture = Fixture::new();
        let moment = Reacquired
            .find(&fixture.run, Some(&fixture.flight), Units::Metric)
            .unwrap();
        assert!(fixture.run.steps[moment.index].corrected());
        assert!(moment.text.contains("Pool"), "{}", moment.text);
    }
}
