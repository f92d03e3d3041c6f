//! The last step: how unsure the filter is in the end.

use egui::{Align2, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run};

use super::super::figure::Figure;
use super::super::lesson::Lesson;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::command::Command;
use crate::units::Units;
use crate::views::inspector::sentence::sigma;
use crate::views::parts::figures;

/// The last step of the run.
#[derive(Default)]
pub(super) struct LastStep;

impl Lesson for LastStep {
    fn title(&self) -> &'static str {
        "Where it ends"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let index = run.steps.len().checked_sub(1)?;
        let (factor, unit) = units.length();
        let spread = figures(factor * sigma(&run.steps[index].after));
        let text = format!("This is the last step of the run. Its 1σ is {spread} {unit}.");
        Some(TourMoment::new(run, index, text))
    }

    fn draw(&self, figure: &Figure<'_>) {
        let at = figure.rect.center() + vec2(0.0, figure.tokens.space);
        let text = format!("{:.0} s", figure.step.time);
        figure.caption(at, Align2::CENTER_CENTER, &text, figure.tokens.text);
    }

    fn trial(&self, _moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::look("Go to the start", vec![Command::GoToStart])
    }
}
