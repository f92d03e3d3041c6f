//! Landmarks while planning: the table of all, and the selected one with how well it is found.

use egui::{Align2, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, vec2};
use pilotage_core::landmark::Landmark;

use super::PlanCommand;
use super::button::button;
use super::planner::Planner;
use super::purpose::Purpose;
use super::tallies;
use super::train_command::TrainCommand;
use super::verdict::LandmarkVerdict;
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{caption, chip, icon_button, icons::Icon, muted, text_button};
use crate::units::Units;
use crate::views::ellipse::largest_sigma;
use pilotage_jobs::MeasuredLandmark;

/// Height of the table before it scrolls, points: what is selected stays in sight below it.
const TABLE_HEIGHT: f32 = 196.0;

/// Draws the tab.
pub fn landmarks_tab(
    ui: &mut Ui,
    planner: &mut Planner,
    documents: &Documents,
    context: &mut ViewContext<'_>,
) {
    let tokens = context.tokens;
    let mission = context.mission;
    ui.horizontal(|ui| {
        draw_menu(ui, planner, context);
        if let Some((done, of)) = planner.assessments.batch() {
            if icon_button(ui, tokens, Icon::Close, "Stop testing").clicked() {
                let stop = PlanCommand::StopAssessing;
                context.commands.push(Command::from(stop));
            }
            let words = planner.assessments.under_way().map_or("", |(_, _, w)| w);
            let text = if of > 1 {
                format!("{} of {of} · {words}", done + 1)
            } else {
                words.to_owned()
            };
            ui.add(egui::Label::new(muted(tokens, text)).truncate());
        } else if mission.landmarks.iter().any(|l| l.enabled) {
            button(ui, context, None, "Test all", false, PlanCommand::AssessAll);
            let all = PlanCommand::Train(TrainCommand::All);
            button(ui, context, None, "Train all", false, all);
        }
    });
    let mut ahead = planner.preferences.tests_ahead;
    let hint = "Looks for each landmark on other days while nothing else is to be computed: what is selected first, \
                then what is in view";
    let tests = ui.checkbox(&mut ahead, "Test landmarks automatically");
    if tests.on_hover_text(hint).changed() {
        let command = PlanCommand::TestAhead(ahead);
        context.commands.push(Command::from(command));
    }
    planner.trainings_card(ui, documents, context);
    planner.suggestions_card(ui, context);
    if mission.landmarks.is_empty() {
        ui.label(muted(
            tokens,
            tokens.advice(
                "None yet. Press N and draw a box around something that stands out on the map: a lone \
                 building, a crossing, a pool. Shift+N marks an outline instead. Or open a file with some.",
                "None yet. Press Draw and draw a box around something that stands out on the map: a lone \
                 building, a crossing, a pool. Or open a file with some.",
            ),
        ));
        return;
    }
    let alone = context.selection.is_none() && planner.marked(None).is_empty();
    let height = if alone { f32::INFINITY } else { TABLE_HEIGHT };
    egui::ScrollArea::vertical()
        .id_salt("landmarks")
        .max_height(height)
        .auto_shrink([false, true])
        .show(ui, |ui| {
            planner.table.show(ui, &planner.assessments, context);
        });
    ui.add_space(tokens.space);
    let marked = planner.marked(context.selection);
    if marked.len() > 1 {
        planner.editor.several(ui, &marked, context);
        ui.add_space(tokens.space);
        planner.detectors(ui, &marked, documents, context);
        ui.add_space(tokens.space);
    } else if let Some(landmark) = context.selection.and_then(|id| mission.landmark(id)) {
        actions(ui, planner, landmark, context);
        ui.add_space(tokens.space);
        planner.detectors(ui, &[landmark.id], documents, context);
        ui.add_space(tokens.space);
        card(ui, planner, landmark, context);
        ui.add_space(tokens.space);
        let examined = planner.examination.of(landmark.id, documents);
        planner.list.selected(ui, landmark, context, examined);
        ui.add_space(tokens.space);
        planner.editor.one(ui, landmark, context);
    }
}

/// The ways to draw a landmark.
fn draw_menu(ui: &mut Ui, planner: &Planner, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let button = text_button(ui, tokens, Some(Icon::Pick), "Draw", false);
    egui::Popup::menu(&button).show(|ui| {
        ui.set_min_width(200.0);
        let under_way = planner.marking.as_ref().map(|m| m.purpose);
        for (label, command, on) in [
            ("Box  (N)", Command::TogglePickTool, false),
            (
                "Outline  (Shift+N)",
                Command::from(PlanCommand::Mark(Purpose::Outline)),
                under_way == Some(Purpose::Outline),
            ),
            (
                "Point",
                Command::from(PlanCommand::Mark(Purpose::Point)),
                under_way == Some(Purpose::Point),
            ),
        ] {
            let choice = ui.selectable_label(on, label);
            if choice.clicked() {
                context.commands.push(command);
                ui.close();
            }
        }
    });
}

/// Draws the actions on the selected landmark.
fn actions(ui: &mut Ui, planner: &Planner, landmark: &Landmark, context: &mut ViewContext<'_>) {
    ui.horizontal_wrapped(|ui| {
        let is_tested = planner.assessments.of(landmark).is_some();
        let label = if is_tested {
            "Test again"
        } else {
            "Test how well it is found"
        };
        let mut under_way = planner.assessments.under_way().into_iter();
        if under_way.all(|(of, ..)| of != landmark.id) {
            let test = PlanCommand::AssessSelected;
            button(ui, context, None, label, !is_tested, test);
        }
        let survey = PlanCommand::SurveyEnvelope;
        button(ui, context, None, "Best altitude", false, survey);
        let copy = PlanCommand::DuplicateLandmark;
        button(ui, context, None, "Duplicate", false, copy);
    });
}

/// Draws the detection statistics of the selected landmark.
fn card(ui: &mut Ui, planner: &Planner, landmark: &Landmark, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    caption(ui, tokens, "How well it is found");
    let under_way = planner.assessments.under_way();
    if let Some((_, fraction, words)) = under_way.filter(|(id, ..)| *id == landmark.id) {
        let bar = egui::ProgressBar::new(fraction).desired_height(4.0);
        ui.add(bar).accessible_name("How far the measurement is");
        ui.label(muted(tokens, words));
        return;
    }
    if let Some(measured) = planner.assessments.of(landmark) {
        result(ui, measured, context);
        ui.add_space(tokens.space);
        tallies::breakdown(ui, &measured.last.breakdown, context);
    } else if planner.assessments.is_misfit(landmark) {
        ui.label(muted(tokens, "Not tested: counted as never found."));
    } else {
        let untested = if planner.assessments.has_any(landmark) {
            "Tested, but not from this height with this camera and these settings"
        } else {
            "Not tested"
        };
        let words = format!("{untested}: counted like {}.", planner.untested.words());
        ui.label(muted(tokens, words));
    }
    let known = planner.assessments.of(landmark).is_some()
        || planner.assessments.envelope(landmark).is_some();
    if planner.assessments.surveyed() == Some(landmark.id) {
        ui.add_space(tokens.space);
        ui.horizontal(|ui| {
            if icon_button(ui, tokens, Icon::Close, "Stop looking from other heights").clicked() {
                let stop = PlanCommand::StopAssessing;
                context.commands.push(Command::from(stop));
            }
            let bar = egui::ProgressBar::new(planner.assessments.survey_progress);
            ui.add(bar.desired_height(4.0))
                .accessible_name("How far the looks from other heights are");
        });
    }
    if let Some((height, envelope)) = planner.assessments.envelope(landmark) {
        ui.add_space(tokens.space);
        tallies::envelope(ui, envelope, height, context);
    }
    if known {
        tallies::legend(ui, tokens);
    }
    if let Some(why) = planner.assessments.trouble(landmark) {
        let text = egui::RichText::new(format!("It could not be measured: {why}"));
        ui.label(text.color(tokens.warning));
    }
}

fn result(ui: &mut Ui, measured: &MeasuredLandmark, context: &ViewContext<'_>) {
    let tokens = context.tokens;
    let found = &measured.last;
    let expected = &found.expected;
    let probability = expected.probability();
    let (factor, unit) = context.units.length();
    ui.horizontal_wrapped(|ui| {
        let verdict = LandmarkVerdict::of(found);
        let tone = match verdict {
            LandmarkVerdict::Good => tokens.truth,
            LandmarkVerdict::Usable => tokens.accent,
            LandmarkVerdict::Weak => tokens.warning,
        };
        chip(ui, tokens, verdict.word(), tone);
        let text = format!("found in {:.0} % of pictures", 100.0 * probability);
        chip(ui, tokens, &text, tone);
        let tone = if found.false_matches > 0.0 {
            tokens.warning
        } else {
            tokens.truth
        };
        let text = format!("wrong {:.0} %", 100.0 * found.false_matches);
        chip(ui, tokens, &text, tone);
        let place = expected.covariance.fixed_view::<2, 2>(0, 0).into_owned();
        let longer = largest_sigma(&place);
        let shorter = (place.trace() - longer * longer).max(0.0).sqrt();
        // Of the longer axis, from north.
        let angle = 0.5 * (2.0 * place[(0, 1)]).atan2(place[(0, 0)] - place[(1, 1)]);
        let text = format!(
            "place ±{:.2} {unit} towards {:.0}°, ±{:.2} {unit} across",
            longer * factor,
            angle.to_degrees().rem_euclid(180.0),
            shorter * factor
        );
        // A place that was never found has no error.
        if longer > 0.0 {
            chip(ui, tokens, &text, tokens.muted);
        }
    });
    ui.label(egui::RichText::new(sentence(measured, context.units)).color(tokens.text));
    rose(ui, measured, context);
}

fn sentence(measured: &MeasuredLandmark, units: Units) -> String {
    let found = &measured.last;
    let days = 1 + found.views.iter().map(|v| v.day).max().unwrap_or(0);
    let good = |day| found.views.iter().any(|v| v.day == day && v.found);
    let recognised = (0..days).filter(|d| good(*d)).count();
    let hits = found.views.iter().filter(|v| v.found).count();
    let (factor, unit) = units.length();
    format!(
        "Recognised on {recognised} of {days} other days, found in {hits} of {} views from {:.0} {unit}.",
        found.views.len(),
        found.height * factor
    )
}

/// Every view: its angle is the camera's heading, its distance from the middle how far from the
/// picture's middle the landmark lay.
fn rose(ui: &mut Ui, measured: &MeasuredLandmark, context: &ViewContext<'_>) {
    let tokens = context.tokens;
    let size = vec2(ui.available_width(), 148.0);
    let (outer, response) = ui.allocate_exact_size(size, Sense::hover());
    let name = "Views by heading of the camera and distance from the picture's middle";
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, name));
    let painter = ui.painter();
    let rect = Rect::from_min_size(outer.min, vec2(outer.height(), outer.height()));
    let (middle, radius) = (rect.center(), 0.5 * rect.height() - 14.0);
    let line = Stroke::new(1.0, tokens.line);
    for share in [0.5, 1.0] {
        painter.circle_stroke(middle, share * radius, line);
    }
    for (angle, text) in [(0.0_f32, "N"), (90.0, "E"), (180.0, "S"), (270.0, "W")] {
        let (sin, cos) = angle.to_radians().sin_cos();
        let at = middle + (radius + 8.0) * vec2(sin, -cos);
        painter.text(
            at,
            Align2::CENTER_CENTER,
            text,
            tokens.small(),
            tokens.muted,
        );
    }
    let views = &measured.last.views;
    let farthest = views.iter().map(|v| v.off_centre).fold(1.0, f64::max);
    for view in views {
        let far = radius * (view.off_centre / farthest) as f32;
        let (sin, cos) = (view.heading as f32).sin_cos();
        let at = middle + far * vec2(sin, -cos);
        mark(painter, at, view.found, view.wrong, tokens);
    }
    let mut at = Pos2::new(rect.right() + 16.0, rect.top() + 20.0);
    for (found, wrong, text) in [
        (true, false, "found"),
        (false, false, "not found"),
        (false, true, "a wrong place believed"),
    ] {
        mark(painter, at, found, wrong, tokens);
        let place = at + vec2(12.0, 0.0);
        painter.text(
            place,
            Align2::LEFT_CENTER,
            text,
            tokens.small(),
            tokens.text,
        );
        at.y += 18.0;
    }
    for text in [
        "Angle: heading of the camera.".to_owned(),
        "From the middle: off the".to_owned(),
        format!("picture's middle, rim {farthest:.0} px."),
    ] {
        painter.text(at, Align2::LEFT_CENTER, text, tokens.small(), tokens.muted);
        at.y += 15.0;
    }
}

fn mark(
    painter: &egui::Painter,
    at: Pos2,
    found: bool,
    wrong: bool,
    tokens: &crate::tokens::Tokens,
) {
    if wrong {
        let stroke = Stroke::new(2.0, tokens.warning);
        painter.line_segment([at - vec2(4.0, 4.0), at + vec2(4.0, 4.0)], stroke);
        painter.line_segment([at + vec2(-4.0, 4.0), at + vec2(4.0, -4.0)], stroke);
    } else if found {
        painter.circle_filled(at, 4.0, tokens.observed);
    } else {
        painter.circle_stroke(at, 3.5, Stroke::new(1.5, tokens.muted));
    }
}
