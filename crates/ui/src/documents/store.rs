//! The open documents. Nothing else remembers what is shown.

use pilotage_core::calibration::CameraAdjustment;
use pilotage_core::flight::Flight;
use pilotage_core::frames::Geodetic;
use pilotage_core::mission::{Mission, Route};
use pilotage_core::navigator::{NavigatorSettings, Run};
use pilotage_core::simulate::SimulationChoice;

use super::empty_mission::empty_mission;
use super::{Brought, FramePictures, History, LogFile, Noticed, OpenedTerrain, Session};
use crate::context::route_of;
use crate::short_map::ShortMap;
use crate::views::Examined;
use pilotage_jobs::{Distinctness, FlightSource, MapInfo, MapSource};

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
}

/// Everything that is open.
#[derive(Debug)]
pub struct Documents {
    /// Mission that people author.
    pub mission: Mission,
    /// Whether the mission differs from the scenario's own.
    pub mission_edited: bool,
    /// The selected route's id.
    pub route: Option<u32>,
    /// Its undo steps.
    pub history: History,
    /// Measured flight.
    pub flight: Option<Flight>,
    /// Run of the navigator so far.
    pub run: Option<Run>,
    /// Whether the run is complete.
    pub run_complete: bool,
    /// Counts flights: whatever was found out about another one is of no use any more.
    pub flight_generation: u64,
    /// Counts runs, so that caches know when another one is shown.
    pub run_generation: u64,
    /// The run before the last change.
    pub ghost: Option<Run>,
    /// The ghost's generation.
    pub ghost_generation: u64,
    /// Encoded camera pictures by frame index.
    pub pictures: FramePictures,
    /// Source of the flight.
    pub flight_source: FlightSource,
    /// Source of the map.
    pub map_source: MapSource,
    /// Description of the map.
    pub map: Option<MapInfo>,
    /// The height of the ground.
    pub terrain: OpenedTerrain,
    /// Distinctness of landmarks, by id; true only while the box is the same.
    pub distinctness: ShortMap<u32, Distinctness>,
    /// The landmark that could not be examined, and why.
    pub examined_in_vain: Option<(u32, String)>,
    /// The log that the flight was read from.
    pub log: Option<LogFile>,
    /// Adjustment of the camera with which the flight was flown.
    pub flown_camera: CameraAdjustment,
    /// Findings in the run.
    pub noticed: Noticed,
    /// Bookmarks in time order, seconds in the flight's time base.
    pub bookmarks: Vec<f64>,
}

impl Documents {
    /// A mission with nothing in it.
    pub fn empty_mission() -> Mission {
        empty_mission()
    }

    /// Nothing flown yet; sources as the session says.
    pub fn new(session: &Session) -> Self {
        Self {
            mission: session.mission.clone().unwrap_or_else(Self::empty_mission),
            mission_edited: session.mission.is_some(),
            route: None,
            history: History::default(),
            flight: None,
            run: None,
            run_complete: false,
            flight_generation: 0,
            run_generation: 0,
            ghost: None,
            ghost_generation: 0,
            pictures: FramePictures::default(),
            flight_source: session.flight.clone(),
            map_source: session.map.clone(),
            map: None,
            terrain: OpenedTerrain::default(),
            distinctness: ShortMap::default(),
            examined_in_vain: None,
            log: session.log.as_ref().and_then(|file| match &session.flight {
                FlightSource::Files(_) => Some(LogFile::named(file.clone())),
                _ => None,
            }),
            flown_camera: CameraAdjustment::default(),
            noticed: Noticed::default(),
            bookmarks: session.bookmarks.clone(),
        }
    }

    /// The selected route.
    pub fn selected_route(&self) -> Option<&Route> {
        route_of(&self.mission, self.route?)
    }

    /// Session to be remembered until the next visit.
    pub fn session(&self) -> Session {
        Session {
            flight: self.flight_source.clone(),
            map: self.map_source.clone(),
            mission: self.mission_edited.then(|| self.mission.clone()),
            bookmarks: self.bookmarks.clone(),
            log: self.log.as_ref().map(|log| log.file.clone()),
        }
    }

    /// Whether the map shows ground that was photographed.
    pub fn has_real_map(&self) -> bool {
        !matches!(self.map_source, MapSource::Nothing | MapSource::World(_))
    }

    /// Who made the map, to be shown with it; `None` if nobody said.
    pub fn attribution(&self) -> Option<&str> {
        match &self.map_source {
            MapSource::Web(map) => Some(&map.template.attribution),
            _ => self.map.as_ref()?.attribution.as_deref(),
        }
    }

    /// Settings of the navigator as they are made for the flight: those of its scenario or study, else the default.
    pub fn usual_navigator(&self) -> NavigatorSettings {
        let choice = match &self.flight_source {
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
        let flight = match &self.flight_source {
            FlightSource::Simulated(options) => {
                let day = if options.other_day {
                    "another day"
                } else {
                    "same day"
                };
                let choice = SimulationChoice::named(&options.scenario);
                let title = choice.map_or(options.scenario.as_str(), |choice| choice.title);
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
                .as_ref()
                .map(|f| f.name.clone())
                .or_else(|| Some(self.log.as_ref()?.file.clone()))
                .unwrap_or_else(|| "Opened files".to_owned()),
        };
        if self.mission_edited && !self.history.is_saved() {
            format!("{flight} · edited")
        } else {
            flight
        }
    }

    /// Begins a run: again of the flight that is open, so that its finished run becomes the ghost.
    pub fn begin_run_again(&mut self, head: Run, staged: Staged) {
        if self.run_complete
            && let Some(old) = self.run.take()
        {
            self.ghost = Some(old);
            self.ghost_generation = self.run_generation;
        }
        self.take_staged(staged);
        self.show_run(Some(head));
    }

    /// Begins the run of a flight, which takes the place of the flight that was open.
    pub fn begin_run(&mut self, head: Run, staged: Staged, source: &FlightSource) {
        self.leave_flight_for(source);
        self.take_staged(staged);
        self.show_run(Some(head));
    }

    fn show_run(&mut self, head: Option<Run>) {
        self.run = head;
        self.run_complete = false;
        self.run_generation += 1;
    }

    /// Leaves the flight that is open for that of `source`. Log and bookmarks stay if it is the same.
    fn leave_flight_for(&mut self, source: &FlightSource) {
        let is_same = self.flight_source == *source;
        let (log, bookmarks) = (self.log.take(), std::mem::take(&mut self.bookmarks));
        self.leave_flight();
        if is_same {
            (self.log, self.bookmarks) = (log, bookmarks);
        }
        self.flight_source.clone_from(source);
    }

    /// Forgets the flight with everything that was found out about it. Every field is named here, so that a new one
    /// has to say whether it belongs to the flight.
    fn leave_flight(&mut self) {
        let Self {
            // What people author or opened beside the flight.
            mission: _,
            mission_edited: _,
            route: _,
            history: _,
            map_source: _,
            map: _,
            terrain: _,
            // The flight.
            flight,
            flight_source,
            log,
            bookmarks,
            pictures,
            run,
            run_complete,
            ghost,
            distinctness,
            examined_in_vain,
            flown_camera,
            noticed,
            // Counters.
            flight_generation,
            run_generation,
            ghost_generation: _,
        } = self;
        (*flight, *run, *ghost, *log) = (None, None, None, None);
        *flight_source = FlightSource::Nothing;
        *run_complete = false;
        bookmarks.clear();
        pictures.clear();
        distinctness.clear();
        *examined_in_vain = None;
        *flown_camera = CameraAdjustment::default();
        *noticed = Noticed::default();
        *flight_generation += 1;
        *run_generation += 1;
    }

    fn take_staged(&mut self, staged: Staged) {
        if let Some(flight) = staged.flight {
            self.flight = Some(flight);
            self.flown_camera = staged.camera_to_log.unwrap_or_default();
        }
        if let Some(mission) = staged.mission {
            let edited = staged.keeps_edits && self.mission_edited;
            let own = std::mem::replace(&mut self.mission, mission);
            self.history.clear();
            self.mission_edited = false;
            if edited {
                self.add_all(vec![Brought {
                    routes: own.routes,
                    landmarks: own.landmarks,
                    no_fly: own.no_fly,
                    rally: own.rally,
                    roads: own.roads,
                }]);
            }
        }
    }

    /// Opens staged documents without a run: a flight that cannot be navigated, or none.
    pub fn look_at(&mut self, staged: Staged, source: &FlightSource) {
        self.leave_flight_for(source);
        self.take_staged(staged);
    }

    /// Origin of the world frame, if what is open has a place on the globe.
    pub fn world_origin(&self) -> Option<Geodetic> {
        let flown = self.flight.as_ref().and_then(|f| f.frame_on_globe);
        let own = self.mission.origin;
        let is_stated = own.latitude != 0.0 || own.longitude != 0.0;
        flown.map(|frame| frame.origin).or(is_stated.then_some(own))
    }

    /// Leaves the flight for a log, whose flight is yet to come. The mission stays.
    pub fn begin_log(&mut self, file: String, source: &FlightSource) {
        self.leave_flight_for(source);
        self.log = Some(LogFile::named(file));
    }

    /// Leaves the flight and begins an empty mission in a world of its own, one undo step away from the mission
    /// before.
    pub fn begin_world(&mut self, origin: Geodetic, name: &str) {
        self.history.remember(&self.mission);
        self.mission = Mission {
            name: name.to_owned(),
            origin,
            camera: self.mission.camera.clone(),
            navigator: self.mission.navigator.clone(),
            ..Self::empty_mission()
        };
        self.mission_edited = true;
        self.leave_flight();
    }

    /// First and last time of the flight, or of the run if there is no flight.
    pub fn span(&self) -> Option<(f64, f64)> {
        let flight = self.flight.as_ref().map(Flight::span);
        let run = self.run.as_ref().and_then(Run::span);
        match (flight, run) {
            (Some((a, b)), Some((c, _))) if a.is_finite() => Some((a.max(c), b)),
            (Some((a, b)), None) if a.is_finite() => Some((a, b)),
            (_, run) => run.or_else(|| self.log.as_ref()?.span),
        }
    }

    /// Time at which every clock on the page stands at zero, seconds in the flight's time base.
    pub fn clock_zero(&self) -> f64 {
        self.span().map_or(0.0, |span| span.0)
    }

    /// Name of what is looked at, for files: the flight, or else the mission.
    pub fn subject(&self) -> &str {
        let flight = self.flight.as_ref();
        flight.map_or(&self.mission.name, |flight| &flight.name)
    }

    /// Time at which looking at a flight begins: just before the take-off of a log, or else its start.
    pub fn first_look(&self) -> Option<f64> {
        let (first, last) = self.span()?;
        let take_off = self.log.as_ref().and_then(|log| log.take_off);
        Some(take_off.map_or(first, |time| (time - LEAD).clamp(first, last)))
    }

    /// First and last time of the flight and of what its log holds around it.
    pub fn whole_span(&self) -> Option<(f64, f64)> {
        let log = self.log.as_ref().and_then(|log| log.span);
        match (self.span(), log) {
            (Some((a, b)), Some((c, d))) => Some((a.min(c), b.max(d))),
            (span, log) => span.or(log),
        }
    }

    /// The distinctness of a landmark, while its box is still the one that was examined.
    pub fn distinctness_of(&self, id: u32) -> Option<&Distinctness> {
        let bounds = self.mission.landmark(id)?.bounds;
        self.distinctness.get(&id).filter(|d| d.bounds == bounds)
    }

    /// Distinctness of the selected landmark, as far as it is known.
    pub fn examined(&self, selection: Option<u32>) -> Examined<'_> {
        let in_vain = self.examined_in_vain.as_ref();
        Examined {
            found: selection.and_then(|id| self.distinctness_of(id)),
            trouble: in_vain
                .filter(|(id, _)| selection == Some(*id))
                .map(|(_, why)| why.as_str()),
        }
    }
}
