//! The Plan workspace: its commands carried out, and its jobs.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Route;
use pilotage_core::simulate::SimulationChoice;

use super::App;
use crate::command::{Command, Workspace};
use crate::host::Host;
use crate::plan::routes::{Step, like};
use crate::plan::{
    Cover, FindCommand, FindPick, HeatCommand, Outlook, Pattern, PlanCommand, PlanTab, flown,
    planner as planning,
};
use pilotage_jobs::{AssessmentOrder, FlightSource, JobEvent, JobId};

/// Width of a corridor when it is made, metres.
const CORRIDOR: f64 = 200.0;

impl App {
    /// Whether the Plan workspace is open.
    pub(super) fn planning(&self) -> bool {
        self.view.workspace == Workspace::Plan
    }

    /// Opens a workspace; Plan stands still and shows all of the plan.
    pub(super) fn show_workspace(&mut self, workspace: Workspace) {
        self.view.workspace = workspace;
        if self.planning() {
            self.playback.playing = false;
        } else {
            self.views.planner.drawing = false;
            self.views.planner.marking = None;
        }
    }

    /// Carries a command out.
    pub(super) fn plan(&mut self, command: PlanCommand, now: f64) {
        if !self.planning() {
            self.show_workspace(Workspace::Plan);
        }
        let Some(command) = self.edit_landmarks(command, now) else {
            return;
        };
        match command {
            PlanCommand::ToggleDraw if self.views.planner.drawing => self.finish_drawing(),
            PlanCommand::ToggleDraw => {
                let planner = &mut self.views.planner;
                planner.drawing = true;
                planner.finder.pick = FindPick::Nothing;
                planner.marking = None;
                self.documents.route = None;
                planner.way_point = None;
                self.views.map.picking = false;
                self.selection = None;
            }
            PlanCommand::FinishDraw => self.finish_drawing(),
            PlanCommand::TakeFlightRoute => self.take_flight_route(now),
            PlanCommand::SelectRoute(id) => {
                self.documents.route = Some(id);
                self.views.planner.way_point = None;
            }
            PlanCommand::SelectWayPoint(which) => {
                self.views.planner.way_point = which;
                if which.is_some() {
                    self.selection = None;
                }
            }
            PlanCommand::SetLimit(limit) => self.views.planner.preferences.limit = limit,
            PlanCommand::SetAircraft {
                bank,
                power,
                energy,
            } => {
                let preferences = &mut self.views.planner.preferences;
                (preferences.bank, preferences.power, preferences.energy) = (bank, power, energy);
            }
            PlanCommand::ToggleProfile => {
                let shown = &mut self.views.planner.preferences.profile;
                *shown = !*shown;
            }
            PlanCommand::SetGround { height, finished } => {
                self.documents.state_ground(height, Step::of(finished));
                self.jobs.document_changed = true;
            }
            PlanCommand::SetWind(wind) => self.views.planner.preferences.wind = wind,
            PlanCommand::Assess(_)
            | PlanCommand::AssessSelected
            | PlanCommand::SurveyEnvelope
            | PlanCommand::AssessAll
            | PlanCommand::StopAssessing => self.assess(&command),
            PlanCommand::Train(command) => self.train(command),
            PlanCommand::Heat(command) => {
                if command == HeatCommand::ToggleBlind || command == HeatCommand::Toggle {
                    self.views.planner.tab = PlanTab::Ground;
                }
                self.views.planner.heat_command(command);
            }
            PlanCommand::EditArea {
                index,
                change,
                finished,
            } => {
                self.views.planner.finder.found = None;
                let step = Step::of(finished);
                self.documents.edit_no_fly(index, step, change);
                self.jobs.document_changed = true;
            }
            PlanCommand::Find(command) => {
                let Self {
                    documents, views, ..
                } = self;
                if matches!(command, FindCommand::Begin | FindCommand::Pick(_)) {
                    views.planner.tab = PlanTab::Ground;
                    views.planner.drawing = false;
                    views.planner.marking = None;
                    views.map.picking = false;
                }
                self.jobs.document_changed |= views.planner.find_command(command, documents);
            }
            PlanCommand::ShowTab(tab) => self.views.planner.tab = tab,
            other => {
                self.jobs.document_changed = true;
                self.edit_route(other);
            }
        }
    }

    fn finish_drawing(&mut self) {
        let planner = &mut self.views.planner;
        planner.drawing = false;
        let short = self.documents.selected_route();
        let short = short.filter(|r| r.way_points.len() < 2).map(|r| r.id);
        if let Some(id) = short {
            self.documents.delete_route(id);
        }
    }

    fn take_flight_route(&mut self, now: f64) {
        let (route, flight) = match &self.documents.flight_source {
            FlightSource::Simulated(options) => {
                let choice = SimulationChoice::named(&options.scenario);
                let route = choice.and_then(|choice| choice.route(options.height));
                let place = options.world().place();
                (route, format!("The flight in {place}"))
            }
            _ => (None, "A recorded flight".to_owned()),
        };
        let Some(route) = route else {
            let title = format!("{flight} has no planned route");
            let text = "Draw a route instead: click on the map where it begins.";
            self.toasts.note(now, title, text);
            return;
        };
        let id = self
            .documents
            .add_route(Some(&route.name), route.way_points);
        self.documents.route = Some(id);
        self.views.planner.fitted = false;
        self.jobs.document_changed = true;
    }

    fn edit_route(&mut self, command: PlanCommand) {
        let Self {
            documents, views, ..
        } = self;
        let planner = &mut views.planner;
        if let PlanCommand::AddWayPoint(at) = &command {
            let at = at.unwrap_or(views.map.camera.center);
            let usual = flown::usual_altitude(documents);
            if let Some(id) = documents.route {
                documents.edit_route(id, Step::Whole, |route| {
                    let new = like(route.way_points.last(), at, usual);
                    route.way_points.push(new);
                });
            } else {
                documents.route = Some(documents.add_route(None, vec![like(None, at, usual)]));
                planner.drawing = true;
            }
            return;
        }
        let Some(id) = documents.route else { return };
        match command {
            PlanCommand::DeleteRoute => {
                documents.delete_route(id);
                planner.drawing = false;
            }
            PlanCommand::Split => {
                let at = planner.way_point;
                if at
                    .and_then(|index| documents.split_route(id, index))
                    .is_some()
                {
                    planner.way_point = None;
                }
            }
            PlanCommand::DuplicateRoute => {
                documents.route = documents.duplicate_route(id).or(Some(id));
            }
            PlanCommand::SetPattern { pattern, finished } => {
                let usual = flown::usual_altitude(documents);
                let route = documents.selected_route();
                let made_for = planning::made_for(planner, documents, route);
                documents.edit_route(id, Step::of(finished), |route| {
                    pattern.apply(route, usual, &made_for);
                });
                planner.way_point = None;
            }
            PlanCommand::CorridorAlong => {
                if let Some(route) = documents.selected_route().cloned() {
                    let usual = flown::usual_altitude(documents);
                    let altitude = route.way_points.first().map_or(usual, |w| w.altitude);
                    let made_for = planning::made_for(planner, documents, Some(&route));
                    let line: Vec<GroundPoint> =
                        route.way_points.iter().map(|w| w.position).collect();
                    let cover = Cover::Corridor { width_m: CORRIDOR };
                    let pattern = Pattern::new(cover, &line, &made_for.frame);
                    let mut new = Route::default();
                    pattern.apply(&mut new, altitude, &made_for);
                    documents.route = Some(documents.add_made(new, "Corridor"));
                    planner.way_point = None;
                }
            }
            PlanCommand::InsertWayPoint { behind, .. } => {
                documents.edit_route(id, step_of(&command), |r| change(r, &command));
                planner.way_point = Some(behind + 1);
            }
            PlanCommand::DeleteWayPoint(which) => {
                let which = which.or(planner.way_point);
                let count = documents.selected_route().map_or(0, |r| r.way_points.len());
                if count <= 1 {
                    documents.delete_route(id);
                    return;
                }
                let command = PlanCommand::DeleteWayPoint(which);
                documents.edit_route(id, Step::Whole, |r| change(r, &command));
                planner.way_point = None;
            }
            other => documents.edit_route(id, step_of(&other), |r| change(r, &other)),
        }
    }

    fn assess(&mut self, command: &PlanCommand) {
        let ids: Vec<u32> = match command {
            PlanCommand::Assess(ids) => ids.clone(),
            PlanCommand::AssessSelected | PlanCommand::SurveyEnvelope => {
                self.selection.into_iter().collect()
            }
            PlanCommand::AssessAll => {
                let landmarks = self.documents.mission.landmarks.iter();
                landmarks.filter(|l| l.enabled).map(|l| l.id).collect()
            }
            _ => {
                self.views.planner.assessments.wants_stop = true;
                return;
            }
        };
        let documents = &self.documents;
        let planner = &mut self.views.planner;
        let height = flown::flown_height(documents);
        let landmarks = ids.iter().filter_map(|id| documents.mission.landmark(*id));
        let mut orders = landmarks.map(|landmark| AssessmentOrder {
            map: documents.map_source.clone(),
            landmark: landmark.clone(),
            camera: flown::camera(documents),
            height,
            navigator: documents.mission.navigator.clone(),
            ground_down: flown::ground_down(documents),
        });
        if *command == PlanCommand::SurveyEnvelope {
            planner.assessments.survey(orders.next());
        } else {
            planner.assessments.ask(orders.collect());
        }
    }

    /// Takes what a worker says about the plan; false if it is about something else.
    pub(super) fn plan_event(&mut self, id: JobId, event: &JobEvent, now: f64) -> bool {
        let planner = &mut self.views.planner;
        planner.forecast.receive(id, event, now)
            || planner.remedies.receive(id, event)
            || planner.heat.receive(id, event)
            || planner.finder.receive(id, event)
            || planner.suggestions.receive(id, event)
            || planner.trainings.receive(id, event)
            || planner
                .assessments
                .receive(id, event, &self.documents.mission.landmarks)
    }

    /// Asks the workers for what the plan is missing.
    pub(super) fn work_on_plan(&mut self, context: &egui::Context, host: &mut dyn Host) {
        let planner = &mut self.views.planner;
        planner.settle(&mut self.documents);
        planner.assessments.work(host, &self.documents);
        planner.trainings.work(host, &self.documents);
        self.keep_detectors(host.now());
        let planner = &mut self.views.planner;
        if self.view.workspace != Workspace::Plan {
            return;
        }
        if !planner.fitted
            && let Some(ground) = planning::plan_ground(&self.documents.mission)
        {
            planner.fitted = true;
            self.views.map.fit(ground);
        }
        let heat = planner.heat_order(&self.documents);
        let blind = planner.preferences.heat.blind;
        let mut waits = planner.heat.work(heat, blind, host, context);
        let mut finder = std::mem::take(&mut planner.finder);
        // The order looks at the ends that the search has.
        (planner.finder.from, planner.finder.to) = (finder.from, finder.to);
        finder.work(|| planner.find_order(&self.documents), host);
        planner.finder = finder;
        let mut suggestions = std::mem::take(&mut planner.suggestions);
        suggestions.keep_to(&self.documents.map_source, host);
        suggestions.work(|| planner.suggest_order(&self.documents), host);
        planner.suggestions = suggestions;
        let order = planner.order(&self.documents);
        let limit = planner.preferences.limit;
        waits |= planner.forecast.work(order, limit, host);
        planner.remedies.work(&planner.forecast, limit, host);
        if waits {
            context.request_repaint_after(std::time::Duration::from_millis(60));
        }
    }

    /// The plan in a sentence or two.
    pub(super) fn plan_text(&self) -> String {
        let planner = &self.views.planner;
        let Some(route) = self.documents.selected_route() else {
            return "No route yet.".to_owned();
        };
        let mut parts = vec![format!(
            "{}: {} way-points.",
            route.name,
            route.way_points.len()
        )];
        let shown = planner.forecast.shown();
        if let Some(outlook) = shown.and_then(|s| Outlook::of(&s.prediction)) {
            let landmarks = &self.documents.mission.landmarks;
            let limit = planner.preferences.limit;
            parts.extend(outlook.sentences(limit, landmarks, self.view.units));
            parts.extend(planner.remedies.sentences(self.view.units));
        }
        parts.join(" ")
    }

    /// Whether a command is about the flight that Plan does not show.
    pub(super) fn is_out_of_place(&self, command: &Command) -> bool {
        self.planning()
            && matches!(
                command,
                Command::TogglePlay
                    | Command::StepFrames(_)
                    | Command::Jump(_)
                    | Command::GoToStart
                    | Command::GoToEnd
            )
    }
}

fn step_of(command: &PlanCommand) -> Step {
    match command {
        PlanCommand::InsertWayPoint { finished, .. }
        | PlanCommand::MoveWayPoint { finished, .. }
        | PlanCommand::SetAltitude { finished, .. }
        | PlanCommand::SetAction { finished, .. }
        | PlanCommand::SetSpeed { finished, .. } => Step::of(*finished),
        _ => Step::Whole,
    }
}

/// Does to a route what a command says. Whoever moves way-points of a pattern has a pattern no more.
fn change(route: &mut Route, command: &PlanCommand) {
    if matches!(
        command,
        PlanCommand::MoveWayPoint { .. }
            | PlanCommand::InsertWayPoint { .. }
            | PlanCommand::DeleteWayPoint(_)
            | PlanCommand::ReleasePattern
            | PlanCommand::Reverse
    ) {
        Pattern::release(route);
    }
    match command {
        PlanCommand::MoveWayPoint { index, to, .. } => {
            if let Some(way_point) = route.way_points.get_mut(*index) {
                way_point.position = *to;
            }
        }
        PlanCommand::InsertWayPoint { behind, at, .. } => insert(route, *behind, *at),
        PlanCommand::DeleteWayPoint(Some(index)) if *index < route.way_points.len() => {
            route.way_points.remove(*index);
        }
        PlanCommand::SetAltitude {
            index, altitude, ..
        } => {
            for (at, way_point) in route.way_points.iter_mut().enumerate() {
                if index.is_none_or(|index| index == at) {
                    way_point.altitude = *altitude;
                }
            }
        }
        PlanCommand::SetAction { index, action, .. } => {
            if let Some(way_point) = route.way_points.get_mut(*index) {
                way_point.action = *action;
            }
        }
        PlanCommand::SetSpeed { index, speed, .. } => {
            if let Some(way_point) = route.way_points.get_mut(*index) {
                way_point.speed = *speed;
            }
        }
        PlanCommand::Reverse => *route = route.reversed(),
        PlanCommand::RenameRoute(name) => route.name.clone_from(name),
        _ => {}
    }
}

fn insert(route: &mut Route, behind: usize, at: GroundPoint) {
    // Both parts of the leg keep its speed.
    let after = route.way_points.get(behind + 1).and_then(|w| w.speed);
    let Some(before) = route.way_points.get(behind) else {
        return;
    };
    let mut new = like(Some(before), at, before.altitude);
    new.speed = after;
    route.way_points.insert(behind + 1, new);
}
