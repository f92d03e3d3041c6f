//! Commands carried out, once a frame, after everything is drawn.

use pilotage_core::navigator::Run;

use super::fly_work::FlyJob;
use super::{App, SideTab};
use crate::command::Command;
use crate::context::frame_after;
use crate::documents::{Documents, SAME_BOOKMARK, Session};
use crate::host::Host;
use crate::units::Units;

/// Scale of the map at first, metres per point.
pub(super) const USUAL_SCALE: f64 = 0.7;

impl App {
    pub(super) fn execute(
        &mut self,
        command: Command,
        context: &egui::Context,
        host: &mut dyn Host,
    ) {
        if self.is_intercepted(&command, context, host) {
            return;
        }
        self.carry_out(command, context, host);
    }

    /// Carries out a command. The match names every one, so that none that is added is left undone.
    #[expect(
        clippy::too_many_lines,
        reason = "a table with a line for each command"
    )]
    fn carry_out(&mut self, command: Command, context: &egui::Context, host: &mut dyn Host) {
        let now = host.now();
        let whole = self.documents.whole_span();
        let time = self.playback.time;
        match command {
            Command::Feature(command) => self.execute_feature(&command, context, host),
            Command::TogglePlay => self.toggle_play(),
            Command::SeekTo(time) => self.seek(time),
            Command::StepFrames(count) => self.step_frames(count),
            Command::Jump(seconds) => self.seek(time + seconds),
            Command::GoToStart => self.seek(f64::NEG_INFINITY),
            Command::GoToEnd => {
                self.seek(f64::INFINITY);
                self.playback.playing = false;
            }
            Command::SelectSpan(selected) => self.playback.select(selected, whole),
            Command::SelectFromHere => self.playback.select_from_here(whole),
            Command::SelectToHere => self.playback.select_to_here(whole),
            Command::SetSpeed(speed) => self.playback.set_speed(speed),
            Command::ToggleLoop => self.playback.looping = !self.playback.looping,
            Command::ToggleBookmark => self.toggle_bookmark(),
            Command::PreviousBookmark => {
                let marks = self.documents.flight.bookmarks.iter().rev();
                if let Some(mark) = marks.copied().find(|b| *b < time - SAME_BOOKMARK) {
                    self.seek(mark);
                }
            }
            Command::NextBookmark => {
                let marks = self.documents.flight.bookmarks.iter();
                if let Some(mark) = marks.copied().find(|b| *b > time + SAME_BOOKMARK) {
                    self.seek(mark);
                }
            }
            Command::SelectLandmark(id) => {
                self.selection = id.filter(|id| self.documents.mission.landmark(*id).is_some());
            }
            Command::TogglePickTool => {
                self.views.map.picking = !self.views.map.picking;
                self.leave_map(None, context, host);
            }
            Command::LeaveMap(to) => self.leave_map(Some(to), context, host),
            Command::AddLandmark(bounds) => {
                let id = self.documents.add_landmark(bounds);
                self.present_landmark(id);
                self.run_is_stale(now);
            }
            Command::ReshapeLandmark {
                id,
                bounds,
                finished,
            } => {
                let over = self.documents.reshape_landmark(id, bounds, finished);
                self.edited(over, now);
            }
            Command::RenameLandmark { id, name } => {
                self.documents.rename_landmark(id, name);
                self.edited(false, now);
            }
            Command::EnableLandmark { id, enabled } => {
                let changed = self.documents.enable_landmark(id, enabled);
                self.edited(changed, now);
            }
            Command::DeleteLandmark(id) => self.delete_landmark(id, now),
            Command::DeleteSelectedLandmark => {
                if let Some(id) = self.selection {
                    self.delete_landmark(id, now);
                }
            }
            Command::Undo => self.step_in_history(Documents::undo, now),
            Command::Redo => self.step_in_history(Documents::redo, now),
            Command::SetNavigator(settings) => {
                let continues = context.input(|i| i.pointer.any_down());
                if self.documents.set_navigator(&settings, continues) {
                    self.run_is_stale(now);
                }
            }
            Command::OpenDemo => {
                let demo = Session::demo();
                self.fly_new(context, host, demo.flight, demo.map, None);
            }
            Command::FlyAgain => self.fly_again(host),
            Command::CancelJob => self.cancel_job(context, host),
            Command::Open => host.ask_for_files(),
            Command::TogglePalette => self.dialogs.palette.toggle(),
            Command::ToggleHelp => self.dialogs.help = !self.dialogs.help,
            Command::ToggleNotices => self.dialogs.notices = !self.dialogs.notices,
            Command::ToggleSettings => self.dialogs.settings = !self.dialogs.settings,
            Command::ToggleTrackUp => self.toggle_track_up(),
            Command::FitMap => {
                if let Some(ground) = self.flight_ground() {
                    self.views.map.fit(ground);
                }
            }
            Command::ToggleFollow => self.views.map.follow = !self.views.map.follow,
            Command::ToggleTheme => {
                self.view.dark = !self.view.dark;
                self.restyle(context);
            }
            Command::ToggleUnits => {
                self.view.units = match self.view.units {
                    Units::Metric => Units::Aviation,
                    Units::Aviation => Units::Metric,
                };
            }
            Command::ResetView => self.reset_view(),
            Command::ShowWorkspace(workspace) => self.show_workspace(workspace),
            Command::ToggleSide => {
                let is_open = self.is_side_open(context.content_rect());
                self.view.side_open = Some(!is_open);
            }
            Command::TogglePlots => {
                let screen = context.content_rect();
                self.view.plots_open = Some(!self.are_plots_open(screen));
            }
        }
    }

    /// Moves the cursor to a time, seconds, or to the end of what is flown.
    pub(super) fn seek(&mut self, time: f64) {
        let time = time.min(self.documents.flown_until().unwrap_or(f64::INFINITY));
        self.playback.seek(time, self.documents.span());
    }

    fn toggle_play(&mut self) {
        let documents = &self.documents;
        let flown = documents.run.navigated.as_ref().and_then(Run::span);
        let flown = flown.filter(|_| documents.run.is_complete);
        // Replay ends with the run, once nothing more of that comes.
        let end = flown.map_or(f64::INFINITY, |(_, last)| last);
        let span = documents.span().map(|(first, last)| (first, last.min(end)));
        let playback = &mut self.playback;
        playback.playing = !playback.playing;
        let at_end = span.is_some_and(|(_, last)| playback.time >= last - 1e-6);
        if playback.playing && at_end {
            playback.seek(f64::NEG_INFINITY, span);
        }
    }

    fn toggle_bookmark(&mut self) {
        if self.documents.span().is_none() {
            return;
        }
        let time = self.playback.time;
        let marks = &mut self.documents.flight.bookmarks;
        let before = marks.len();
        marks.retain(|b| (b - time).abs() > SAME_BOOKMARK);
        if marks.len() == before {
            marks.push(time);
            marks.sort_by(f64::total_cmp);
        }
        self.stored.document_changed = true;
    }

    /// Moves the cursor by camera frames and pauses.
    fn step_frames(&mut self, count: i32) {
        self.playback.playing = false;
        let Some(flight) = &self.documents.flight.measured else {
            return;
        };
        let index = frame_after(flight, self.playback.time, count);
        if let Some(frame) = flight.frames.get(index) {
            let time = frame.time;
            self.seek(time);
        }
    }

    fn delete_landmark(&mut self, id: u32, now: f64) {
        let changed = self.documents.delete_landmark(id);
        let mission = &self.documents.mission;
        self.selection = self.selection.filter(|s| mission.landmark(*s).is_some());
        self.edited(changed, now);
    }

    /// Takes an edit back or makes it again, and selects the landmark that came back by it.
    fn step_in_history(&mut self, step: fn(&mut Documents) -> Option<bool>, now: f64) {
        let known: Vec<u32> = (self.documents.mission.landmarks.iter())
            .map(|l| l.id)
            .collect();
        let affected = step(&mut self.documents);
        let mission = &self.documents.mission;
        let mut ids = mission.landmarks.iter().map(|l| l.id);
        let back = ids.rfind(|id| !known.contains(id));
        let still = self.selection.filter(|id| mission.landmark(*id).is_some());
        self.selection = back.or(still);
        self.edited(affected == Some(true), now);
    }

    /// Selects a landmark that was just made, and has people name it.
    pub(super) fn present_landmark(&mut self, id: u32) {
        self.selection = Some(id);
        self.side_tab = SideTab::Landmarks;
        let name = self.documents.mission.landmark(id).map(|l| l.name.clone());
        self.views.map.name_new(id, &name.unwrap_or_default());
    }

    /// After an edit, which may have changed what the run depends on.
    fn edited(&mut self, is_run_changed: bool, now: f64) {
        self.stored.document_changed = true;
        if is_run_changed {
            self.run_is_stale(now);
        }
    }

    /// Stops the flight under way, or else the work that the top bar tells of, or else that of the first that has any.
    fn cancel_job(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        if self.fly_work.job.is_none() {
            let _ = self.stop_features(true, egui, host)
                || self.openings.stop(host)
                || self.map_work.stop(&mut self.toasts, host)
                || self.stop_features(false, egui, host);
            return;
        }
        self.documents.run.is_complete |= self.fly_work.job.as_ref().is_some_and(FlyJob::began);
        self.fly_work.stop(host);
        self.tell_of_run_over(false, egui, host);
        self.seek(self.playback.time);
        let part = self.documents.part_flown();
        let part = part.map_or_else(String::new, |part| format!(": {part}"));
        let text = format!("What had been computed stays on screen{part}.");
        self.toasts.note(host.now(), "Stopped", text);
    }

    fn toggle_track_up(&mut self) {
        let map = &mut self.views.map;
        map.track_up = !map.track_up;
        if !map.track_up {
            map.camera.up = 0.0;
        }
    }

    /// Panels and map of the workspace as they were at first: the aircraft followed, or else all in view.
    fn reset_view(&mut self) {
        self.view.reset_panels();
        let is_flown = self.documents.run.navigated.is_some() && !self.is_flight_hidden();
        let map = &mut self.views.map;
        map.track_up = false;
        map.camera.up = 0.0;
        if is_flown && self.documents.flight.log.is_none() {
            map.follow = true;
            map.camera.metres_per_point = USUAL_SCALE;
        } else {
            self.commands.push(Command::FitMap);
        }
    }
}
