//! The Plan workspace as journeys read it.

use serde_json::{Value, json};

use super::App;
use crate::plan::{Outlook, Pattern};

impl App {
    /// The plan for journeys.
    pub(super) fn plan_json(&self) -> Value {
        let planner = &self.views.planner;
        let mission = &self.documents.mission;
        let view = self.views.map.screen_from_world();
        let way_point = |w: &pilotage_core::mission::WayPoint| {
            let screen = view.map(|v| v.apply(&w.position));
            json!({
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
                json!({
                    "id": r.id,
                    "name": r.name,
                    "length": r.length(),
                    "pattern": Pattern::of(r).is_some(),
                    "way_points": r.way_points.iter().map(way_point).collect::<Vec<_>>(),
                })
            })
            .collect();
        let shown = planner.forecast.shown();
        let outlook = shown.and_then(|s| Outlook::of(&s.prediction));
        let mean = shown.map(|s| {
            let samples = &s.prediction.samples;
            let across: f64 = samples.iter().map(|s| s.corridor.across).sum();
            across / samples.len().max(1) as f64
        });
        let measured: Vec<Value> = mission
            .landmarks
            .iter()
            .filter_map(|l| Some((l, planner.assessments.of(l)?)))
            .map(|(l, m)| {
                json!({
                    "id": l.id,
                    "probability": m.last.expected.probability(),
                    "false_matches": m.last.false_matches,
                    "views": m.last.views.len(),
                })
            })
            .collect();
        json!({"plan": {
            "routes": routes,
            "route": self.documents.route,
            "way_point": planner.way_point,
            "drawing": planner.drawing,
            "limit": planner.preferences.limit,
            "chart": planner.chart_rect().map(|r| [r.left(), r.top(), r.right(), r.bottom()]),
            "marking": planner.marking.as_ref().map(|m| json!({
                "purpose": format!("{:?}", m.purpose),
                "corners": m.corners.len(),
            })),
            "marked": planner.marked(self.selection),
            "tab": format!("{:?}", planner.tab),
            "prediction": outlook.map(|o| json!({
                "fine": planner.forecast.is_fine(),
                "worlds": shown.map(|s| s.order.worlds),
                "took": shown.map(|s| s.took),
                "coarse_took": planner.forecast.coarse_took().map(|t| t.0),
                "coarse_computed": planner.forecast.coarse_took().map(|t| t.1),
                "landmarks": shown.map(|s| s.order.landmarks.len()),
                "worst_sigma": o.sigma,
                "widest": o.across,
                "mean_width": mean,
                "dead_reckoning": o.dead_reckoning,
                "stretches": o.stretches,
                "over": o.over,
                "length": o.length,
            })),
            "trouble": planner.forecast.trouble(),
            "measured": measured,
            "areas": mission.no_fly.iter().map(|z| json!({
                "name": z.name,
                "corners": z.corners.iter().map(|p| [p.north, p.east]).collect::<Vec<_>>(),
            })).collect::<Vec<_>>(),
            "no_fly": mission.no_fly.iter().map(|z| z.corners.len()).collect::<Vec<_>>(),
            "heat": planner.heat_json(),
            "remedies": planner.remedies.json(),
            "find": planner.find_json(),
            "suggested": planner.suggestions_json(&mission.landmarks),
            "envelopes": mission.landmarks.iter().filter_map(|l| {
                let (height, envelope) = planner.assessments.envelope(l)?;
                let looks = envelope.cells.iter().map(|c| c.looks).sum::<usize>();
                Some(json!({"id": l.id, "height": height, "looks": looks}))
            }).collect::<Vec<_>>(),
            "surveying": planner.assessments.surveyed(),
            "trainings": planner.trainings.json(&self.documents),
            "measuring": planner.assessments.under_way().map(|(id, fraction, words)| {
                json!({"id": id, "progress": fraction, "words": words})
            }),
        }})
    }
}
