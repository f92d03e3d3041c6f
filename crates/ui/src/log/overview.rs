//! A log at a glance: what it is, what measured, what looks wrong, what can be done with it.

use egui::{RichText, Ui};
use pilotage_core::exchange::Format;
use pilotage_core::flight::log::{LogFormat, LogOutline};
use pilotage_core::flight::overview::{Ability, Finding, Overview, Sensor, Severity};
use pilotage_core::flight::with_moments;
use pilotage_core::sorting::sort;
use pilotage_core::text::capitalised;

use super::words::{date, duration, size};
use super::{LogCommand, OpenLog};
use crate::command::Command;
use crate::context::ViewContext;
use crate::export_command::ExportCommand;
use crate::feature_command::FeatureCommand;
use crate::units::{clock, direction};
use crate::views::parts::{self, NumberReadout};

/// Messages shown before the rest is folded.
const FIRST_MESSAGES: usize = 400;

/// Draws the overview of a log, with what was found `beside` it in pictures and in flight; `progress` says how far
/// its reading is, if it goes on.
pub fn overview_panel(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    log: &OpenLog,
    beside: &[Finding],
    progress: Option<f32>,
) {
    let tokens = context.tokens;
    let Some(outline) = &log.outline else {
        parts::empty(
            ui,
            tokens,
            "Reading the log",
            "What it holds shows here in a moment.",
        );
        return;
    };
    let first = context.clock_zero;
    ui.label(
        RichText::new(&outline.name)
            .font(tokens.large())
            .color(tokens.text),
    );
    let mut about = vec![outline.format.label().to_owned()];
    about.push(size(outline.report.bytes));
    if !outline.vehicle.is_empty() {
        about.push(outline.vehicle.clone());
    }
    ui.label(RichText::new(about.join(" · ")).color(tokens.muted));
    vehicles(ui, context, outline, log.is_read());
    if let Some(progress) = progress {
        let percent = 100.0 * progress;
        ui.label(RichText::new(format!("Read so far: {percent:.0} %")).color(tokens.accent));
    } else if !log.is_read() {
        ui.label(RichText::new("Reading was stopped.").color(tokens.warning));
        let again = crate::shell::text_button(ui, tokens, None, "Read it again", false);
        if again.clicked() {
            context.commands.push(Command::from(LogCommand::ReadAgain));
        }
    }
    if outline.format == LogFormat::Photos {
        let words = "Lay them on the map one by one";
        if crate::shell::text_button(ui, tokens, None, words, false).clicked() {
            let show = Command::Feature(FeatureCommand::show("photos"));
            context.commands.push(show);
        }
    }
    ui.add_space(0.5 * tokens.space);
    facts(ui, context, outline, log.overview.as_ref());
    if let Some(overview) = &log.overview {
        let mut all = [beside, &overview.findings[..]].concat();
        sort(&mut all, &|a, b| b.severity.cmp(&a.severity));
        findings(ui, context, &all, first);
        abilities(ui, context, &overview.abilities);
        sensors(ui, context, &overview.sensors);
        save_track(ui, context);
    }
    modes(ui, context, outline, first);
    messages(ui, context, outline, first);
    parameters(ui, context, outline);
}

/// The choice of the vehicle that flies, where there are several and all of the log was read.
fn vehicles(ui: &mut Ui, context: &mut ViewContext<'_>, outline: &LogOutline, is_read: bool) {
    let Some(chosen) = outline
        .chosen_vehicle
        .filter(|_| is_read && outline.vehicles.len() > 1)
    else {
        return;
    };
    ui.horizontal(|ui| {
        ui.label("Vehicle that flies");
        let name = |system: u32| format!("System {system}");
        let choice = egui::ComboBox::from_id_salt("vehicle").selected_text(name(chosen));
        let choice = choice.show_ui(ui, |ui| {
            for system in &outline.vehicles {
                let is_chosen = *system == chosen;
                if ui.selectable_label(is_chosen, name(*system)).clicked() && !is_chosen {
                    let fly = LogCommand::FlyVehicle(*system);
                    context.commands.push(Command::from(fly));
                }
            }
        });
        choice.response.accessible_name("Vehicle that flies");
    });
}

/// Buttons that save the estimated track for maps and globes.
fn save_track(ui: &mut Ui, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    parts::section(ui, tokens, "Save the flown track", true, |ui| {
        ui.label(
            RichText::new("As the filter estimated it, with the field that colours the track.")
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
        ui.horizontal(|ui| {
            for format in Format::all().filter(|format| format.holds_tracks()) {
                let words = format.name();
                if crate::shell::text_button(ui, tokens, None, words, false).clicked() {
                    context.commands.push(ExportCommand::Track(format).into());
                }
            }
        });
    });
}

fn facts(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    outline: &LogOutline,
    overview: Option<&Overview>,
) {
    let tokens = context.tokens;
    let mut row = |label: &str, value: String, unit: &str| {
        parts::reading(ui, tokens, &NumberReadout::new(label, value, unit));
    };
    if let (Some(utc), Some(span)) = (outline.utc_at_zero, outline.span) {
        row("Began", date(utc + span.0), "");
    }
    if let Some((from, to)) = outline.span {
        row("Length", duration(to - from), "");
    }
    let Some(overview) = overview else {
        return;
    };
    let airborne: f64 = overview.airborne.iter().map(|(a, b)| b - a).sum();
    if airborne > 0.0 {
        row("In the air", duration(airborne), "");
        let distance = context.units.way(overview.distance);
        row("Distance over ground", distance, "");
    } else {
        row("In the air", "never".to_owned(), "");
    }
    let (metres, length) = context.units.length();
    let (per_second, speed) = context.units.speed();
    if let Some((least, greatest)) = overview.heights {
        let (label, heights) = height_words(metres * least, metres * greatest);
        row(label, heights, length);
    }
    if let Some(greatest) = overview.greatest_speed {
        row(
            "Greatest speed over ground",
            format!("{:.1}", per_second * greatest),
            speed,
        );
    }
    if let Some(fit) = &overview.air_data {
        let from = direction((-fit.wind.y).atan2(-fit.wind.x), 0);
        let strength = per_second * fit.wind.norm();
        row(
            "Mean wind, fitted",
            format!("{strength:.1} from {from}°"),
            speed,
        );
        row("Airspeed scale", format!("{:.3}", fit.scale), "");
    }
}

/// The rate of a sensor in words, from its number of samples and their rate (hertz).
fn rate_words(samples: usize, rate: f64) -> String {
    match samples {
        0 => "never".to_owned(),
        1 => "once".to_owned(),
        _ if rate >= 9.95 => format!("{rate:.0} Hz"),
        _ => format!("{rate:.1} Hz"),
    }
}

/// Label and value for heights above the start: both ends where the flight goes well below it, as one does that was
/// recorded from the air.
fn height_words(least: f64, greatest: f64) -> (&'static str, String) {
    let number = |height: f64| format!("{:.0}", height.round() + 0.0).replace('-', "−");
    if -least > 0.1 * (greatest - least) && number(least) != number(greatest) {
        let both = format!("{} to {}", number(least), number(greatest));
        ("Heights above start", both)
    } else {
        ("Greatest height above start", number(greatest))
    }
}

fn findings(ui: &mut Ui, context: &mut ViewContext<'_>, findings: &[Finding], first: f64) {
    let tokens = context.tokens;
    let title = match findings.len() {
        0 => "Nothing was found wrong".to_owned(),
        1 => "One thing to know".to_owned(),
        n => format!("{n} things to know"),
    };
    parts::section(ui, tokens, &title, true, |ui| {
        for finding in findings {
            let color = match finding.severity {
                Severity::Note => tokens.text,
                Severity::Warning => tokens.accent,
                Severity::Trouble => tokens.warning,
            };
            let heading = RichText::new(&finding.title).color(color);
            let response = match finding.span {
                Some((from, _)) => {
                    let place = format!("{} · {}", finding.title, clock(from, first));
                    let response = ui.link(RichText::new(place).color(color));
                    if response.clicked() {
                        context.commands.push(Command::SeekTo(from));
                    }
                    response
                }
                None => ui.label(heading),
            };
            let text = with_moments(&finding.text, |time| clock(time, first));
            let text = capitalised(&text);
            response.on_hover_text(&text);
            ui.label(
                RichText::new(text)
                    .size(tokens.text_sizes[0])
                    .color(tokens.muted),
            );
            ui.add_space(0.5 * tokens.space);
        }
    });
}

fn abilities(ui: &mut Ui, context: &mut ViewContext<'_>, abilities: &[Ability]) {
    let tokens = context.tokens;
    parts::section(ui, tokens, "What can be done with it", true, |ui| {
        for ability in abilities {
            let (sign, color) = match ability.lacks {
                None => ("+", tokens.truth),
                Some(_) => ("–", tokens.muted),
            };
            let text = RichText::new(format!("{sign}  {}", ability.what)).color(color);
            if ability.lacks.is_none() && ability.is_camera_to_log() {
                if ui.link(text).clicked() {
                    let show = Command::Feature(FeatureCommand::show("camera_log"));
                    context.commands.push(show);
                }
            } else {
                ui.label(text);
            }
            if let Some(lacks) = &ability.lacks {
                ui.label(
                    RichText::new(format!("     {lacks}"))
                        .size(tokens.text_sizes[0])
                        .color(tokens.muted),
                );
            }
        }
    });
}

fn sensors(ui: &mut Ui, context: &ViewContext<'_>, sensors: &[Sensor]) {
    let tokens = context.tokens;
    parts::section(ui, tokens, "What measured", true, |ui| {
        egui::Grid::new("sensors")
            .num_columns(3)
            .spacing([tokens.space, 0.25 * tokens.space])
            .show(ui, |ui| {
                for sensor in sensors {
                    let small = |text: String| RichText::new(text).size(tokens.text_sizes[0]);
                    let color = if sensor.is_dead {
                        tokens.warning
                    } else {
                        tokens.text
                    };
                    ui.label(small(sensor.role.label().to_owned()).color(color));
                    ui.label(small(sensor.source.clone()).color(tokens.muted));
                    let rate = rate_words(sensor.samples, sensor.rate);
                    ui.label(small(rate).color(tokens.text));
                    ui.end_row();
                }
            });
    });
}

fn modes(ui: &mut Ui, context: &mut ViewContext<'_>, outline: &LogOutline, first: f64) {
    if outline.modes.is_empty() {
        return;
    }
    let tokens = context.tokens;
    let title = format!("Modes ({})", outline.modes.len());
    parts::section(ui, tokens, &title, false, |ui| {
        for change in &outline.modes {
            let text = format!("{}  {}", clock(change.time, first), change.mode);
            if ui.link(text).clicked() {
                context.commands.push(Command::SeekTo(change.time));
            }
        }
    });
}

fn messages(ui: &mut Ui, context: &mut ViewContext<'_>, outline: &LogOutline, first: f64) {
    if outline.messages.is_empty() {
        return;
    }
    let tokens = context.tokens;
    let title = format!("Messages ({})", outline.messages.len());
    parts::section(ui, tokens, &title, false, |ui| {
        for message in outline.messages.iter().take(FIRST_MESSAGES) {
            let text = format!("{}  {}", clock(message.time, first), message.text);
            let color = match message.severity {
                Some(0..=3) => tokens.warning,
                Some(4) => tokens.accent,
                _ => tokens.text,
            };
            let text = RichText::new(text).size(tokens.text_sizes[0]).color(color);
            if ui.link(text).clicked() {
                context.commands.push(Command::SeekTo(message.time));
            }
        }
        if outline.messages.len() > FIRST_MESSAGES {
            let more = format!("and {} more", outline.messages.len() - FIRST_MESSAGES);
            ui.label(RichText::new(more).color(tokens.muted));
        }
    });
}

fn parameters(ui: &mut Ui, context: &ViewContext<'_>, outline: &LogOutline) {
    if outline.parameters.is_empty() {
        return;
    }
    let tokens = context.tokens;
    let title = format!("Parameters ({})", outline.parameters.len());
    parts::section(ui, tokens, &title, false, |ui| {
        for parameter in &outline.parameters {
            let value = format!("{}", parameter.value as f32);
            let default = parameter.other_default();
            let default = default.map_or_else(String::new, |it| format!("(default {})", it as f32));
            parts::reading(
                ui,
                tokens,
                &NumberReadout::new(&parameter.name, value, &default),
            );
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_without_samples_was_never_read() {
        let words =
            [(0, 0.0), (1, 0.0), (9, 4.96), (900, 49.7)].map(|(n, rate)| rate_words(n, rate));
        assert_eq!(words, ["never", "once", "5.0 Hz", "50 Hz"]);
    }

    #[test]
    fn heights_below_the_start_are_told_where_they_are_no_noise() {
        let of_landing = ("Greatest height above start", "131".to_owned());
        assert_eq!(height_words(-2.4, 131.0), of_landing);
        let of_descent = ("Heights above start", "−35 to 0".to_owned());
        assert_eq!(height_words(-35.2, -0.0), of_descent);
        assert_eq!(height_words(0.0, 0.0).1, "0");
        assert_eq!(
            height_words(-0.14, 0.05),
            ("Greatest height above start", "0".to_owned())
        );
        assert_eq!(height_words(-0.6, 0.4).1, "−1 to 0");
    }
}
