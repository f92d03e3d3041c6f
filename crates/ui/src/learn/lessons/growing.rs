//! Sigma points that drift apart while nothing tells the place.

use egui::{Align2, pos2, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run};

use super::super::candidates::judged;
use super::super::figure::Figure;
use super::super::gap::{Gap, estimates_wind, longest_gap, no_gap};
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::sigma_points::{reach, sigma_set};
use super::super::trial::TourTrial;
use crate::command::Command;
use crate::units::Units;
use crate::views::inspector::sentence::sigma;
use crate::views::parts::figures;

/// The end of the longest stretch of dead reckoning.
#[derive(Default)]
pub(super) struct GrowingStop;

impl TourStop for GrowingStop {
    fn title(&self) -> &'static str {
        "The sigma points spread"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let Gap { from, last, .. } = longest_gap(run, |_| true)?;
        let (factor, unit) = units.length();
        let search = if judged(run).next().is_some() {
            ", and widens its search for the next landmark"
        } else {
            ""
        };
        let flies = if estimates_wind(run) {
            "flies on with its own guess of the wind"
        } else {
            "goes on by its own guess of the vehicle's motion"
        };
        let text = format!(
            "Every sigma point {flies}, so that they drift apart: the 1σ has grown from {} to {} {unit}. \
             Nothing went wrong here: the filter honestly says how little it knows by now{search}.",
            figures(factor * sigma(&run.steps[from].after)),
            figures(factor * sigma(&run.steps[last].after))
        );
        Some(TourMoment::new(run, last, text).from(run.steps[from].time))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_gap(run)
    }

    // Sigma points at four times of the gap, side by side at one scale.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            run,
            moment,
            ..
        } = *figure;
        let Some(first) = run.index_at(moment.from) else {
            return;
        };
        let span = moment.index.saturating_sub(first);
        let width = 0.25 * rect.width();
        let widest = reach(&run.steps[moment.index].sigma.after_predict).max(0.01);
        let scale = 0.42 * width.min(rect.height() - 3.0 * tokens.text_sizes[0]) / widest as f32;
        let corner = pos2(rect.right() - tokens.space, rect.top() + 2.5 * tokens.space);
        figure.scale(scale, corner);
        for i in 0..4 {
            let step = &run.steps[first + span * i / 3];
            let middle = pos2(
                rect.left() + width * (i as f32 + 0.5),
                rect.center().y - tokens.text_sizes[0],
            );
            let points = match (&step.sigma.after_correct, i) {
                (Some(points), 0) => points,
                _ => &step.sigma.after_predict,
            };
            let (north, east) = (points[(0, 0)], points[(1, 0)]);
            let at = |n: f64, e: f64| middle + vec2((e - east) as f32, (north - n) as f32) * scale;
            let color = if i == 0 {
                tokens.corrected
            } else {
                tokens.dead_reckoning
            };
            sigma_set(
                painter,
                points,
                &step.after.position_covariance(),
                &at,
                color,
            );
            figure.caption(
                pos2(middle.x, rect.bottom() - 0.5 * tokens.space),
                Align2::CENTER_BOTTOM,
                &format!("+{:.0} s", step.time - moment.from),
                tokens.muted,
            );
        }
    }

    fn trial(&self, moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::look(
            "Go back to where it began",
            vec![Command::SeekTo(moment.from)],
        )
    }
}
