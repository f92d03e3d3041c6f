//! Runs and flights beside each other: errors against one of them, on one clock.

mod chart;
mod command;
mod contest;
mod on_map;
mod panel;
mod results;
mod shelf;

use egui::{Key, Ui};
use pilotage_core::flight::trajectory::Trajectory;
use pilotage_core::navigator::{EstimatorChoice, Run};
use pilotage_jobs::{ContestOrder, Job, JobEvent, JobId, SmoothOrder};
use serde_json::{Value, json};

use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::feature_work::{FeatureWork, WorkEvent};
use crate::map::MapLayer;
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, shift};

use command::{CompareCommand, ID, TrackId};
use contest::ContestState;
use panel::CompareView;
use results::{CompareScene, open_tracks};
use shelf::Shelf;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Compare",
    place: FeaturePlace::Tab,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    vec![
        entry(
            CommandGroup::View,
            "Compare runs and flights",
            vec![shift(Key::C)],
            CompareCommand::Show.into(),
        )
        .also("difference error ghost trajectory ape rpe"),
        entry(
            CommandGroup::Document,
            "Keep this run for comparison",
            Vec::new(),
            CompareCommand::Keep(TrackId::Run).into(),
        ),
        entry(
            CommandGroup::Document,
            "Keep this run smoothed",
            Vec::new(),
            CompareCommand::KeepSmoothed.into(),
        )
        .also("smoother rts"),
    ]
}

/// Trajectories beside each other, and every estimator on the flight that is open.
#[derive(Default)]
pub struct Compare {
    view: CompareView,
    contest: ContestState,
    shelf: Shelf,
    smoothing: Smoothing,
}

/// Run that is being smoothed.
#[derive(Debug, Default)]
pub(super) struct Smoothing {
    /// Work on it, while it is under way.
    pub work: FeatureWork,
    /// Its track to be, but for its places.
    track: Option<Trajectory>,
}

/// Seconds since 1970 at time zero of the flight that is open, where its log says so.
fn utc_at_zero(documents: &Documents) -> Option<f64> {
    documents.flight.log.as_ref()?.utc_at_zero
}

/// Name of a kept run of the flight `of`: with its estimator where that is not the usual one.
fn named_after(of: &str, run: Option<&Run>) -> String {
    let estimator = run.map(|run| run.settings.estimator.choice);
    match estimator.filter(|choice| *choice != EstimatorChoice::default()) {
        Some(choice) => format!("{of}, {}", choice.label()),
        None => of.to_owned(),
    }
}

impl Compare {
    /// Keeps one of the trajectories that are open.
    fn keep(&mut self, id: TrackId, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let utc = utc_at_zero(documents);
        let (flight, run) = (
            documents.flight.measured.as_ref(),
            documents.run.navigated.as_ref(),
        );
        let is_recorded = documents.flight.log.is_some();
        let open = open_tracks(flight, run, documents.run.ghost.as_ref(), utc, is_recorded);
        let wanted = open.into_iter().find(|(found, _)| *found == id);
        let Some((_, mut track)) = wanted else {
            let text = "Simulate or open a flight first.".to_owned();
            return context.note("Nothing to keep", text);
        };
        let of = documents.subject();
        track.name = match id {
            TrackId::Truth if is_recorded => format!("{of}, recorded"),
            TrackId::Truth => format!("{of}, true"),
            TrackId::Unaided => format!("{of}, dead reckoning"),
            _ => named_after(of, run),
        };
        let name = self.shelf.keep(track).to_owned();
        context.note("Kept for comparison", name);
    }

    /// Has every step of the run estimated from all of the flight; the result is kept.
    fn smooth(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let run = documents
            .run
            .navigated
            .as_ref()
            .filter(|_| documents.run.is_complete);
        let (Some(flight), Some(run)) = (documents.flight.measured.as_ref(), run) else {
            let text = "Wait until the flight is flown to its end.".to_owned();
            return context.note("Nothing to smooth yet", text);
        };
        let track = Trajectory {
            name: format!("{}, smoothed", named_after(documents.subject(), Some(run))),
            frame: flight.frame_on_globe,
            utc_at_zero: utc_at_zero(documents),
            has_height: false,
            places: Vec::new(),
        };
        let order = SmoothOrder(Box::new(run.clone()));
        self.smoothing.track = Some(track);
        let words = "Smoothing the run".to_owned();
        self.smoothing
            .work
            .begin(words, Job::Smooth(order), context);
    }

    /// Keeps the places of a run that was smoothed.
    fn keep_smoothed(&mut self, places: Vec<(f64, f64, f64)>, context: &mut FeatureContext<'_>) {
        let Some(track) = self.smoothing.track.take() else {
            return;
        };
        let mut kept = Trajectory::on_the_ground(track.name, track.frame, places);
        kept.utc_at_zero = track.utc_at_zero;
        let name = self.shelf.keep(kept).to_owned();
        context.note("Kept for comparison", name);
    }

    /// Flies what is open by every estimator.
    fn fly_by_all(&mut self, context: &mut FeatureContext<'_>) {
        let documents = &*context.documents;
        let order = ContestOrder::of_all(
            documents.flight.source.clone(),
            documents.map.source.clone(),
            documents.mission.clone(),
        );
        let job = Job::Contest(Box::new(order.clone()));
        self.contest.found = None;
        self.contest.remarks.clear();
        self.contest.order = Some(order);
        self.contest
            .work
            .begin("Beginning".to_owned(), job, context);
    }
}

impl Feature for Compare {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<CompareCommand>() else {
            return false;
        };
        match *command {
            CompareCommand::Show => context.show(),
            CompareCommand::Keep(id) => self.keep(id, context),
            CompareCommand::KeepSmoothed if self.smoothing.work.words.is_some() => {}
            CompareCommand::KeepSmoothed => self.smooth(context),
            CompareCommand::StopSmoothing => {
                self.smoothing.work.stop(context);
            }
            CompareCommand::FlyAll => self.fly_by_all(context),
            CompareCommand::StopFlights => {
                self.contest.work.stop(context);
            }
            CompareCommand::Discard(number) => self.shelf.discard(number),
            CompareCommand::ToggleShown(number) => self.shelf.toggle_shown(number),
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let scene = CompareScene {
            shelf: &self.shelf,
            generations: [documents.run.generation, documents.run.ghost_generation],
            is_complete: documents.run.is_complete,
            contest: &self.contest,
            smoothing: self.smoothing.work.words.as_deref(),
            is_contest_of_before: self.contest.is_of_before(documents),
            utc_at_zero: utc_at_zero(documents),
        };
        self.view.show(ui, context, &scene);
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        vec![&self.shelf]
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, context: &mut FeatureContext<'_>) -> bool {
        let event = match self.smoothing.work.take(job, event) {
            WorkEvent::Content(JobEvent::Smoothed(places)) => {
                self.keep_smoothed(places, context);
                return true;
            }
            WorkEvent::Taken => {
                if let Some(why) = self.smoothing.work.trouble.take() {
                    context.trouble("The run cannot be smoothed", why);
                }
                return true;
            }
            WorkEvent::Content(_) => return false,
            WorkEvent::Other(event) => event,
        };
        match self.contest.work.take(job, event) {
            WorkEvent::Content(JobEvent::ContestJudged(found)) => self.contest.found = Some(*found),
            WorkEvent::Content(JobEvent::Remark(text)) => self.contest.remarks.push(text),
            WorkEvent::Taken => {}
            WorkEvent::Content(_) | WorkEvent::Other(_) => return false,
        }
        true
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.contest.work.stop(context) || self.smoothing.work.stop(context)
    }

    /// Forgets the contest; trajectories that were kept stay, to be compared with other flights.
    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        self.contest = ContestState::default();
        self.smoothing.work.stop(context);
    }

    fn state(&self, documents: &Documents) -> Value {
        let kept = self.shelf.kept().iter();
        let kept = kept.map(|k| json!({"name": k.track.name, "shown": k.is_shown}));
        let errors = self.view.found().map(|(name, errors)| {
            json!({
                "name": name,
                "rms": errors.map(|e| e.0),
                "greatest": errors.map(|e| e.1),
            })
        });
        json!({
            "kept": kept.collect::<Vec<_>>(),
            "contest": self.contest.found.as_ref().map(|found| {
                let errors = found.rows.iter().map(|row| row.position_error_m);
                errors.map(|error| error.map(|error| error.rms)).collect::<Vec<_>>()
            }),
            "contest_of_before": self.contest.is_of_before(documents),
            "errors": errors.collect::<Vec<_>>(),
        })
    }
}
