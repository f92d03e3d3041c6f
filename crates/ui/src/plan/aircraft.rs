//! Aircraft as the user states it: its bank limit, its power and the energy on board.

use egui::Ui;
use pilotage_core::frames::GroundPoint;
use pilotage_core::mission::Route;
use pilotage_core::mission::turn::{too_short, turn_radius};

use super::PlanCommand;
use super::legs::Leg;
use super::planner::PlanPreferences;
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{NumberField, caption, icon_button, icons::Icon, muted};
use pilotage_core::plan::cruise;

/// Radius of the turn at a way-point, metres, at the airspeed of the leg that leads there and the
/// bank limit, in calm air.
pub fn radius_at(route: &Route, index: usize, bank: f64) -> f64 {
    let speed = route.way_points.get(index).and_then(|w| w.speed);
    turn_radius(speed.unwrap_or_else(cruise), bank)
}

/// Legs that are too short for the turns at their ends, by the way-point they lead to.
pub fn tight_legs(route: &Route, bank: f64) -> Vec<usize> {
    let places: Vec<GroundPoint> = route.way_points.iter().map(|w| w.position).collect();
    let radii = (0..places.len()).map(|i| radius_at(route, i, bank));
    too_short(&places, radii.fold(0.0, f64::max))
}

/// Energy left at each way-point, watt hours; `None` if the user states no power or nothing on
/// board, or where the wind does not let the aircraft get on.
pub fn energy_left(legs: &[Leg], preferences: &PlanPreferences) -> Option<Vec<f64>> {
    let (power, mut left) = (preferences.power?, preferences.energy?);
    let mut list = vec![left];
    for leg in legs {
        left -= power * leg.time? / 3600.0;
        list.push(left);
    }
    Some(list)
}

/// Draws the fields.
pub fn aircraft(ui: &mut Ui, preferences: &PlanPreferences, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    caption(ui, tokens, "Aircraft");
    let mut next = preferences.clone();
    ui.horizontal_wrapped(|ui| {
        ui.label(muted(tokens, "Bank up to"));
        let field = NumberField::new(5_f64.to_radians()..=60_f64.to_radians());
        let field = field.degrees().speed(0.25).show(ui, &mut next.bank);
        field.accessible_name("Bank limit");
        let (factor, unit) = context.units.length();
        let radius = turn_radius(cruise(), preferences.bank) * factor;
        ui.label(muted(
            tokens,
            format!("turns of {radius:.0} {unit} in cruise"),
        ));
    });
    ui.horizontal_wrapped(|ui| {
        optional(
            ui,
            "Power in cruise",
            " W",
            "Power in cruise",
            &mut next.power,
            context,
        );
        optional(
            ui,
            "Energy on board",
            " Wh",
            "Energy on board",
            &mut next.energy,
            context,
        );
    });
    if next != *preferences {
        let command = PlanCommand::SetAircraft {
            bank: next.bank,
            power: next.power,
            energy: next.energy,
        };
        context.commands.push(Command::from(command));
    }
}

/// A number that may be stated, and unstated again.
fn optional(
    ui: &mut Ui,
    label: &str,
    unit: &str,
    name: &str,
    value: &mut Option<f64>,
    context: &ViewContext<'_>,
) {
    let tokens = context.tokens;
    ui.label(muted(tokens, label));
    let stated = *value;
    let mut number = stated.unwrap_or(0.0);
    let suffix = unit.to_owned();
    let field = NumberField::new(0.0..=1e6).words(move |value| match stated {
        Some(_) => format!("{value:.0}{suffix}"),
        None => "not stated".to_owned(),
    });
    let field = field.show(ui, &mut number);
    if field.accessible_name(name).changed() {
        *value = Some(number).filter(|n| *n > 0.0);
    }
    let forget = format!("Do not state: {}", name.to_lowercase());
    if stated.is_some() && icon_button(ui, tokens, Icon::Close, &forget).clicked() {
        *value = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_sinks_with_the_time_of_the_legs() {
        let leg = |time| Leg {
            distance: 100.0,
            course: None,
            time,
        };
        let stated = PlanPreferences {
            power: Some(180.0),
            energy: Some(60.0),
            ..PlanPreferences::default()
        };
        let legs = [leg(Some(600.0)), leg(Some(300.0))];
        assert_eq!(energy_left(&legs, &stated), Some(vec![60.0, 30.0, 15.0]));
        assert_eq!(energy_left(&[leg(None)], &stated), None);
        assert_eq!(energy_left(&legs, &PlanPreferences::default()), None);
    }
}
