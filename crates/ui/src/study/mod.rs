//! Small studies in the page: the same flight flown many times with one thing changed, and its failures in Replay.

mod chart;
mod command;
mod draft;
mod failed;
mod form;
mod grouping;
mod outcome;
mod panel;
mod reading;
mod results;
mod stop_asked;
mod under_way;

use egui::Ui;
use pilotage_core::simulate::SimulationChoice;
use pilotage_jobs::{FlightSource, JobEvent, JobId, MapSource};
use pilotage_study::{MeasureKind, StudyPlan};
use serde_json::{Value, json};

use crate::command::{Command, Workspace};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::feature_command::STUDIES;
use crate::shell::CommandLack;
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry};

use draft::StudyDraft;
use grouping::StudyBy;
use outcome::StudyOutcome;
use panel::{StudySheet, open_run};
use reading::PlanReading;
use under_way::StudyUnderWay;

pub use command::StudyCommand;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: STUDIES,
    tab: "Study",
    place: FeaturePlace::Sheet,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    let of = |label, command: StudyCommand| {
        entry(CommandGroup::Document, label, Vec::new(), command.into())
    };
    vec![
        of("Fly a study: many flights…", StudyCommand::Show)
            .also("monte carlo simulate statistics sweep vary parameters sensitivity reliability nees experiment batch")
            .under(BarMenu::Open),
        of("Stop the study", StudyCommand::Stop).also("cancel monte carlo"),
    ]
}

/// Studies.
#[derive(Default)]
pub struct StudyFeature {
    sheet: StudySheet,
    study: Option<StudyUnderWay>,
    words: String,
    reading: PlanReading,
}

impl StudyFeature {
    fn start(&mut self, context: &mut FeatureContext<'_>) {
        if self.sheet.draft.refusal().is_some() {
            return;
        }
        let Some(plan) = self.sheet.draft.ready() else {
            return;
        };
        let plan = plan.clone();
        self.stop_study(context);
        self.sheet.forget();
        self.study = Some(StudyUnderWay::begin(plan, context));
        self.tell();
        context.show();
    }

    fn stop_study(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.study.as_mut().is_some_and(|study| study.stop(context))
    }

    /// Puts into words how far it is.
    fn tell(&mut self) {
        if let Some(study) = &self.study {
            self.words = format!("Flying {} of {}", study.flown(), study.plan().runs());
        }
    }

    fn save_plan(&self, context: &mut FeatureContext<'_>) {
        if let Some(plan) = self.sheet.draft.ready() {
            let name = format!("{}.toml", plan.name);
            context
                .host
                .save_file(&name, self.sheet.draft.packed().as_bytes());
        }
    }

    /// Flies a run once more, in Replay.
    fn open(&self, run: u64, context: &mut FeatureContext<'_>) {
        let Some(studied) = self.study.as_ref().and_then(|study| study.flight(run)) else {
            return;
        };
        let scenario = studied.flight.of_scenario().map(SimulationChoice::named);
        let map = scenario.map(|choice| {
            choice.map_or(MapSource::Nothing, |choice| {
                MapSource::world(choice.world.key())
            })
        });
        let flight = FlightSource::Studied(Box::new(studied));
        if let Some(map) = map {
            context.fly_own(flight, map);
        } else {
            // The mission that is open stays, and its undo steps.
            let map = context.documents.map.source.clone();
            context.fly_over(flight, map);
        }
        context.ask(Command::ShowWorkspace(Workspace::Replay));
    }
}

impl Feature for StudyFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<StudyCommand>() else {
            return false;
        };
        match *command {
            StudyCommand::Show => context.show(),
            StudyCommand::Close => context.hide(),
            StudyCommand::Start => self.start(context),
            StudyCommand::Stop => {
                self.stop_study(context);
            }
            StudyCommand::SavePlan => self.save_plan(context),
            StudyCommand::Open(run) => self.open(run, context),
        }
        true
    }

    fn missing(
        &self,
        command: &FeatureCommand,
        _documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        let is_stop = command.action() == Some(&StudyCommand::Stop);
        let is_under_way = self.study.as_ref().is_some_and(StudyUnderWay::is_under_way);
        CommandLack::unless(!is_stop || is_under_way, "No study is under way", "")
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        self.sheet.show(ui, context, self.study.as_ref(), documents);
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let draft = &mut self.sheet.draft;
        if self.reading.receive(job, &event, draft, context) {
            return true;
        }
        let Some(study) = &mut self.study else {
            return false;
        };
        if !study.receive(job, &event, context) {
            return false;
        }
        if !study.is_under_way()
            && let (Some(pace), flown) = (study.pace(), self.sheet.draft.flown_seconds())
            && let Some(plan) = self.sheet.draft.ready()
            && plan == study.plan()
        {
            self.sheet.pace = Some(pace * plan.runs() as f64 / flown.max(1.0));
        }
        self.tell();
        true
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        if self.sheet.was_drawn {
            self.reading.ask(&mut self.sheet.draft, context);
        }
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.stop_study(context)
    }

    fn progress(&self) -> Option<(f32, &str)> {
        let study = self.study.as_ref().filter(|study| study.is_under_way())?;
        Some((study.progress(), self.words.as_str()))
    }

    fn restore(&mut self, saved: &str) {
        if let Some(draft) = StudyDraft::of_kept(saved) {
            self.sheet.draft = draft;
        }
    }

    fn save(&self) -> Option<String> {
        Some(self.sheet.draft.kept())
    }

    fn state(&self, documents: &Documents) -> Value {
        let draft = &self.sheet.draft;
        let refusal = draft.refusal();
        let study = self.study.as_ref().map(|study| {
            let outcome = StudyOutcome::of(study, MeasureKind::ErrorRms, StudyBy::Compared);
            let settings = outcome.settings.iter().map(|own| {
                json!({
                    "label": own.label,
                    "flights": own.flights,
                    "quantiles": own.error.map(|error| error.quantiles),
                    "inside": own.inside,
                    "interval": own.interval,
                    "time_inside": own.time_inside,
                })
            });
            let failed = outcome.failed.iter().map(|run| {
                json!({
                    "run": run.run,
                    "largest": run.largest,
                    "rms": run.rms,
                    "inside": run.inside,
                    "why": run.why,
                })
            });
            json!({
                "name": study.plan().name,
                "flights": study.plan().runs(),
                "flown": study.flown(),
                "under_way": study.is_under_way(),
                "enough_after": study.stopped_by_rule(),
                "trouble": study.trouble(),
                "settings": settings.collect::<Vec<_>>(),
                "failed": failed.collect::<Vec<_>>(),
                "open": open_run(study, documents),
            })
        });
        json!({
            "chosen": draft.chosen(),
            "flights": draft.ready().map(StudyPlan::runs),
            "refusal": refusal,
            "study": study,
        })
    }
}
