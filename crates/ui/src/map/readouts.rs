//! The few numbers that matter at the time cursor, above the map.

use egui::{Align2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use pilotage_core::filter::circle_radius;
use pilotage_core::imagery::terrain::{HeightDatum, Terrain as _};
use pilotage_core::navigator::StepReport;

use crate::context::ViewContext;
use crate::documents::OpenedTerrain;
use crate::tokens::Tokens;

/// Single number: its name, value and unit.
struct Readout {
    name: &'static str,
    value: String,
    unit: &'static str,
    /// Whether it is beyond what was promised.
    is_broken: bool,
}

/// Probability with which the position is within the distance that is told.
const HELD: f64 = 0.95;

fn readouts(context: &ViewContext<'_>, ground: &OpenedTerrain, step: &StepReport) -> Vec<Readout> {
    let (length, length_unit) = context.units.length();
    let (speed, speed_unit) = context.units.speed();
    let radius = circle_radius(&step.after.position_covariance(), HELD);
    let (within, within_unit) = context.units.short_distance(radius);
    let mut list = vec![Readout {
        name: "Position within (95 %)",
        value: within,
        unit: within_unit,
        is_broken: false,
    }];
    let truth = context.flight.and_then(|f| f.truth.as_ref());
    if let Some(truth) = truth.and_then(|t| t.position(step.time)) {
        let own = step.after.position();
        let error = (own.north - truth.x).hypot(own.east - truth.y);
        let (value, unit) = context.units.short_distance(error);
        list.push(Readout {
            name: "True error",
            value,
            unit,
            is_broken: error > radius,
        });
    }
    let mut add = |name, value: String, unit| {
        list.push(Readout {
            name,
            value,
            unit,
            is_broken: false,
        });
    };
    let wind = context.run.and_then(|run| {
        let at = |name| run.state_index(name).map(|i| step.after.mean[i]);
        Some((at("wind north")?, at("wind east")?))
    });
    if let Some((north, east)) = wind {
        let from = (-east).atan2(-north).to_degrees().rem_euclid(360.0);
        let strength = north.hypot(east) * speed;
        add(
            "Wind (estimated) from",
            if strength < 0.05 {
                "0.0".to_owned()
            } else {
                format!("{from:03.0}° {strength:.1}")
            },
            speed_unit,
        );
    }
    // Rounded before it is written: a little below the ground is no "-0".
    let height = (step.control.height * length).round() + 0.0;
    add("Height above ground", format!("{height:.0}"), length_unit);
    let below = ground.height_at(&step.after.position());
    if let Some((below, grid)) = below.zip(ground.heights()) {
        let height = (below + step.control.height) * length;
        let name = match grid.datum() {
            HeightDatum::MeanSeaLevel(_) => "Height AMSL",
            HeightDatum::Ellipsoid => "Above the ellipsoid",
            HeightDatum::NotStated => "Height, no datum",
        };
        add(name, format!("{height:.0}"), length_unit);
    }
    list
}

/// Draws the numbers from `left_top` on; `room` points are free to the right. What it covers.
pub fn paint_readouts(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    ground: &OpenedTerrain,
    step: &StepReport,
    left_top: egui::Pos2,
    room: f32,
) -> Rect {
    let tokens: &Tokens = context.tokens;
    let mut list = readouts(context, ground, step);
    let cell = vec2(128.0, 44.0);
    list.truncate((room / cell.x).max(1.0) as usize);
    let size = vec2(cell.x * list.len() as f32 + 8.0, cell.y);
    let rect = Rect::from_min_size(left_top, size);
    let response = ui.interact(rect, ui.scope_id().with("readouts"), Sense::hover());
    response.widget_info(|| {
        let words: Vec<String> = list
            .iter()
            .map(|r| format!("{}: {} {}", r.name, r.value, r.unit))
            .collect();
        WidgetInfo::labeled(Role::Label, true, words.join(". "))
    });
    let painter = ui.painter();
    painter.rect_filled(rect, tokens.radius, tokens.over_map());
    painter.rect_stroke(
        rect,
        tokens.radius,
        Stroke::new(1.0, tokens.line),
        egui::StrokeKind::Inside,
    );
    for (index, readout) in list.iter().enumerate() {
        let right = rect.left() + cell.x * (index + 1) as f32 - 4.0;
        painter.text(
            pos2(right, rect.top() + 6.0),
            Align2::RIGHT_TOP,
            readout.name,
            tokens.small(),
            tokens.muted,
        );
        let color = if readout.is_broken {
            tokens.warning
        } else {
            tokens.text
        };
        let unit = painter.text(
            pos2(right, rect.bottom() - 6.0),
            Align2::RIGHT_BOTTOM,
            readout.unit,
            tokens.small(),
            tokens.muted,
        );
        painter.text(
            pos2(unit.left() - 4.0, rect.bottom() - 5.0),
            Align2::RIGHT_BOTTOM,
            &readout.value,
            tokens.normal(),
            color,
        );
    }
    rect
}
