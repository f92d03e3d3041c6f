//! The sheet of filter settings. Each has its unit and one line on what it means.

use egui::{Slider, SliderClamping, Ui};
use pilotage_core::navigator::{EstimatorChoice, NavigatorSettings, VehicleChoice};
use pilotage_core::registration::FollowSettings;

use super::aid_settings::aids;
use super::landmark_settings::landmarks;
use super::setting_rows::{limit_slider, linear, meaning, named, scaled};
use crate::command::Command;
use crate::context::ViewContext;
use crate::shell::{caption, icons::Icon, muted, text_button, title};
use crate::tokens::Tokens;
use crate::units::Units;

/// Limit of the search that is offered first, metres to each side.
const USUAL_FARTHEST: f64 = 100.0;

/// Draws the sheet; true when it is to be closed. `usual` are the settings made for the flight.
pub fn settings_sheet(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    usual: impl FnOnce() -> NavigatorSettings,
) -> bool {
    let tokens = context.tokens;
    let close = title(ui, tokens, "Filter settings");
    ui.label(muted(
        tokens,
        "A change flies the flight again; the run before it stays on the map as a ghost.",
    ));
    ui.add_space(tokens.space);
    let mut settings = context.mission.navigator.clone();
    egui::ScrollArea::vertical()
        .auto_shrink([false, false])
        .show(ui, |ui| {
            estimator(ui, tokens, &mut settings);
            vehicle(ui, tokens, &mut settings);
            whole_frames(ui, tokens, &mut settings, context.units);
            landmarks(ui, tokens, &mut settings.detector, context.units);
            spread(ui, tokens, &mut settings);
            process(ui, tokens, &mut settings, context.units);
            measurement(ui, tokens, &mut settings, context.units);
            start(ui, tokens, &mut settings, context.units);
            aids(ui, tokens, &mut settings, context.flight, context.units);
            ui.add_space(tokens.space);
            if text_button(ui, tokens, Some(Icon::Undo), "Reset to default", false).clicked() {
                settings = usual();
            }
            ui.add_space(2.0 * tokens.space);
        });
    if settings != context.mission.navigator {
        context
            .commands
            .push(Command::SetNavigator(Box::new(settings)));
    }
    close
}

fn estimator(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings) {
    caption(ui, tokens, "Estimator");
    let chosen = &mut settings.estimator.choice;
    egui::ComboBox::from_id_salt("estimator")
        .selected_text(chosen.label())
        .width(ui.available_width() - 8.0)
        .show_ui(ui, |ui| {
            for choice in EstimatorChoice::ALL {
                ui.selectable_value(chosen, choice, choice.label());
            }
        })
        .response
        .accessible_name("Estimator");
    meaning(ui, tokens, chosen.description());
}

fn vehicle(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings) {
    caption(ui, tokens, "Vehicle model");
    egui::ComboBox::from_id_salt("vehicle")
        .selected_text(settings.vehicle.label())
        .width(ui.available_width() - 8.0)
        .show_ui(ui, |ui| {
            for choice in VehicleChoice::ALL {
                ui.selectable_value(&mut settings.vehicle, choice, choice.label());
            }
        })
        .response
        .accessible_name("Vehicle model");
    meaning(
        ui,
        tokens,
        "How the filter believes the vehicle to move between two pictures.",
    );
}

fn whole_frames(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings, units: Units) {
    caption(ui, tokens, "Whole pictures");
    let mut wanted = settings.whole_frames.is_some();
    if ui
        .checkbox(&mut wanted, "Lay whole pictures on the map")
        .changed()
    {
        settings.whole_frames = wanted.then(FollowSettings::default);
    }
    meaning(
        ui,
        tokens,
        "Finds where a picture lies from many places in it at once, before landmarks are looked for: needs a map \
         that looks like the ground, and neither landmarks nor, without airspeed, a heading.",
    );
    let Some(assumed) = &mut settings.whole_frames else {
        return;
    };
    let (length, length_unit) = units.length();
    scaled(
        ui,
        "Height if not logged",
        length_unit,
        &mut assumed.height,
        length,
        5.0..=1000.0,
    );
    search_limits(ui, tokens, assumed, units);
    ui.checkbox(
        &mut assumed.may_be_turned,
        "Pictures may be stored turned by quarter turns",
    );
}

/// Draws the limits of the search of pictures around the assumed position, heading and height, and the
/// accuracy of the map.
fn search_limits(ui: &mut Ui, tokens: &Tokens, assumed: &mut FollowSettings, units: Units) {
    let (length, length_unit) = units.length();
    let mut is_limited = assumed.farthest.is_some();
    let limit = ui.checkbox(&mut is_limited, "Search no farther than a limit");
    if limit.changed() {
        assumed.farthest = is_limited.then_some(USUAL_FARTHEST);
    }
    if let Some(farthest) = &mut assumed.farthest {
        let name = "Position, to each side";
        limit_slider(ui, name, length_unit, farthest, length, 5.0..=2000.0);
    }
    meaning(
        ui,
        tokens,
        "Otherwise pictures are searched as far as the filter is uncertain: a lost one searches far, and slowly.",
    );
    let mut heading = assumed.heading_limit();
    let degrees = 1.0_f64.to_degrees();
    let name = "Heading, to each side";
    if limit_slider(ui, name, "°", &mut heading, degrees, 0.02..=1.2) {
        assumed.limit_heading(heading);
    }
    meaning(
        ui,
        tokens,
        "How wrong the measured heading may be, the camera’s mount included: compasses of small drones are up to 30° off.",
    );
    let mut height = assumed.height_limit();
    let name = "Height, up and down";
    if limit_slider(ui, name, "%", &mut height, 100.0, 0.01..=1.5) {
        assumed.limit_height(height);
    }
    meaning(
        ui,
        tokens,
        "How wrong a measured height may be: the ground is not level where it is counted from take-off.",
    );
    let name = "Map is good to, σ";
    let map = &mut assumed.map_deviation;
    linear(ui, name, length_unit, map, length, 0.0..=20.0);
    meaning(
        ui,
        tokens,
        "How far off the map itself may be, per axis: some 3 m for satellite and aerial maps of the web, near 0 for an \
         orthophoto with ground control. No place is known better than its map.",
    );
}

fn spread(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings) {
    caption(ui, tokens, "Sigma points");
    let slider = Slider::new(&mut settings.alpha, 1e-4..=1.0)
        .clamping(SliderClamping::Edits)
        .logarithmic(true)
        .custom_formatter(|v, _| format!("{v:.1e}").replace("e0", ""));
    named(ui, "α", "", |ui| ui.add(slider));
    meaning(
        ui,
        tokens,
        "Spread of the sigma points: α·√n standard deviations from the mean, n the number of states.",
    );
    named(ui, "β", "", |ui| {
        ui.add(
            Slider::new(&mut settings.beta, 0.0..=4.0)
                .clamping(SliderClamping::Edits)
                .max_decimals(1),
        )
    });
    meaning(
        ui,
        tokens,
        "What is known of the distribution’s shape; 2 is best for a Gaussian.",
    );
    ui.checkbox(
        &mut settings.redraw,
        "Draw the points anew after the process noise",
    );
    meaning(
        ui,
        tokens,
        "Otherwise the predicted points are carried through to the correction.",
    );
}

fn process(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings, units: Units) {
    caption(ui, tokens, "Process noise Q");
    let (speed, speed_unit) = units.speed();
    let process = &mut settings.process;
    ui.checkbox(
        &mut process.thesis_per_step,
        "Fixed noise per step (original thesis)",
    );
    meaning(
        ui,
        tokens,
        "Otherwise densities in time, which do not depend on the length of a step.",
    );
    ui.add_enabled_ui(!process.thesis_per_step, |ui| {
        let unit = format!("{speed_unit}/√Hz");
        scaled(
            ui,
            "Airspeed noise",
            &unit,
            &mut process.airspeed,
            speed,
            0.01..=3.0,
        );
        meaning(
            ui,
            tokens,
            "How much the measured airspeed wanders about the true one.",
        );
        let degrees = 1.0_f64.to_degrees();
        scaled(
            ui,
            "Heading noise",
            "°/√Hz",
            &mut process.heading,
            degrees,
            0.001..=0.1,
        );
        meaning(
            ui,
            tokens,
            "How much the measured heading wanders about the true one.",
        );
        let unit = format!("{speed_unit}/√s");
        scaled(
            ui,
            "Wind drift",
            &unit,
            &mut process.wind,
            speed,
            0.001..=1.0,
        );
        meaning(
            ui,
            tokens,
            "How fast the wind may change: more learns faster and forgets faster.",
        );
    });
    let slider = Slider::new(&mut settings.shortest_step, 0.0..=1.0)
        .clamping(SliderClamping::Edits)
        .max_decimals(3);
    named(ui, "Shortest step", "s", |ui| ui.add(slider));
    meaning(
        ui,
        tokens,
        "Measurements that follow each other faster are taken together; 0 makes a step of each.",
    );
}

fn measurement(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings, units: Units) {
    caption(ui, tokens, "Measurement noise R and gate");
    let (length, length_unit) = units.length();
    scaled(
        ui,
        "Factor on R",
        "×",
        &mut settings.measurement_scale,
        1.0,
        0.05..=20.0,
    );
    meaning(ui, tokens, "Over 1 trusts the camera less, under 1 more.");
    let degrees = 1.0_f64.to_degrees();
    let sensors = &mut settings.sensors;
    let mut tilt = 0.5 * (sensors.roll + sensors.pitch);
    if scaled(ui, "Camera tilt σ", "°", &mut tilt, degrees, 0.001..=0.1) {
        sensors.roll = tilt;
        sensors.pitch = tilt;
    }
    meaning(
        ui,
        tokens,
        "Roll and pitch of the camera: attitude sensor and mount vibration together.",
    );
    scaled(
        ui,
        "Camera yaw σ",
        "°",
        &mut sensors.yaw,
        degrees,
        0.001..=0.2,
    );
    meaning(
        ui,
        tokens,
        "Error of the direction in which the picture’s top points.",
    );
    scaled(
        ui,
        "Height σ",
        length_unit,
        &mut sensors.height,
        length,
        0.05..=10.0,
    );
    meaning(ui, tokens, "Error of the height above ground.");
    scaled(ui, "Pixel σ", "px", &mut sensors.pixel, 1.0, 0.05..=10.0);
    meaning(
        ui,
        tokens,
        "Least error of a found place, added to what the detector says.",
    );
    scaled(
        ui,
        "Ground σ",
        length_unit,
        &mut sensors.ground,
        length,
        0.0..=10.0,
    );
    meaning(
        ui,
        tokens,
        "The same on the ground: another sun and season move what a landmark looks like, in every picture alike.",
    );
    scaled(
        ui,
        "Gate confidence",
        "%",
        &mut settings.gate_confidence,
        100.0,
        0.5..=0.9999,
    );
    meaning(
        ui,
        tokens,
        "A match this improbable for the filter is refused: lower refuses more.",
    );
}

fn start(ui: &mut Ui, tokens: &Tokens, settings: &mut NavigatorSettings, units: Units) {
    caption(ui, tokens, "Start");
    let (length, length_unit) = units.length();
    let (speed, speed_unit) = units.speed();
    let start = &mut settings.start;
    scaled(
        ui,
        "Position σ",
        length_unit,
        &mut start.position,
        length,
        0.1..=200.0,
    );
    meaning(
        ui,
        tokens,
        "How uncertain the filter believes the first position to be, per axis.",
    );
    scaled(ui, "Wind σ", speed_unit, &mut start.wind, speed, 0.1..=20.0);
    meaning(
        ui,
        tokens,
        "How uncertain the wind is at the start, per axis.",
    );
    linear(
        ui,
        "Error north",
        length_unit,
        &mut start.offset[0],
        length,
        -60.0..=60.0,
    );
    linear(
        ui,
        "Error east",
        length_unit,
        &mut start.offset[1],
        length,
        -60.0..=60.0,
    );
    meaning(
        ui,
        tokens,
        "An error put into the start on purpose: does the filter find back?",
    );
}
