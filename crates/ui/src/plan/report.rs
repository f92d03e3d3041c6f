//! The Plan workspace as journeys read it.

use pilotage_core::frames::GroundPoint;
use serde_json::Value;

use crate::state_json::object;

use super::patterns::Pattern;
use super::planner::Planner;
use super::verdict::LandmarkVerdict;
use super::words::PredictionFigures;
use crate::documents::Documents;
use crate::shell::counted;
use crate::units::Units;

impl Planner {
    /// The plan for journeys.
    pub(super) fn json(&self, documents: &Documents) -> Value {
        let mission = &documents.mission;
        let way_point = |w: &pilotage_core::mission::WayPoint| {
            let screen = self.seen.view.map(|v| v.apply(&w.position));
            object!({
                "north": w.position.north,
                "east": w.position.east,
                "altitude": w.altitude.metres,
                "frame": w.altitude.frame.name(),
                "speed": w.speed,
                "action": format!("{:?}", w.action),
                "screen": screen.map(|p| [p.x, p.y]),
            })
        };
        let routes: Vec<Value> = mission
            .routes
            .iter()
            .map(|r| {
                object!({
                    "id": r.id,
                    "name": r.name,
                    "length": r.length(),
                    "returns": r.returns,
                    "pattern": Pattern::of(r).is_some(),
                    "way_points": r.way_points.iter().map(way_point).collect::<Vec<_>>(),
                })
            })
            .collect();
        let ring = |corners: &Vec<GroundPoint>| -> Vec<[f64; 2]> {
            corners.iter().map(|p| [p.north, p.east]).collect()
        };
        let shown = self.forecast.shown();
        let outlook = shown.and_then(|s| PredictionFigures::of(&s.prediction));
        let mean = shown.map(|s| {
            let samples = &s.prediction.samples;
            let across: f64 = samples.iter().map(|s| s.corridor.across).sum();
            across / samples.len().max(1) as f64
        });
        object!({
            "routes": routes,
            "route": documents.mission.route,
            "way_point": self.way_point,
            "drawing": self.drawing,
            "limit": self.preferences.limit,
            "chart": self.chart_rect().map(|r| [r.left(), r.top(), r.right(), r.bottom()]),
            "marking": self.marking.as_ref().map(|m| object!({
                "purpose": format!("{:?}", m.purpose),
                "corners": m.corners.len(),
            })),
            "marked": self.marked(self.seen.selection),
            "tab": format!("{:?}", self.tab),
            "prediction": outlook.map(|o| object!({
                "fine": self.forecast.is_fine(),
                "worlds": shown.map(|s| s.order.worlds),
                "took": shown.map(|s| s.took),
                "coarse_took": self.forecast.coarse_took().map(|t| t.0),
                "coarse_computed": self.forecast.coarse_took().map(|t| t.1),
                "landmarks": shown.map(|s| s.order.landmarks.len()),
                "worst_sigma": o.sigma,
                "widest": o.across,
                "mean_width": mean,
                "dead_reckoning": o.dead_reckoning,
                "stretches": o.stretches,
                "over": o.over,
                "length": o.length,
            })),
            "trouble": self.forecast.trouble(),
            "measured": self.measured_json(documents),
            "untested": self.untested.json(),
            "areas": mission.no_fly.iter().map(|z| object!({
                "name": z.name,
                "corners": ring(&z.corners),
                "holes": z.holes.iter().map(ring).collect::<Vec<_>>(),
            })).collect::<Vec<_>>(),
            "rally": mission.rally.iter().map(|r| object!({
                "name": r.name,
                "north": r.position.north,
                "east": r.position.east,
                "altitude": r.altitude.metres,
            })).collect::<Vec<_>>(),
            "no_fly_warnings": documents
                .mission.selected_route()
                .map(|_| self.no_fly_sentences(crate::units::Units::Metric)),
            "no_fly": mission.no_fly.iter().map(|z| z.corners.len()).collect::<Vec<_>>(),
            "heat": self.heat_json(),
            "rehearsal": self.rehearsal.json(),
            "remedies": self.remedies.json(),
            "find": self.find_json(),
            "suggested": self.suggestions_json(&mission.landmarks),
            "envelopes": mission.landmarks.iter().filter_map(|l| {
                let (height, envelope) = self.assessments.envelope(l)?;
                let looks = envelope.cells.iter().map(|c| c.looks).sum::<usize>();
                Some(object!({"id": l.id, "height": height, "looks": looks}))
            }).collect::<Vec<_>>(),
            "surveying": self.assessments.surveyed(),
            "trainings": self.trainings.json(documents),
            "measuring": self.assessments.under_way().map(|(id, fraction, words)| {
                object!({"id": id, "progress": fraction, "words": words})
            }),
        })
    }

    fn measured_json(&self, documents: &Documents) -> Value {
        let landmarks = documents.mission.landmarks.iter();
        let measured = landmarks.filter_map(|l| {
            let measured = &self.assessments.of(l)?.last;
            Some(object!({
                "id": l.id,
                "probability": measured.expected.probability(),
                "false_matches": measured.false_matches,
                "views": measured.views.len(),
                "verdict": LandmarkVerdict::of(measured).word(),
            }))
        });
        Value::Array(measured.collect())
    }

    /// The plan in a sentence or two.
    pub(super) fn text(&self, documents: &Documents, units: Units) -> String {
        let Some(route) = documents.mission.selected_route() else {
            return "No route yet.".to_owned();
        };
        let mut parts = vec![format!(
            "{}: {}.",
            route.name,
            counted(route.way_points.len(), "way-point", "way-points")
        )];
        let shown = self.forecast.shown();
        if let Some(outlook) = shown.and_then(|s| PredictionFigures::of(&s.prediction)) {
            let landmarks = &documents.mission.landmarks;
            let limit = self.preferences.limit;
            parts.extend(outlook.sentences(limit, &landmarks.iter().collect::<Vec<_>>(), units));
            parts.extend(self.remedies.sentences(units));
        }
        parts.join(" ")
    }
}
