//! Results of the photos, a row each.

use egui::{Align, Layout, Rect, UiBuilder, pos2, vec2};
use egui::{Align2, Color32, Label, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};
use pilotage_core::filter::probability_words;

use super::PhotosCommand as Do;
use super::scene::send;
use super::state::PhotosState;
use crate::context::ViewContext;
use crate::shell::muted;
use crate::tokens::Tokens;
use crate::units::{Units, direction};
use crate::views::{parts, table};
use pilotage_jobs::PhotoReport;

/// Height of the rows that are seen at once, points.
const SEEN: f32 = 260.0;

/// Draws the table.
pub(super) fn list(ui: &mut Ui, context: &mut ViewContext<'_>, photos: &PhotosState) {
    let tokens = context.tokens;
    let (_, unit) = context.units.length();
    ui.spacing_mut().item_spacing.y = 0.0;
    let titles = [
        "prob.".to_owned(),
        format!("± {unit}"),
        "hdg".to_owned(),
        format!("{unit} high"),
    ];
    table::heads(ui, tokens, &titles, |ui| {
        ui.label(RichText::new("photo").color(tokens.muted));
    });
    egui::ScrollArea::vertical()
        .id_salt("list of photos")
        .max_height(SEEN)
        .auto_shrink([false, true])
        .show_viewport(ui, |ui, seen| rows(ui, context, photos, seen));
    ui.spacing_mut().item_spacing.y = 0.75 * tokens.space;
    if photos.counts().0 > 0 {
        let words = "On the map the chosen photo has the bold outline; the heavy edge is the top of the picture.";
        ui.add(Label::new(muted(tokens, words)).wrap());
    }
}

/// Reason for which a photo was not laid, if it was not.
fn refusal(photos: &PhotosState, number: usize) -> Option<&str> {
    let report = photos.reports[number].as_ref()?;
    report.answer.laid.as_ref().err().map(String::as_str)
}

/// Height of the line with that reason, points.
fn reason_height(tokens: &Tokens) -> f32 {
    1.5 * tokens.text_sizes[0]
}

/// Draws the rows of the part of the list that is seen, and one more at either end to which the keyboard can go: of
/// thousands of photos no more are laid out.
fn rows(ui: &mut Ui, context: &mut ViewContext<'_>, photos: &PhotosState, seen: Rect) {
    let tokens = context.tokens;
    let (plain, reason) = (table::height(tokens), reason_height(tokens));
    let height = |number: usize| {
        let is_refused = refusal(photos, number).is_some();
        plain + if is_refused { reason } else { 0.0 }
    };
    let count = photos.reports.len();
    let mut top = 0.0;
    let mut first = 0;
    while first < count && top + height(first) <= seen.top() {
        top += height(first);
        first += 1;
    }
    let mut bottom = top;
    let mut end = first;
    while end < count && bottom < seen.bottom() {
        bottom += height(end);
        end += 1;
    }
    if end < count {
        bottom += height(end);
        end += 1;
    }
    if first > 0 {
        first -= 1;
        top -= height(first);
    }
    let whole = bottom + (end..count).map(height).sum::<f32>();
    let area = ui.max_rect();
    ui.set_height(whole);
    let shown = Rect::from_x_y_ranges(area.x_range(), area.top() + top..=area.top() + bottom);
    ui.scope_builder(UiBuilder::new().max_rect(shown), |ui| {
        ui.skip_ahead_auto_ids(first);
        for number in first..end {
            row(ui, context, photos, number);
        }
    });
}

/// Numbers of a row: four of them.
fn cells(report: Option<&PhotoReport>, units: Units) -> [String; 4] {
    let (length, _) = units.length();
    let none = || "–".to_owned();
    let Some(report) = report else {
        return ["…".to_owned(), none(), none(), none()];
    };
    let probability = probability_words(report.answer.probability);
    match &report.answer.laid {
        Ok(laid) => [
            probability,
            format!("{:.1}", length * laid.centre_deviation()),
            heading(laid.camera.attitude.yaw),
            parts::figures(length * laid.height()),
        ],
        Err(_) => [probability, none(), none(), none()],
    }
}

/// A heading, clockwise from north.
fn heading(radians: f64) -> String {
    format!("{}°", direction(radians, 0))
}

fn row(ui: &mut Ui, context: &mut ViewContext<'_>, photos: &PhotosState, number: usize) {
    let tokens = context.tokens;
    let report = photos.reports[number].as_ref();
    let refused = refusal(photos, number);
    let cells = cells(report, context.units);
    let name = photos.name(number);
    let is_chosen = photos.chosen == Some(number);
    let top = ui.cursor().top();
    let back = ui.painter().add(egui::Shape::Noop);
    let area = ui.scope(|ui| {
        let colour = if refused.is_some() {
            tokens.muted
        } else {
            tokens.text
        };
        table::row(ui, tokens, &cells, colour, |ui| {
            mark(ui, tokens, report);
            ui.add(
                Label::new(RichText::new(name).color(tokens.text))
                    .truncate()
                    .selectable(false),
            );
        });
        if let Some(why) = refused {
            // All of it stands below the list once the photo is chosen.
            let size = vec2(ui.available_width(), reason_height(tokens));
            let (mut line, _) = ui.allocate_exact_size(size, Sense::hover());
            line.set_left(line.left() + 2.0 * tokens.space);
            let left_to_right = Layout::left_to_right(Align::Center);
            let builder = UiBuilder::new().max_rect(line).layout(left_to_right);
            ui.scope_builder(builder, |ui| {
                let text = RichText::new(why).size(tokens.text_sizes[0]);
                let text = text.color(tokens.warning);
                ui.add(Label::new(text).truncate().selectable(false));
            });
        }
    });
    let mut rect = area.response.rect;
    rect.set_top(top);
    let id = ui.scope_id().with(("photo", number));
    let response = ui.interact(rect, id, Sense::click());
    let what = match refused {
        None => format!("{name}: {}", cells.join(" ")),
        Some(why) => format!("{name}: not laid: {why}"),
    };
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, is_chosen, &what));
    if response.gained_focus() {
        response.scroll_to_me(None);
    }
    let fill = match (is_chosen, response.hovered() || response.has_focus()) {
        (true, _) => tokens.accent.gamma_multiply(0.22),
        (false, true) => tokens.hover(),
        (false, false) => Color32::TRANSPARENT,
    };
    ui.painter()
        .set(back, egui::Shape::rect_filled(rect, tokens.radius, fill));
    if response.has_focus() {
        let stroke = Stroke::new(1.5, tokens.accent);
        ui.painter()
            .rect_stroke(rect, tokens.radius, stroke, StrokeKind::Inside);
    }
    if response.clicked() {
        send(context, Do::Choose(number));
    }
}

/// Draws a coloured sign that tells whether the photo was laid.
fn mark(ui: &mut Ui, tokens: &Tokens, report: Option<&PhotoReport>) {
    let (rect, _) = ui.allocate_exact_size(vec2(12.0, 12.0), Sense::hover());
    let painter = ui.painter();
    let middle = rect.center();
    match report.map(|r| r.answer.laid.is_ok()) {
        Some(true) => {
            let line = Stroke::new(2.0, tokens.truth);
            let corner = pos2(middle.x - 1.0, middle.y + 3.5);
            painter.line_segment([pos2(middle.x - 4.5, middle.y), corner], line);
            painter.line_segment([corner, pos2(middle.x + 4.5, middle.y - 3.5)], line);
        }
        Some(false) => parts::cross(painter, middle, 3.5, Stroke::new(2.0, tokens.warning)),
        None => {
            let font = parts::small(tokens);
            painter.text(middle, Align2::CENTER_CENTER, "·", font, tokens.muted);
        }
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;
    use pilotage_core::frames::{GroundPoint, GroundRect};
    use pilotage_jobs::MapSource;

    use super::super::state::Sought;
    use super::*;
    use crate::views::fixture::Fixture;

    /// A thousand photos that are not laid yet.
    fn a_thousand() -> PhotosState {
        let mut photos = PhotosState::default();
        photos.sought = Some(Sought {
            key: "opened-1".to_owned(),
            names: (0..1000).map(|i| format!("photo {i}.jpg")).collect(),
            map: MapSource::Nothing,
            origin: None,
            ground: GroundRect::centered(GroundPoint::default(), 100.0, 100.0),
        });
        photos.reports.resize(1000, None);
        photos
    }

    /// The list of a thousand photos, as it is first drawn.
    fn list_of_a_thousand() -> Harness<'static> {
        let (photos, fixture) = (a_thousand(), Fixture::lasting(2.0));
        let draw = move |ui: &mut Ui| {
            let mut commands = Vec::new();
            let mut context = fixture.context(1.0, &mut commands);
            list(ui, &mut context, &photos);
        };
        let mut harness = Harness::builder().with_size([360.0, 500.0]).build_ui(draw);
        harness.run();
        harness
    }

    /// Whether the keyboard is on the row of a photo.
    fn is_focused(harness: &Harness<'_>, number: usize) -> bool {
        let name = format!("photo {number}.jpg:");
        let row = harness.query_by(|node| {
            let label = node.label();
            node.is_focused() && label.is_some_and(|it| it.starts_with(&name))
        });
        row.is_some()
    }

    #[test]
    fn every_row_is_reached_by_the_keyboard_forth_and_back() {
        let mut harness = list_of_a_thousand();
        harness.get_by_label_contains("photo 0.jpg:").focus();
        harness.run();
        for number in 1..30 {
            harness.key_press(egui::Key::Tab);
            harness.run();
            assert!(is_focused(&harness, number), "{number}");
        }
        for number in (0..29).rev() {
            harness.key_press_modifiers(egui::Modifiers::SHIFT, egui::Key::Tab);
            harness.run();
            assert!(is_focused(&harness, number), "{number}");
        }
    }

    #[test]
    fn of_a_thousand_photos_only_those_that_are_seen_are_laid_out() {
        let harness = list_of_a_thousand();
        let is_row = |node: &egui_kittest::kittest::AccessKitNode<'_>| {
            let label = node.label();
            node.role() == Role::Button && label.is_some_and(|it| it.starts_with("photo "))
        };
        let count = harness.query_all_by(is_row).count();
        assert!((3..40).contains(&count), "{count}");
    }

    #[test]
    fn a_heading_is_told_clockwise_from_north() {
        assert_eq!(heading(-0.5), "331°");
    }
}
