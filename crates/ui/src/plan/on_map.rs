//! The plan as a tool of the map.

use egui::{Response, Ui};

use super::find_command::FindPick;
use super::find_tool::paint_hint;
use super::incursions::paint_incursions;
use super::marking::Marking;
use super::marks::{mark_labels, other_route_labels};
use super::no_fly_paint::{no_fly_labels, paint_no_fly};
use super::planner::Planner;
use super::tab::PlanTab;
use crate::context::ViewContext;
use crate::map::{LandmarkLabel, Layer, MapCanvas, MapStage, MapTool, ScreenFromWorld};

impl MapTool for Planner {
    fn hides_flight(&self) -> bool {
        true
    }

    fn interact(
        &mut self,
        ui: &Ui,
        view: &ScreenFromWorld,
        response: &Response,
        context: &mut ViewContext<'_>,
    ) -> bool {
        if self.choose_on_map(ui, view, response, context) {
            return true;
        }
        if self.finder.pick != FindPick::Nothing {
            return false;
        }
        let mut pointer = std::mem::take(&mut self.pointer);
        let is_busy = pointer.interact(ui, view, response, self, context);
        self.pointer = pointer;
        is_busy
    }

    fn takes_middle(&self, _has_keyboard: bool) -> bool {
        let is_point = |marking: &Marking| marking.purpose.is_point();
        self.drawing
            || self.finder.pick != FindPick::Nothing
            || self.marking.as_ref().is_some_and(is_point)
    }

    fn labels(&self, canvas: &MapCanvas<'_>) -> Vec<LandmarkLabel> {
        if !canvas.layers.shows(Layer::Route) {
            return Vec::new();
        }
        let (view, tokens) = (canvas.view, canvas.tokens);
        let marks = mark_labels(view, canvas.mission, canvas.route, tokens);
        let names = other_route_labels(view, canvas.mission, canvas.route, tokens);
        let advice = self.remedy_label(view, tokens);
        let areas = no_fly_labels(view, canvas.mission, tokens);
        let names = marks.into_iter().chain(areas).chain(names);
        names.chain(advice).collect()
    }

    fn paint(&self, stage: MapStage, canvas: &MapCanvas<'_>) {
        let MapCanvas {
            painter,
            view,
            rect,
            pointer,
            mission,
            route,
            layers,
            tokens,
        } = *canvas;
        match stage {
            MapStage::Ground => self.paint_heat(painter, view),
            MapStage::BelowMarks => {
                let held = self.tab == PlanTab::Ground;
                paint_no_fly(painter, view, mission, held, tokens);
                if layers.shows(Layer::Corridor) {
                    self.paint_corridor(painter, view, tokens);
                }
            }
            MapStage::AboveMarks if layers.shows(Layer::Route) => {
                paint_incursions(painter, view, &self.incursions.legs, tokens);
                self.paint_routes(painter, view, mission, route, &self.pointer, tokens);
            }
            MapStage::AboveMarks => {}
            MapStage::Last => {
                self.paint_remedy(painter, view, tokens);
                self.paint_suggestions(painter, view, &mission.landmarks, tokens);
                self.paint_find(painter, view, tokens);
                if let Some(pointer) = pointer {
                    self.paint_heat_readout(painter, view, pointer, tokens);
                }
                paint_hint(painter, rect, self.finder.pick, tokens);
            }
        }
    }
}
