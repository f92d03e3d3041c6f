//! Results of the photos, a row each.

use egui::{Align2, Color32, Label, RichText, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};
use egui::{pos2, vec2};
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
        .show(ui, |ui| {
            for number in 0..photos.reports.len() {
                row(ui, context, photos, number);
            }
        });
    ui.spacing_mut().item_spacing.y = 0.75 * tokens.space;
    if photos.counts().0 > 0 {
        let words = "On the map the chosen photo has the bold outline; the heavy edge is the top of the picture.";
        ui.add(Label::new(muted(tokens, words)).wrap());
    }
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
    let refused = report.and_then(|r| r.answer.laid.as_ref().err());
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
            ui.indent(("why not", number), |ui| {
                let text = RichText::new(why).size(tokens.text_sizes[0]);
                ui.add(
                    Label::new(text.color(tokens.warning))
                        .wrap()
                        .selectable(false),
                );
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
    use super::*;

    #[test]
    fn a_heading_is_told_clockwise_from_north() {
        assert_eq!(heading(-0.5), "331°");
    }
}
