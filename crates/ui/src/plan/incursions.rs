//! No-fly areas that the selected route leads over or near: said, marked on the map, asked about before an export.

use egui::{Painter, Pos2, Shape, Stroke};
use pilotage_core::plan::Incursion;

use super::flown::flown_way;
use super::planner::Planner;
use super::words::distance_text;
use crate::documents::Documents;
use crate::feature::FeatureContext;
use crate::map::ScreenFromWorld;
use crate::tokens::Tokens;
use crate::units::Units;

/// Distance between two strokes of the hatch along a leg, points.
const HATCH: f32 = 9.0;

impl Planner {
    /// Warnings about no-fly areas; empty where the route and its corridor keep clear of them.
    pub fn no_fly_sentences(&self, units: Units) -> Vec<String> {
        let found = &self.incursions;
        let far = |metres| distance_text(metres, units);
        let legs = found.legs.iter();
        let legs = legs.map(|it| it.sentence(found.name(it.zone), &far));
        let reached = found.reached.iter();
        let reached = reached.map(|it| it.sentence(found.name(it.zone), &far));
        legs.chain(reached).collect()
    }

    /// Looks at no-fly areas along the selected route anew, if anything changed.
    pub(super) fn check_incursions(&mut self, documents: &Documents) {
        let mission = &documents.mission;
        let route = mission.selected_route();
        // Nobody asks for the way where nothing is forbidden.
        let route = route.filter(|_| !mission.no_fly.is_empty());
        let bank = self.preferences.bank;
        let way = route.map(|route| flown_way(route, documents, bank));
        let way = way.unwrap_or_default();
        self.incursions.keep_to(mission, way, &self.forecast);
    }

    /// Says what is wrong before a route is exported for the first time; whether it did, so that the export waits.
    pub(super) fn asks_before_export(&mut self, context: &mut FeatureContext<'_>) -> bool {
        self.check_incursions(context.documents);
        let warnings = self.no_fly_sentences(context.view.units);
        let Some(first) = warnings.first().filter(|_| !self.incursions.was_told()) else {
            return false;
        };
        self.incursions.tell();
        let more = match warnings.len() {
            1 => "",
            _ => " The Route tab has more.",
        };
        let text = format!("{first}{more} Export again to save the route as it is.");
        context.trouble("The route was not exported yet", text);
        true
    }
}

/// Marks legs that lead over no-fly areas.
pub fn paint_incursions(
    painter: &Painter,
    view: &ScreenFromWorld,
    legs: &[Incursion],
    tokens: &Tokens,
) {
    for [a, b] in legs.iter().flat_map(|it| &it.parts) {
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
