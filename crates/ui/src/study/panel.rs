//! The sheet of studies.

use egui::{Label, ProgressBar, RichText, ScrollArea, Ui};
use pilotage_jobs::FlightSource;

use super::command::StudyCommand;
use super::draft::StudyDraft;
use super::failed::{FailedOrder, failed};
use super::form::{USUAL_PACE, form, wait};
use super::grouping::StudyBy;
use super::outcome::StudyOutcome;
use super::results::{PlotChoice, results};
use super::under_way::StudyUnderWay;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::icons::Icon;
use crate::shell::{counted, heading, icon_button, muted, text_button, title};

/// State of the sheet.
#[derive(Default)]
pub struct StudySheet {
    /// The plan that is written down.
    pub draft: StudyDraft,
    /// Whether it was ever drawn, so that its plan is worth reading.
    pub was_drawn: bool,
    /// Whether results stand in the place of the form.
    is_form_away: bool,
    /// Plots that are shown.
    plotted: PlotChoice,
    order: FailedOrder,
    /// Outcome of the study, of that many flights and for those plots.
    outcome: Option<(u64, PlotChoice, StudyOutcome)>,
    /// Wall-clock time per second of flight, milliseconds, by the last study.
    pub pace: Option<f64>,
}

/// Run of the study that is open in Replay, if one is.
pub fn open_run(study: &StudyUnderWay, documents: &Documents) -> Option<u64> {
    let FlightSource::Studied(open) = &documents.flight.source else {
        return None;
    };
    let own = study.flight(open.run)?;
    (own == **open).then_some(open.run)
}

impl StudySheet {
    /// Lets go of what came of the study before: another one begins.
    pub fn forget(&mut self) {
        self.is_form_away = true;
        self.outcome = None;
        self.plotted.by = StudyBy::default();
    }

    /// Outcome of the study so far.
    pub fn outcome(&mut self, study: &StudyUnderWay) -> &StudyOutcome {
        let (flown, plotted) = (study.flown(), self.plotted);
        let kept = self.outcome.take();
        let kept = kept.filter(|(of, choice, _)| *of == flown && *choice == plotted);
        let made = || {
            let outcome = StudyOutcome::of(study, plotted.error, plotted.by);
            (flown, plotted, outcome)
        };
        &self.outcome.insert(kept.unwrap_or_else(made)).2
    }

    /// Draws the sheet.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        study: Option<&StudyUnderWay>,
        documents: &Documents,
    ) {
        self.was_drawn = true;
        let tokens = context.tokens;
        if title(ui, tokens, "Study") {
            context.commands.push(StudyCommand::Close.into());
        }
        ScrollArea::vertical()
            .id_salt("study")
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.75 * tokens.space;
                let is_under_way = study.is_some_and(StudyUnderWay::is_under_way);
                if !self.is_form_away {
                    let words = "Fly the same flight many times, change one thing, and see how the error follows. \
                                 Flights are without pictures: landmarks are found as often and as well as stated.";
                    ui.add(Label::new(muted(tokens, words)).wrap());
                    let pace = self.pace.unwrap_or(USUAL_PACE);
                    form(ui, context, &mut self.draft, pace);
                } else if !is_under_way
                    && text_button(ui, tokens, None, "Another study…", false).clicked()
                {
                    self.is_form_away = false;
                }
                if let Some(study) = study {
                    self.of(ui, context, study, documents);
                }
            });
    }

    fn of(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        study: &StudyUnderWay,
        documents: &Documents,
    ) {
        let tokens = context.tokens;
        if !self.is_form_away {
            ui.separator();
        }
        heading(ui, tokens, &study.plan().question);
        progress(ui, context, study);
        if let Some(trouble) = study.trouble() {
            let text = RichText::new(format!("The study stopped: {trouble}"));
            ui.add(Label::new(text.color(tokens.warning)).wrap());
        }
        if study.flown() == 0 {
            return;
        }
        let open = open_run(study, documents);
        let (mut plotted, mut order) = (self.plotted, self.order);
        let outcome = self.outcome(study);
        results(ui, context, study, outcome, &mut plotted);
        ui.add_space(tokens.space);
        failed(ui, context, outcome, &mut order, open);
        (self.plotted, self.order) = (plotted, order);
    }
}

fn progress(ui: &mut Ui, context: &mut ViewContext<'_>, study: &StudyUnderWay) {
    let tokens = context.tokens;
    let (flown, all) = (study.flown(), study.plan().runs());
    let of_all = counted(all as usize, "flight", "flights");
    if !study.is_under_way() {
        let words = match study.stopped_by_rule() {
            Some(draws) => format!(
                "Enough after {flown} of {of_all} ({draws} draws), by the plan's rule to stop."
            ),
            None if flown < all => format!("Stopped after {flown} of {of_all}."),
            None => format!("{of_all} flown."),
        };
        ui.label(muted(tokens, words));
        return;
    }
    ui.horizontal(|ui| {
        if icon_button(ui, tokens, Icon::Close, "Stop the study").clicked() {
            context.commands.push(StudyCommand::Stop.into());
        }
        ui.vertical(|ui| {
            let bar = ProgressBar::new(study.progress()).desired_height(4.0);
            ui.add(bar).accessible_name("How far the study is");
            let left = study
                .left()
                .map_or_else(String::new, |left| format!(", {} left", wait(left)));
            ui.label(muted(tokens, format!("{flown} of {of_all} flown{left}")));
        });
    });
}
