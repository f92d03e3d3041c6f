//! The few numbers of a plan that matter, above the map.

use egui::{Align2, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::mission::Mission;
use pilotage_core::plan::Incursion;

use super::incursion_check::IncursionCheck;
use super::planner::Planner;
use super::words::{PredictionFigures, distance_text};
use crate::tokens::Tokens;
use crate::units::Units;

/// Name of the number about no-fly areas.
const NO_FLY: &str = "No-fly areas";

/// Draws the numbers from `left_top` on; returns what they cover.
pub fn plan_readouts(
    ui: &Ui,
    tokens: &Tokens,
    units: Units,
    planner: &Planner,
    mission: &Mission,
    left_top: egui::Pos2,
) -> Option<Rect> {
    let outlook = PredictionFigures::of(&planner.forecast.shown()?.prediction)?;
    let (factor, unit) = units.length();
    let over = if outlook.stretches == 0 {
        "nowhere".to_owned()
    } else {
        distance_text(outlook.over, units)
    };
    let mut cells = vec![
        (
            "Largest error (1σ)",
            format!("{:.1} {unit}", outlook.sigma * factor),
            false,
        ),
        (
            "Widest corridor",
            format!("±{:.1} {unit}", outlook.across * factor),
            false,
        ),
        (
            "Dead reckoning",
            format!("{:.0} s", outlook.dead_reckoning),
            false,
        ),
        ("Too uncertain", over, outlook.stretches > 0),
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
        cells.push((NO_FLY, words, !legs.is_empty() || is_reached));
    }
    let cell = vec2(120.0, 44.0);
    let rect = Rect::from_min_size(left_top, vec2(cell.x * cells.len() as f32 + 8.0, cell.y));
    let response = ui.interact(rect, ui.scope_id().with("plan readouts"), Sense::hover());
    response.widget_info(|| {
        let words: Vec<String> = cells.iter().map(|(n, v, _)| format!("{n}: {v}")).collect();
        WidgetInfo::labeled(Role::Label, true, words.join(". "))
    });
    let painter = ui.painter();
    painter.rect_filled(rect, tokens.radius, tokens.over_map());
    let line = Stroke::new(1.0, tokens.line);
    painter.rect_stroke(rect, tokens.radius, line, StrokeKind::Inside);
    for (index, (name, value, bad)) in cells.iter().enumerate() {
        let right = rect.left() + cell.x * (index + 1) as f32 - 4.0;
        let top = pos2(right, rect.top() + 6.0);
        painter.text(top, Align2::RIGHT_TOP, name, tokens.small(), tokens.muted);
        let bottom = pos2(right, rect.bottom() - 5.0);
        let color = match *bad {
            true if *name == NO_FLY => tokens.no_fly,
            true => tokens.warning,
            false => tokens.text,
        };
        painter.text(bottom, Align2::RIGHT_BOTTOM, value, tokens.normal(), color);
    }
    Some(rect)
}
