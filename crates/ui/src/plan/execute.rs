//! Commands of planning carried out.

use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::{Route, WayPointAction};
use pilotage_core::simulate::SimulationChoice;

use super::PlanCommand;
use super::actions::{act, change_ends, lead_on};
use super::find_command::{FindCommand, FindPick};
use super::flown;
use super::heat_command::HeatCommand;
use super::patterns::{CoveredGround, Pattern};
use super::planner::{Planner, made_for};
use super::rally::edit_rally_points;
use super::routes::{EditStep, like};
use super::tab::PlanTab;
use crate::context::route_of;
use crate::documents::Documents;
use crate::feature::FeatureContext;
use pilotage_jobs::{AssessmentOrder, FlightSource};

/// Width of a corridor when it is made, metres.
const CORRIDOR: f64 = 200.0;

impl Planner {
    /// Carries a command out; whether anything here does so. A new command needs an arm here, where no other catches it.
    pub(super) fn carry_out(
        &mut self,
        command: PlanCommand,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        if !context.is_shown {
            context.show();
        }
        if let PlanCommand::OfRoute(route, command) = command {
            return self.carry_out_of(route, *command, context);
        }
        let left = self.edit_landmarks(command, context);
        let left = left.and_then(|command| edit_rally_points(command, context));
        let left = left.and_then(|command| self.measure(command, context));
        let Some(command) = left.and_then(|command| self.prefer(command)) else {
            return true;
        };
        match command {
            PlanCommand::ToggleDraw if self.drawing => self.finish_drawing(context),
            PlanCommand::ToggleDraw => self.begin_drawing(context),
            PlanCommand::FinishDraw => self.finish_drawing(context),
            PlanCommand::TakeFlightRoute => self.take_flight_route(context),
            PlanCommand::SelectRoute(id) => {
                context.documents.mission.route = Some(id);
                self.way_point = None;
            }
            PlanCommand::SelectWayPoint(which) => {
                self.way_point = which;
                if which.is_some() {
                    *context.selection = None;
                }
            }
            PlanCommand::SetGround { height, finished } => {
                let step = EditStep::of(finished);
                context.documents.state_ground(height, step);
                context.document_changed();
            }
            PlanCommand::Train(command) => self.train(command, context),
            PlanCommand::Rehearse(command) => self.rehearse(&command, context),
            PlanCommand::PrintBrief => self.ask_for_brief(context),
            PlanCommand::Heat(command) => self.show_heat(command),
            PlanCommand::EditArea {
                index,
                change,
                finished,
            } => {
                let step = EditStep::of(finished);
                context.documents.edit_no_fly(index, step, change);
                context.document_changed();
            }
            PlanCommand::DeleteArea(index) => {
                if context.documents.delete_no_fly(index) {
                    context.document_changed();
                }
            }
            PlanCommand::Find(command) => self.find(command, context),
            PlanCommand::AddWayPoint(_)
            | PlanCommand::InsertWayPoint { .. }
            | PlanCommand::MoveWayPoint { .. }
            | PlanCommand::DeleteWayPoint(_)
            | PlanCommand::SetAltitude { .. }
            | PlanCommand::SetSpeed { .. }
            | PlanCommand::SetAction { .. }
            | PlanCommand::Reverse
            | PlanCommand::Split
            | PlanCommand::DuplicateRoute
            | PlanCommand::DeleteRoute
            | PlanCommand::RenameRoute { .. }
            | PlanCommand::ToggleTakeOff
            | PlanCommand::ToggleReturn
            | PlanCommand::ToggleLanding
            | PlanCommand::SetPattern { .. }
            | PlanCommand::CorridorAlong
            | PlanCommand::ReleasePattern => {
                context.document_changed();
                return self.edit_route(command, context);
            }
            // Done above, or by nobody.
            PlanCommand::OfRoute(..)
            | PlanCommand::Assess(_)
            | PlanCommand::AssessSelected
            | PlanCommand::AssessAll
            | PlanCommand::SurveyEnvelope
            | PlanCommand::StopAssessing
            | PlanCommand::EditLandmarks { .. }
            | PlanCommand::DeleteLandmarks(_)
            | PlanCommand::DuplicateLandmark
            | PlanCommand::MarkLandmarks(_)
            | PlanCommand::Suggest(_)
            | PlanCommand::Mark(_)
            | PlanCommand::AddCorner(_)
            | PlanCommand::RemoveCorner
            | PlanCommand::FinishMarking
            | PlanCommand::CancelMarking
            | PlanCommand::EditRally { .. }
            | PlanCommand::DeleteRally(_)
            | PlanCommand::SetLimit(_)
            | PlanCommand::SetAircraft { .. }
            | PlanCommand::SetWind(_)
            | PlanCommand::ToggleProfile
            | PlanCommand::TestAhead(_)
            | PlanCommand::ShowTab(_) => return false,
        }
        true
    }

    /// Carries a command about a route out; the route that is selected otherwise stays so.
    fn carry_out_of(
        &mut self,
        route: u32,
        command: PlanCommand,
        context: &mut FeatureContext<'_>,
    ) -> bool {
        let before = (context.documents.mission.route, self.way_point);
        if before.0 == Some(route) {
            return self.carry_out(command, context);
        }
        // None of that id: it was deleted meanwhile.
        if route_of(&context.documents.mission, route).is_some() {
            context.documents.mission.route = Some(route);
            self.carry_out(command, context);
            (context.documents.mission.route, self.way_point) = before;
        }
        true
    }

    /// Measures landmarks; gives back what is something else.
    fn measure(
        &mut self,
        command: PlanCommand,
        context: &FeatureContext<'_>,
    ) -> Option<PlanCommand> {
        match command {
            PlanCommand::Assess(ids) => {
                let orders = self.assessments_of(ids, context.documents);
                self.assessments.ask(orders);
            }
            PlanCommand::AssessSelected => {
                let orders = self.assessments_of(*context.selection, context.documents);
                self.assessments.ask(orders);
            }
            PlanCommand::AssessAll => {
                let landmarks = context.documents.mission.landmarks.iter();
                let ids = landmarks.filter(|l| l.enabled).map(|l| l.id);
                let orders = self.assessments_of(ids, context.documents);
                self.assessments.ask(orders);
            }
            PlanCommand::SurveyEnvelope => {
                let orders = self.assessments_of(*context.selection, context.documents);
                self.assessments.survey(orders.into_iter().next());
            }
            PlanCommand::StopAssessing => {
                self.assessments.wants_stop = true;
                self.preferences.tests_ahead = false;
            }
            other => return Some(other),
        }
        None
    }

    fn begin_drawing(&mut self, context: &mut FeatureContext<'_>) {
        self.drawing = true;
        self.finder.pick = FindPick::Nothing;
        self.put_marking_away(context);
        self.way_point = None;
        context.documents.mission.route = None;
        context.take_map();
        *context.selection = None;
    }

    fn show_heat(&mut self, command: HeatCommand) {
        if command == HeatCommand::ToggleBlind || command == HeatCommand::Toggle {
            self.tab = PlanTab::Ground;
        }
        self.heat_command(command);
    }

    fn find(&mut self, command: FindCommand, context: &mut FeatureContext<'_>) {
        if matches!(command, FindCommand::Begin | FindCommand::Pick(_)) {
            self.tab = PlanTab::Ground;
            self.drawing = false;
            self.put_marking_away(context);
            context.take_map();
        }
        if self.find_command(command, context.documents) {
            context.document_changed();
        }
    }

    /// Takes note of what people prefer; gives back what is something else.
    fn prefer(&mut self, command: PlanCommand) -> Option<PlanCommand> {
        let preferences = &mut self.preferences;
        match command {
            PlanCommand::SetLimit(limit) => preferences.limit = limit,
            PlanCommand::SetAircraft {
                bank,
                power,
                energy,
            } => (preferences.bank, preferences.power, preferences.energy) = (bank, power, energy),
            PlanCommand::SetWind(wind) => preferences.wind = wind,
            PlanCommand::ToggleProfile => preferences.profile = !preferences.profile,
            PlanCommand::TestAhead(on) => preferences.tests_ahead = on,
            PlanCommand::ShowTab(tab) => self.tab = tab,
            other => return Some(other),
        }
        None
    }

    pub(super) fn finish_drawing(&mut self, context: &mut FeatureContext<'_>) {
        self.drawing = false;
        let short = context.documents.mission.selected_route();
        let short = short.filter(|r| r.way_points.len() < 2).map(|r| r.id);
        if let Some(id) = short {
            context.documents.give_up_route(id);
        }
    }

    fn take_flight_route(&mut self, context: &mut FeatureContext<'_>) {
        let (route, flight) = match &context.documents.flight.source {
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
            context.note(&title, text);
            return;
        };
        let documents = &mut *context.documents;
        documents.mission.route = Some(documents.add_route(Some(&route.name), route.way_points));
        self.fitted = false;
        context.document_changed();
    }

    /// Does something to the selected route, if there is one; false if the command is none of a route.
    fn edit_route(&mut self, command: PlanCommand, context: &mut FeatureContext<'_>) -> bool {
        let documents = &mut *context.documents;
        if let PlanCommand::AddWayPoint(at) = &command {
            let at = at.unwrap_or(context.map.camera.center);
            let usual = flown::usual_altitude(documents);
            if let Some(id) = documents.mission.route {
                documents.edit_route(id, EditStep::Whole, |route| {
                    change(route, &command);
                    let new = like(route.way_points.last(), at, usual);
                    lead_on(route, new);
                });
            } else {
                documents.mission.route =
                    Some(documents.add_route(None, vec![like(None, at, usual)]));
                self.drawing = true;
            }
            return true;
        }
        let Some(id) = documents.mission.route else {
            return true;
        };
        match command {
            PlanCommand::DeleteRoute => {
                documents.delete_route(id);
                self.drawing = false;
            }
            PlanCommand::Split => {
                let at = self.way_point;
                if at
                    .and_then(|index| documents.split_route(id, index))
                    .is_some()
                {
                    self.way_point = None;
                }
            }
            PlanCommand::RenameRoute { id, name } => documents.rename_route(id, &name),
            PlanCommand::DuplicateRoute => {
                documents.mission.route = documents.duplicate_route(id).or(Some(id));
            }
            PlanCommand::SetPattern { pattern, finished } => {
                let usual = flown::usual_altitude(documents);
                if let Some(before) = documents.mission.selected_route().cloned() {
                    let made_for = made_for(self, documents, Some(&before));
                    let mut laid = before.clone();
                    pattern.apply(&mut laid, usual, &made_for);
                    documents.relief().keep_heights(&before, &mut laid);
                    documents.edit_route(id, EditStep::of(finished), |route| *route = laid);
                }
                self.way_point = None;
            }
            PlanCommand::CorridorAlong => {
                if let Some(route) = documents.mission.selected_route().cloned() {
                    let usual = flown::usual_altitude(documents);
                    let altitude = route.way_points.first().map_or(usual, |w| w.altitude);
                    let made_for = made_for(self, documents, Some(&route));
                    let line: Vec<GroundPoint> =
                        route.way_points.iter().map(|w| w.position).collect();
                    let cover = CoveredGround::Corridor { width_m: CORRIDOR };
                    let pattern = Pattern::new(cover, &line, &made_for.frame);
                    let mut new = Route::default();
                    pattern.apply(&mut new, altitude, &made_for);
                    documents.relief().keep_heights(&route, &mut new);
                    documents.mission.route = Some(documents.add_made(new, "Corridor"));
                    self.way_point = None;
                }
            }
            PlanCommand::InsertWayPoint { behind, .. } => {
                documents.edit_route(id, step_of(&command), |route| {
                    change(route, &command);
                });
                self.way_point = Some(behind + 1);
            }
            PlanCommand::DeleteWayPoint(which) => {
                let Some(which) = which.or(self.way_point) else {
                    return true;
                };
                let count = documents
                    .mission
                    .selected_route()
                    .map_or(0, |r| r.way_points.len());
                if count <= 1 {
                    documents.delete_route(id);
                    return true;
                }
                let command = PlanCommand::DeleteWayPoint(Some(which));
                edit_as_high(id, &command, documents);
                self.way_point = None;
            }
            PlanCommand::Reverse => edit_as_high(id, &command, documents),
            other => {
                let laid = self.laid_anew(&other, documents);
                let mut is_of_route = true;
                documents.edit_route(id, step_of(&other), |route| match laid {
                    Some(laid) => *route = laid,
                    None => is_of_route = change(route, &other),
                });
                return is_of_route;
            }
        }
        true
    }

    /// The selected route after a command that sets the altitude or the speed of a pattern, whose passes are laid for them.
    fn laid_anew(&self, command: &PlanCommand, documents: &Documents) -> Option<Route> {
        let sets = matches!(
            command,
            PlanCommand::SetAltitude {
                index: None | Some(0),
                ..
            } | PlanCommand::SetSpeed { index: 1, .. }
        );
        let route = documents.mission.selected_route().filter(|_| sets)?;
        let pattern = Pattern::of(route)?;
        let mut laid = route.clone();
        change(&mut laid, command);
        let made_for = made_for(self, documents, Some(&laid));
        pattern.apply(&mut laid, flown::usual_altitude(documents), &made_for);
        Some(laid)
    }

    /// Orders to measure landmarks.
    fn assessments_of(
        &self,
        ids: impl IntoIterator<Item = u32>,
        documents: &Documents,
    ) -> Vec<AssessmentOrder> {
        let ids = ids.into_iter();
        let landmarks = ids.filter_map(|id| documents.mission.landmark(id));
        let orders = landmarks.map(|landmark| self.assessment(landmark, documents));
        orders.collect()
    }
}

fn step_of(command: &PlanCommand) -> EditStep {
    match command {
        PlanCommand::InsertWayPoint { finished, .. }
        | PlanCommand::MoveWayPoint { finished, .. }
        | PlanCommand::SetAltitude { finished, .. }
        | PlanCommand::SetAction { finished, .. }
        | PlanCommand::SetSpeed { finished, .. } => EditStep::of(*finished),
        _ => EditStep::Whole,
    }
}

/// Whether a route that is a pattern is none any more after a command: where it is laid anew, way-points have no place,
/// action, altitude or speed of their own but a take-off and a landing at the ends.
fn ends_pattern(route: &Route, command: &PlanCommand) -> bool {
    let last = route.way_points.len().saturating_sub(1);
    match command {
        PlanCommand::AddWayPoint(_)
        | PlanCommand::MoveWayPoint { .. }
        | PlanCommand::InsertWayPoint { .. }
        | PlanCommand::DeleteWayPoint(_)
        | PlanCommand::ReleasePattern
        | PlanCommand::Reverse => true,
        PlanCommand::SetAction { index, action, .. } => match action {
            WayPointAction::FlyBy => false,
            WayPointAction::TakeOff => *index != 0,
            WayPointAction::Land => *index != last,
            _ => true,
        },
        PlanCommand::SetAltitude {
            index: Some(index), ..
        } => {
            let lands = *index == last && route.lands();
            *index > 0 && !lands
        }
        PlanCommand::SetSpeed { index, .. } => *index != 1,
        _ => false,
    }
}

/// Does to a route what a command says that lets it begin elsewhere, as high as before.
fn edit_as_high(id: u32, command: &PlanCommand, documents: &mut Documents) {
    if let Some(before) = route_of(&documents.mission, id) {
        let mut route = before.clone();
        change(&mut route, command);
        documents.relief().keep_heights(before, &mut route);
        documents.edit_route(id, EditStep::Whole, |it| *it = route);
    }
}

/// Does to a route what a command says; false if it says nothing of a route alone.
fn change(route: &mut Route, command: &PlanCommand) -> bool {
    if ends_pattern(route, command) {
        Pattern::release(route);
    }
    match command {
        // Nothing else than to be no pattern any more.
        PlanCommand::AddWayPoint(_) | PlanCommand::ReleasePattern => {}
        PlanCommand::MoveWayPoint { index, to, .. } => {
            if let Some(way_point) = route.way_points.get_mut(*index) {
                way_point.position = *to;
            }
        }
        PlanCommand::InsertWayPoint { behind, at, .. } => insert(route, *behind, *at),
        PlanCommand::DeleteWayPoint(which) => {
            if let Some(index) = which.filter(|index| *index < route.way_points.len()) {
                route.way_points.remove(index);
            }
        }
        PlanCommand::SetAltitude {
            index, altitude, ..
        } => {
            for (at, way_point) in route.way_points.iter_mut().enumerate() {
                let lands = way_point.action == WayPointAction::Land;
                if index.map_or(!lands, |index| index == at) {
                    way_point.altitude = *altitude;
                }
            }
        }
        PlanCommand::SetAction { index, action, .. } => act(route, *index, *action),
        PlanCommand::SetSpeed { index, speed, .. } => {
            if let Some(way_point) = route.way_points.get_mut(*index) {
                way_point.speed = *speed;
            }
        }
        PlanCommand::Reverse => *route = route.reversed(),
        other => return change_ends(route, other),
    }
    true
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

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::frames::{Altitude, AltitudeFrame, Geodetic, LocalFrame};

    /// A survey of three passes.
    fn surveyed() -> Route {
        let altitude = Altitude::new(100.0, AltitudeFrame::AboveGround);
        let places = (0..6).map(|i| GroundPoint::new(f64::from(i), 0.0));
        let places: Vec<GroundPoint> = places.collect();
        let mut route = flown::line(&places, altitude);
        let frame = LocalFrame::new(Geodetic::from_degrees(47.0, 8.0, 0.0));
        let pattern = Pattern::new(CoveredGround::Survey, &places, &frame);
        let text = serde_json::to_string(&pattern).unwrap();
        route.properties.insert("pattern".to_owned(), text);
        route
    }

    #[test]
    fn a_pattern_is_none_any_more_once_a_way_point_has_something_of_its_own() {
        let action = |index, action| PlanCommand::SetAction {
            index,
            action,
            finished: true,
        };
        let altitude = |index| PlanCommand::SetAltitude {
            index,
            altitude: Altitude::new(150.0, AltitudeFrame::AboveGround),
            finished: true,
        };
        let speed = |index| PlanCommand::SetSpeed {
            index,
            speed: Some(14.0),
            finished: true,
        };
        let circle = WayPointAction::Loiter {
            radius: 60.0,
            turns: 1.0,
        };
        for (command, stays) in [
            (PlanCommand::ToggleTakeOff, true),
            (PlanCommand::ToggleLanding, true),
            (PlanCommand::ToggleReturn, true),
            (action(0, WayPointAction::TakeOff), true),
            (action(5, WayPointAction::Land), true),
            (action(3, circle), false),
            (action(0, circle), false),
            (altitude(None), true),
            (altitude(Some(0)), true),
            (altitude(Some(4)), false),
            (speed(1), true),
            (speed(3), false),
            (PlanCommand::AddWayPoint(None), false),
        ] {
            let mut route = surveyed();
            change(&mut route, &command);
            assert_eq!(Pattern::of(&route).is_some(), stays, "{command:?}");
        }
    }
}
