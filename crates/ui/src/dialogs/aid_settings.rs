//! Settings of the aids beside pictures, made from their list.

use egui::Ui;
use pilotage_core::flight::Flight;
use pilotage_core::navigator::{AidInfo, ChosenAid, NavigatorSettings};

use super::setting_rows::{meaning, scaled};
use crate::shell::caption;
use crate::tokens::Tokens;
use crate::units::Units;

/// Range of a number that is offered, as factors on its usual value.
const RANGE: (f64, f64) = (0.02, 50.0);

/// Draws a switch for every aid, with its numbers while it is on; those of which `flight` has no readings, or no pictures
/// where they look at these, cannot be switched on.
pub(super) fn aids(
    ui: &mut Ui,
    tokens: &Tokens,
    settings: &mut NavigatorSettings,
    flight: Option<&Flight>,
    units: Units,
) {
    caption(ui, tokens, "Aids beside pictures");
    ui.checkbox(&mut settings.estimates_height, "Estimate the height");
    meaning(
        ui,
        tokens,
        "Height and the bias of the barometer become states of the filter, for the aids that measure them. Landmarks are \
         still looked for from the height in the log. Where the biases of airspeed and heading are estimated as well, the map's \
         error is no state then, but taken to be another in every picture: over a long time the position becomes surer \
         than the map.",
    );
    let chosen = &mut settings.aids;
    for info in AidInfo::ALL {
        let place = chosen.iter().position(|aid| aid.key == info.key);
        let lack = flight.map_or(Some("readings of it"), |flight| lack(info, flight));
        let has_readings = lack.is_none();
        let mut is_on = place.is_some();
        ui.add_enabled_ui(has_readings || is_on, |ui| {
            if ui.checkbox(&mut is_on, info.label).changed() {
                match place {
                    Some(place) => drop(chosen.remove(place)),
                    None => chosen.push(ChosenAid::usual(info.key)),
                }
            }
        });
        let text = match lack {
            None => info.description.to_owned(),
            Some(lack) => format!("{} This flight has no {lack}.", info.description),
        };
        meaning(ui, tokens, &text);
        if let Some(aid) = chosen.iter_mut().find(|aid| aid.key == info.key) {
            numbers(ui, info, aid, units);
        }
    }
}

/// Part of a flight without which an aid tells nothing, if it lacks one.
fn lack(info: &AidInfo, flight: &Flight) -> Option<&'static str> {
    let mut channels = info.channels.iter().map(|name| flight.channel(*name));
    if info.sees() && flight.frames.is_empty() {
        Some("pictures")
    } else if channels.all(|channel| channel.is_some_and(|c| !c.times.is_empty())) {
        None
    } else {
        Some("readings of it")
    }
}

fn numbers(ui: &mut Ui, info: &AidInfo, aid: &mut ChosenAid, units: Units) {
    let Ok(values) = info.values(aid) else { return };
    for (number, mut value) in info.numbers.iter().zip(values) {
        let range = RANGE.0 * number.usual..=RANGE.1 * number.usual;
        let (factor, unit) = match number.unit {
            "rad" => (1.0_f64.to_degrees(), "°"),
            "m" => units.length(),
            "m/s" => units.speed(),
            unit => (1.0, unit),
        };
        if scaled(ui, number.label, unit, &mut value, factor, range) {
            *aid = std::mem::take(aid).with(number.key, value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_core::camera::CameraModel;
    use pilotage_core::flight::{Frame, StartFix};
    use pilotage_core::frames::GroundPoint;

    #[test]
    fn what_looks_at_pictures_needs_some() {
        let mut flight = Flight {
            name: "tables".to_owned(),
            frame_on_globe: None,
            camera: CameraModel::pinhole(64, 48, 1.0),
            ground_down: 0.0,
            channels: Vec::new(),
            frames: Vec::new(),
            start: StartFix {
                time: 0.0,
                position: GroundPoint::default(),
                standard_deviation: 3.0,
            },
            truth: None,
        };
        let lacks = |flight: &Flight| {
            ["roads", "gps-position"]
                .map(|key| AidInfo::named(key).ok().and_then(|it| lack(it, flight)))
        };
        assert_eq!(lacks(&flight), [Some("pictures"), Some("readings of it")]);
        flight.frames.push(Frame {
            time: 0.0,
            name: "1".to_owned(),
            stored_turn: 0.0,
        });
        assert_eq!(lacks(&flight), [None, Some("readings of it")]);
    }
}
