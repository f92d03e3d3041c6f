//! Features: parts of the app with a panel, commands, jobs and a layer on the map of their own. The app holds a list
//! of them and knows none by name; a new one is a folder and a line in `lib.rs`.

use egui::{Rect, Ui};
use pilotage_core::exchange::FlownValues;
use pilotage_core::flight::overview::Finding;
use pilotage_core::flight::photo::PhotoSearch;
use pilotage_core::frames::GroundRect;
use pilotage_jobs::{
    Beside, FlightSource, Job, JobEvent, JobId, MapSource, OpenedFiles, TrackSeries,
};
use serde_json::Value;

use crate::command::{Command, Workspace};
use crate::context::{DrawnTimes, ViewContext};
use crate::documents::kept::provide;
use crate::documents::{Documents, Session, ViewState};
pub use crate::feature_command::{FeatureAction, FeatureCommand, FeatureId};
pub use crate::feature_wishes::{FeatureWishes, FlightFiles, FlightWish, OpenedSet, PanelWish};
use crate::host::{Host, OpenedFile};
use crate::job_owners::JobOwner;
use crate::map::{MapButton, MapLayer, MapTool, MapView};
use crate::shell::catalog::CommandEntry;
use crate::shell::icons::Icon;
use crate::shell::{CommandLack, NextStep, Toasts};
use crate::timeline::Playback;
use crate::units::Units;
use crate::views::{CameraView, Examined};

/// Place of a feature's panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeaturePlace {
    /// A tab of the column at the right, below the camera picture.
    Tab,
    /// The whole column at the right, while it is shown.
    Sheet,
    /// The column at the right of a workspace that is its own.
    Workspace(Workspace),
    /// A tab in front of all others, whose panel scrolls by itself.
    FirstTab,
    /// A tab behind the camera picture, for what is seen in that, whose panel scrolls by itself.
    PictureTab,
    /// A column beside the picture with which it fills the window, while it takes that, in a workspace.
    Window(Workspace),
    /// A column beside the map and what it draws beside that, in the place of everything else, while it takes the
    /// window.
    BesideMap,
    /// A dialog over everything, which it draws itself while that is open.
    Dialog,
    /// No place: it has no panel; its tool has the map of any workspace before that of the workspace.
    Nowhere,
}

/// Description of a feature for whoever lists features.
#[derive(Debug)]
pub struct FeatureInfo {
    /// Identity.
    pub id: FeatureId,
    /// Name on its tab in the column at the right.
    pub tab: &'static str,
    /// Place of its panel.
    pub place: FeaturePlace,
    /// Its rows of the table of all commands.
    pub commands: fn() -> Vec<CommandEntry>,
}

/// Lack for which `command` can do nothing now, to an edit or a bookmark, or as the feature says that it is for.
pub fn lack(
    command: &Command,
    features: &[Box<dyn Feature>],
    documents: &Documents,
    selected: Option<u32>,
) -> Option<CommandLack> {
    let (past, future) = documents.mission.history.depth();
    let (is_there, what, advice) = match command {
        Command::Feature(command) => {
            let owner = features.iter().find(|it| it.info().id == command.to())?;
            return owner.missing(command, documents, selected);
        }
        Command::Undo => (past > 0, "Nothing to undo", ""),
        Command::Redo => (future > 0, "Nothing to redo", ""),
        Command::DeleteSelectedLandmark => (
            selected.is_some(),
            "No landmark is selected",
            "Click one on the map or in the list.",
        ),
        Command::PreviousBookmark | Command::NextBookmark => (
            !documents.flight.bookmarks.is_empty(),
            "No bookmark",
            "Set one with B.",
        ),
        _ => return None,
    };
    CommandLack::unless(is_there, what, advice)
}

/// Button of a feature on the camera picture.
#[derive(Clone, Debug)]
pub struct PictureButton {
    /// Sign.
    pub icon: Icon,
    /// Action in words, with its key.
    pub label: &'static str,
    /// Command that it gives.
    pub command: Command,
}

/// Part of the app that a feature may use while it does something.
pub struct FeatureContext<'a> {
    /// Documents that are open.
    pub documents: &'a mut Documents,
    /// Time cursor.
    pub playback: &'a mut Playback,
    /// Selected landmark.
    pub selection: &'a mut Option<u32>,
    /// Map view.
    pub map: &'a mut MapView,
    /// View state that is remembered between visits.
    pub view: &'a mut ViewState,
    /// Notices.
    pub toasts: &'a mut Toasts,
    /// Services of the shell.
    pub host: &'a mut dyn Host,
    /// Toolkit, for textures and repainting.
    pub egui: &'a egui::Context,
    /// Feature that does it.
    pub own: FeatureId,
    /// Whether its panel is shown.
    pub is_shown: bool,
    /// Files of the set with a key, if the browser keeps them.
    pub kept: &'a dyn Fn(&str) -> Option<Vec<OpenedFile>>,
    /// Features before it in the list of all, and those behind it.
    pub beside: [&'a [Box<dyn Feature>]; 2],
    /// Wishes that the app fulfils once the feature is done.
    pub wishes: FeatureWishes,
}

impl FeatureContext<'_> {
    /// Starts a job whose events come to the feature.
    pub fn start(&mut self, job: Job) -> JobId {
        self.host.start(JobOwner::Feature(self.own), job)
    }

    /// Stops a job; nothing more of it comes to the feature.
    pub fn cancel(&mut self, job: JobId) {
        self.host.leave(job);
    }

    /// Waits no more for a job that has given its answer, and lets it end by itself; nothing more of it comes to the feature.
    pub fn wait_no_more(&mut self, job: JobId) {
        self.host.owners().leave(job);
    }

    /// Tells people something.
    pub fn note(&mut self, title: &str, text: impl Into<String>) {
        let now = self.host.now();
        self.toasts.note(now, title, text);
    }

    /// Tells people of something that failed.
    pub fn trouble(&mut self, title: &str, text: impl Into<String>) {
        let now = self.host.now();
        self.toasts.trouble(now, title, text);
    }

    /// Opens the feature's panel.
    pub fn show(&mut self) {
        self.wishes.panel = Some(PanelWish::Shown);
    }

    /// Shows something else in the place of its panel.
    pub fn hide(&mut self) {
        self.wishes.panel = Some(PanelWish::Hidden);
    }

    /// Says that the mission changed in a way that changes the run.
    pub fn run_is_stale(&mut self) {
        self.wishes.is_run_stale = true;
    }

    /// Says that the worker which read the log answered a question about it with an error: it may have it no more.
    pub fn lose_log(&mut self) {
        self.wishes.is_log_lost = true;
    }

    /// Says that something changed that is stored with the documents.
    pub fn document_changed(&mut self) {
        self.wishes.is_document_changed = true;
    }

    /// Has the tools of others leave the map.
    pub fn take_map(&mut self) {
        self.map.picking = false;
        self.ask(Command::LeaveMap(self.own));
    }

    /// Asks the app, or another feature, to do something once this is over.
    pub fn ask(&mut self, command: impl Into<Command>) {
        self.wishes.commands.push(command.into());
    }

    /// Selects a landmark that was just made, and has people name it.
    pub fn present(&mut self, landmark: u32) {
        self.wishes.presented = Some(landmark);
    }

    /// Opens the feature's panel wherever the flight is looked at, unless one is shown that takes the whole column.
    pub fn offer(&mut self) {
        self.wishes.panel = Some(PanelWish::Offered);
    }

    /// Stops what is being flown; what has streamed in stays.
    pub fn stop_flying(&mut self) {
        self.wishes.flight = Some(FlightWish::Nothing);
    }

    /// Shows another map.
    pub fn change_map(&mut self, map: MapSource) {
        self.wishes.map = Some(map);
    }

    /// Flies a flight of files over `map`.
    pub fn fly(&mut self, flight: FlightFiles, map: MapSource) {
        self.wishes.flight = Some(FlightWish::Read(Box::new((flight, map))));
    }

    /// Flies a flight over `map` with the mission that is open.
    pub fn fly_over(&mut self, flight: FlightSource, map: MapSource) {
        self.wishes.flight = Some(FlightWish::Open(Box::new((flight, map))));
    }

    /// Flies a flight over `map` with the mission that comes with it.
    pub fn fly_own(&mut self, flight: FlightSource, map: MapSource) {
        self.wishes.flight = Some(FlightWish::Own(Box::new((flight, map))));
    }

    /// Gives the workers files, and has the browser keep them for the next visit.
    pub fn provide(&mut self, set: OpenedSet) {
        provide(self.host, &set.key, &set.files);
        self.keep(set);
    }

    /// Has the browser keep files, which the workers have, for the next visit.
    pub fn keep(&mut self, set: OpenedSet) {
        self.wishes.kept.push(set);
    }

    /// Opens files as if people had chosen them.
    pub fn open(&mut self, files: Vec<OpenedFile>) {
        self.wishes.opened.push(files);
    }

    /// Has whoever reads flights read one in opened files, which is flown then.
    pub fn read(&mut self, flight: FlightFiles) {
        self.wishes.read = Some(flight);
    }

    /// Opens a session in the place of what is open.
    pub fn open_session(&mut self, session: Session) {
        self.wishes.session = Some(session);
    }

    /// Every other feature, in the order of the list of all.
    pub fn others(&self) -> impl Iterator<Item = &dyn Feature> {
        let [before, behind] = self.beside;
        before.iter().chain(behind).map(AsRef::as_ref)
    }
}

/// All that features found out about how the selected landmark stands out from the map.
pub fn examined<'a>(
    features: &'a [Box<dyn Feature>],
    selection: Option<u32>,
    documents: &Documents,
) -> Examined<'a> {
    let known = selection.and_then(|id| {
        let mut told = features.iter().filter_map(|it| it.examined(id, documents));
        told.next()
    });
    known.unwrap_or_default()
}

/// Part of the app with a panel, commands, jobs and a layer on the map of its own.
pub trait Feature {
    /// Description.
    fn info(&self) -> &'static FeatureInfo;

    /// Carries out a command that is addressed to it; false if it is none of its own.
    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool;

    /// Lack for which a command of its own can do nothing now, in the documents, the landmark that is selected or itself.
    fn missing(
        &self,
        _command: &FeatureCommand,
        _documents: &Documents,
        _selected: Option<u32>,
    ) -> Option<CommandLack> {
        None
    }

    /// Draws its panel.
    fn panel(&mut self, _ui: &mut Ui, _context: &mut ViewContext<'_>, _documents: &Documents) {}

    /// Its layers on the map.
    fn layers(&self) -> Vec<&dyn MapLayer> {
        Vec::new()
    }

    /// Takes an event of a job that it started; whether it waits for that job, and for events of that kind. One that
    /// nobody waits for is a fault of the program, and told: a feature waits for a job until its last event, or says that
    /// it waits no more.
    fn on_event(
        &mut self,
        _job: JobId,
        _event: JobEvent,
        _context: &mut FeatureContext<'_>,
    ) -> bool {
        false
    }

    /// Stops its work because people asked for that; whether there was any.
    fn stop(&mut self, _context: &mut FeatureContext<'_>) -> bool {
        false
    }

    /// Forgets everything that belonged to the flight that was open: another one is.
    fn on_flight_changed(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Does what is due, once a frame.
    fn tend(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Takes note that the run that was under way is over, whole or not.
    fn on_run_over(&mut self, _is_whole: bool, _context: &mut FeatureContext<'_>) {}

    /// All that it found out about how a landmark stands out from the map.
    fn examined(&self, _landmark: u32, _documents: &Documents) -> Option<Examined<'_>> {
        None
    }

    /// Findings about the flight, to be told with those of its log.
    fn findings(&self, _documents: &Documents) -> Vec<Finding> {
        Vec::new()
    }

    /// State of what is on screen, for journeys; null if there is nothing.
    fn state(&self, _documents: &Documents) -> Value {
        Value::Null
    }

    /// Takes up its part of what is remembered between visits, a JSON object.
    fn restore(&mut self, _saved: &str) {}

    /// Its part of what is remembered between visits, a JSON object; `None` if there is nothing.
    fn save(&self) -> Option<String> {
        None
    }

    /// Takes up what it stored at an earlier visit itself, once, as the app starts.
    fn start(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Hears of a command of the app before it is carried out; true if it is done here in the app's place.
    fn intercept(&mut self, _command: &Command, _context: &mut FeatureContext<'_>) -> bool {
        false
    }

    /// Leaves the map, whose next clicks are for another tool.
    fn leave_map(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Tool that has the map now; of the owner of a workspace, while that is open, or of a feature without a place.
    fn tool(&mut self) -> Option<&mut dyn MapTool> {
        None
    }

    /// Whether its workspace is about something else than the flight, which waits and is not shown meanwhile.
    fn hides_flight(&self) -> bool {
        false
    }

    /// Draws its panel below the map: in a workspace that hides the flight, or where it has plots of that.
    fn plots(&mut self, _ui: &mut Ui, _context: &mut ViewContext<'_>, _documents: &Documents) {}

    /// Draws over the map of its workspace, or of any if it has no place, which takes `rect` of the screen; the parts
    /// that it covers.
    fn over_map(&self, _ui: &mut Ui, _rect: Rect, _context: &mut ViewContext<'_>) -> Vec<Rect> {
        Vec::new()
    }

    /// Its workspace in a sentence or two, for screen readers.
    fn summary(&self, _documents: &Documents, _units: Units) -> Option<String> {
        None
    }

    /// Takes its part of what files turned out to hold; `file` is what people call them.
    fn take_opened(
        &mut self,
        _file: &str,
        _opened: &mut OpenedFiles,
        _context: &mut FeatureContext<'_>,
    ) {
    }

    /// Puts what is to be saved with the mission beside it.
    fn put_beside(&self, _beside: &mut Beside, _documents: &Documents) {}

    /// Takes its part of what was saved beside a mission that was opened.
    fn take_beside(&mut self, _beside: &mut Beside) {}

    /// Progress of its work that people wait for, 0 to 1, and its words.
    fn progress(&self) -> Option<(f32, &str)> {
        None
    }

    /// Whether its tab is there.
    fn has_tab(&self) -> bool {
        true
    }

    /// Whether it has plots of the flight for the panel below the map.
    fn has_plots(&self) -> bool {
        false
    }

    /// Whether it has something to show in the strip below the map of its workspace; the map has the room otherwise.
    fn fills_strip(&self, _documents: &Documents) -> bool {
        true
    }

    /// Whether the plots of the run are shown beneath what it drew there.
    fn leaves_room_for_run(&self) -> bool {
        true
    }

    /// Whether what is open has no place, so that nothing lies on the map and its plots get the room.
    fn leaves_map_empty(&self, _documents: &Documents) -> bool {
        false
    }

    /// Reads a flight in opened files, which is flown once it is read.
    fn read_flight(&mut self, _files: &FlightFiles, _context: &mut FeatureContext<'_>) {}

    /// Leaves a flight that it prepares: another one is about to be flown.
    fn on_other_flight(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Keys of the opened files that it needs beside those of the documents.
    fn used_files(&self) -> Vec<&str> {
        Vec::new()
    }

    /// Reads the log that is open again, if it is the one who read it: no worker may have it any more.
    fn on_log_lost(&mut self) {}

    /// Series of the log whose values are to be saved beside the flown track, and what they are called there.
    fn series_along(&self) -> Option<(FlownValues, TrackSeries)> {
        None
    }

    /// Whether it fills the window in the place of map and columns, wherever it may.
    fn takes_window(&self) -> bool {
        false
    }

    /// Fills the window, but for the column of its panel and the map if its place is beside that.
    fn window(
        &mut self,
        _ui: &mut Ui,
        _context: &mut ViewContext<'_>,
        _documents: &Documents,
        _camera: &mut CameraView,
    ) {
    }

    /// Its button on the camera picture of a flight.
    fn picture_button(&self) -> Option<PictureButton> {
        None
    }

    /// Photo that is looked at in it: key of the files that it is among, its name, and what is known of it better than it
    /// tells.
    fn photo(&self) -> Option<(&str, &str, &PhotoSearch)> {
        None
    }

    /// Draws what lies over everything while it is open: a dialog.
    fn overlay(&mut self, _ui: &mut Ui, _context: &mut ViewContext<'_>, _documents: &Documents) {}

    /// Times of what its panel drew last, if it draws what belongs to the cursor.
    fn drawn(&self) -> Option<DrawnTimes> {
        None
    }

    /// Takes note that people asked for its panel, which is shown from now on.
    fn on_shown(&mut self, _context: &mut FeatureContext<'_>) {}

    /// Looks at what files turned out to hold before anything of it is opened; true if all of it is its own.
    fn take_first(
        &mut self,
        _set: &OpenedSet,
        _opened: &mut OpenedFiles,
        _context: &mut FeatureContext<'_>,
    ) -> bool {
        false
    }

    /// Whether its panel is about something else than the flight, which neither plays unasked nor is plotted unasked
    /// while that is shown.
    fn leaves_flight_aside(&self) -> bool {
        false
    }

    /// Ground to which the map is fitted in the place of the flight's while its panel is shown.
    fn ground(&self) -> Option<GroundRect> {
        None
    }

    /// Whether people see by it what to do with what is open, and need no advice.
    fn needs_no_advice(&self) -> bool {
        false
    }

    /// Takes files that were opened for it alone, before anybody looks at what they hold; whether they are its own.
    fn take_files(&mut self, _set: &OpenedSet, _context: &mut FeatureContext<'_>) -> bool {
        false
    }

    /// Whether a dialog of it lies over everything, or a tool of it has the map, which Escape closes.
    fn is_open_over(&self) -> bool {
        false
    }

    /// Whether letters are for its dialog, even before a field of that has the keyboard.
    fn takes_letters(&self) -> bool {
        false
    }

    /// Whether the camera picture stays in the column of its workspace, below its panel, where the window is wide.
    fn keeps_picture(&self) -> bool {
        false
    }

    /// Draws a line of advice over the map of the flight, which takes `rect` of the screen, unless the workspace is a
    /// feature's own; the part that it covers.
    fn advice(
        &self,
        _ui: &mut Ui,
        _rect: Rect,
        _context: &mut ViewContext<'_>,
        _documents: &Documents,
    ) -> Option<Rect> {
        None
    }

    /// Its button among the controls of the map.
    fn map_button(&self) -> Option<MapButton> {
        None
    }

    /// Page of its workspace that is shown, from 0, if there are several: Back and Forward move between them.
    fn page(&self) -> Option<usize> {
        None
    }

    /// Shows a page of its workspace; the last one where there are not so many.
    fn turn_to(&mut self, _page: usize) {}

    /// Step that comes next in a workspace, as the one button that stands out in the top bar; that of the first feature
    /// that knows one is taken.
    fn next_step(&self, _workspace: Workspace, _documents: &Documents) -> Option<NextStep> {
        None
    }
}
