//! A stretch in which nothing tells the place.

use egui::{Align2, Pos2, Rect, Stroke, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{NavigatorSettings, Run, UpdateReport, VehicleChoice};

use super::super::figure::Figure;
use super::super::gap::{Gap, estimates_wind, longest_gap, no_gap};
use super::super::lesson::TourStop;
use super::super::moment::TourMoment;
use super::super::trial::TourTrial;
use crate::units::Units;
use crate::views::inspector::sentence::sigma;
use crate::views::parts::figures;

/// The longest stretch in which nothing tells the place.
#[derive(Default)]
pub(super) struct DeadReckoningStop;

impl TourStop for DeadReckoningStop {
    fn title(&self) -> &'static str {
        "Nothing in view: dead reckoning"
    }

    fn find(&self, run: &Run, _flight: Option<&Flight>, units: Units) -> Option<TourMoment> {
        let Gap { from, last, end } = longest_gap(run, |_| true)?;
        let middle = usize::midpoint(from, end);
        let start = &run.steps[from];
        let lasting = run.steps[end].time - start.time;
        let (factor, unit) = units.length();
        let grown = sigma(&run.steps[last].after) - sigma(&start.after);
        let rate = factor * grown / (run.steps[last].time - start.time);
        let mut updates = run.steps[from + 1..=last].iter().flat_map(|s| &s.updates);
        let alone = if updates.any(UpdateReport::is_accepted) {
            "with what aids say that do not tell the place"
        } else {
            "and nothing else"
        };
        let is_by_air = estimates_wind(run) && run.settings.vehicle != VehicleChoice::Multirotor;
        let reckons = if is_by_air {
            "adds up airspeed, heading and the wind it believes in"
        } else {
            "goes on as its model of the vehicle does"
        };
        let text = format!(
            "For {lasting:.1} seconds nothing tells the place: the filter {reckons}, {alone}. \
             The track turns blue and the uncertainty grows by about {} {unit} each second.",
            figures(rate)
        );
        let moment = TourMoment::new(run, middle, text).from(start.time);
        Some(moment.until(run.steps[end].time))
    }

    fn missing(&self, run: &Run) -> Option<&'static str> {
        no_gap(run)
    }

    // The position's σ over time: a sawtooth, with the gap shaded.
    fn draw(&self, figure: &Figure<'_>) {
        let Figure {
            painter,
            rect,
            tokens,
            units,
            run,
            time,
            moment,
            ..
        } = *figure;
        let (factor, unit) = units.length();
        let Some(span) = run.span() else { return };
        let highest = figure
            .thinned()
            .map(|s| sigma(&s.after))
            .fold(0.0, f64::max);
        let axes = figure.axes(span, (0.0, 1.1 * factor * highest));
        let x = axes.screen_x(moment.from)..=axes.screen_x(moment.until);
        let shade = Rect::from_x_y_ranges(x, axes.rect.y_range());
        painter.rect_filled(shade, 0.0, tokens.dead_reckoning.gamma_multiply(0.18));
        axes.draw_y(painter, tokens);
        axes.draw_time(painter, tokens, figure.clock_zero);
        let curve: Vec<Pos2> = figure
            .thinned()
            .map(|s| axes.at(s.time, factor * sigma(&s.after)))
            .collect();
        painter.line(curve, Stroke::new(1.5, tokens.text));
        let stroke = Stroke::new(1.0, tokens.accent);
        painter.vline(axes.screen_x(time), axes.rect.y_range(), stroke);
        let at = rect.left_top() + vec2(tokens.space, 0.5 * tokens.space);
        let text = format!("1σ of the position, {unit}; blue: dead reckoning");
        figure.caption(at, Align2::LEFT_TOP, &text, tokens.muted);
    }

    fn trial(&self, moment: &TourMoment, _settings: &NavigatorSettings) -> TourTrial {
        TourTrial::play("Play this stretch", moment.from)
    }
}
