//! Residuals of the pictures against the log over time.

use egui::{Color32, Pos2, Sense, Stroke, Ui, vec2};
use pilotage_core::calibration::{FrameResidual, ResidualSummary};

use super::work::ResidualPreview;
use crate::command::Command;
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::views::chart::ChartAxes;
use crate::views::{TimeAxis, parts};

/// Height of the curves, points.
const HEIGHT: f32 = 120.0;
/// Share of the residuals that the axis holds; wild ones stand at its edge.
const HELD: f64 = 0.95;

/// Component of the residuals that is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum ShownComponent {
    /// Along the track and across it.
    #[default]
    Track,
    /// North and east.
    North,
    /// Heading.
    Heading,
    /// Height.
    Height,
}

impl ShownComponent {
    /// All, in the order of the chips.
    pub const ALL: [Self; 4] = [Self::Track, Self::North, Self::Heading, Self::Height];

    /// Words on its chip.
    pub fn label(self) -> &'static str {
        match self {
            Self::Track => "Along, across",
            Self::North => "North, east",
            Self::Heading => "Heading",
            Self::Height => "Height",
        }
    }

    /// Names of its curves.
    pub fn curves(self) -> &'static [&'static str] {
        match self {
            Self::Track => &["along the track", "to the right"],
            Self::North => &["north", "east"],
            Self::Heading => &["heading"],
            Self::Height => &["height"],
        }
    }

    /// Its unit, given that of lengths.
    pub fn unit(self, length: &'static str) -> &'static str {
        match self {
            Self::Track | Self::North => length,
            Self::Heading => "°",
            Self::Height => "%",
        }
    }

    /// Its root mean square over all frames, in that unit.
    fn root_mean_square(self, summary: &ResidualSummary, length: f64) -> Option<f64> {
        match self {
            Self::Track | Self::North => Some(length * summary.place),
            Self::Heading => summary.heading.map(f64::to_degrees),
            Self::Height => summary.log_height.map(height_percent),
        }
    }

    /// Values of a frame, in that unit.
    fn values(self, residual: &FrameResidual, length: f64) -> [Option<f64>; 2] {
        match self {
            Self::Track => {
                let both = residual.along_and_across;
                [both.map(|b| length * b.0), both.map(|b| length * b.1)]
            }
            Self::North => [Some(length * residual.north), Some(length * residual.east)],
            Self::Heading => [residual.heading.map(f64::to_degrees), None],
            Self::Height => [residual.log_height.map(height_percent), None],
        }
    }
}

/// Error of a height in per cent of it, of the logarithm of their ratio.
pub(super) fn height_percent(log: f64) -> f64 {
    100.0 * log.exp_m1()
}

/// Colours of the curves.
pub(super) fn colours(tokens: &Tokens) -> [Color32; 2] {
    [tokens.accent, tokens.dead_reckoning]
}

/// The mark of a frame on a curve: full on the first, hollow on the second.
pub(super) fn mark(painter: &egui::Painter, at: Pos2, curve: usize, colour: Color32) {
    if curve == 0 {
        painter.circle_filled(at, 2.75, colour);
    } else {
        painter.circle_stroke(at, 2.5, Stroke::new(1.25, colour));
    }
}

/// Draws the residuals; a click goes to the time of the frame.
pub(super) fn residual_chart(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    preview: &ResidualPreview,
    shown: ShownComponent,
) {
    let residuals = &preview.residuals;
    let tokens = context.tokens;
    let (factor, length) = context.units.length();
    let labels = 1.8 * tokens.text_sizes[0] + 4.0;
    let size = vec2(ui.available_width(), HEIGHT + labels);
    let (outer, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let unit = shown.unit(length);
    let name = format!("Residuals of {} over time, {unit}", shown.label());
    parts::name(&response, name);
    let mut rect = TimeAxis::curves_rect(outer, tokens);
    rect.set_height(HEIGHT);
    let painter = ui.painter_at(outer);
    painter.rect_filled(rect, 2.0, tokens.background);
    let times = || residuals.iter().map(|r| r.time);
    let (first, last) = times().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), t| {
        (a.min(t), b.max(t))
    });
    let values = |r: &FrameResidual| shown.values(r, factor);
    let mut sizes: Vec<f64> = residuals.iter().flat_map(values).flatten().collect();
    if sizes.is_empty() || last <= first {
        let words = "No frame tells this.";
        let font = parts::small(tokens);
        let centre = egui::Align2::CENTER_CENTER;
        painter.text(rect.center(), centre, words, font, tokens.muted);
        return;
    }
    for size in &mut sizes {
        *size = size.abs();
    }
    sizes.sort_by(f64::total_cmp);
    let held = ((sizes.len() - 1) as f64 * HELD).round() as usize;
    let most = 1.25 * sizes[held].max(1e-3);
    let margin = 0.02 * (last - first);
    let axes = ChartAxes {
        rect,
        x: (first - margin, last + margin),
        y: (-most, most),
        log: false,
    };
    axes.draw_y(&painter, tokens);
    axes.draw_time(&painter, tokens, context.clock_zero);
    let inside = painter.with_clip_rect(rect);
    for (curve, colour) in colours(tokens).into_iter().enumerate() {
        let at = |r: &FrameResidual| {
            let value = values(r)[curve]?;
            Some(axes.at(r.time, value.clamp(-most, most)))
        };
        let points: Vec<_> = residuals.iter().filter_map(at).collect();
        let faint = Stroke::new(1.0, colour.gamma_multiply(0.5));
        inside.line(points.clone(), faint);
        for point in points {
            mark(&inside, point, curve, colour);
        }
    }
    if (axes.x.0..=axes.x.1).contains(&context.time) {
        let x = axes.screen_x(context.time);
        inside.vline(x, rect.y_range(), Stroke::new(1.0, tokens.text));
    }
    let rms = preview.summaries[2].and_then(|s| shown.root_mean_square(&s, factor));
    if let Some(rms) = rms {
        let words = format!("RMS {} {unit}", parts::figures(rms));
        let at = rect.right_top() + vec2(-0.75 * tokens.space, 0.5 * tokens.space);
        let galley = painter.layout_no_wrap(words, parts::normal(tokens), tokens.text);
        let place = egui::Align2::RIGHT_TOP.anchor_size(at, galley.size());
        painter.rect_filled(place.expand(2.0), 2.0, parts::shade(tokens));
        painter.galley(place.min, galley, tokens.text);
    }
    if let Some(pointer) = response.interact_pointer_pos() {
        let time = axes.x_at(pointer.x).clamp(first, last);
        context.commands.push(Command::SeekTo(time));
    }
}
