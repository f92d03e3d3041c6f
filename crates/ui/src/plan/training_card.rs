//! By which detector landmarks are looked for, and how the training of detectors goes.

use egui::{Align2, Label, ProgressBar, RichText, Role, Sense, Ui, WidgetInfo, vec2};
use pilotage_core::flight::Flight;
use pilotage_core::landmark::cascade::train::StageRow;
use pilotage_core::landmark::{DetectorChoice, Landmark};
use pilotage_core::training::{StageReport, TrainingPhase};

use super::PlanCommand;
use super::button::button;
use super::planner::Planner;
use super::train_command::TrainCommand;
use super::train_orders::labels_of;
use super::trainings::{Training, TrainingState, left_words};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::documents::landmarks::LandmarkChange;
use crate::shell::{NumberField, caption, icon_button, icons::Icon, muted, tab};
use crate::tokens::Tokens;
use pilotage_jobs::TrainingOutcome;

/// Height of the list of trainings before it scrolls, points.
const LIST_HEIGHT: f32 = 156.0;
/// Height of a row of the table of stages, points.
const ROW: f32 = 18.0;
/// Fewest and most photos that a detector learns from.
const PHOTOS: std::ops::RangeInclusive<usize> = 12..=1000;

fn say(command: TrainCommand) -> Command {
    Command::from(PlanCommand::Train(command))
}

impl Planner {
    /// Draws the trainings that are not done: how far each is, and what can be done with it.
    pub(super) fn trainings_card(
        &self,
        ui: &mut Ui,
        documents: &Documents,
        context: &mut ViewContext<'_>,
    ) {
        let tokens = context.tokens;
        let all: Vec<&Training> = self.trainings.unfinished(documents).collect();
        if all.is_empty() {
            return;
        }
        ui.horizontal(|ui| {
            caption(ui, tokens, "Training of detectors");
            if all.len() < 2 {
                return;
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = 0.0;
                let is_paused = |t: &&&Training| t.state() == TrainingState::Paused;
                let paused = all.iter().filter(is_paused).count();
                let mut offers = vec![(
                    Icon::Close,
                    "Cancel all trainings",
                    TrainCommand::Cancel(None),
                )];
                if paused < all.len() {
                    offers.push((
                        Icon::Pause,
                        "Pause all trainings",
                        TrainCommand::Pause(None),
                    ));
                }
                if paused > 0 {
                    offers.push((
                        Icon::Play,
                        "Resume all trainings",
                        TrainCommand::Resume(None),
                    ));
                }
                for (icon, label, command) in offers {
                    if icon_button(ui, tokens, icon, label).clicked() {
                        context.commands.push(say(command));
                    }
                }
            });
        });
        egui::ScrollArea::vertical()
            .id_salt("trainings")
            .max_height(LIST_HEIGHT)
            .auto_shrink([false, true])
            .show(ui, |ui| {
                for training in all {
                    row(ui, training, context);
                }
            });
        ui.add_space(tokens.space);
    }

    /// Draws by which detector landmarks are looked for; of one, how its training goes or went.
    pub(super) fn detectors(
        &self,
        ui: &mut Ui,
        ids: &[u32],
        documents: &Documents,
        context: &mut ViewContext<'_>,
    ) {
        let tokens = context.tokens;
        let mission = context.mission;
        let landmarks: Vec<&Landmark> = ids.iter().filter_map(|id| mission.landmark(*id)).collect();
        let Some(first) = landmarks.first() else {
            return;
        };
        caption(ui, tokens, "Detector");
        let choice = first.detector_choice();
        let common = landmarks.iter().all(|l| l.detector_choice() == choice);
        choices(ui, ids, common.then_some(choice), context);
        let trained = landmarks.iter().filter(|l| l.is_trained()).count();
        let training = self.trainings.of(first, documents);
        let training = training.filter(|_| landmarks.len() == 1);
        let outcome = self.trainings.outcome(first, documents);
        let outcome = outcome.filter(|_| landmarks.len() == 1);
        words(ui, &landmarks, trained, outcome, context);
        let under_way = training.filter(|t| t.outcome.is_none() && t.trouble.is_none());
        if let Some(training) = under_way {
            let text = format!("Its training: {}.", phase_words(training).to_lowercase());
            ui.label(muted(tokens, text));
        } else {
            self.offer(ui, landmarks.len(), trained, context);
            labelled_words(ui, &landmarks, context);
        }
        if let Some(why) = training.and_then(|t| t.trouble.as_ref()) {
            let text = RichText::new(format!("No detector came of the training: {why}"));
            ui.label(text.color(tokens.warning));
        }
        let shown = under_way.or(training.filter(|_| outcome.is_some()));
        if let Some(training) = shown {
            stages(ui, training, tokens);
        }
    }

    fn offer(&self, ui: &mut Ui, count: usize, trained: usize, context: &mut ViewContext<'_>) {
        ui.horizontal(|ui| {
            let label = match (count, trained) {
                (1, 0) => "Train detector".to_owned(),
                (1, _) => "Train it again".to_owned(),
                (count, _) => format!("Train {count} detectors"),
            };
            let command = PlanCommand::Train(TrainCommand::Selected);
            button(ui, context, None, &label, false, command);
            let mut photos = self.preferences.photos;
            let field = NumberField::whole(PHOTOS).speed(1.0).suffix(" photos");
            let field = field.show(ui, &mut photos);
            if field.accessible_name("Photos to learn from").changed() {
                context.commands.push(say(TrainCommand::Photos(photos)));
            }
        });
    }
}

/// Draws the number of labelled frames that will be learned from as well, if any.
fn labelled_words(ui: &mut Ui, landmarks: &[&Landmark], context: &ViewContext<'_>) {
    let Some(flight) = context.flight.map(Flight::identity) else {
        return;
    };
    let count = |of: &&Landmark| labels_of(of, &flight, context.mission).count();
    let text = match landmarks.iter().map(count).sum() {
        0 => return,
        1 => "And from 1 labelled frame.".to_owned(),
        count => format!("And from {count} labelled frames."),
    };
    ui.label(muted(context.tokens, text));
}

/// The three ways to look for a landmark.
fn choices(
    ui: &mut Ui,
    ids: &[u32],
    chosen: Option<DetectorChoice>,
    context: &mut ViewContext<'_>,
) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        for choice in DetectorChoice::ALL {
            let label = match choice {
                DetectorChoice::Template => "Template",
                DetectorChoice::Cascade => "Cascade",
                DetectorChoice::Both => "Both",
            };
            let is_chosen = chosen == Some(choice);
            if tab(ui, context.tokens, label, is_chosen, 30.0).clicked() && !is_chosen {
                let command = PlanCommand::EditLandmarks {
                    ids: ids.to_vec(),
                    change: LandmarkChange::Detector(choice),
                    finished: true,
                };
                context.commands.push(Command::from(command));
            }
        }
    });
}

/// Draws the state of the trained detectors, in words.
fn words(
    ui: &mut Ui,
    landmarks: &[&Landmark],
    trained: usize,
    outcome: Option<&TrainingOutcome>,
    context: &ViewContext<'_>,
) {
    let tokens = context.tokens;
    let wants = landmarks
        .iter()
        .filter(|l| l.detector_choice() != DetectorChoice::Template)
        .any(|l| !l.is_trained());
    if wants {
        let text = "Not trained yet: until then it is looked for by its map patch.";
        ui.label(
            RichText::new(text)
                .font(tokens.small())
                .color(tokens.warning),
        );
    } else if let Some(outcome) = outcome {
        ui.label(RichText::new(outcome_words(outcome, context)).font(tokens.small()));
        unused_words(ui, landmarks, context);
    } else if trained == 0 {
        let text = "Looked for by its map patch. A cascade is trained from the map alone.";
        ui.label(muted(tokens, text));
    } else if landmarks.len() > 1 {
        let text = format!("{trained} of {} are trained.", landmarks.len());
        ui.label(muted(tokens, text));
    } else {
        ui.label(muted(tokens, "A cascade was trained for it."));
        unused_words(ui, landmarks, context);
    }
}

/// Draws that a trained detector is not flown with, where the landmark is looked for by its map patch.
fn unused_words(ui: &mut Ui, landmarks: &[&Landmark], context: &ViewContext<'_>) {
    let is_unused = |l: &&Landmark| l.detector_choice() == DetectorChoice::Template;
    if landmarks.iter().all(is_unused) {
        let text =
            "Flights do not use it yet: they look for the map patch. Choose Cascade or Both.";
        ui.label(muted(context.tokens, text));
    }
}

/// Results of a trained detector on photos that it did not learn from, in words.
fn outcome_words(outcome: &TrainingOutcome, context: &ViewContext<'_>) -> String {
    let (factor, unit) = context.units.length();
    let [north, east] = outcome.sigmas.map(|s| s * factor);
    let alarms = match outcome.false_alarms {
        1 => "1 false alarm".to_owned(),
        count => format!("{count} false alarms"),
    };
    format!(
        "Found in {} of {} photos that it did not learn from ({:.0}\u{a0}%), {alarms}. It counts as found where its \
         score is {:.2} or more. Its place is known to ±{north:.2}\u{a0}{unit} north and ±{east:.2}\u{a0}{unit} east (1σ).",
        outcome.found,
        outcome.judged,
        100.0 * outcome.found as f64 / outcome.judged.max(1) as f64,
        outcome.least_score,
    )
}

/// Present activity of a training, in words.
fn phase_words(training: &Training) -> String {
    let stage = training.stages().len() + 1;
    match (training.state(), &training.report) {
        (TrainingState::Paused, _) => left_words(training.order.left.as_ref()),
        (TrainingState::Failed, _) => "No detector came of it".to_owned(),
        (TrainingState::Waiting, _) => "Waiting for its turn".to_owned(),
        (_, None) => training.words.clone(),
        (_, Some(report)) => match report.phase {
            TrainingPhase::Photos => "Taking photos".to_owned(),
            TrainingPhase::Mining => format!("Searching for stage {stage}"),
            TrainingPhase::Voting => format!("Growing stage {stage}"),
            TrainingPhase::Judging | TrainingPhase::Done => "Judging on other days".to_owned(),
        },
    }
}

/// Draws the row of a training: its landmark, its activity, the time that it worked, its progress.
fn row(ui: &mut Ui, training: &Training, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let landmark = &training.order.landmark;
    let (id, name) = (landmark.id, landmark.name.as_str());
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let label = format!("Cancel the training of {name}");
            if icon_button(ui, tokens, Icon::Close, &label).clicked() {
                context.commands.push(say(TrainCommand::Cancel(Some(id))));
            }
            let offer = match training.state() {
                TrainingState::Paused => {
                    Some((Icon::Play, "Resume", TrainCommand::Resume(Some(id))))
                }
                TrainingState::Waiting | TrainingState::Working => {
                    Some((Icon::Pause, "Pause", TrainCommand::Pause(Some(id))))
                }
                TrainingState::Done | TrainingState::Failed => None,
            };
            if let Some((icon, verb, command)) = offer {
                let label = format!("{verb} the training of {name}");
                if icon_button(ui, tokens, icon, &label).clicked() {
                    context.commands.push(say(command));
                }
            }
            ui.add_space(tokens.space);
            let seconds = training.seconds();
            if seconds > 0.0 {
                ui.label(muted(tokens, format!("{seconds:.0}\u{a0}s")))
                    .on_hover_text("Work so far");
                ui.add_space(tokens.space);
            }
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = tokens.space;
                let title = Label::new(name).truncate().sense(Sense::click());
                if ui.add(title).clicked() {
                    context.commands.push(Command::SelectLandmark(Some(id)));
                }
                let text = muted(tokens, phase_words(training));
                ui.add(Label::new(text).truncate());
            });
        });
    });
    let fraction = training.report.as_ref().map_or(0.0, |r| r.fraction);
    let bar = ProgressBar::new(fraction).desired_height(4.0);
    ui.add(bar)
        .accessible_name(format!("How far the training of {name} is"));
}

/// The table of stages.
fn stages(ui: &mut Ui, training: &Training, tokens: &Tokens) {
    let whole = training.stages();
    let growing = training.report.as_ref().and_then(|r| r.growing);
    let growing = growing.filter(|row| row.votes > 0 && training.outcome.is_none());
    if whole.is_empty() && growing.is_none() {
        return;
    }
    ui.add_space(0.5 * tokens.space);
    let heads = ["Stage", "Features", "Hits", "False alarms", "Looked at"];
    let hint = "A detector asks stage after stage, each only about what the stages before let pass. Features: what the \
                stage measures. Hits: views of the landmark that it lets pass. False alarms: places that are something \
                else and that it lets pass, though it did not learn from them. Looked at: of all such places, those \
                that the stages before let pass to it.";
    cells(ui, &heads.map(str::to_owned), tokens.muted, tokens, None).on_hover_text(hint);
    for (number, stage) in whole.iter().enumerate() {
        let StageReport { row, passed_before } = stage;
        line(ui, number + 1, row, Some(*passed_before), tokens);
    }
    if let Some(row) = growing {
        line(ui, whole.len() + 1, &row, None, tokens);
    }
}

fn line(ui: &mut Ui, number: usize, row: &StageRow, before: Option<f64>, tokens: &Tokens) {
    let texts = [
        number.to_string(),
        row.votes.to_string(),
        percent(row.hit_rate),
        percent(row.false_alarm_rate),
        before.map_or_else(|| "grows …".to_owned(), percent),
    ];
    let name = format!(
        "Stage {number}: {} features, {} hits, {} false alarms, {}",
        texts[1],
        texts[2],
        texts[3],
        before.map_or_else(
            || "growing".to_owned(),
            |p| format!("{} looked at", percent(p))
        )
    );
    let color = if before.is_some() {
        tokens.text
    } else {
        tokens.accent
    };
    cells(ui, &texts, color, tokens, Some(name));
}

/// A share as percent, with as many digits as it takes.
fn percent(share: f64) -> String {
    let p = 100.0 * share;
    let digits = match p {
        p if p >= 99.95 || p == 0.0 => 0,
        p if p >= 10.0 => 1,
        p if p >= 1.0 => 2,
        p if p >= 0.01 => 3,
        _ => 5,
    };
    format!("{p:.digits$}\u{a0}%")
}

/// A row of five numbers, right-aligned.
fn cells(
    ui: &mut Ui,
    texts: &[String; 5],
    color: egui::Color32,
    tokens: &Tokens,
    name: Option<String>,
) -> egui::Response {
    let size = vec2(ui.available_width(), ROW);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    if let Some(name) = name {
        response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &name));
    }
    let painter = ui.painter_at(rect);
    for (text, share) in texts.iter().zip([0.12, 0.32, 0.52, 0.78, 1.0]) {
        let at = rect.left_center() + vec2(share * rect.width(), 0.0);
        painter.text(at, Align2::RIGHT_CENTER, text, tokens.small(), color);
    }
    response
}
