//! Results of a study on screen: both plots, in words too.

use egui::{ComboBox, Label, RichText, Ui};
use pilotage_study::MeasureKind;

use super::chart::{PlotRow, PlotScale, PlottedDot, plot};
use super::grouping::StudyBy;
use super::outcome::{PROMISED, SettingOutcome, StudyOutcome};
use super::under_way::StudyUnderWay;
use crate::context::ViewContext;
use crate::shell::{counted, heading, muted};
use crate::views::parts;

/// Kinds of errors that can be plotted, in words.
const ERRORS: [(MeasureKind, &str); 5] = [
    (MeasureKind::ErrorRms, "RMS error"),
    (MeasureKind::ErrorMax, "Largest error"),
    (MeasureKind::ErrorEnd, "Error at the end"),
    (MeasureKind::WindErrorEnd, "Error of the wind at the end"),
    (
        MeasureKind::ReckonedMax,
        "Largest error by dead reckoning alone",
    ),
];

/// Plots that are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlotChoice {
    /// Kind of error.
    pub error: MeasureKind,
    /// Setting by which it is plotted.
    pub by: StudyBy,
}

impl Default for PlotChoice {
    fn default() -> Self {
        Self {
            error: MeasureKind::ErrorRms,
            by: StudyBy::default(),
        }
    }
}

/// Name of a kind of error.
fn name(kind: MeasureKind) -> &'static str {
    let found = ERRORS.iter().find(|(own, _)| *own == kind);
    found.map_or("Error", |(_, name)| *name)
}

/// Draws both plots.
pub(super) fn results(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    study: &StudyUnderWay,
    outcome: &StudyOutcome,
    plotted: &mut PlotChoice,
) {
    let tokens = context.tokens;
    heading(ui, tokens, "Error by setting");
    let groupings = StudyBy::all(study);
    let by = groupings.iter().find(|(own, _)| *own == plotted.by);
    let by = by.map_or("", |(_, name)| name.as_str());
    ui.horizontal_wrapped(|ui| {
        let kinds = ERRORS.map(|(kind, name)| (kind, name));
        choose(
            ui,
            "Error that is plotted",
            name(plotted.error),
            &kinds,
            &mut plotted.error,
        );
        ui.label(muted(tokens, "by"));
        let groupings: Vec<(StudyBy, &str)> = groupings
            .iter()
            .map(|(by, name)| (*by, name.as_str()))
            .collect();
        choose(
            ui,
            "Setting by which it is plotted",
            by,
            &groupings,
            &mut plotted.by,
        );
    });
    errors(ui, context, outcome, plotted.error);
    ui.add_space(tokens.space);
    reliability(ui, context, outcome);
}

/// A choice among a few, of which the chosen one is called `chosen`.
fn choose<T: Copy + PartialEq>(
    ui: &mut Ui,
    label: &str,
    chosen: &str,
    all: &[(T, &str)],
    value: &mut T,
) {
    let combo = ComboBox::from_id_salt(label).selected_text(chosen);
    let combo = combo.show_ui(ui, |ui| {
        for (own, name) in all {
            ui.selectable_value(value, *own, *name);
        }
    });
    combo.response.widget_info(|| {
        let label = format!("{label}: {chosen}");
        egui::WidgetInfo::labeled(egui::Role::ComboBox, true, label)
    });
}

/// Errors of a setting in words, in a unit.
fn told_errors(own: &SettingOutcome, (factor, unit): (f64, &str)) -> String {
    let flights = counted(own.flights, "flight", "flights");
    own.error.map_or_else(
        || format!("no errors of {flights}"),
        |spread| {
            let of = |value: f64| parts::figures(factor * value);
            let [low, _, median, _, high] = spread.quantiles;
            let interval = spread.median.map_or_else(String::new, |[from, to]| {
                let (from, to) = (of(from), of(to));
                format!(" (95 % interval {from} to {to})")
            });
            format!(
                "median {} {unit}{interval}; nine of ten flights from {} to {} {unit}; {flights}",
                of(median),
                of(low),
                of(high)
            )
        },
    )
}

fn errors(ui: &mut Ui, context: &mut ViewContext<'_>, outcome: &StudyOutcome, error: MeasureKind) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.of_si(error.unit());
    let spreads = outcome.settings.iter().filter_map(|own| own.error);
    let largest = spreads
        .map(|spread| spread.quantiles[4])
        .fold(0.0, f64::max);
    let row = |own: &SettingOutcome| {
        let words = told_errors(own, (factor, &unit));
        let dot = own.error.map(|spread| {
            let [low, lower, median, upper, high] = spread.quantiles.map(|value| factor * value);
            PlottedDot {
                value: median,
                thin: [low, high],
                thick: Some([lower, upper]),
                mark: None,
                colour: tokens.dead_reckoning,
            }
        });
        (dot, words)
    };
    let rows = outcome.settings.iter().map(|own| {
        let (dot, words) = row(own);
        let label = own.label.as_str();
        PlotRow { label, dot, words }
    });
    let rows: Vec<PlotRow<'_>> = rows.collect();
    let scale = PlotScale {
        name: &format!("{}, {unit}", name(error)),
        ends: (0.0, (1.08 * factor * largest).max(1e-3)),
        line: None,
    };
    plot(ui, tokens, &scale, &rows);
    let words = "Dot: the median flight. Thick: the middle half of the flights. Thin: nine of ten.";
    ui.add(Label::new(muted(tokens, words)).wrap());
}

/// Share of the flights of a setting that ended in their ellipse, in words.
fn told_share(own: &SettingOutcome) -> String {
    let [inside, of] = own.inside;
    match (own.share(), own.time_inside) {
        (Some(share), Some(time)) => format!(
            "at the end the truth is inside for {inside} of {}, {:.0} % (95 % interval {:.0} to {:.0} %); {:.0} % of the time; promised {:.0} %{}",
            counted(of, "flight", "flights"),
            100.0 * share,
            100.0 * own.interval[0],
            100.0 * own.interval[1],
            100.0 * time,
            100.0 * PROMISED,
            if own.is_too_sure() {
                ": too sure of itself"
            } else {
                ""
            }
        ),
        _ => "no flights yet".to_owned(),
    }
}

fn reliability(ui: &mut Ui, context: &mut ViewContext<'_>, outcome: &StudyOutcome) {
    let tokens = context.tokens;
    heading(ui, tokens, "Is the filter honest?");
    let lowest = outcome.settings.iter().filter(|own| own.share().is_some());
    let lowest = lowest
        .flat_map(|own| [Some(own.interval[0]), own.time_inside])
        .flatten();
    let lowest = lowest.fold(0.8, f64::min);
    let from = (10.0 * lowest).floor() / 10.0;
    let row = |own: &SettingOutcome| {
        let words = told_share(own);
        let dot = own.share().map(|share| PlottedDot {
            value: 100.0 * share,
            thin: own.interval.map(|end| 100.0 * end),
            thick: None,
            mark: own.time_inside.map(|time| 100.0 * time),
            colour: if own.is_too_sure() {
                tokens.warning
            } else {
                tokens.truth
            },
        });
        (dot, words)
    };
    let rows = outcome.settings.iter().map(|own| {
        let (dot, words) = row(own);
        let label = own.label.as_str();
        PlotRow { label, dot, words }
    });
    let rows: Vec<PlotRow<'_>> = rows.collect();
    let scale = PlotScale {
        name: "flights inside, %",
        ends: (100.0 * from, 100.0),
        line: Some((100.0 * PROMISED, "promised 95 %")),
    };
    plot(ui, tokens, &scale, &rows);
    let words = "The filter draws an ellipse that should hold the true position in 95 of 100 cases. Dot with its 95 % \
                 interval: the flights for which it does so at the end. Stroke across: the share of the time.";
    ui.add(Label::new(muted(tokens, words)).wrap());
    let too_sure: Vec<&str> = outcome
        .settings
        .iter()
        .filter(|own| own.is_too_sure())
        .map(|own| own.label.as_str())
        .collect();
    if !too_sure.is_empty() {
        let words = format!(
            "Too sure of itself, beyond chance: {}.",
            too_sure.join("; ")
        );
        ui.add(Label::new(RichText::new(words).color(tokens.warning)).wrap());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::outcome::ErrorSpread;

    #[test]
    fn a_setting_of_a_single_flight_has_no_plural() {
        let mut own = SettingOutcome {
            label: "all flights".to_owned(),
            flights: 1,
            error: None,
            inside: [1, 1],
            interval: [0.2065, 1.0],
            time_inside: Some(0.9),
        };
        assert_eq!(told_errors(&own, (1.0, "m")), "no errors of 1 flight");
        own.error = Some(ErrorSpread {
            quantiles: [2.0; 5],
            median: None,
        });
        let words = told_errors(&own, (1.0, "m"));
        assert!(words.ends_with("; 1 flight"), "{words}");
        assert!(told_share(&own).contains("for 1 of 1 flight, 100 %"));
        own.flights = 2;
        assert!(told_errors(&own, (1.0, "m")).ends_with("; 2 flights"));
    }
}
