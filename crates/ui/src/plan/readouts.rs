//! The few numbers of a plan that matter, above the map.

use egui::{Rect, Ui};
use pilotage_core::mission::Mission;
use pilotage_core::plan::Incursion;

use super::incursion_check::IncursionCheck;
use super::planner::Planner;
use super::route_tab::stopped;
use super::words::{PredictionFigures, distance_text};
use crate::shell::{Headline, Light, Readout, hud};
use crate::tokens::Tokens;
use crate::units::Units;

/// Draws the numbers from `left_top` on, where `room` points are free; returns what they cover.
pub fn plan_readouts(
    ui: &Ui,
    tokens: &Tokens,
    units: Units,
    planner: &Planner,
    mission: &Mission,
    left_top: egui::Pos2,
    room: f32,
) -> Option<Rect> {
    let prediction = &planner.forecast.shown()?.prediction;
    let outlook = PredictionFigures::of(prediction)?;
    let is_within = outlook.stretches == 0;
    let over = if is_within {
        "nowhere".to_owned()
    } else {
        distance_text(outlook.over, units)
    };
    let plain = |name, value| Readout {
        name,
        value,
        color: None,
    };
    let across = format!("±{}", units.short(outlook.across));
    let mut rest = vec![
        plain("Widest corridor", across),
        plain("Dead reckoning", format!("{:.0} s", outlook.dead_reckoning)),
        Readout {
            color: (!is_within).then_some(tokens.warning),
            ..plain("Too uncertain", over)
        },
    ];
    if !mission.no_fly.is_empty() {
        let IncursionCheck { legs, reached, .. } = &planner.incursions;
        let over: f64 = legs.iter().map(Incursion::length).sum();
        let is_reached = !reached.is_empty();
        let words = match (legs.is_empty(), is_reached) {
            (false, _) => format!("{} over", distance_text(over, units)),
            (true, true) => "corridor reaches".to_owned(),
            (true, false) => "clear".to_owned(),
        };
        let is_bad = !legs.is_empty() || is_reached;
        rest.push(Readout {
            color: is_bad.then_some(tokens.no_fly),
            ..plain("No-fly areas", words)
        });
    }
    let (light, word) = if stopped(planner).is_some() {
        (Light::Poor, "wind too strong")
    } else if is_within {
        (Light::Good, "in the limit")
    } else {
        (Light::Poor, "over the limit")
    };
    let samples = &prediction.samples;
    let (value, unit) = units.short_distance(outlook.sigma);
    let headline = Headline {
        name: "Largest error (1σ)",
        lead: "",
        value,
        unit,
        light,
        word,
        why: "Predicted for the whole route; the limit is set in the Route tab.",
        course: samples.iter().map(|it| it.corridor.sigma_major).collect(),
        stretch: "along the route",
    };
    Some(hud(ui, tokens, &headline, &rest, left_top, room))
}
