//! Card of the pattern of a route, to be changed.

use egui::Ui;
use pilotage_core::mission::Route;

use super::button::button;
use super::command::PlanCommand;
use super::patterns::{CoveredGround, PassCircumstances, Pattern};
use crate::context::ViewContext;
use crate::shell::{NumberField, caption, counted, icon_button, icons::Icon, muted};
use crate::units::direction;

/// Draws what a pattern is made of.
pub fn pattern_card(
    ui: &mut Ui,
    route: &Route,
    pattern: &Pattern,
    circumstances: &PassCircumstances,
    cruise: f64,
    context: &mut ViewContext<'_>,
) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    let mut next = pattern.clone();
    let mut finished = true;
    let title = match pattern.cover {
        CoveredGround::Survey => "Survey of an area",
        CoveredGround::Corridor { .. } => "Corridor along a line",
    };
    caption(ui, tokens, title);
    ui.horizontal_wrapped(|ui| {
        ui.label(muted(tokens, "Overlap aside"));
        finished &= percent(ui, "Overlap with the pass beside", &mut next.side_overlap);
        ui.label(muted(tokens, "ahead"));
        finished &= percent(
            ui,
            "Overlap with the next picture",
            &mut next.forward_overlap,
        );
        match &mut next.cover {
            CoveredGround::Survey => {
                let stated = next.course_deg;
                let mut course = stated.unwrap_or(0.0);
                ui.label(muted(tokens, "course"));
                let field = NumberField::new(f64::MIN..=f64::MAX).decimals(1);
                let field = field.words(move |value| match stated {
                    Some(_) => format!("{:0>3}°", direction(value.to_radians(), 0)),
                    None => "fewest passes".to_owned(),
                });
                let field = field.show(ui, &mut course);
                let field = field.accessible_name("Course of the passes");
                if field.changed() {
                    next.course_deg = Some(course.rem_euclid(360.0));
                }
                finished &= !field.dragged();
                let label = "The course with the fewest passes";
                if stated.is_some() && icon_button(ui, tokens, Icon::Undo, label).clicked() {
                    next.course_deg = None;
                }
            }
            CoveredGround::Corridor { width_m } => {
                ui.label(muted(tokens, "width"));
                let field = NumberField::new(1.0..=20_000.0).unit((factor, unit));
                let field = field.show(ui, width_m);
                let field = field.accessible_name("Width of the corridor");
                finished &= !field.dragged();
            }
        }
    });
    let laid = pattern.laid(route, circumstances);
    let between = pattern.between_pictures(circumstances);
    let passes = match laid.spacing {
        Some(spacing) => {
            let overlap = 100.0 * Pattern::overlap(spacing, circumstances);
            let beside = if overlap < 0.0 {
                "with gaps between their pictures".to_owned()
            } else {
                format!("overlap {overlap:.0} %")
            };
            let apart = spacing * factor;
            let count = laid.count;
            format!("{count} passes, {apart:.0} {unit} apart, {beside}")
        }
        None => "1 pass".to_owned(),
    };
    let words = format!(
        "{passes}; a picture every {:.0} {unit}, {:.1} s in calm air.",
        between * factor,
        between / cruise
    );
    ui.label(muted(tokens, words));
    if !laid.is_of_now {
        let needed = counted(laid.needed, "pass", "passes");
        let words = format!(
            "They were laid for another height, camera or bank limit: now it takes {needed}."
        );
        ui.label(egui::RichText::new(words).color(tokens.warning));
        let set = PlanCommand::SetPattern {
            pattern: Box::new(pattern.clone()),
            finished: true,
        };
        let set = set.of(route.id);
        button(ui, context, None, "Lay the passes anew", true, set);
    }
    if next != *pattern {
        let set = PlanCommand::SetPattern {
            pattern: Box::new(next),
            finished,
        };
        context.commands.push(set.of(route.id).into());
    }
}

/// A share as a percentage; false while it is dragged.
fn percent(ui: &mut Ui, name: &str, share: &mut f64) -> bool {
    let field = NumberField::new(0.0..=0.95).unit((100.0, "%")).speed(0.5);
    !field.show(ui, share).accessible_name(name).dragged()
}
