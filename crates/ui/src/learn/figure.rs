//! The small picture of a stop, into which its lesson draws.

use egui::{Align2, Color32, Painter, Pos2, Rect, Sense, Stroke, Ui, pos2, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{Run, StepReport};

use super::moment::TourMoment;
use crate::context::ViewContext;
use crate::map::{length_text, round_length};
use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::chart::ChartAxes;
use crate::views::parts;

/// Least and most height of a figure, points.
const HEIGHTS: [f32; 2] = [128.0, 248.0];

/// Greatest length of the bar that says how large a figure is, points.
const LONGEST_BAR: f32 = 64.0;

/// At most this many points of a curve in a figure.
const MOST_POINTS: usize = 400;

/// Numbers of a whole run of which a figure is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct FigureNumbers {
    /// Matches: what is drawn of each, and whether it was used.
    pub matches: Vec<([f64; 2], bool)>,
    /// Threshold of the gate for the first of them.
    pub threshold: Option<f64>,
    /// Landmarks by their ids, with the numbers of looks that were used and refused.
    pub looks: Vec<(u32, usize, usize)>,
}

/// Place for a picture drawn from the run on screen, and what is drawn there.
pub(super) struct Figure<'a> {
    /// Painter that keeps to the place.
    pub painter: &'a Painter,
    /// Place on the screen.
    pub rect: Rect,
    /// The look.
    pub tokens: &'a Tokens,
    /// The user's units.
    pub units: Units,
    /// Flight of the run.
    pub flight: Option<&'a Flight>,
    /// Run on screen.
    pub run: &'a Run,
    /// Step of the moment.
    pub step: &'a StepReport,
    /// Moment that the stop tells of.
    pub moment: &'a TourMoment,
    /// Numbers that the stop gathered of the run.
    pub numbers: &'a FigureNumbers,
    /// The time cursor, seconds in the flight's time base.
    pub time: f64,
    /// Time at which every clock on the page stands at zero.
    pub clock_zero: f64,
}

/// Has `draw` draw the figure of the stop called `title` into `room` points of height, more or less.
pub(super) fn place(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    title: &str,
    (moment, numbers): (&TourMoment, &FigureNumbers),
    room: f32,
    draw: &dyn Fn(&Figure<'_>),
) {
    let Some(run) = context.run else { return };
    let Some(step) = run.steps.get(moment.index) else {
        return;
    };
    let tokens = context.tokens;
    let height = room.clamp(HEIGHTS[0], HEIGHTS[1]);
    let (rect, response) =
        ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    parts::name(&response, format!("Figure: {title}"));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, tokens.radius, tokens.background);
    draw(&Figure {
        painter: &painter,
        rect,
        tokens,
        units: context.units,
        flight: context.flight,
        run,
        step,
        moment,
        numbers,
        time: context.time,
        clock_zero: context.clock_zero,
    });
}

impl Figure<'_> {
    /// Writes small words.
    pub fn caption(&self, at: Pos2, align: Align2, text: &str, color: Color32) {
        let font = parts::small(self.tokens);
        self.painter.text(at, align, text, font, color);
    }

    /// Writes rows at the left that explain the marks.
    pub fn key(&self, rows: &[(&str, Color32)]) {
        let tokens = self.tokens;
        for (i, (text, color)) in rows.iter().enumerate() {
            let y = self.rect.top() + tokens.space + i as f32 * 1.5 * tokens.text_sizes[0];
            let at = pos2(self.rect.left() + tokens.space, y);
            let dot = at + vec2(3.0, 0.5 * tokens.text_sizes[0]);
            self.painter.circle_filled(dot, 3.0, *color);
            let at = at + vec2(11.0, 0.0);
            self.caption(at, Align2::LEFT_TOP, text, tokens.muted);
        }
    }

    /// Draws a bar of a round length whose right end is `right`, where a metre is so many points long.
    pub fn scale(&self, points_per_metre: f32, right: Pos2) {
        let (factor, _) = self.units.length();
        let most = f64::from(LONGEST_BAR / points_per_metre.max(1e-6));
        let length = round_length(most * factor) / factor;
        let left = right - vec2(length as f32 * points_per_metre, 0.0);
        let ink = self.tokens.muted;
        self.painter
            .line_segment([left, right], Stroke::new(1.5, ink));
        let words = length_text(length, self.units);
        let above = right - vec2(0.0, 3.0);
        self.caption(above, Align2::RIGHT_BOTTOM, &words, ink);
    }

    /// Axes over values from left to right and from the bottom up, in the middle of the figure.
    pub fn axes(&self, x: (f64, f64), y: (f64, f64)) -> ChartAxes {
        let tokens = self.tokens;
        let text = tokens.text_sizes[0];
        ChartAxes {
            rect: Rect::from_min_max(
                self.rect.min + vec2(3.2 * text, 1.8 * text),
                self.rect.max - vec2(tokens.space, 1.9 * text),
            ),
            x: (x.0, x.1.max(x.0 + 0.1)),
            y: (y.0, if y.1 > y.0 { y.1 } else { y.0 + 1.0 }),
            log: false,
        }
    }

    /// Every n-th step of the run, so that a figure stays small.
    pub fn thinned(&self) -> impl Iterator<Item = &StepReport> {
        let steps = &self.run.steps;
        steps.iter().step_by((steps.len() / MOST_POINTS).max(1))
    }
}
