//! The open documents. Nothing else remembers what is shown.

use pilotage_core::calibration::CameraAdjustment;
use pilotage_core::flight::Flight;
use pilotage_core::frames::Geodetic;
use pilotage_core::mission::Mission;
use pilotage_core::navigator::{NavigatorSettings, Run};
use pilotage_core::simulate::SimulationChoice;

use super::empty_mission::empty_mission;
use super::{Brought, FlightDocument, LogFile, MapDocument, MissionDocument, RunDocument, Session};
use pilotage_jobs::{FlightSource, MapSource};

/// Seconds on the ground that are seen before a take-off.
const LEAD: f64 = 2.0;

/// Documents that a new flight brings before its run begins; swapped in at once, so that a flight that fails
/// early leaves everything as it was.
#[derive(Debug, Default)]
pub struct Staged {
    /// The flight.
    pub flight: Option<Flight>,
    /// The mission.
    pub mission: Option<Mission>,
    /// Adjustment of its camera and of the times of its pictures with which it is flown.
    pub camera_to_log: Option<CameraAdjustment>,
    /// Whether what was edited meanwhile is added to it.
    pub keeps_edits: bool,
    /// Its bookmarks, where they come with it.
    pub bookmarks: Option<Vec<f64>>,
}

impl Staged {
    /// Whether a mission that people edited and did not save makes room for its own, which undo takes back.
    pub fn replaces_unsaved(&self, mission: &MissionDocument) -> bool {
        let is_unsaved = mission.is_edited && !mission.history.is_saved();
        is_unsaved && self.mission.is_some() && !self.keeps_edits
    }
}

/// Everything that is open. What features found out about it is theirs.
#[derive(Debug)]
pub struct Documents {
    /// Mission that people author.
    pub mission: MissionDocument,
    /// Measured flight.
    pub flight: FlightDocument,
    /// Run of the navigator over it.
    pub run: RunDocument,
    /// Map below it.
    pub map: MapDocument,
}

impl Documents {
    /// Nothing flown yet; sources as the session says.
    pub fn new(session: &Session) -> Self {
        let mission = session.mission.clone().unwrap_or_else(empty_mission);
        let log = session.log.as_ref().and_then(|file| match &session.flight {
            FlightSource::Files(_) => Some(LogFile::named(file.clone())),
            _ => None,
        });
        Self {
            mission: MissionDocument::new(mission, session.mission.is_some()),
            flight: FlightDocument {
                log,
                bookmarks: session.bookmarks.clone(),
                ..FlightDocument::of_source(session.flight.clone())
            },
            run: RunDocument::default(),
            map: MapDocument::of_source(session.map.clone()),
        }
    }

    /// Opens a session in the place of what is open; what counts flights and runs goes on.
    pub fn replace(&mut self, session: &Session) {
        let left = std::mem::replace(self, Self::new(session));
        self.flight.generation = left.flight.generation + 1;
        self.run.generation = left.run.generation + 1;
        self.run.ghost_generation = left.run.ghost_generation;
    }

    /// Session to be remembered until the next visit.
    pub fn session(&self) -> Session {
        Session {
            flight: self.flight.source.clone(),
            map: self.map.source.clone(),
            mission: self.mission.is_edited.then(|| self.mission.clone()),
            bookmarks: self.flight.bookmarks.clone(),
            log: self.flight.log.as_ref().map(|log| log.file.clone()),
        }
    }

    /// Settings of the navigator as they are made for the flight: those of its scenario or study, else the default.
    pub fn usual_navigator(&self) -> NavigatorSettings {
        let choice = match &self.flight.source {
            FlightSource::Studied(studied) => {
                return studied.flight.navigator().unwrap_or_default();
            }
            FlightSource::Simulated(options) => SimulationChoice::named(&options.scenario),
            FlightSource::Files(_) | FlightSource::Rehearsed(_) | FlightSource::Nothing => None,
        };
        choice.map_or_else(NavigatorSettings::default, |choice| choice.navigator())
    }

    /// Title for the top bar.
    pub fn title(&self) -> String {
        let flight = match &self.flight.source {
            FlightSource::Simulated(options) => {
                let day = if options.other_day {
                    "another day"
                } else {
                    "same day"
                };
                let title = self.subject();
                format!("{title} · {day} · seed {}", options.seed)
            }
            FlightSource::Rehearsed(flight) => {
                format!("{} · rehearsal, seed {}", flight.name, flight.seed)
            }
            FlightSource::Studied(flight) => {
                format!("Run {} of the study “{}”", flight.run, flight.study)
            }
            FlightSource::Nothing => self.mission.name.clone(),
            FlightSource::Files(_) => self
                .flight
                .measured
                .as_ref()
                .map(|f| f.name.clone())
                .or_else(|| Some(self.flight.log.as_ref()?.file.clone()))
                .unwrap_or_else(|| "Opened files".to_owned()),
        };
        if self.mission.is_edited && !self.mission.history.is_saved() {
            format!("{flight} · edited")
        } else {
            flight
        }
    }

    /// Begins a run over a map: again of the flight that is open, so that its finished run becomes the ghost.
    pub fn begin_run_again(&mut self, head: Run, staged: Staged, over: MapSource) {
        self.run.haunt();
        self.take_staged(staged);
        self.run.show(Some(head), Some(over));
    }

    /// Begins the run of a flight over a map, which takes the place of the flight that was open.
    pub fn begin_run(
        &mut self,
        head: Run,
        staged: Staged,
        (source, over): (&FlightSource, MapSource),
    ) {
        self.look_at(staged, source);
        self.run.show(Some(head), Some(over));
    }

    fn take_staged(&mut self, staged: Staged) {
        if let Some(bookmarks) = staged.bookmarks {
            self.flight.add_bookmarks(bookmarks);
        }
        if let Some(flight) = staged.flight {
            self.flight.measured = Some(flight);
            self.flight.flown_camera = staged.camera_to_log.unwrap_or_default();
        }
        if let Some(mission) = staged.mission {
            let edited = self.mission.is_edited;
            if edited {
                self.mission.remember();
            } else {
                self.mission.history.clear();
            }
            let own = std::mem::replace(&mut self.mission.content, mission);
            self.mission.is_edited = false;
            if edited && staged.keeps_edits {
                self.add_all(vec![Brought {
                    routes: own.routes,
                    landmarks: own.landmarks,
                    no_fly: own.no_fly,
                    rally: own.rally,
                    roads: own.roads.to_vec(),
                }]);
            }
        }
    }

    /// Keeps the mission as one of its own where a flight was flown with one that was `given`: it is not edited by that,
    /// but neither is it the flight's own.
    pub fn keep_given(&mut self, given: bool) {
        if given && !self.mission.is_edited {
            self.mission.is_edited = true;
            let edits = self.mission.history.edits();
            self.mission.history.mark_saved(edits);
        }
    }

    /// Opens staged documents without a run: a flight that cannot be navigated, or none.
    pub fn look_at(&mut self, staged: Staged, source: &FlightSource) {
        self.flight.leave_for(source);
        self.run.leave();
        self.take_staged(staged);
    }

    /// Origin of the world frame, if what is open has a place on the globe.
    pub fn world_origin(&self) -> Option<Geodetic> {
        let flown = self.flight.measured.as_ref().and_then(|f| f.frame_on_globe);
        let own = self.mission.origin;
        let is_stated = own.latitude != 0.0 || own.longitude != 0.0;
        flown.map(|frame| frame.origin).or(is_stated.then_some(own))
    }

    /// Leaves the flight for a log, whose flight is yet to come. The mission stays.
    pub fn begin_log(&mut self, file: String, source: &FlightSource) {
        self.flight.leave_for(source);
        self.run.leave();
        self.flight.log = Some(LogFile::named(file));
    }

    /// Leaves the flight and begins an empty mission in a world of its own, one undo step away from the mission
    /// before.
    pub fn begin_world(&mut self, origin: Geodetic, name: &str) {
        self.mission.remember();
        self.mission.content = Mission {
            name: name.to_owned(),
            origin,
            camera: self.mission.camera.clone(),
            navigator: self.mission.navigator.clone(),
            ..empty_mission()
        };
        self.mission.is_edited = true;
        self.flight.leave();
        self.run.leave();
    }

    /// First and last time of the flight, or of the run if there is no flight.
    pub fn span(&self) -> Option<(f64, f64)> {
        let flight = self.flight.measured.as_ref().map(Flight::span);
        let run = self.run.navigated.as_ref().and_then(Run::span);
        match (flight, run) {
            (Some((a, b)), Some((c, _))) if a.is_finite() => Some((a.max(c), b)),
            (Some((a, b)), None) if a.is_finite() => Some((a, b)),
            (_, run) => run.or_else(|| self.flight.log.as_ref()?.span),
        }
    }

    /// Time at which every clock on the page stands at zero, seconds in the flight's time base.
    pub fn clock_zero(&self) -> f64 {
        self.span().map_or(0.0, |span| span.0)
    }

    /// Name of what is looked at: the flight as people chose it, or else the mission.
    pub fn subject(&self) -> &str {
        let chosen = match &self.flight.source {
            FlightSource::Simulated(options) => SimulationChoice::named(&options.scenario),
            _ => None,
        };
        match (chosen, &self.flight.measured) {
            (Some(choice), _) => choice.title,
            (None, Some(flight)) => &flight.name,
            (None, None) => &self.mission.name,
        }
    }

    /// Time at which looking at a flight begins: just before the take-off of a log, or else its start.
    pub fn first_look(&self) -> Option<f64> {
        let (first, last) = self.span()?;
        let take_off = self.flight.log.as_ref().and_then(|log| log.take_off);
        Some(take_off.map_or(first, |time| (time - LEAD).clamp(first, last)))
    }

    /// First and last time of the flight and of what its log holds around it.
    pub fn whole_span(&self) -> Option<(f64, f64)> {
        let log = self.flight.log.as_ref().and_then(|log| log.span);
        match (self.span(), log) {
            (Some((a, b)), Some((c, d))) => Some((a.min(c), b.max(d))),
            (span, log) => span.or(log),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flights_and_runs_are_counted_on_when_a_session_takes_the_place_of_what_is_open() {
        let mut documents = Documents::new(&Session::demo());
        documents.run.show(None, None);
        documents.flight.leave();
        let counts = |it: &Documents| (it.flight.generation, it.run.generation);
        assert_eq!(counts(&documents), (1, 1));
        documents.replace(&Session::demo());
        assert_eq!(counts(&documents), (2, 2));
    }
}
