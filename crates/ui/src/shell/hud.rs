//! Heads-up display: one large number with a light and its course, and a few calm ones beside it.

use egui::{
    Align2, Color32, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, StrokeKind, Ui, WidgetInfo,
    pos2, vec2,
};

use crate::tokens::Tokens;

/// Distance from the upper edge of a map to whatever comes below the display, points.
pub const BELOW_HUD: f32 = 88.0;

const HEIGHT: f32 = 64.0;
/// Least width of the large number with its light, points.
const HEADLINE: f32 = 184.0;
/// Width of its course, points.
const COURSE: f32 = 96.0;

/// Light beside the large number: told by colour, shape and word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Light {
    /// All is well: a disc.
    Good,
    /// Take care: a triangle.
    Fair,
    /// All is not well: a square on its corner.
    Poor,
}

impl Light {
    fn color(self, tokens: &Tokens) -> Color32 {
        match self {
            Self::Good => tokens.truth,
            Self::Fair => tokens.accent,
            Self::Poor => tokens.no_fly,
        }
    }

    fn paint(self, painter: &Painter, at: Pos2, tokens: &Tokens) {
        let color = self.color(tokens);
        let corners = |corners: &[(f32, f32)]| {
            let corners = corners.iter().map(|(x, y)| at + vec2(*x, *y));
            Shape::convex_polygon(corners.collect(), color, Stroke::NONE)
        };
        painter.add(match self {
            Self::Good => Shape::circle_filled(at, 6.0, color),
            Self::Fair => corners(&[(0.0, -7.0), (7.0, 6.0), (-7.0, 6.0)]),
            Self::Poor => corners(&[(0.0, -7.0), (7.0, 0.0), (0.0, 7.0), (-7.0, 0.0)]),
        });
    }
}

/// The large number.
pub struct Headline<'a> {
    /// Name of the quantity.
    pub name: &'a str,
    /// Words before the value.
    pub lead: &'a str,
    /// Value as text.
    pub value: String,
    /// Its unit.
    pub unit: &'a str,
    /// Light that says how well that is.
    pub light: Light,
    /// The light in words.
    pub word: &'a str,
    /// The word explained.
    pub why: &'a str,
    /// Course of the value up to here, in any unit; none is drawn of fewer than two.
    pub course: Vec<f64>,
    /// Stretch of the course in words.
    pub stretch: &'a str,
}

/// Number beside the large one.
pub struct Readout {
    /// Name of the quantity.
    pub name: &'static str,
    /// Value with its unit.
    pub value: String,
    /// Colour of the value, if it means something.
    pub color: Option<Color32>,
}

/// Draws the numbers from `left_top` on, as many as `room` points have place for; the part of the screen that they
/// cover.
pub fn hud(
    ui: &Ui,
    tokens: &Tokens,
    headline: &Headline<'_>,
    rest: &[Readout],
    left_top: Pos2,
    room: f32,
) -> Rect {
    let painter = ui.painter();
    let width_of = |text: &str, font| {
        let galley = painter.layout_no_wrap(text.to_owned(), font, tokens.text);
        galley.size().x
    };
    let named = width_of(headline.name, tokens.small()) + width_of(headline.word, tokens.small());
    let first = (named + 36.0).max(HEADLINE);
    let has_course = headline.course.len() > 1 && room >= first + COURSE;
    let mut width = first + if has_course { COURSE + 12.0 } else { 0.0 };
    let mut cells = Vec::new();
    for readout in rest {
        let name = width_of(readout.name, tokens.small());
        let value = width_of(&readout.value, tokens.normal());
        let cell = name.max(value).max(64.0) + 20.0;
        if width + cell > room {
            break;
        }
        cells.push((readout, width));
        width += cell;
    }
    let rect = Rect::from_min_size(left_top, vec2(width, HEIGHT));
    let response = ui.interact(rect, ui.scope_id().with("readouts"), Sense::hover());
    response.widget_info(|| {
        let Headline {
            name, lead, value, ..
        } = headline;
        let mut words = format!("{name}: {lead}{value} {}, {}", headline.unit, headline.word);
        for readout in rest {
            words = format!("{words}. {}: {}", readout.name, readout.value);
        }
        WidgetInfo::labeled(Role::Label, true, words)
    });
    response.on_hover_text(headline.why);
    painter.rect_filled(rect, tokens.radius, tokens.over_map());
    let line = Stroke::new(1.0, tokens.line);
    painter.rect_stroke(rect, tokens.radius, line, StrokeKind::Inside);
    paint_headline(painter, tokens, headline, rect.left_top());
    if has_course {
        let corner = rect.left_top() + vec2(first, 0.0);
        let area = Rect::from_min_size(corner, vec2(COURSE, HEIGHT));
        paint_course(painter, tokens, headline, area);
    }
    for (readout, left) in cells {
        let left = rect.left() + left + 8.0;
        let name = pos2(left, rect.top() + 8.0);
        let (small, normal) = (tokens.small(), tokens.normal());
        painter.text(name, Align2::LEFT_TOP, readout.name, small, tokens.muted);
        let value = pos2(left, rect.bottom() - 12.0);
        let color = readout.color.unwrap_or(tokens.text);
        painter.text(value, Align2::LEFT_BOTTOM, &readout.value, normal, color);
    }
    rect
}

fn paint_headline(painter: &Painter, tokens: &Tokens, headline: &Headline<'_>, corner: Pos2) {
    let left = corner.x + 12.0;
    let small = tokens.small();
    let top = pos2(left, corner.y + 8.0);
    let name = painter.text(
        top,
        Align2::LEFT_TOP,
        headline.name,
        small.clone(),
        tokens.muted,
    );
    let word = pos2(name.right() + 8.0, top.y);
    let color = headline.light.color(tokens);
    painter.text(word, Align2::LEFT_TOP, headline.word, small, color);
    let middle = corner.y + 43.0;
    headline
        .light
        .paint(painter, pos2(left + 7.0, middle), tokens);
    let base = middle + 9.0;
    let before = painter.text(
        pos2(left + 22.0, base),
        Align2::LEFT_BOTTOM,
        headline.lead,
        tokens.normal(),
        tokens.text,
    );
    let value = painter.text(
        pos2(before.right(), base + 5.0),
        Align2::LEFT_BOTTOM,
        &headline.value,
        tokens.figure(),
        tokens.text,
    );
    painter.text(
        pos2(value.right() + 4.0, base),
        Align2::LEFT_BOTTOM,
        headline.unit,
        tokens.normal(),
        tokens.text,
    );
}

/// Draws the course of the large number from zero to its greatest value.
fn paint_course(painter: &Painter, tokens: &Tokens, headline: &Headline<'_>, area: Rect) {
    let top = pos2(area.left(), area.top() + 8.0);
    let (small, muted) = (tokens.small(), tokens.muted);
    painter.text(top, Align2::LEFT_TOP, headline.stretch, small, muted);
    let curve = Rect::from_min_max(
        pos2(area.left(), area.top() + 28.0),
        pos2(area.right(), area.bottom() - 12.0),
    );
    let greatest = headline.course.iter().copied().fold(0.0, f64::max);
    let last = (headline.course.len() - 1) as f32;
    let points = headline.course.iter().enumerate().map(|(index, value)| {
        let share = (value / greatest.max(f64::MIN_POSITIVE)) as f32;
        let x = curve.left() + curve.width() * index as f32 / last;
        pos2(x, curve.bottom() - curve.height() * share)
    });
    let points: Vec<Pos2> = points.collect();
    painter.hline(
        curve.x_range(),
        curve.bottom(),
        Stroke::new(1.0, tokens.line),
    );
    let end = points.last().copied();
    painter.add(Shape::line(points, Stroke::new(1.5, tokens.text)));
    if let Some(end) = end {
        painter.circle_filled(end, 2.5, headline.light.color(tokens));
    }
}
