//! The few numbers that matter at the time cursor, above the map.

use egui::{Rect, Ui};
use pilotage_core::imagery::terrain::{HeightDatum, Terrain as _};
use pilotage_core::navigator::{Run, StepReport};
use pilotage_core::vehicle::StateComponent;

use crate::context::ViewContext;
use crate::documents::OpenedTerrain;
use crate::shell::{Headline, Light, Readout, hud};
use crate::units::{direction, with_minus};

/// Stretch of time whose course is drawn, seconds.
const COURSE: f64 = 60.0;
/// Points of the course.
const POINTS: usize = 49;

/// Light for a position within `radius` metres, seen from `height` metres above the ground: about as much ground as
/// that is in the picture.
fn light(radius: f64, height: f64) -> (Light, &'static str) {
    match radius / height.max(1e-3) {
        share if share <= 0.1 => (Light::Good, "good"),
        share if share <= 0.5 => (Light::Fair, "fair"),
        _ => (Light::Poor, "poor"),
    }
}

/// Longer standard deviation of the position over the last minute, metres: of the same course as the circle's radius,
/// whose integral would be sought too often.
fn course(run: &Run, time: f64) -> Vec<f64> {
    let begin = run
        .span()
        .map_or(time, |(first, _)| first.max(time - COURSE));
    if time - begin < 1.0 {
        return Vec::new();
    }
    let times = (0..POINTS).map(|i| begin + (time - begin) * i as f64 / (POINTS - 1) as f64);
    let steps = times.filter_map(|time| run.step_at(time));
    let axes = steps.map(|step| {
        let covariance = step.after.position_covariance();
        let half = (0.5 * (covariance.m11 - covariance.m22)).hypot(covariance.m12);
        (0.5 * covariance.trace() + half).max(0.0).sqrt()
    });
    axes.collect()
}

/// The time of which the course is, in words.
fn stretch(span: Option<(f64, f64)>, time: f64) -> &'static str {
    if span.is_some_and(|(first, _)| time - first < COURSE) {
        "so far"
    } else {
        "last 60 s"
    }
}

fn headline(context: &ViewContext<'_>, step: &StepReport, radius: f64) -> Headline<'static> {
    let (value, unit) = context.units.short_distance(radius);
    let (light, word) = light(radius, step.control.height);
    Headline {
        name: "Position (95 %)",
        lead: "within ",
        value,
        unit,
        light,
        word,
        why: "Good: within a tenth of the height above ground. Fair: within half of it. Poor: landmarks may be \
              elsewhere in the picture than they are looked for, or outside of it.",
        course: context
            .run
            .map_or_else(Vec::new, |run| course(run, step.time)),
        stretch: stretch(context.run.and_then(Run::span), step.time),
    }
}

fn readouts(
    context: &ViewContext<'_>,
    ground: &OpenedTerrain,
    step: &StepReport,
    radius: f64,
) -> Vec<Readout> {
    let (length, length_unit) = context.units.length();
    let (speed, speed_unit) = context.units.speed();
    let mut list = Vec::new();
    let truth = context.flight.and_then(|f| f.truth.as_ref());
    if let Some(truth) = truth.and_then(|t| t.position(step.time)) {
        let own = step.after.position();
        let error = (own.north - truth.x).hypot(own.east - truth.y);
        let (value, unit) = context.units.short_distance(error);
        list.push(Readout {
            name: if context.is_recorded {
                "Off the recorded track"
            } else {
                "True error"
            },
            value: format!("{value} {unit}"),
            color: (error > radius).then_some(context.tokens.warning),
        });
    }
    let mut add = |name, value: String, unit| {
        let value = with_minus(&format!("{value} {unit}"));
        let color = None;
        list.push(Readout { name, value, color });
    };
    let wind = context.run.and_then(|run| {
        let at = |component| run.state_index(component).map(|i| step.after.mean[i]);
        Some((
            at(StateComponent::WindNorth)?,
            at(StateComponent::WindEast)?,
        ))
    });
    if let Some((north, east)) = wind {
        let from = direction((-east).atan2(-north), 0);
        let strength = north.hypot(east) * speed;
        add(
            "Wind (estimated) from",
            if strength < 0.05 {
                "0.0".to_owned()
            } else {
                format!("{from:0>3}° {strength:.1}")
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

/// Draws the numbers from `left_top` on; `room` points are free to the right. The part of the screen that they cover.
pub fn paint_readouts(
    ui: &Ui,
    context: &ViewContext<'_>,
    ground: &OpenedTerrain,
    step: &StepReport,
    left_top: egui::Pos2,
    room: f32,
) -> Rect {
    let radius = step.radius_held();
    let headline = headline(context, step, radius);
    let rest = readouts(context, ground, step, radius);
    hud(ui, context.tokens, &headline, &rest, left_top, room)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_course_is_called_as_long_as_it_is() {
        assert_eq!(COURSE, 60.0);
        assert_eq!(stretch(Some((100.0, 400.0)), 159.0), "so far");
        assert_eq!(stretch(Some((100.0, 400.0)), 160.0), "last 60 s");
    }

    #[test]
    fn the_light_goes_with_the_share_of_the_picture() {
        assert_eq!(light(12.0, 121.0).0, Light::Good);
        assert_eq!(light(0.35, 3.0).0, Light::Fair, "in a hall");
        assert_eq!(light(0.35, 121.0).0, Light::Good);
        assert_eq!(light(80.0, 121.0).0, Light::Poor);
        assert_eq!(light(1.0, 0.0).0, Light::Poor, "on the ground");
    }
}
