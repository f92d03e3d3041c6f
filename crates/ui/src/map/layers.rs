//! Layers that the map can show, and the legend that switches them.

use egui::{
    Color32, Frame, Painter, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use pilotage_core::navigator::SightedKind;
use pilotage_core::reference::GenericClass;

use crate::shell::icons::Icon;
use crate::tokens::Tokens;
use crate::views::sighted::mark;

/// Colour of the track of that number, of those beside the flight's.
pub(crate) fn track_colour(tokens: &Tokens, number: usize) -> Color32 {
    [tokens.sigma, tokens.accent, tokens.observed, tokens.ghost][number % 4]
}

/// A layer of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layer {
    /// True track of the aircraft.
    Truth,
    /// Tracks of the log beside that of the flight: the autopilot's own estimate, and other vehicles.
    Recorded,
    /// Estimated track of the navigator.
    Estimate,
    /// Track by dead reckoning alone.
    Unaided,
    /// The previous run.
    Ghost,
    /// Sigma points.
    Sigma,
    /// The 1-2-3 σ ellipses.
    Ellipses,
    /// Footprint of the camera on the ground.
    Footprint,
    /// Landmarks.
    Landmarks,
    /// Lines to accepted matches.
    Matches,
    /// Things that aids saw in the last picture, and those of the map that they took them for.
    Sighted,
    /// Roads of the mission.
    Roads,
    /// Routes of the plan.
    Route,
    /// The corridor predicted along a route.
    Corridor,
}

impl Layer {
    /// Every layer, in the order of the legend.
    pub const ALL: [Self; 14] = [
        Self::Truth,
        Self::Recorded,
        Self::Estimate,
        Self::Unaided,
        Self::Ghost,
        Self::Sigma,
        Self::Ellipses,
        Self::Footprint,
        Self::Landmarks,
        Self::Matches,
        Self::Sighted,
        Self::Roads,
        Self::Route,
        Self::Corridor,
    ];

    /// Name in the legend.
    pub fn label(self) -> &'static str {
        match self {
            Self::Truth => "True track",
            Self::Recorded => "Other tracks of the log",
            Self::Estimate => "Estimated track",
            Self::Unaided => "Dead reckoning alone",
            Self::Ghost => "Previous run",
            Self::Sigma => "Sigma points",
            Self::Ellipses => "1-2-3 σ ellipses",
            Self::Footprint => "Camera footprint",
            Self::Landmarks => "Landmarks",
            Self::Matches => "Accepted matches",
            Self::Sighted => "Seen by aids",
            Self::Roads => "Roads",
            Self::Route => "Routes",
            Self::Corridor => "95 % corridor",
        }
    }

    fn swatch(self, painter: &Painter, rect: Rect, tokens: &Tokens) {
        let (left, right) = (rect.left_center(), rect.right_center());
        let line = |from: Pos2, to: Pos2, color: Color32, width: f32| {
            painter.line_segment([from, to], Stroke::new(width, color));
        };
        let dashes = |color: Color32, dash: f32, gap: f32| {
            painter.extend(Shape::dashed_line(
                &[left, right],
                Stroke::new(2.0, color),
                dash,
                gap,
            ));
        };
        match self {
            Self::Truth => line(left, right, tokens.truth, 2.0),
            Self::Recorded => {
                line(left, rect.center(), track_colour(tokens, 0), 1.5);
                line(rect.center(), right, track_colour(tokens, 1), 1.5);
            }
            Self::Estimate => {
                line(left, rect.center(), tokens.corrected, 2.5);
                painter.extend(Shape::dashed_line(
                    &[rect.center() + vec2(3.0, 0.0), right],
                    Stroke::new(2.5, tokens.dead_reckoning),
                    4.0,
                    2.0,
                ));
            }
            Self::Unaided => dashes(tokens.unaided, 6.0, 4.0),
            Self::Ghost => dashes(tokens.ghost, 2.0, 3.0),
            Self::Sigma => {
                for x in [0.2, 0.5, 0.8] {
                    let at = pos2(rect.left() + x * rect.width(), rect.center().y);
                    painter.circle(at, 2.5, tokens.sigma, Stroke::new(1.0, tokens.outline()));
                }
            }
            Self::Ellipses => ellipses(painter, rect, tokens),
            Self::Footprint => {
                let inner = Rect::from_center_size(rect.center(), vec2(16.0, 10.0));
                painter.rect_stroke(
                    inner,
                    0.0,
                    Stroke::new(1.25, tokens.sigma),
                    egui::StrokeKind::Middle,
                );
            }
            Self::Landmarks => {
                for (x, color, crossed) in [
                    (0.15, tokens.text, false),
                    (0.5, tokens.observed, false),
                    (0.85, tokens.refused, true),
                ] {
                    let at = pos2(rect.left() + x * rect.width(), rect.center().y);
                    let small = Rect::from_center_size(at, vec2(7.0, 7.0));
                    painter.rect_stroke(
                        small,
                        0.0,
                        Stroke::new(1.25, color),
                        egui::StrokeKind::Middle,
                    );
                    if crossed {
                        line(small.left_top(), small.right_bottom(), color, 1.0);
                        line(small.right_top(), small.left_bottom(), color, 1.0);
                    }
                }
            }
            Self::Matches => {
                line(left, right, tokens.observed, 1.5);
                painter.circle_filled(left, 2.5, tokens.observed);
            }
            Self::Sighted => pair(painter, rect, tokens),
            Self::Roads => {
                line(left, right, tokens.outline(), 5.0);
                line(left, right, tokens.road, 2.5);
            }
            Self::Route => {
                line(left, right, tokens.accent, 2.5);
                let edge = Stroke::new(1.5, tokens.accent);
                painter.circle(rect.center(), 4.0, tokens.surface, edge);
            }
            Self::Corridor => {
                let split = rect.center().x + 2.0;
                let kept = Rect::from_x_y_ranges(rect.left()..=split, rect.y_range());
                painter.rect_filled(kept, 0.0, tokens.observed.gamma_multiply(0.35));
                let over = Rect::from_x_y_ranges(split..=rect.right(), rect.y_range());
                painter.rect_filled(over, 0.0, tokens.warning.gamma_multiply(0.35));
                for y in [rect.top(), rect.bottom()] {
                    line(pos2(rect.left(), y), pos2(split, y), tokens.observed, 1.25);
                    let ends = [pos2(split, y), pos2(rect.right(), y)];
                    let stroke = Stroke::new(1.5, tokens.warning);
                    painter.extend(Shape::dashed_line(&ends, stroke, 4.0, 2.5));
                }
            }
        }
    }
}

/// A building that was seen, joined with that of the map.
fn pair(painter: &Painter, rect: Rect, tokens: &Tokens) {
    let seen = rect.left_center() + vec2(6.0, 2.0);
    let known = rect.right_center() - vec2(6.0, 2.0);
    painter.line_segment([seen, known], Stroke::new(1.5, tokens.observed));
    let kind = SightedKind::Landmark(GenericClass::Building);
    let (full, empty) = (tokens.observed, Color32::TRANSPARENT);
    mark(painter, seen, kind, Stroke::new(1.5, full), full, tokens);
    let line = Stroke::new(1.0, tokens.text);
    mark(painter, known, kind, line, empty, tokens);
}

/// Three ellipses in one another.
fn ellipses(painter: &Painter, rect: Rect, tokens: &Tokens) {
    for scale in [0.35, 0.65, 0.95] {
        let points = (0..24)
            .map(|i| {
                let a = std::f32::consts::TAU * i as f32 / 24.0;
                let half = 0.5 * scale * rect.size();
                rect.center() + vec2(half.x * a.cos(), half.y * 0.9 * a.sin())
            })
            .collect();
        painter.add(Shape::closed_line(
            points,
            Stroke::new(1.0, tokens.corrected),
        ));
    }
}

/// Width of the open legend, of the closed one, and heights of its head and of a row, points.
const WIDTH: f32 = 184.0;
const CHIP: f32 = 80.0;
const HEADER: f32 = 24.0;
const ROW: f32 = 22.0;
/// Height of either that fingers press, points.
const FINGER: f32 = 44.0;

/// Layers that are on, and the state of the legend.
#[derive(Clone, Debug, Default)]
pub struct Layers {
    hidden: Vec<Layer>,
    is_open: bool,
    /// Whether fingers press it.
    pub touch: bool,
}

impl Layers {
    fn header_height(&self) -> f32 {
        if self.touch { FINGER } else { HEADER }
    }

    fn row_height(&self) -> f32 {
        if self.touch { FINGER } else { ROW }
    }

    /// Space that the legend takes with so many rows, points: of a chip unless people opened it.
    pub fn legend_size(&self, rows: usize) -> egui::Vec2 {
        let head = 10.0 + self.header_height();
        if self.is_open {
            vec2(WIDTH + 10.0, head + self.row_height() * rows as f32)
        } else {
            vec2(CHIP + 10.0, head)
        }
    }

    /// Whether a layer is on.
    pub fn shows(&self, layer: Layer) -> bool {
        !self.hidden.contains(&layer)
    }

    /// Names of the layers that are off.
    pub fn hidden_names(&self) -> Vec<String> {
        self.hidden.iter().map(|l| l.label().to_owned()).collect()
    }

    /// Switches off exactly these layers.
    pub fn hide_names(&mut self, names: &[String]) {
        self.hidden = Layer::ALL
            .into_iter()
            .filter(|l| names.iter().any(|n| n == l.label()))
            .collect();
    }

    fn toggle(&mut self, layer: Layer) {
        if self.shows(layer) {
            self.hidden.push(layer);
        } else {
            self.hidden.retain(|l| *l != layer);
        }
    }

    /// Draws the legend; `shown` names the layers that have anything to show.
    pub fn legend(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        shown: impl Fn(Layer) -> Option<&'static str>,
    ) {
        Frame::new()
            .fill(tokens.over_map())
            .stroke(Stroke::new(1.0, tokens.line))
            .corner_radius(tokens.radius)
            .inner_margin(4)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                if header(ui, tokens, self.is_open, self.header_height()).clicked() {
                    self.is_open = !self.is_open;
                }
                if !self.is_open {
                    return;
                }
                for layer in Layer::ALL {
                    let Some(name) = shown(layer) else { continue };
                    let on = self.shows(layer);
                    if row(
                        ui,
                        tokens,
                        (name, self.row_height()),
                        on,
                        |painter, rect| {
                            if on {
                                layer.swatch(painter, rect, tokens);
                            } else {
                                Icon::EyeOff.paint_sized(
                                    painter,
                                    rect.center(),
                                    12.0,
                                    tokens.muted,
                                );
                            }
                        },
                    ) {
                        self.toggle(layer);
                    }
                }
            });
    }
}

/// Head of the legend, which opens and closes it.
fn header(ui: &mut Ui, tokens: &Tokens, is_open: bool, height: f32) -> egui::Response {
    let (width, icon) = if is_open {
        (WIDTH, Icon::Down)
    } else {
        (CHIP, Icon::Right)
    };
    let (rect, response) = ui.allocate_exact_size(vec2(width, height), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Legend"));
    let painter = ui.painter();
    if response.hovered() || response.has_focus() {
        painter.rect_filled(rect, tokens.radius, tokens.hover());
    }
    let words = rect.left_center() + vec2(8.0, 0.0);
    let (left, font) = (egui::Align2::LEFT_CENTER, tokens.caption());
    painter.text(words, left, "Legend", font, tokens.text);
    let at = rect.right_center() - vec2(12.0, 0.0);
    icon.paint_sized(painter, at, 10.0, tokens.muted);
    response
}

fn row(
    ui: &mut Ui,
    tokens: &Tokens,
    (label, height): (&str, f32),
    on: bool,
    paint: impl FnOnce(&Painter, Rect),
) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, height), Sense::click());
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, on, label));
    let painter = ui.painter();
    if response.hovered() || response.has_focus() {
        painter.rect_filled(rect, tokens.radius, tokens.hover());
    }
    let swatch = Rect::from_min_size(
        rect.min + vec2(6.0, 0.5 * (rect.height() - 12.0)),
        vec2(30.0, 12.0),
    );
    paint(painter, swatch);
    let color = if on { tokens.text } else { tokens.muted };
    painter.text(
        pos2(swatch.right() + 10.0, rect.center().y),
        egui::Align2::LEFT_CENTER,
        label,
        tokens.small(),
        color,
    );
    response.clicked()
}
