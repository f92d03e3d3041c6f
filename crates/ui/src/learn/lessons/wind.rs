//! The wind, which nothing measures and the filter learns.

use egui::{Align2, Pos2, Stroke, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run, StepReport};
use pilotage_core::vehicle::StateComponent;

use super::super::figure::Figure;
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::parts::figures;

/// Parts of the start's error, or σ, at which the wind counts as learned: the smallest that the run
/// comes to.
const LEARNED: [f64; 3] = [0.15, 0.3, 0.5];

/// Number of steps for which the wind has to stay learned.
const LASTING: usize = 100;

/// The time at which the wind is learned.
#[derive(Default)]
pub(super) struct WindStop;

impl TourStop for WindStop {
    fn title(&self) -> &'static str {
        "The wind is learned"
    }

    // When the wind's error (or, without a truth, its σ) has first come down to a small part of the
    // start's.
    fn find(&self, run: &Run, flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let (north, east) = run
            .state_index(StateComponent::WindNorth)
            .zip(run.state_index(StateComponent::WindEast))?;
        let spread = |s: &StepReport| {
            (s.after.covariance[(north, north)] + s.after.covariance[(east, east)])
                .max(0.0)
                .sqrt()
        };
        let error = |s: &StepReport| {
            let wind = flight?.truth.as_ref()?.wind(s.time)?;
            Some((s.after.mean[north] - wind.x).hypot(s.after.mean[east] - wind.y))
        };
        let (factor, unit) = units.speed();
        let first = run.steps.first()?;
        let measured = error(first).filter(|e| *e > 0.5);
        let (index, text) = if let Some(start) = measured {
            let index = first_below(run, start, error)?;
            let text = format!(
                "No instrument measures the wind, yet by now its error has fallen from {} to {} {unit}. \
                 Each time a correction shows that the aircraft has drifted, the filter blames the wind in proportion, because position and wind err together.",
                figures(factor * start),
                figures(factor * error(&run.steps[index]).unwrap_or(0.0))
            );
            (index, text)
        } else {
            let start = spread(first);
            let index = first_below(run, start, |s| Some(spread(s)))?;
            let text = format!(
                "No instrument measures the wind, yet by now its uncertainty has fallen from {} to {} {unit}. \
                 Each time a correction shows that the aircraft has drifted, the filter blames the wind in proportion, because position and wind err together.",
                figures(factor * start),
                figures(factor * spread(&run.steps[index]))
            );
            (index, text)
        };
        Some(TourMoment::new(run, index, text).from(first.time))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        run.state_index(StateComponent::WindNorth).is_none().then_some(
            "This vehicle model does not estimate the wind. Choose “Airplane + wind” in the filter settings to see it learned.",
        )
    }

    // Both wind components beside the truth.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            units,
            flight,
            run,
            moment,
            ..
        } = *figure;
        let Some((north, east)) = run
            .state_index(StateComponent::WindNorth)
            .zip(run.state_index(StateComponent::WindEast))
        else {
            return;
        };
        let (factor, unit) = units.speed();
        let truth = flight.and_then(|f| f.truth.as_ref());
        let values = |s: &StepReport| [factor * s.after.mean[north], factor * s.after.mean[east]];
        let extent = figure
            .thinned()
            .flat_map(values)
            .fold((0.0_f64, 0.0_f64), |(a, b), v| (a.min(v), b.max(v)));
        let Some(span) = run.span() else { return };
        let axes = figure.axes(span, (extent.0 - 0.5, extent.1 + 0.5));
        axes.draw_y(painter, tokens);
        axes.draw_time(painter, tokens, figure.clock_zero);
        let curve = |f: &dyn Fn(&StepReport) -> Option<f64>| -> Vec<Pos2> {
            figure
                .thinned()
                .filter_map(|s| Some(axes.at(s.time, factor * f(s)?)))
                .collect()
        };
        for (index, width) in [(north, 2.0), (east, 1.0)] {
            let estimate = curve(&|s| Some(s.after.mean[index]));
            painter.line(estimate, Stroke::new(width, tokens.corrected));
            let real = curve(&|s| {
                let wind = truth?.wind(s.time)?;
                Some(if index == north { wind.x } else { wind.y })
            });
            painter.line(real, Stroke::new(width, tokens.truth));
        }
        let stroke = Stroke::new(1.0, tokens.accent);
        painter.vline(axes.screen_x(moment.time), axes.rect.y_range(), stroke);
        let text = format!("{unit}: north thick, east thin, truth green");
        let at = rect.left_top() + vec2(tokens.space, 0.5 * tokens.space);
        figure.caption(at, Align2::LEFT_TOP, &text, tokens.muted);
    }

    fn trial(&self, _moment: &TourMoment, settings: &NavigatorSettings) -> TourTrial {
        TourTrial::change(
            settings,
            "Fly again with the wind pinned to zero at the start",
            &|s| {
                s.start.wind = 0.1;
            },
        )
    }
}

/// The first step at which `value` is below one of [`LEARNED`] of `start` and stays there a while.
fn first_below(run: &Run, start: f64, value: impl Fn(&StepReport) -> Option<f64>) -> Option<usize> {
    let below = |part: f64| {
        let low = |s: &StepReport| value(s).is_some_and(|v| v < part * start);
        (0..run.steps.len()).find(|i| {
            let end = run.steps.len().min(i + LASTING);
            run.steps[*i..end].iter().all(low)
        })
    };
    LEARNED.into_iter().find_map(below)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views::fixture::Fixture;

    #[test]
    fn the_wind_is_learned_when_little_of_its_error_is_left() {
        let fixture = Fixture::new();
        let moment = WindStop
            .find(&fixture.run, Some(&fixture.flight), Units::Metric)
            .unwrap();
        let error = |i: usize| {
            let step = &fixture.run.steps[i];
            (step.after.mean[2] - 2.0).hypot(step.after.mean[3] + 3.0)
        };
        assert!(error(moment.index) < 0.5 * error(0));
        assert!(error(moment.index - 1) > error(moment.index));
    }
}
