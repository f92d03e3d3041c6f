//! No-fly areas that the selected route leads over or near: said, marked on the map, asked about before an export.

use egui::{Painter, Pos2, Shape, Stroke};
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::{Mission, Route};
use pilotage_core::plan::{Incursion, ReachedZone, incursions, reached_zones};

use super::planner::Planner;
use super::words::distance_text;
use crate::feature::FeatureContext;
use crate::map::ScreenFromWorld;
use crate::tokens::Tokens;
use crate::units::Units;

/// Distance between two strokes of the hatch along a leg, points.
const HATCH: f32 = 9.0;

/// Legs of a route over no-fly areas.
pub fn over(mission: &Mission, route: &Route) -> Vec<Incursion> {
    if mission.no_fly.is_empty() {
        return Vec::new();
    }
    let places: Vec<GroundPoint> = route.way_points.iter().map(|w| w.position).collect();
    incursions(&places, &mission.no_fly)
}

impl Planner {
    /// Stretches of the predicted path on which its corridor reaches into no-fly areas.
    pub fn reached(&self, mission: &Mission) -> Vec<ReachedZone> {
        match self.forecast.shown() {
            Some(shown) if !mission.no_fly.is_empty() => {
                reached_zones(&shown.prediction.samples, &mission.no_fly)
            }
            _ => Vec::new(),
        }
    }

    /// Warnings about no-fly areas; empty where the route and its corridor keep clear of them.
    pub fn no_fly_sentences(&self, mission: &Mission, route: &Route, units: Units) -> Vec<String> {
        let name = |zone: usize| mission.no_fly[zone].name.as_str();
        let legs = over(mission, route);
        let mut list: Vec<String> = legs
            .iter()
            .map(|it| {
                let length = distance_text(it.length(), units);
                format!("Leg {} crosses {} for {length}.", it.leg + 1, name(it.zone))
            })
            .collect();
        for it in self.reached(mission) {
            let [from, to] = [it.between.0, it.between.1].map(|d| distance_text(d, units));
            list.push(format!(
                "The 95 % corridor reaches into {} from {from} to {to} of the way.",
                name(it.zone)
            ));
        }
        list
    }

    /// Says what is wrong before a route is exported for the first time; whether it did, so that the export waits.
    pub(super) fn asks_before_export(&mut self, context: &mut FeatureContext<'_>) -> bool {
        let documents = &*context.documents;
        let Some(route) = documents.selected_route() else {
            return false;
        };
        let units = context.view.units;
        let mut warnings = self.no_fly_sentences(&documents.mission, route, units);
        if warnings.is_empty() || self.warned == warnings {
            return false;
        }
        self.warned.clone_from(&warnings);
        warnings.push("Export again to save the route as it is.".to_owned());
        context.trouble("The route was not exported yet", warnings.join(" "));
        true
    }
}

/// Marks the legs of a route that lead over no-fly areas.
pub fn paint_incursions(
    painter: &Painter,
    view: &ScreenFromWorld,
    mission: &Mission,
    route: &Route,
    tokens: &Tokens,
) {
    for [a, b] in over(mission, route).iter().flat_map(|it| &it.parts) {
        hatched(painter, view.apply(a), view.apply(b), tokens);
    }
}

/// Draws a thick line with strokes across it.
fn hatched(painter: &Painter, a: Pos2, b: Pos2, tokens: &Tokens) {
    let way = b - a;
    let length = way.length();
    painter.line_segment([a, b], Stroke::new(7.0, tokens.outline()));
    painter.line_segment([a, b], Stroke::new(4.0, tokens.no_fly));
    if length < 1.0 || !painter.clip_rect().expand(length.min(4000.0)).contains(a) {
        return;
    }
    let ahead = way / length;
    let across = 6.0 * (ahead.rot90() + ahead);
    let count = (length / HATCH).min(2000.0) as usize;
    let strokes = (0..=count).map(|i| a + ahead * (HATCH * i as f32));
    painter.extend(strokes.map(|at| {
        Shape::line_segment([at - across, at + across], Stroke::new(2.0, tokens.no_fly))
    }));
}
