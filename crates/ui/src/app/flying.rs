//! The flight that is flown in a worker, as it comes.

use pilotage_core::frames::{GroundPoint, GroundRect};

use super::App;
use super::pending_jobs::ShownFlight;
use crate::feature::Feature;
use crate::host::Host;
use crate::map::MapLayer;
use pilotage_jobs::{FlightSource, JobEvent, MapSource};

/// Scales of the map at which an aircraft can be followed, metres per point.
const USUAL_SCALES: std::ops::RangeInclusive<f64> = 0.25..=2.5;
/// Square around the origin in which other tracks of a log are fitted into the map, metres across.
const NEARBY: f64 = 20_000.0;
/// Title of the notice that a flight came to nothing.
const CANNOT_FLY: &str = "The flight cannot be flown";

impl App {
    /// Takes what the worker that flies says.
    pub(super) fn fly_event(&mut self, egui: &egui::Context, host: &mut dyn Host, event: JobEvent) {
        let Some(fly) = &mut self.jobs.fly else {
            return;
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
            JobEvent::RunStarted(head) => {
                let again = fly.again;
                let given = fly.given;
                let staged = std::mem::take(&mut fly.staged);
                let (flight, map) = (fly.flight.clone(), fly.map.clone());
                let first = !fly.began();
                fly.shown = ShownFlight::Run;
                if again {
                    self.documents.begin_run_again(*head, staged);
                } else {
                    self.documents.begin_run(*head, staged, &flight);
                }
                self.documents.mission_edited |= given;
                if !again {
                    self.take_place(host, map);
                    if first {
                        self.show_new_flight();
                    }
                }
            }
            JobEvent::CannotNavigate(why) => self.look_at_flight(host, &why),
            JobEvent::Steps(_) if fly.shown == ShownFlight::Pictures => {}
            JobEvent::Steps(mut steps) => {
                if let Some(run) = &mut self.documents.run {
                    run.steps.append(&mut steps);
                }
            }
            JobEvent::FrameTaken { index, .. } => {
                let was_taken = self.documents.pictures.take(index);
                if was_taken && !fly.again {
                    self.views.camera.forget(index);
                }
            }
            // It could not be navigated, and all of its pictures are there.
            JobEvent::Finished if !fly.began() => {
                self.jobs.fly = None;
                self.tell_of_run_over(false, egui, host);
            }
            JobEvent::Finished => {
                let again = fly.again;
                self.documents.run_complete = true;
                self.jobs.fly = None;
                // Where a recorded flight went may be known only now.
                if !again && self.views.map.is_fitted() && !self.is_flight_hidden() {
                    self.fit_to_flight_and_map();
                }
                self.tell_of_run_over(true, egui, host);
            }
            JobEvent::Cancelled => self.jobs.fly = None,
            JobEvent::Failed(why) => {
                let began = fly.began();
                let is_of_log = self.documents.flight_source == fly.flight && !fly.again;
                self.jobs.fly = None;
                self.tell_of_run_over(false, egui, host);
                self.documents.run_complete |= began;
                let log = self.documents.log.as_mut().filter(|_| is_of_log);
                let kept = if began {
                    "What had been computed stays."
                } else if let Some(log) = log {
                    if let Some((first, _)) = log.span {
                        self.playback.time = first;
                    }
                    log.unnavigable = Some(why.clone());
                    "What was measured can be plotted all the same."
                } else {
                    "Everything open stays as it was."
                };
                let text = format!("{why} {kept}");
                self.toasts.trouble(host.now(), CANNOT_FLY, text);
            }
            _ => {}
        }
    }

    /// A flight that cannot be navigated is shown all the same; one that was flown before stays as it is.
    fn look_at_flight(&mut self, host: &mut dyn Host, why: &str) {
        let Some(fly) = &mut self.jobs.fly else {
            return;
        };
        if fly.again {
            self.stop_flying(host);
            let text = format!("{why} Everything open stays as it was.");
            self.toasts.trouble(host.now(), CANNOT_FLY, text);
            return;
        }
        let staged = std::mem::take(&mut fly.staged);
        let (flight, map, given) = (fly.flight.clone(), fly.map.clone(), fly.given);
        let is_first = self.documents.flight.is_none() || self.documents.flight_source != flight;
        self.documents.look_at(staged, &flight);
        self.documents.mission_edited |= given;
        self.take_place(host, map);
        if is_first {
            self.show_new_flight();
        }
        if let Some(log) = &mut self.documents.log {
            log.unnavigable = Some(why.to_owned());
        }
        let text = format!("{why} Its track, its pictures and what was measured are shown.");
        self.toasts
            .note(host.now(), "The flight cannot be navigated", text);
    }

    /// Shows the flight that was staged over its own map.
    fn take_place(&mut self, host: &mut dyn Host, map: MapSource) {
        self.jobs.document_changed = true;
        self.change_map(host, map);
    }

    /// Puts the cursor at the start and the map over the flight.
    fn show_new_flight(&mut self) {
        self.selection = None;
        self.playback.selected_span = None;
        if let Some((first, _)) = self.documents.span() {
            self.playback.time = first;
        }
        self.playback.playing = !self.is_flight_hidden() && !self.is_flight_aside();
        self.views.map.is_placed = false;
        // All of a recorded flight is shown at once, and all of a small world.
        let is_whole = match &self.documents.flight_source {
            FlightSource::Simulated(options) => options.world().is_shown_whole(),
            FlightSource::Files(_) => true,
            FlightSource::Rehearsed(_) | FlightSource::Nothing => false,
        };
        self.map_work.fits_flight = is_whole && self.documents.map.is_none();
        if is_whole {
            self.fit_to_flight_and_map();
            return;
        }
        let map = &mut self.views.map;
        map.follow = true;
        if let Some(flight) = &self.documents.flight {
            map.camera.center = flight.start.position;
        }
        if !USUAL_SCALES.contains(&map.camera.metres_per_point) {
            map.camera.metres_per_point = 0.7;
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
        let map = self.documents.map.as_ref().map(|m| m.bounds);
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
        let truth = documents.flight.iter().flat_map(|f| &f.truth);
        let truth = truth
            .flat_map(|t| t.states.iter().step_by(1 + t.states.len() / 500))
            .map(|s| GroundPoint::new(s.position.x, s.position.y));
        let steps = documents
            .run
            .iter()
            .flat_map(|r| r.steps.iter().step_by(1 + r.steps.len() / 500));
        let estimate = steps.map(|s| s.after.position());
        let landmarks = documents.mission.landmarks.iter().map(|l| l.reference);
        let flight = truth.chain(estimate).chain(landmarks);
        let layers = self.views.features.iter().flat_map(|it| it.layers());
        let beside = layers.flat_map(MapLayer::places);
        let near = GroundRect::centered(GroundPoint::default(), NEARBY, NEARBY);
        GroundRect::around(flight.chain(beside.filter(|place| near.contains(place))))
            .or_else(|| documents.map.as_ref().map(|m| m.bounds))
    }
}
