//! The form in which a study is chosen, and its plan as text.

use egui::{Id, Label, RichText, TextEdit, Ui};
use pilotage_core::text::capitalised;
use pilotage_study::{SHIPPED_PLANS, StopRule, StudyMeasure, StudyPlan, question_of};

use super::command::StudyCommand;
use super::draft::{DRAWS, StudyDraft, plan_of_routes, with_draws};
use crate::context::ViewContext;
use crate::shell::icons::Icon;
use crate::shell::{NumberField, caption, counted, muted, text_button};
use crate::views::parts;

/// Wall-clock time per second of flight before any study was flown, milliseconds of all workers together.
pub const USUAL_PACE: f64 = 1.0;

/// A time that people wait, in words.
pub fn wait(milliseconds: f64) -> String {
    let seconds = 1e-3 * milliseconds;
    if seconds < 90.0 {
        format!("{:.0} s", seconds.ceil().max(1.0))
    } else {
        format!("{:.0} min", (seconds / 60.0).ceil())
    }
}

/// Draws the form. `pace` is the time per second of flight, milliseconds.
pub(super) fn form(ui: &mut Ui, context: &mut ViewContext<'_>, draft: &mut StudyDraft, pace: f64) {
    let tokens = context.tokens;
    caption(ui, tokens, "Question");
    for (number, question) in questions().enumerate() {
        let is_chosen = draft.chosen() == Some(number);
        let text = RichText::new(question);
        if ui.radio(is_chosen, text).clicked() && !is_chosen {
            draft.choose(number);
        }
    }
    let is_routes = own_routes(ui, context, draft);
    if draft.chosen().is_none() && !is_routes {
        let _ = ui.radio(true, "Your own plan, below");
    }
    flights(ui, context, draft);
    parts::section(ui, tokens, "The plan as text (TOML)", false, |ui| {
        plan_text(ui, context, draft);
    });
    for note in draft.notes() {
        let text = format!("{}.", capitalised(note));
        ui.add(Label::new(muted(tokens, text)).wrap());
    }
    if let Some(why) = draft.refusal() {
        let text = RichText::new(why).color(tokens.warning);
        ui.add(Label::new(text).wrap());
    }
    start(ui, context, draft, pace);
}

/// Draws the question about the routes of the mission, if it has any; whether it is chosen.
fn own_routes(ui: &mut Ui, context: &mut ViewContext<'_>, draft: &mut StudyDraft) -> bool {
    let Some(text) = plan_of_routes(context.mission) else {
        return false;
    };
    let words = match context.mission.routes.len() {
        1 => "How well is the place known along my route, in any wind up to 8 m/s?",
        _ => "Along which of my routes is the place known best, in any wind up to 8 m/s?",
    };
    let is_chosen = draft.chosen().is_none() && with_draws(draft.text(), 0) == with_draws(&text, 0);
    if ui.radio(is_chosen, words).clicked() && !is_chosen {
        draft.write(text);
    }
    is_chosen
}

/// Draws how often each setting is flown.
fn flights(ui: &mut Ui, context: &mut ViewContext<'_>, draft: &mut StudyDraft) {
    let tokens = context.tokens;
    let counts = draft.plan().map(|plan| (plan.cells(), plan.draws));
    ui.horizontal_wrapped(|ui| {
        let label = ui.label("Flights of each setting");
        let Some((cells, draws)) = counts else {
            ui.label(muted(tokens, "once the plan is read"));
            return;
        };
        let mut count = draws;
        let range = *DRAWS.start()..=(*DRAWS.end()).max(draws);
        let field = NumberField::whole(range).speed(1.0).show(ui, &mut count);
        if field.labelled_by(label.id).changed() {
            draft.set_draws(count);
        }
        let settings = if cells == 1 {
            "1 setting".to_owned()
        } else {
            format!("{cells} settings")
        };
        ui.label(muted(tokens, format!("× {settings}")));
    });
}

fn plan_text(ui: &mut Ui, context: &mut ViewContext<'_>, draft: &mut StudyDraft) {
    let tokens = context.tokens;
    let words = "What is crossed is compared; what is drawn is new in each flight. Change it, or paste a plan of yours.";
    ui.add(Label::new(muted(tokens, words)).wrap());
    let mut text = draft.text().to_owned();
    // What stands above it comes and goes while people write.
    let field = TextEdit::multiline(&mut text)
        .id(Id::unique("plan of the study"))
        .desired_rows(12)
        .desired_width(f32::INFINITY)
        .font(tokens.small());
    if ui.add(field).accessible_name("Plan of the study").changed() {
        draft.write(text);
    }
}

fn start(ui: &mut Ui, context: &mut ViewContext<'_>, draft: &StudyDraft, pace: f64) {
    let tokens = context.tokens;
    let is_fine = draft.ready().is_some() && draft.refusal().is_none();
    ui.horizontal_wrapped(|ui| {
        let flights = draft.plan().map_or(0, StudyPlan::runs);
        ui.add_enabled_ui(is_fine, |ui| {
            let label = if is_fine {
                format!("Fly {}", counted(flights as usize, "flight", "flights"))
            } else {
                "Fly".to_owned()
            };
            if text_button(ui, tokens, Some(Icon::Play), &label, true).clicked() {
                context.commands.push(StudyCommand::Start.into());
            }
        });
        if is_fine {
            let words = format!("about {}", wait(pace * draft.flown_seconds()));
            ui.label(muted(tokens, words));
        }
        if draft.ready().is_some() && text_button(ui, tokens, None, "Save plan", false).clicked() {
            context.commands.push(StudyCommand::SavePlan.into());
        }
    });
    if let Some(plan) = draft.plan()
        && let Some(stop) = &plan.stop
    {
        let words = stop_words(stop, &plan.measure);
        ui.add(Label::new(muted(tokens, words)).wrap());
    }
    let name = draft.plan().map_or("PLAN", |plan| plan.name.as_str());
    let words = format!(
        "More flights, on all cores or a cluster: save the plan, and on the terminal: pilotage study {name}.toml"
    );
    ui.add(Label::new(muted(tokens, words)).wrap());
}

/// The rule of a plan to stop early, in words.
fn stop_words(stop: &StopRule, measures: &[StudyMeasure]) -> String {
    let measure = measures.iter().find(|own| own.name() == stop.measure);
    let unit = measure.map_or("", StudyMeasure::unit);
    let space = if unit.is_empty() { "" } else { " " };
    format!(
        "Ends early, once the 95 % interval of \"{}\" is no wider than {}{space}{unit}; looked at every {} draws.",
        stop.measure,
        2.0 * stop.half_width,
        stop.every
    )
}

/// Questions of the plans that come with the program.
fn questions() -> impl Iterator<Item = &'static str> {
    let questions = SHIPPED_PLANS.into_iter().map(question_of);
    questions.map(Option::unwrap_or_default)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_plan_that_comes_with_the_program_asks_a_question() {
        assert_eq!(questions().count(), SHIPPED_PLANS.len());
        assert!(questions().all(|question| question.ends_with('?')));
    }

    #[test]
    fn waits_are_told_in_whole_seconds_or_minutes() {
        assert_eq!(
            [wait(20.0), wait(11_200.0), wait(100_000.0)],
            ["1 s", "12 s", "2 min"]
        );
    }
}
