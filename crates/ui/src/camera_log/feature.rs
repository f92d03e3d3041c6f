//! Camera beside its log, as a feature: its commands, its jobs and its mark on the map.

use egui::{Key, Painter, Ui};
use pilotage_core::calibration::{CameraAdjustment, CameraPrior, camera_findings};
use pilotage_core::flight::overview::Finding;
use pilotage_core::frames::LocalFrame;
use pilotage_jobs::{CalibrationOrder, Job, JobEvent, JobId, MapSource};
use serde_json::Value;

use super::CameraLogCommand;
use super::panel::{CameraLogScene, CameraLogView};
use super::work::{CameraLog, Missing};
use crate::command::Command;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::feature_work::{FeatureWork, WorkEvent};
use crate::map::{MapLayer, ScreenFromWorld, paint_tried_footprint};
use crate::shell::catalog::{CommandEntry, CommandGroup, entry, shift};
use crate::state_json::object;

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: super::ID,
    tab: "Camera to log",
    place: FeaturePlace::Sheet,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    vec![
        entry(
            CommandGroup::View,
            "Camera to log: time offset, mount, focal length",
            vec![shift(Key::T)],
            Command::Feature(FeatureCommand::show(super::ID)),
        )
        .also("calibrate calibration synchronise delay lag boresight"),
    ]
}

/// Camera beside its log.
#[derive(Default)]
pub struct CameraLogFeature {
    work: CameraLog,
    view: CameraLogView,
    job: FeatureWork,
    /// Adjustment of the mission as it was set here.
    applied: Option<CameraAdjustment>,
    /// Map on which the frames were laid by which it is being estimated.
    estimated_on: Option<MapSource>,
    /// Whether it is to be estimated once the flight under way is over.
    is_after_flight: bool,
    /// Whether its panel is shown.
    is_shown: bool,
}

fn missing(work: &CameraLog, documents: &Documents) -> Option<Missing> {
    let has_map = documents.map.source != MapSource::Nothing;
    let (flight, run) = (
        documents.flight.measured.as_ref(),
        documents.run.navigated.as_ref(),
    );
    work.missing(flight, run, has_map)
}

impl CameraLogFeature {
    fn refresh(&mut self, documents: &Documents) -> bool {
        let generation = (documents.run.is_complete).then_some(documents.run.generation);
        self.work.refresh(
            documents.flight.measured.as_ref(),
            documents.run.navigated.as_ref(),
            generation,
            &documents.flight.flown_camera,
            documents.mission.camera_to_log.as_ref(),
        )
    }

    fn change(&mut self, camera: Option<CameraAdjustment>, context: &mut FeatureContext<'_>) {
        self.applied = camera;
        if context.documents.set_camera_to_log(camera) {
            context.run_is_stale();
        }
    }

    fn estimate(&mut self, context: &mut FeatureContext<'_>) {
        let is_wanted = missing(&self.work, context.documents).is_none();
        let (true, Some(evidence)) = (is_wanted, self.work.evidence()) else {
            return;
        };
        let order = CalibrationOrder {
            evidence: evidence.clone(),
            believed: CameraPrior {
                offset: self.work.clock,
                ..CameraPrior::default()
            },
        };
        self.estimated_on.clone_from(&context.documents.run.over);
        let job = Job::Calibrate(Box::new(order));
        self.job.begin("Estimating".to_owned(), job, context);
    }

    /// Leaves an estimate of another map than that of the run; another one comes once the flight is over that makes the
    /// run, unless somebody moved the hand. Nothing makes a run that was opened.
    fn keep_to_map(&mut self, is_flown: bool, documents: &Documents) {
        if self.work.keep_to(documents.run.over.as_ref()) {
            self.is_after_flight |= is_flown && self.work.by_hand.is_none();
        }
    }

    /// Registers whole pictures on the map in another run; what is estimated from it comes at its end.
    fn fly_and_estimate(&mut self, context: &mut FeatureContext<'_>) {
        context.show();
        let documents = &mut *context.documents;
        let Some(flight) = &documents.flight.measured else {
            return;
        };
        let settings = documents.mission.navigator.clone();
        let settings = settings.laying_pictures_of(flight);
        documents.set_navigator(&settings, false);
        self.job.trouble = None;
        context.document_changed();
        context.ask(Command::FlyAgain);
        self.is_after_flight = true;
    }
}

impl Feature for CameraLogFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<CameraLogCommand>() else {
            return false;
        };
        let applied = context.documents.mission.camera_to_log;
        let work = &mut self.work;
        match command {
            CameraLogCommand::Close => context.hide(),
            CameraLogCommand::Estimate => {
                context.show();
                self.refresh(context.documents);
                self.estimate(context);
            }
            CameraLogCommand::Stop => {
                self.job.stop(context);
            }
            CameraLogCommand::FlyAndEstimate => self.fly_and_estimate(context),
            CameraLogCommand::Believe(clock) => work.clock = *clock,
            CameraLogCommand::Adjust(change) => work.by_hand = Some(**change),
            CameraLogCommand::UseEstimate => work.by_hand = work.found.map(|found| found.change),
            CameraLogCommand::Reset => {
                let middle = work.change(None).middle;
                work.by_hand = Some(CameraAdjustment::none(middle));
                self.change(None, context);
            }
            CameraLogCommand::Apply => {
                let change = work.change(applied.as_ref());
                self.change(Some(change).filter(|c| !c.is_none()), context);
            }
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let scene = CameraLogScene {
            work: &self.work,
            job: &self.job,
            has_map: documents.map.source != MapSource::Nothing,
            flying: context.flying.filter(|_| !documents.run.is_complete),
        };
        self.view.show(ui, context, &scene);
    }

    fn layers(&self) -> Vec<&dyn MapLayer> {
        vec![self]
    }

    fn on_event(&mut self, job: JobId, event: JobEvent, _context: &mut FeatureContext<'_>) -> bool {
        match self.job.take(job, event) {
            WorkEvent::Content(JobEvent::CameraCalibrated(found)) => {
                self.work.take(*found, self.estimated_on.take());
            }
            WorkEvent::Taken => {}
            WorkEvent::Content(_) | WorkEvent::Other(_) => return false,
        }
        true
    }

    fn stop(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.job.stop(context)
    }

    /// Looks at the run and the hand anew, while that is shown.
    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        self.is_shown = context.is_shown;
        let applied = context.documents.mission.camera_to_log;
        if self.applied != applied {
            // Taken back or made again: the hand follows.
            self.work.by_hand = None;
            self.applied = applied;
        }
        let is_flown = !context.documents.run.is_complete;
        self.keep_to_map(is_flown, context.documents);
        if self.is_shown && self.refresh(context.documents) {
            context.egui.request_repaint();
        }
    }

    /// Estimates what was asked for, and what nobody touched yet wherever its pictures allow it, so that the overview
    /// tells a lag by itself.
    fn on_run_over(&mut self, is_whole: bool, context: &mut FeatureContext<'_>) {
        self.keep_to_map(true, context.documents);
        let is_asked = std::mem::take(&mut self.is_after_flight);
        let is_untouched = self.work.found.is_none() && self.work.by_hand.is_none();
        let applied = context.documents.mission.camera_to_log;
        if is_whole && (is_asked || is_untouched && applied.is_none()) {
            self.refresh(context.documents);
            self.estimate(context);
        }
    }

    fn on_flight_changed(&mut self, context: &mut FeatureContext<'_>) {
        self.stop(context);
        *self = Self::default();
    }

    fn findings(&self, documents: &Documents) -> Vec<Finding> {
        let left = self.work.left(&documents.flight.flown_camera);
        left.map_or_else(Vec::new, |left| camera_findings(&left))
    }

    /// Changes are told as in the file of a mission, root mean squares as opened, estimated and by hand.
    fn state(&self, documents: &Documents) -> Value {
        let work = &self.work;
        let applied = documents.mission.camera_to_log;
        let missing = missing(work, documents);
        let summaries = work.preview().map(|preview| preview.summaries);
        let rms = summaries.map(|of| of.map(|s| s.map(|s| s.place)));
        let frames = documents
            .flight
            .measured
            .as_ref()
            .map_or(&[][..], |f| &f.frames);
        object!({
            "missing": missing.map(|missing| format!("{missing:?}")),
            "at_work": self.job.words.is_some(),
            "trouble": self.job.trouble,
            "estimate": work.found.map(|found| object!({"told": found.told, "change": found.change})),
            "by_hand": work.change(applied.as_ref()),
            "applied": applied,
            "position_rms": rms,
            "frame_times": [frames.first().map(|f| f.time), frames.last().map(|f| f.time)],
        })
    }
}

impl MapLayer for CameraLogFeature {
    /// Draws the ground that the frame at the cursor would show as the hand has the camera, while that is shown.
    fn paint(
        &self,
        painter: &Painter,
        view: &ScreenFromWorld,
        context: &ViewContext<'_>,
        _frame: Option<LocalFrame>,
    ) {
        if !self.is_shown || context.flight.is_none() {
            return;
        }
        let applied = context.mission.camera_to_log.as_ref();
        let index = context.shown_frame().unwrap_or(0);
        let corners = self.work.footprint(index, applied);
        if let Some(corners) = corners {
            paint_tried_footprint(painter, view, &corners, context.tokens);
        }
    }
}
