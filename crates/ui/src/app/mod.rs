//! The app: one object that the shell draws every frame.

mod aside;
mod dialogs;
mod execute;
mod feature_work;
mod fly_work;
mod flying;
mod frame_pictures;
mod height_work;
mod inbox;
mod keeping;
mod layout;
mod map_work;
mod openings;
mod report;
mod side_tab;
mod start;
mod storage;
mod stored;
mod views;

use pilotage_jobs::{FlightSource, MapSource};

use crate::command::{Command, Workspace};
use crate::documents::{Documents, ViewState};
use crate::feature::Feature;
use crate::host::Host;
use crate::shell::catalog::CommandEntry;
use crate::shell::keys::ShortcutListener;
use crate::shell::{Toasts, apply_theme, is_touched, keep_slow_clicks};
use crate::timeline::Playback;
use crate::tokens::Tokens;

use dialogs::Dialogs;
use fly_work::FlyWork;
use frame_pictures::FramePictureRequests;
use height_work::HeightWork;
use keeping::used_files;
use map_work::{MapParts, MapWork};
use openings::Openings;
use report::Report;
use side_tab::{SideTab, is_sheet};
use storage::{Keeping, TRY_AGAIN_AFTER};
use stored::Stored;
use views::Views;

/// The app.
pub struct App {
    documents: Documents,
    playback: Playback,
    view: ViewState,
    tokens: Tokens,
    selection: Option<u32>,
    side_tab: SideTab,
    dialogs: Dialogs,
    toasts: Toasts,
    views: Views,
    fly_work: FlyWork,
    openings: Openings,
    map_work: MapWork,
    height_work: HeightWork,
    frame_pictures: FramePictureRequests,
    /// Table of all commands, the features' among them.
    catalog: Vec<CommandEntry>,
    commands: Vec<Command>,
    /// Whether keys and clicks of a slow frame wait for the next one.
    input_waits: bool,
    started: bool,
    /// Generation and source of the flight for which everything here is.
    followed: (u64, FlightSource),
    /// Document that was stored at an earlier visit and could not be read.
    aside: Option<aside::Aside>,
    /// Opened files on their way into the storage.
    keeping: Keeping,
    last_now: Option<f64>,
    stored: Stored,
}

impl App {
    /// Draws one frame and does what was asked.
    pub fn ui(&mut self, ui: &mut egui::Ui, host: &mut dyn Host) {
        keep_slow_clicks(ui.ctx());
        let now = host.now();
        if !self.started {
            self.started = true;
            self.start(ui.ctx(), host);
        }
        self.follow_touch(ui.ctx());
        self.receive(ui.ctx(), host);
        self.views.map.turn(self.is_flight_hidden());
        self.tick(now);
        self.input_waits = ShortcutListener::waits(ui.ctx());
        let mut commands = ShortcutListener::take(ui.ctx());
        commands.append(&mut self.commands);
        if self.is_covered() {
            ShortcutListener::cover(ui.ctx());
        }
        self.layout(ui, now, &mut commands);
        self.escape(ui.ctx(), &mut commands);
        for command in commands {
            self.execute(command, ui.ctx(), host);
            self.follow_flight(ui.ctx(), host);
            self.views.map.turn(self.is_flight_hidden());
        }
        let mut features = self.views.features.iter();
        let takes_letters = self.dialogs.palette.is_open() || features.any(|it| it.takes_letters());
        ShortcutListener::hold(ui.ctx(), takes_letters);
        // A name that is typed is one step, as a drag is.
        if !ui.input(|i| i.pointer.any_down()) && !ui.ctx().text_edit_focused() {
            let documents = &mut self.documents;
            documents
                .mission
                .history
                .finish_drag(&documents.mission.content);
        }
        self.follow_back(ui.ctx(), host);
        self.work(ui.ctx(), host);
        if self.keeping.tend(ui.ctx(), &mut self.toasts, host) {
            // What was stored before is still there; what is open now is tried again.
            self.stored.store_anew(Some(now + TRY_AGAIN_AFTER));
        }
        self.remember(ui.ctx(), host);
        if self.playback.playing && self.documents.run.navigated.is_some() {
            ui.ctx().request_repaint();
        }
    }

    /// Whether a dialog lies over the views.
    fn is_covered(&mut self) -> bool {
        let dialogs = &self.dialogs;
        let mut features = self.views.features.iter_mut();
        dialogs.palette.is_open()
            || dialogs.help
            || dialogs.notices
            || features.any(|it| it.is_open_over() && it.tool().is_none())
    }

    /// Escape that nothing else was left by selects no span of time, or else closes the settings.
    fn escape(&self, context: &egui::Context, commands: &mut Vec<Command>) {
        let views = &self.views;
        let is_taken = ShortcutListener::is_covered(context)
            || views.beside_map().is_some()
            || views.fills_window(self.view.workspace).is_some()
            || views.features.iter().any(|it| it.is_open_over());
        let command = if self.playback.selected_span.is_some() && !self.is_flight_hidden() {
            Command::SelectSpan(None)
        } else if self.dialogs.settings {
            Command::ToggleSettings
        } else {
            return;
        };
        let escape = |input: &mut egui::InputState| {
            input.consume_key(egui::Modifiers::NONE, egui::Key::Escape)
        };
        if !is_taken && context.input_mut(escape) {
            commands.push(command);
        }
    }

    fn tick(&mut self, now: f64) {
        let elapsed = self.last_now.map_or(0.0, |last| 1e-3 * (now - last));
        self.last_now = Some(now);
        let span = self.documents.span();
        let streamed = self
            .documents
            .run
            .navigated
            .as_ref()
            .and_then(pilotage_core::navigator::Run::span)
            .map(|s| s.1);
        if let Some(streamed) = streamed {
            let complete = self.documents.run.is_complete;
            self.playback.advance(elapsed, span, streamed, complete);
        }
    }

    /// Work on the map, and what is lent to it.
    fn map_parts<'a>(&'a mut self, host: &'a mut dyn Host) -> (&'a mut MapWork, MapParts<'a>) {
        let parts = MapParts {
            documents: &mut self.documents,
            view: &mut self.views.map,
            toasts: &mut self.toasts,
            host,
        };
        (&mut self.map_work, parts)
    }

    /// Shows another map.
    fn change_map(&mut self, host: &mut dyn Host, map: MapSource) {
        let (work, mut parts) = self.map_parts(host);
        if work.leave_for(map, &mut parts) {
            self.views.map.forget_elsewhere();
            let features = &self.views.features;
            let mut used = used_files(&self.documents, &self.fly_work, features);
            used.extend(self.openings.keys().map(str::to_owned));
            host.let_go(&used);
            self.map_work.describe(&self.documents, host);
        }
    }

    /// Keeps the map to the mission's world where nothing is flown: after an undo, or a mission that was
    /// opened, that may be another one.
    fn follow_world(&mut self, host: &mut dyn Host) {
        let documents = &self.documents;
        let Some(origin) = documents.map.source.origin() else {
            return;
        };
        let world = documents.mission.origin;
        if documents.flight.source == FlightSource::Nothing && world != origin {
            let moved = documents.map.source.moved(world);
            self.change_map(host, moved);
        }
    }

    /// Starts what is due.
    fn work(&mut self, context: &egui::Context, host: &mut dyn Host) {
        let now = host.now();
        // While people plan, the flight waits: its time is better spent on the prediction.
        let flies_now = !self.is_flight_hidden();
        if flies_now && self.fly_work.again_at.is_some_and(|at| at <= now) {
            self.fly_again(host);
        }
        self.documents.tend_noticed();
        self.tend_features(context, host);
        self.follow_world(host);
        self.height_work.ask(&mut self.documents, host);
        if self.documents.run.navigated.is_some() || self.fly_work.job.is_none() {
            // Else where the flight begins is about to be known; anything else would be asked in vain.
            let (documents, map) = (&self.documents, &self.views.map);
            self.map_work.ask_for_tiles(documents, map, host);
        }
        if self.map_work.try_again(&mut self.views.map, now) {
            context.request_repaint_after(std::time::Duration::from_secs(1));
        }
        let camera = &self.views.camera;
        let (documents, playback) = (&self.documents, &self.playback);
        self.frame_pictures.ask(host, documents, playback, camera);
        let waiting = self.fly_work.again_at.is_some() && flies_now || self.stored.is_waiting();
        if waiting {
            context.request_repaint_after(std::time::Duration::from_millis(60));
        }
    }

    /// Lets the flight go on, lap after lap, until its run has at least so many steps, for measuring
    /// what long flights cost; returns how many steps it has then.
    pub fn repeat_laps(&mut self, least_steps: usize) -> usize {
        self.documents.repeat_laps(least_steps)
    }

    fn report(&self) -> Report<'_> {
        Report {
            documents: &self.documents,
            playback: &self.playback,
            view: &self.view,
            selection: self.selection,
            side_tab: self.side_tab,
            dialogs: &self.dialogs,
            toasts: &self.toasts,
            views: &self.views,
            job: self.progress(),
            input_waits: self.input_waits,
        }
    }

    /// State of the screen, as JSON. Places on screen are in points; times in seconds; boxes in metres.
    pub fn state_json(&self) -> String {
        self.report().state_json()
    }

    /// Summary of the screen, in a sentence or three.
    pub fn summary_text(&self) -> String {
        self.report().summary_text()
    }

    /// Opens a workspace.
    fn show_workspace(&mut self, workspace: Workspace) {
        self.view.workspace = workspace;
    }

    /// Place in the app, as the browser's Back and Forward know it: the workspace, and the page of its feature.
    fn place(&self) -> String {
        let workspace = self.view.workspace.label();
        let owner = self.views.owner(self.view.workspace);
        match owner.and_then(Feature::page) {
            Some(page) => format!("{workspace} {page}"),
            None => workspace.to_owned(),
        }
    }

    /// Goes where the browser's Back or Forward leads.
    fn follow_back(&mut self, egui: &egui::Context, host: &mut dyn Host) {
        let Some(place) = host.follow(&self.place()) else {
            return;
        };
        let mut words = place.split(' ');
        let label = words.next();
        let mut all = Workspace::ALL.into_iter();
        if let Some(workspace) = all.find(|it| Some(it.label()) == label) {
            self.execute(Command::ShowWorkspace(workspace), egui, host);
        }
        let page = words.next().and_then(|page| page.parse().ok());
        if let Some((page, owner)) = page.zip(self.views.owner_mut(self.view.workspace)) {
            owner.turn_to(page);
        }
        egui.request_repaint();
    }

    /// Whether the open workspace is about something else than the flight.
    fn is_flight_hidden(&self) -> bool {
        self.views.hide_flight(self.view.workspace)
    }

    /// Feature whose panel is shown beside the flight, if one is.
    fn shown_feature(&self) -> Option<&dyn Feature> {
        let SideTab::Feature(id) = self.side_tab else {
            return None;
        };
        let is_replay = self.view.workspace == Workspace::Replay;
        let mut features = self.views.features.iter().filter(|_| is_replay);
        features.find(|it| it.info().id == id).map(AsRef::as_ref)
    }

    /// Whether people look at something else than the flight beside it.
    fn is_flight_aside(&self) -> bool {
        self.shown_feature()
            .is_some_and(Feature::leaves_flight_aside)
    }

    /// Makes what is pressed as large as whatever presses it needs.
    fn follow_touch(&mut self, context: &egui::Context) {
        let touch = context.input(|input| is_touched(input, self.tokens.touch));
        if touch != self.tokens.touch {
            self.tokens.touch = touch;
            self.restyle(context);
        }
    }

    fn restyle(&mut self, context: &egui::Context) {
        let touch = self.tokens.touch;
        self.tokens = Tokens {
            touch,
            ..Tokens::of(self.view.dark)
        };
        apply_theme(context, &self.tokens);
    }
}
