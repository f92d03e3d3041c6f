//! A landmark's row in lists of them: its switch, its cells, and a keyboard path for everything the map does with the
//! pointer.

use egui::{
    Align2, Color32, EventFilter, Key, Modifiers, Painter, Rect, Response, Role, Sense, Ui,
    WidgetInfo, vec2,
};
use pilotage_core::frames::GroundRect;
use pilotage_core::landmark::Landmark;

use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{icon_button, paint_focus_ring, paint_row};
use crate::tokens::Tokens;

/// Between a cell's edge and its text, points.
const PADDING: f32 = 8.0;

/// Row whose cells are drawn.
pub struct LandmarkRow<'a> {
    /// Its painter.
    pub painter: &'a Painter,
    /// Its place on the screen.
    pub rect: Rect,
    /// Colour of its name.
    pub color: Color32,
    landmark: &'a Landmark,
    tokens: &'a Tokens,
}

impl LandmarkRow<'_> {
    /// Writes the landmark's name into the cell `rect`.
    pub fn name(&self, rect: Rect) {
        let clipped = self
            .painter
            .with_clip_rect(rect.intersect(self.painter.clip_rect()));
        let at = rect.left_center() + vec2(PADDING, 0.0);
        let font = self.tokens.normal();
        clipped.text(
            at,
            Align2::LEFT_CENTER,
            &self.landmark.name,
            font,
            self.color,
        );
    }
}

/// Draws the row of a landmark, which is called `words` for screen readers; `cells` draws what stands in it.
pub fn landmark_row(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    landmark: &Landmark,
    is_selected: bool,
    words: &str,
    cells: impl FnOnce(&LandmarkRow<'_>),
) -> Response {
    let tokens = context.tokens;
    let id = landmark.id;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        let (icon, label) = if landmark.enabled {
            (Icon::Eye, format!("Switch {} off", landmark.name))
        } else {
            (Icon::EyeOff, format!("Switch {} on", landmark.name))
        };
        if icon_button(ui, tokens, icon, &label).clicked() {
            context.commands.push(Command::EnableLandmark {
                id,
                enabled: !landmark.enabled,
            });
        }
        let size = vec2(ui.available_width(), tokens.target());
        let (_, rect) = ui.allocate_space(size);
        let response = ui.interact(rect, egui::Id::unique(("landmark row", id)), Sense::click());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_selected, words));
        let painter = ui.painter();
        if ui.is_rect_visible(rect) {
            paint_row(painter, rect, tokens, is_selected, response.hovered());
            cells(&LandmarkRow {
                painter,
                rect,
                color: if landmark.enabled {
                    tokens.text
                } else {
                    tokens.muted
                },
                landmark,
                tokens,
            });
        }
        if response.has_focus() {
            paint_focus_ring(painter, rect, tokens);
            keyboard(ui, response.id, landmark, context.commands);
        }
        response
    })
    .inner
}

/// Arrows move the box by a metre, Shift with arrows resizes it, Delete deletes it.
fn keyboard(ui: &Ui, widget: egui::Id, landmark: &Landmark, commands: &mut Vec<Command>) {
    ui.memory_mut(|m| {
        m.set_focus_lock_filter(
            widget,
            EventFilter {
                horizontal_arrows: true,
                vertical_arrows: true,
                ..Default::default()
            },
        );
    });
    let (north, east, shift, delete) = ui.input_mut(|i| {
        let along = |minus: Key, plus: Key| {
            f64::from(u32::try_from(i.num_presses(plus)).unwrap_or(0))
                - f64::from(u32::try_from(i.num_presses(minus)).unwrap_or(0))
        };
        (
            along(Key::ArrowDown, Key::ArrowUp),
            along(Key::ArrowLeft, Key::ArrowRight),
            i.modifiers.shift,
            // The map would delete what is selected by the same press.
            i.consume_key(Modifiers::NONE, Key::Delete),
        )
    });
    let id = landmark.id;
    if delete {
        commands.push(Command::DeleteLandmark(id));
    }
    if north == 0.0 && east == 0.0 {
        return;
    }
    let old = landmark.bounds;
    let bounds = if shift {
        GroundRect {
            north: (old.north + north).max(old.south + 3.0),
            east: (old.east + east).max(old.west + 3.0),
            ..old
        }
    } else {
        GroundRect {
            south: old.south + north,
            north: old.north + north,
            west: old.west + east,
            east: old.east + east,
        }
    };
    commands.push(Command::ReshapeLandmark {
        id,
        bounds,
        finished: true,
    });
}
