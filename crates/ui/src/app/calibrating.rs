//! The camera of the flight that is open, put in time and place beside its log.

use pilotage_core::calibration::{CameraAdjustment, CameraPrior};
use pilotage_core::flight::ChannelName;
use pilotage_core::frames::GroundPoint;
use pilotage_core::navigator::VehicleChoice;
use pilotage_core::registration::FollowSettings;

use super::{App, SideTab};
use crate::camera_log::CameraLogCommand;
use crate::command::Workspace;
use crate::host::Host;
use pilotage_jobs::{CalibrationOrder, Job, JobEvent, JobId, MapSource};

impl App {
    /// Does what was asked about the camera beside the log.
    pub(super) fn camera_log(&mut self, command: CameraLogCommand, host: &mut dyn Host) {
        let now = host.now();
        match command {
            CameraLogCommand::Show => self.show_camera_log(),
            CameraLogCommand::Close => self.side_tab = SideTab::Match,
            CameraLogCommand::Estimate => {
                self.show_camera_log();
                self.refresh_camera_log();
                self.estimate_camera(host);
            }
            CameraLogCommand::FlyAndEstimate => self.fly_and_estimate(host),
            CameraLogCommand::Believe(clock) => self.documents.camera_log.clock = clock,
            CameraLogCommand::Adjust(change) => {
                self.documents.camera_log.by_hand = Some(*change);
            }
            CameraLogCommand::UseEstimate => {
                let work = &mut self.documents.camera_log;
                work.by_hand = work.found.map(|found| found.change);
            }
            CameraLogCommand::Reset => {
                let work = &mut self.documents.camera_log;
                let middle = work.change(None).middle;
                work.by_hand = Some(CameraAdjustment::none(middle));
                self.change_camera(None, now);
            }
            CameraLogCommand::Apply => {
                let applied = self.documents.mission.camera_to_log;
                let change = self.documents.camera_log.change(applied.as_ref());
                self.change_camera(Some(change).filter(|c| !c.is_none()), now);
            }
        }
    }

    fn show_camera_log(&mut self) {
        self.view.workspace = Workspace::Replay;
        self.view.side_open = true;
        self.dialogs.settings = false;
        self.side_tab = SideTab::CameraLog;
    }

    fn change_camera(&mut self, change: Option<CameraAdjustment>, now: f64) {
        if self.documents.set_camera_to_log(change) {
            self.run_is_stale(now);
        }
    }

    fn estimate_camera(&mut self, host: &mut dyn Host) {
        let is_wanted = self.is_camera_log_possible();
        let work = &mut self.documents.camera_log;
        let (true, Some(evidence)) = (is_wanted, work.evidence()) else {
            return;
        };
        let order = CalibrationOrder {
            evidence: evidence.clone(),
            believed: CameraPrior {
                offset: work.clock,
                ..CameraPrior::default()
            },
        };
        work.trouble = None;
        work.at_work = Some((0.0, "Estimating".to_owned()));
        self.stop_calibrating(host);
        self.jobs.calibrating = Some(host.start(Job::Calibrate(Box::new(order))));
    }

    fn is_camera_log_possible(&self) -> bool {
        let documents = &self.documents;
        let has_map = documents.map_source != MapSource::Nothing;
        let (flight, run) = (documents.flight.as_ref(), documents.run.as_ref());
        let missing = documents.camera_log.missing(flight, run, has_map);
        missing.is_none()
    }

    /// Lays whole pictures on the map in another run; what is estimated from it comes at its end.
    fn fly_and_estimate(&mut self, host: &mut dyn Host) {
        self.show_camera_log();
        let Some(flight) = &self.documents.flight else {
            return;
        };
        let mut settings = self.documents.mission.navigator.clone();
        if settings.whole_frames.is_none() {
            settings.whole_frames = Some(FollowSettings::default());
        }
        if flight.channel(ChannelName::Airspeed).is_none() {
            settings.vehicle = VehicleChoice::ConstantVelocity;
        }
        self.documents.set_navigator(&settings, false);
        self.documents.camera_log.trouble = None;
        self.jobs.document_changed = true;
        self.fly_again(host);
        self.jobs.calibrate_after_flight = true;
    }

    /// The flight is over, as far as it went: what was asked for is estimated, and what nobody touched yet wherever
    /// its pictures allow it, so that the overview tells a lag by itself.
    pub(super) fn calibrate_after_flight(&mut self, host: &mut dyn Host, is_whole: bool) {
        let is_asked = std::mem::take(&mut self.jobs.calibrate_after_flight);
        let work = &self.documents.camera_log;
        let is_untouched = work.found.is_none() && work.by_hand.is_none();
        let applied = self.documents.mission.camera_to_log;
        if is_whole && (is_asked || is_untouched && applied.is_none()) {
            self.refresh_camera_log();
            self.estimate_camera(host);
        }
    }

    /// Looks at the run and the hand anew, while that is shown.
    pub(super) fn tend_camera_log(&mut self, context: &egui::Context) {
        if self.side_tab == SideTab::CameraLog && self.refresh_camera_log() {
            context.request_repaint();
        }
    }

    fn refresh_camera_log(&mut self) -> bool {
        let documents = &mut self.documents;
        let generation = (documents.run_complete).then_some(documents.run_generation);
        documents.camera_log.refresh(
            documents.flight.as_ref(),
            documents.run.as_ref(),
            generation,
            documents.mission.camera_to_log.as_ref(),
        )
    }

    /// Stops an estimate; whether there was one.
    pub(super) fn stop_calibrating(&mut self, host: &mut dyn Host) -> bool {
        let job = self.jobs.calibrating.take();
        if let Some(job) = job {
            host.cancel(job);
            self.documents.camera_log.at_work = None;
        }
        job.is_some()
    }

    /// Takes what a worker says of an estimate; whether `id` was about one.
    pub(super) fn calibration_event(&mut self, id: JobId, event: &JobEvent) -> bool {
        if self.jobs.calibrating != Some(id) {
            return false;
        }
        let work = &mut self.documents.camera_log;
        match event {
            JobEvent::Progress(share, words) => work.at_work = Some((*share, words.clone())),
            JobEvent::CameraCalibrated(found) => work.take(**found),
            JobEvent::Failed(why) => work.trouble = Some(why.clone()),
            _ => {}
        }
        if event.is_last() {
            work.at_work = None;
            self.jobs.calibrating = None;
        }
        true
    }

    /// Corners of the ground that the frame at the cursor would show as the hand has the camera, while that is
    /// shown.
    pub(super) fn tried_footprint(&self) -> Option<Vec<GroundPoint>> {
        if self.side_tab != SideTab::CameraLog || !self.is_camera_log_possible() {
            return None;
        }
        let documents = &self.documents;
        let frames = &documents.flight.as_ref()?.frames;
        let after = frames.partition_point(|f| f.time <= self.playback.time + 1e-6);
        let applied = documents.mission.camera_to_log.as_ref();
        let index = after.saturating_sub(1);
        documents.camera_log.footprint(index, applied)
    }
}
