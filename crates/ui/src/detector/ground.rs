//! The searched ground on the screen, with lengths along its sides.

use egui::{Align2, Painter, Pos2, Rect, Stroke, StrokeKind, Vec2, pos2, vec2};
use pilotage_core::landmark::CascadeEvidence;

use crate::tokens::Tokens;
use crate::units::Units;
use crate::views::chart::{self, ChartAxes};
use crate::views::parts;

/// Room for the numbers at the left of the ground and below it, points.
const LEFT: f32 = 26.0;
const BELOW: f32 = 17.0;

/// Place of the searched ground on the screen.
pub(super) struct GroundPlan<'a> {
    evidence: &'a CascadeEvidence,
    axes: ChartAxes,
    /// Points in a pixel of the ground.
    scale: f32,
}

impl<'a> GroundPlan<'a> {
    /// The ground as large as it fits into `area`, at its upper left, its numbers included.
    pub fn within(evidence: &'a CascadeEvidence, area: Rect) -> Self {
        let ground = &evidence.ground;
        let size = vec2(ground.width().max(1) as f32, ground.height().max(1) as f32);
        let room = area.size() - vec2(LEFT, BELOW + 4.0);
        let scale = (room.x / size.x).min(room.y / size.y).max(0.1);
        let rect = Rect::from_min_size(area.min + vec2(LEFT, 4.0), size * scale);
        let covered = evidence.window.rect();
        let expected = evidence.expected;
        Self {
            evidence,
            axes: ChartAxes {
                rect,
                x: (covered.west - expected.east, covered.east - expected.east),
                y: (
                    covered.south - expected.north,
                    covered.north - expected.north,
                ),
                log: false,
            },
            scale,
        }
    }

    /// Size that the ground takes with its numbers, as large as it fits into `room`.
    pub fn size_within(evidence: &CascadeEvidence, room: Vec2) -> Vec2 {
        let ground = &evidence.ground;
        let aspect = ground.width().max(1) as f32 / ground.height().max(1) as f32;
        let around = vec2(LEFT, BELOW + 4.0);
        let free = (room - around).max(vec2(20.0, 20.0));
        let height = free.y.min(free.x / aspect);
        vec2(height * aspect, height) + around
    }

    /// Part of the screen with the picture.
    pub fn rect(&self) -> Rect {
        self.axes.rect
    }

    /// Part of the screen with the middles of the windows, of the outermost with half a pixel more.
    pub fn windows(&self) -> Rect {
        let (width, height) = self.evidence.size;
        let first = (0.5 * width as f64 - 0.5, 0.5 * height as f64 - 0.5);
        let scores = &self.evidence.scores;
        let size = vec2(scores.width() as f32, scores.height() as f32);
        Rect::from_min_size(self.at(first), size * self.scale)
    }

    /// A place of the ground's pixels on the screen.
    pub fn at(&self, pixel: (f64, f64)) -> Pos2 {
        self.axes.rect.min + vec2(pixel.0 as f32, pixel.1 as f32) * self.scale
    }

    /// Draws pictures: of the ground, and over it one with a pixel for each window.
    pub fn paint(&self, painter: &Painter, ground: Option<egui::TextureId>, over: egui::TextureId) {
        let whole = Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0));
        let white = egui::Color32::WHITE;
        if let Some(ground) = ground {
            painter.image(ground, self.rect(), whole, white);
        }
        painter.image(over, self.windows(), whole, white);
    }

    /// Draws the frame and the lengths along it.
    pub fn paint_axes(&self, painter: &Painter, tokens: &Tokens, units: Units) {
        let (factor, _) = units.length();
        let rect = self.rect();
        let stroke = Stroke::new(1.0, tokens.line);
        painter.rect_stroke(rect, 0.0, stroke, StrokeKind::Outside);
        let text = |at: Pos2, align: Align2, text: &str| {
            painter.text(at, align, text, parts::small(tokens), tokens.muted);
        };
        let most = |room: f32| ((room / 44.0) as usize).clamp(2, 8);
        let ticks =
            |(low, high): (f64, f64), room| chart::ticks(factor * low, factor * high, most(room));
        for east in ticks(self.axes.x, rect.width()) {
            let x = self.axes.screen_x(east / factor);
            painter.vline(x, rect.bottom()..=rect.bottom() + 3.0, stroke);
            let at = pos2(
                x.clamp(rect.left() + 6.0, rect.right() - 6.0),
                rect.bottom() + 3.0,
            );
            text(at, Align2::CENTER_TOP, &whole(east));
        }
        for north in ticks(self.axes.y, rect.height()) {
            let y = self.axes.screen_y(north / factor);
            painter.hline(rect.left() - 3.0..=rect.left(), y, stroke);
            let at = pos2(
                rect.left() - 4.0,
                y.clamp(rect.top() + 6.0, rect.bottom() - 6.0),
            );
            text(at, Align2::RIGHT_CENTER, &whole(north));
        }
    }

    /// Draws the best place with its window, and the second best.
    pub fn paint_marks(&self, painter: &Painter, tokens: &Tokens, with_windows: bool) {
        let painter = painter.with_clip_rect(self.rect());
        let (width, height) = self.evidence.size;
        let size = vec2(width as f32, height as f32) * self.scale;
        let over = Tokens::over_imagery();
        let colors = [(over.observed, 2.0), (over.refused, 1.5)];
        for (mark, (color, width)) in self.evidence.marks.iter().zip(colors) {
            let at = self.at(mark.pixel);
            for stroke in [
                Stroke::new(width + 2.0, parts::rim(tokens)),
                Stroke::new(width, color),
            ] {
                painter.circle_stroke(at, 6.0, stroke);
                if with_windows {
                    let outline = Rect::from_center_size(at, size);
                    painter.rect_stroke(outline, 0.0, stroke, StrokeKind::Middle);
                }
            }
        }
    }

    /// Draws a cross where the map says that the landmark is.
    pub fn paint_expected(&self, painter: &Painter, tokens: &Tokens) {
        let at = self.axes.at(0.0, 0.0);
        let half = 5.0;
        for stroke in [
            Stroke::new(3.5, parts::rim(tokens)),
            Stroke::new(1.5, tokens.sigma),
        ] {
            painter.hline(at.x - half..=at.x + half, at.y, stroke);
            painter.vline(at.x, at.y - half..=at.y + half, stroke);
        }
    }
}

/// The legend of the marks in a row.
pub(super) fn legend(ui: &mut egui::Ui, tokens: &Tokens, units: Units) {
    let (_, unit) = units.length();
    let height = 1.5 * tokens.text_sizes[0];
    let size = Vec2::new(ui.available_width(), height);
    let (rect, response) = ui.allocate_exact_size(size, egui::Sense::hover());
    parts::name(
        &response,
        format!(
            "Ring: best place; orange ring: second best; cross: expected place. {unit} north and east of it"
        ),
    );
    let painter = ui.painter_at(rect);
    let (mut left, middle) = (rect.left(), rect.center().y);
    let text = |left: f32, text: &str| {
        let at = pos2(left, middle);
        let font = parts::small(tokens);
        painter.text(at, Align2::LEFT_CENTER, text, font, tokens.muted)
    };
    for (color, name) in [(tokens.observed, "best"), (tokens.refused, "second")] {
        painter.circle_stroke(pos2(left + 6.0, middle), 4.0, Stroke::new(2.0, color));
        left = text(left + 14.0, name).right() + tokens.space;
    }
    let at = pos2(left + 5.0, middle);
    let stroke = Stroke::new(1.5, parts::ink(tokens));
    painter.hline(at.x - 4.0..=at.x + 4.0, at.y, stroke);
    painter.vline(at.x, at.y - 4.0..=at.y + 4.0, stroke);
    let words = format!("expected; {unit} north and east of it");
    text(left + 13.0, &words);
}

fn whole(value: f64) -> String {
    format!("{:.0}", value + 0.0).replace('-', "−")
}
