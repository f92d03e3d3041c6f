//! The landmark that ends the longest stretch of dead reckoning that a landmark ends.

use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run, StepReport};

use super::super::candidates::{best_accepted, no_landmark};
use super::super::figure::Figure;
use super::super::found;
use super::super::gap::{Gap, estimates_wind, longest_gap, no_gap};
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::inspector::sentence::sigma;
use crate::views::parts::figures;
use crate::views::picking;

/// The landmark after the longest stretch of dead reckoning.
#[derive(Default)]
pub(super) struct ReacquiredStop;

impl TourStop for ReacquiredStop {
    fn title(&self) -> &'static str {
        "Found again"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let Gap { from, end, .. } = longest_gap(run, is_found_again)?;
        let step = &run.steps[end];
        let found = best_accepted(step)?.landmark;
        let (factor, unit) = units.length();
        let shift = factor * step.after.position().distance(&step.predicted.position());
        let wind = if estimates_wind(run) {
            ", and the wind that was believed in meanwhile is corrected as well"
        } else {
            ""
        };
        let text = format!(
            "After {:.1} seconds “{}” comes into view where the widened search expects it, and the estimate jumps {} {unit} back. \
             The 1σ falls from {} to {} {unit}{wind}.",
            step.time - run.steps[from].time,
            picking::landmark_name(run, found),
            figures(shift),
            figures(factor * sigma(&step.predicted)),
            figures(factor * sigma(&step.after))
        );
        let moment = TourMoment::new(run, end, text).from(run.steps[from].time);
        Some(moment.landmark(Some(found)))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_landmark(run).or_else(|| no_gap(run))
    }

    fn draw(&self, figure: &Figure<'_>) {
        found::draw(figure);
    }

    fn trial(&self, moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::play("Watch the last two seconds before", moment.time - 2.0)
    }
}

/// Whether a landmark corrected the estimate in this step, and made it surer.
fn is_found_again(step: &StepReport) -> bool {
    best_accepted(step).is_some() && sigma(&step.after) < sigma(&step.predicted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn after_the_gap_a_landmark_is_found_again() {
        let fixture = Fixture::new();
        let moment = ReacquiredStop
            .find(&fixture.run, Some(&fixture.flight), Units::Metric)
            .unwrap();
        assert!(fixture.run.steps[moment.index].corrected());
        assert!(moment.text.contains("Pool"), "{}", moment.text);
    }
}
