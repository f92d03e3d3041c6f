//! The flight that is flown in a worker: asked for, taken as it comes, left for another one.

use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{Run, unused_pictures};
use pilotage_core::simulate::SimulationChoice;

use super::App;
use super::fly_work::{FlyJob, ShownFlight};
use crate::documents::{Session, Staged, is_run_of};
use crate::feature::Feature;
use crate::host::Host;
use crate::map::MapLayer;
use pilotage_jobs::{FlightSource, JobEvent, JobId, MapSource};

/// Delay after the last of several changes before the run is computed again, milliseconds.
const FLY_AGAIN_AFTER: f64 = 350.0;
/// Scales of the map at which an aircraft can be followed, metres per point.
const USUAL_SCALES: std::ops::RangeInclusive<f64> = 0.25..=2.5;
/// Square around the origin in which other tracks of a log are fitted into the map, metres across.
const NEARBY: f64 = 20_000.0;
/// Title of the notice that a flight came to nothing.
const CANNOT_FLY: &str = "The flight cannot be flown";

impl App {
    /// Flies another flight; what is open stays until it begins.
    pub(super) fn fly_new(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        flight: FlightSource,
        map: MapSource,
        mission: Option<Mission>,
    ) {
        self.tell_of_other_flight(egui, host);
        let staged = Staged {
            flight: None,
            mission: mission.clone(),
            ..Staged::default()
        };
        self.fly_work
            .begin((flight, map), mission, staged, false, host);
    }

    /// Tells of an edited mission that is about to make room for that of a flight.
    fn tell_of_replaced(&mut self, staged: &Staged, host: &dyn Host) {
        if staged.replaces_unsaved(&self.documents.mission) {
            let title = "The flight brought a mission of its own";
            let name = &self.documents.mission.name;
            let text = format!("Undo brings back yours, \u{201c}{name}\u{201d}, to save it.");
            self.toasts.note(host.now(), title, text);
        }
    }

    /// Flies another flight over the mission that is open, which stays.
    pub(super) fn fly_over_mission(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        (flight, map): (FlightSource, MapSource),
    ) {
        self.tell_of_other_flight(egui, host);
        let session = Session {
            flight,
            map,
            mission: Some(self.documents.mission.clone()),
            ..self.documents.session()
        };
        self.fly_open(host, session);
    }

    /// Flies what a session names with the mission that is open, which stays: it may be edited before
    /// the run begins.
    pub(super) fn fly_open(&mut self, host: &mut dyn Host, session: Session) {
        let Session {
            flight,
            map,
            mission,
            ..
        } = session;
        let staged = Staged {
            keeps_edits: true,
            ..Staged::default()
        };
        self.fly_work
            .begin((flight, map), mission, staged, false, host);
    }

    /// Flies the same flight again with the mission as it is now.
    pub(super) fn fly_again(&mut self, host: &mut dyn Host) {
        // What is edited meanwhile is added to the flight's own mission, which is yet to come.
        let awaited = |fly: &FlyJob| !fly.given && !fly.began();
        if self.fly_work.job.as_ref().is_some_and(awaited) {
            self.fly_work.again_at = Some(host.now() + FLY_AGAIN_AFTER);
            return;
        }
        self.fly_work.again_at = None;
        let again = self.documents.run.navigated.is_some();
        let mission = Some(self.documents.mission.clone());
        let flight = self.documents.flight.source.clone();
        let map = self.documents.map.source.clone();
        let staged = Staged::default();
        self.fly_work
            .begin((flight, map), mission, staged, again, host);
    }

    /// Shows a run out of a file, unless it was made of another flight than the one that is open; whether it was. The
    /// flight that is under way beneath it goes on for its pictures.
    pub(super) fn show_opened_run(&mut self, host: &mut dyn Host, run: Run) -> bool {
        let flight = self.documents.flight.measured.as_ref();
        if flight.is_some_and(|flight| !is_run_of(&run, flight)) {
            let title = "The run was made of another flight";
            let text = match SimulationChoice::named(&run.name) {
                Some(choice) => format!(
                    "It is of \u{201c}{}\u{201d}, or of that with another seed or day. Simulate that, then open the run.",
                    choice.title
                ),
                None => format!(
                    "It is of \u{201c}{}\u{201d}. Open that flight, then the run.",
                    run.name
                ),
            };
            self.toasts.trouble(host.now(), title, text);
            return false;
        }
        match self.fly_work.job.as_mut().filter(|fly| fly.began()) {
            Some(fly) => {
                fly.shown = ShownFlight::Pictures;
                self.fly_work.again_at = None;
            }
            None => self.fly_work.stop(host),
        }
        // Nobody says over what it was flown; the map that is open is the best guess.
        let map = self.documents.map.source.clone();
        self.documents.begin_run_again(run, Staged::default(), map);
        self.documents.run.is_complete = true;
        true
    }

    /// The mission changed in a way that changes the run.
    pub(super) fn run_is_stale(&mut self, now: f64) {
        self.fly_work.again_at = Some(now + FLY_AGAIN_AFTER);
        self.stored.document_changed = true;
    }

    /// Leaves what is being done about the flight that was open, once another one is. To be called after whatever can
    /// change the flight, before anything else is done: an answer about the old one would be taken for the new one's.
    pub(super) fn follow_flight(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        let generation = self.documents.flight.generation;
        if self.followed.0 == generation {
            return;
        }
        let source = self.documents.flight.source.clone();
        let (_, old) = std::mem::replace(&mut self.followed, (generation, source));
        self.tell_features_of_flight(egui, host);
        if old != self.documents.flight.source {
            self.playback.selected_span = None;
            self.views.plots.show_all_time();
        }
        self.frame_pictures.leave(host);
        self.views.camera.clear();
        self.views.map.forget_elsewhere();
        let mission = &self.documents.mission;
        self.selection = self.selection.filter(|id| mission.landmark(*id).is_some());
    }

    /// Takes what the worker that flies says; false if no such flight is awaited, or nothing of that kind of it.
    pub(super) fn fly_event(
        &mut self,
        egui: &egui::Context,
        host: &mut dyn Host,
        (id, event): (JobId, JobEvent),
    ) -> bool {
        let Some(fly) = self.fly_work.job.as_mut().filter(|fly| fly.id == id) else {
            return false;
        };
        match event {
            JobEvent::Progress(fraction, words) => {
                fly.progress = fraction;
                fly.words = if fly.shown == ShownFlight::Pictures {
                    "Taking the pictures".to_owned()
                } else {
                    words
                };
            }
            JobEvent::Flight(flight) => fly.staged.flight = Some(*flight),
            JobEvent::Mission(mission) => {
                fly.staged.camera_to_log = mission.camera_to_log;
                fly.staged.mission = Some(*mission);
            }
            JobEvent::RunStarted(head) => self.begin_run(host, *head),
            JobEvent::CannotNavigate(why) => self.look_at_flight(host, &why),
            JobEvent::WithoutMission(why) => {
                // Of a log without pictures nobody would expect else.
                let flight = self.documents.flight.measured.as_ref();
                if flight.is_some_and(|flight| !flight.frames.is_empty()) {
                    let title = "The flight came without a mission";
                    self.toasts.note(host.now(), title, why);
                }
            }
            JobEvent::Steps(_) if fly.shown == ShownFlight::Pictures => {}
            JobEvent::Steps(mut steps) => {
                if let Some(run) = &mut self.documents.run.navigated {
                    run.steps.append(&mut steps);
                }
            }
            JobEvent::FrameTaken { index, .. } => {
                let was_taken = self.documents.flight.pictures.take(index);
                if was_taken && !fly.again {
                    self.views.camera.forget(index);
                }
            }
            // It could not be navigated, and all of its pictures are there.
            JobEvent::Finished if !fly.began() => {
                self.fly_work.job = None;
                self.tell_of_run_over(false, egui, host);
            }
            JobEvent::Finished => {
                let again = fly.again;
                let is_new_run = fly.has_new_run() && fly.has_pictures();
                self.documents.run.is_complete = true;
                self.fly_work.job = None;
                // Where a recorded flight went may be known only now.
                if !again && self.views.map.is_fitted() && !self.is_flight_hidden() {
                    self.fit_to_flight_and_map();
                }
                let run = self.documents.run.navigated.as_ref().filter(|_| is_new_run);
                if let Some(why) = run.and_then(unused_pictures) {
                    self.toasts.trouble(host.now(), "No picture helped", why);
                }
                self.tell_of_run_over(true, egui, host);
            }
            JobEvent::Cancelled => self.fly_work.job = None,
            JobEvent::Failed(why) => {
                let began = fly.began();
                let is_of_log = self.documents.flight.source == fly.flight && !fly.again;
                self.fly_work.job = None;
                self.tell_of_run_over(false, egui, host);
                self.documents.run.is_complete |= began;
                self.seek(self.playback.time);
                let log = self.documents.flight.log.as_mut().filter(|_| is_of_log);
                let kept = if began {
                    "What had been computed stays."
                } else if let Some(log) = log {
                    log.unnavigable = Some(why.clone());
                    if let Some(time) = self.documents.first_look() {
                        self.playback.time = time;
                    }
                    "What was measured can be plotted all the same."
                } else {
                    "Everything open stays as it was."
                };
                let text = format!("{why} {kept}");
                self.toasts.trouble(host.now(), CANNOT_FLY, text);
            }
            _ => return false,
        }
        true
    }

    /// Shows the run of what is flown, which has begun.
    fn begin_run(&mut self, host: &mut dyn Host, head: Run) {
        let Some(fly) = &mut self.fly_work.job else {
            return;
        };
        let (again, given, first) = (fly.again, fly.given, !fly.began());
        let staged = std::mem::take(&mut fly.staged);
        let (flight, map) = (fly.flight.clone(), fly.map.clone());
        fly.shown = ShownFlight::Run;
        self.tell_of_replaced(&staged, host);
        if again {
            self.documents.begin_run_again(head, staged, map.clone());
        } else {
            let flown = (&flight, map.clone());
            self.documents.begin_run(head, staged, flown);
        }
        self.documents.keep_given(given);
        if !again {
            self.take_place(host, map);
            if first {
                self.show_new_flight();
            }
        }
    }

    /// A flight that cannot be navigated is shown all the same; one that was flown before stays as it is.
    fn look_at_flight(&mut self, host: &mut dyn Host, why: &str) {
        let Some(fly) = &mut self.fly_work.job else {
            return;
        };
        if fly.again {
            self.fly_work.stop(host);
            let text = format!("{why} Everything open stays as it was.");
            self.toasts.trouble(host.now(), CANNOT_FLY, text);
            return;
        }
        let staged = std::mem::take(&mut fly.staged);
        let has_pictures = (staged.flight.as_ref()).is_some_and(|flight| !flight.frames.is_empty());
        let (flight, map, given) = (fly.flight.clone(), fly.map.clone(), fly.given);
        let is_first =
            self.documents.flight.measured.is_none() || self.documents.flight.source != flight;
        self.tell_of_replaced(&staged, host);
        self.documents.look_at(staged, &flight);
        self.documents.keep_given(given);
        self.take_place(host, map);
        if is_first {
            self.show_new_flight();
        }
        if let Some(log) = &mut self.documents.flight.log {
            log.unnavigable = Some(why.to_owned());
        }
        // Each picture may be found on a map by itself.
        let remedy = if has_pictures {
            " Open a map of the ground, then View, \u{201c}Lay photos on the map\u{201d}: that needs no heading."
        } else {
            ""
        };
        let text =
            format!("{why} Its track, its pictures and what was measured are shown.{remedy}");
        self.toasts
            .note(host.now(), "The flight cannot be navigated", text);
    }

    /// Shows the flight that was staged over its own map.
    fn take_place(&mut self, host: &mut dyn Host, map: MapSource) {
        self.stored.document_changed = true;
        self.change_map(host, map);
    }

    /// Puts the cursor at the start and the map over the flight.
    fn show_new_flight(&mut self) {
        self.selection = None;
        self.playback.selected_span = None;
        if let Some(time) = self.documents.first_look() {
            self.playback.time = time;
        }
        self.playback.playing = !self.is_flight_hidden() && !self.is_flight_aside();
        self.views.map.is_placed = false;
        // All of a recorded flight is shown at once, and all of a small world.
        let is_whole = match &self.documents.flight.source {
            FlightSource::Simulated(options) => options.world().is_shown_whole(),
            FlightSource::Files(_) => true,
            FlightSource::Rehearsed(_) | FlightSource::Studied(_) | FlightSource::Nothing => false,
        };
        self.map_work.fits_flight = is_whole && self.documents.map.info.is_none();
        if is_whole {
            self.fit_to_flight_and_map();
            return;
        }
        let map = &mut self.views.map;
        map.follow = true;
        if let Some(flight) = &self.documents.flight.measured {
            map.camera.center = flight.start.position;
        }
        if !USUAL_SCALES.contains(&map.camera.metres_per_point) {
            map.camera.metres_per_point = super::execute::USUAL_SCALE;
        }
    }

    /// Shows all of the flight and, unless it is far larger, all of the map.
    pub(super) fn fit_to_flight_and_map(&mut self) {
        if let Some(ground) = self.shown_feature().and_then(Feature::ground) {
            self.views.map.fit(ground);
            return;
        }
        let Some(flight) = self.flight_ground() else {
            return;
        };
        let map = self.documents.map.info.as_ref().map(|m| m.bounds);
        let size = |r: &GroundRect| r.width().max(r.height());
        let both = map.filter(|map| {
            let flown = size(&flight);
            flown < 30.0 || size(map) < 4.0 * flown
        });
        self.views
            .map
            .fit(both.map_or(flight, |map| flight.union(&map)));
    }

    /// The ground over which the flight goes, with its landmarks and what else its log tracks nearby.
    pub(super) fn flight_ground(&self) -> Option<GroundRect> {
        let documents = &self.documents;
        let truth = documents.flight.measured.iter().flat_map(|f| &f.truth);
        let truth = truth
            .flat_map(|t| t.states.iter().step_by(1 + t.states.len() / 500))
            .map(|s| GroundPoint::new(s.position.x, s.position.y));
        let steps = documents
            .run
            .navigated
            .iter()
            .flat_map(|r| r.steps.iter().step_by(1 + r.steps.len() / 500));
        let estimate = steps.map(|s| s.after.position());
        let landmarks = documents.mission.landmarks.iter().map(|l| l.reference);
        let flight = truth.chain(estimate).chain(landmarks);
        let layers = self.views.features.iter().flat_map(|it| it.layers());
        let beside = layers.flat_map(MapLayer::places);
        let near = GroundRect::centered(GroundPoint::default(), NEARBY, NEARBY);
        GroundRect::around(flight.chain(beside.filter(|place| near.contains(place))))
            .or_else(|| documents.map.info.as_ref().map(|m| m.bounds))
    }
}
