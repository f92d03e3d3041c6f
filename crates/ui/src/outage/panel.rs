//! Choose a stretch, cut GPS out of it, and read what would have been known.

use egui::{RichText, Stroke, Ui, vec2};

use pilotage_core::flight::with_moments;

use super::chart::{growth_chart, look};
use super::state::{OutageCommand, Outages, is_of_before, measures_airspeed};
use super::wind::winds;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::shell::{at_work, counted, of_before_again, text_button, whole_sentences};
use crate::units::clock;
use crate::views::chart::dashed;
use crate::views::{parts, table};
use pilotage_jobs::{OutageReport, StudyReport};

/// Lengths of outages that are offered, seconds.
const LENGTHS: [f64; 3] = [30.0, 60.0, 120.0];
/// Times since GPS was lost at which errors are told, seconds.
const TOLD: [f64; 2] = [10.0, 30.0];

/// Length of the line beside the name of a way, points: dashes are told apart on it.
const SWATCH: f32 = 24.0;

/// Time between two reports of an error, and a little more, seconds.
const REPORTS: f64 = 0.3;

/// Words for results that go on with positions of a run before.
const OF_BEFORE: &str = "Of the run before: the flight has been flown again since, and its pictures may tell other places.";

/// Draws the view of an outage.
pub fn outage_panel(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    documents: &Documents,
    outages: &Outages,
) {
    let tokens = context.tokens;
    ui.spacing_mut().item_spacing.y = 0.75 * tokens.space;
    let has_airspeed = context.flight.is_some_and(measures_airspeed);
    let by = if has_airspeed {
        "airspeed"
    } else {
        "mean speed"
    };
    let words = format!(
        "How far off would it be if GPS failed here? The program learns from the flight up to the outage, goes on by \
         {by} and heading alone, and is compared with the {}.",
        context.known_track()
    );
    wrapped(ui, tokens.muted, &words);
    if !has_airspeed {
        let words = "This flight has no airspeed, so errors grow faster.";
        wrapped(ui, tokens.warning, words);
    }
    choose(ui, context, outages);
    if let Some(words) = &outages.work.words
        && at_work(ui, tokens, words)
    {
        context.commands.push(OutageCommand::Stop.into());
    }
    if let Some(trouble) = &outages.work.trouble {
        let sentence = whole_sentences(std::slice::from_ref(trouble));
        wrapped(ui, tokens.warning, &sentence);
    }
    let is_under_way = outages.work.words.is_some();
    if let Some(report) = &outages.report {
        let words = is_of_before(outages.report_of, documents).then_some(OF_BEFORE);
        let draw = |ui: &mut Ui| one_outage(ui, context, report);
        if of_before_again(ui, tokens, words, is_under_way, draw) {
            let (from, to) = report.span;
            context.commands.push(OutageCommand::Of(from, to).into());
        }
    }
    study(ui, context, outages);
    if let Some(report) = &outages.study {
        let words = is_of_before(outages.study_of, documents).then_some(OF_BEFORE);
        let draw = |ui: &mut Ui| studied(ui, context, report);
        if of_before_again(ui, tokens, words, is_under_way, draw) {
            let again = OutageCommand::Study(report.length);
            context.commands.push(again.into());
        }
    }
    if let Some(report) = outages.report.as_ref().and_then(|r| r.winds.as_ref()) {
        winds(ui, context, report);
    }
}

fn choose(ui: &mut Ui, context: &mut ViewContext<'_>, outages: &Outages) {
    let tokens = context.tokens;
    let now = context.time;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(0.5 * tokens.space, 0.5 * tokens.space);
        if let Some((from, to)) = context.selected_span {
            let text = format!(
                "Cut GPS from {} to {}",
                clock(from, context.clock_zero),
                clock(to, context.clock_zero)
            );
            if text_button(ui, tokens, None, &text, true).clicked() {
                context.commands.push(OutageCommand::Selected.into());
            }
        } else {
            for length in LENGTHS {
                let text = format!("Cut {length:.0} s from here");
                if text_button(ui, tokens, None, &text, false).clicked() {
                    let of = OutageCommand::Of(now, now + length);
                    context.commands.push(of.into());
                }
            }
        }
        if outages.report.is_some() && text_button(ui, tokens, None, "Clear", false).clicked() {
            context.commands.push(OutageCommand::Clear.into());
        }
    });
    // Fingers hold no Shift.
    if context.selected_span.is_none() && !context.tokens.touch {
        let hint = "Or hold Shift and drag over a plot or the time line.";
        ui.label(
            RichText::new(hint)
                .size(tokens.text_sizes[0])
                .color(tokens.muted),
        );
    }
}

/// A sentence that may take several lines.
fn wrapped(ui: &mut Ui, colour: egui::Color32, text: &str) {
    ui.add(egui::Label::new(RichText::new(text).color(colour)).wrap());
}

/// Numbers and the growth of the error of one outage.
fn one_outage(ui: &mut Ui, context: &mut ViewContext<'_>, report: &OutageReport) {
    let tokens = context.tokens;
    let (factor, unit) = context.units.length();
    ui.add_space(0.5 * tokens.space);
    let (from, to) = report.span;
    let title = format!(
        "No GPS from {} to {} ({:.0} s)",
        clock(from, context.clock_zero),
        clock(to, context.clock_zero),
        to - from
    );
    ui.label(
        RichText::new(title)
            .color(tokens.text)
            .font(tokens.heading()),
    );
    let small = |text: String| {
        RichText::new(text)
            .size(tokens.text_sizes[0])
            .color(tokens.muted)
    };
    let titles: Vec<String> = TOLD
        .map(|t| format!("{t:.0} s"))
        .into_iter()
        .chain(["end".to_owned(), "95 %".to_owned()])
        .collect();
    table::heads(ui, tokens, &titles, |ui| {
        ui.label(small(format!("error, {unit}")));
    });
    for (number, result) in report.results.iter().enumerate() {
        let at = |since: f64| {
            let reached = result.growth.iter().find(|p| p.since > since - REPORTS);
            reached.and_then(|p| p.error)
        };
        let end = result.growth.last();
        let ends = [end.and_then(|p| p.error), end.map(|p| p.radius)];
        let cells: Vec<String> = (TOLD.map(at).into_iter().chain(ends))
            .map(|value| value.map_or_else(|| "–".into(), |v| error_text(factor * v)))
            .collect();
        table::named_row(ui, tokens, &cells, (&result.label, SWATCH + 4.0), |ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(SWATCH, 12.0), egui::Sense::hover());
            let (colour, dash) = look(tokens, number);
            let ends = vec![rect.left_center(), rect.right_center()];
            let line = dashed(ends, Stroke::new(2.5, colour), dash);
            ui.painter().extend(line);
            let label = RichText::new(&result.label).color(tokens.text);
            ui.add(egui::Label::new(label).truncate());
        });
    }
    let since = context.time - from;
    growth_chart(
        ui,
        tokens,
        &report.results,
        context.units.length(),
        Some(since),
    );
    let caption = format!(
        "Lines: distance from the {}, {unit}. Dots: the radius that should hold it in 95 of 100 cases.",
        context.known_track()
    );
    ui.add(egui::Label::new(small(caption)).wrap());
    for remark in &report.remarks {
        let remark = with_moments(remark, |time| clock(time, context.clock_zero));
        wrapped(ui, tokens.warning, &remark);
    }
}

/// Error in a column of others, with as many decimals as they.
fn error_text(value: f64) -> String {
    let decimals = if value < 9.995 { 2 } else { 1 };
    format!("{value:.decimals$}")
}

/// Choice of outages all along the flight.
fn study(ui: &mut Ui, context: &mut ViewContext<'_>, outages: &Outages) {
    let tokens = context.tokens;
    ui.add_space(tokens.space);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = vec2(0.5 * tokens.space, 0.5 * tokens.space);
        ui.label(
            RichText::new("One outage after the other along the whole flight, each of:")
                .color(tokens.muted),
        );
        for length in LENGTHS {
            let name = format!("Outages of {length:.0} s all along");
            let on = outages.study.as_ref().is_some_and(|s| s.length == length);
            if parts::chip(ui, tokens, on, &format!("{length:.0} s"), &name).clicked() {
                let study = OutageCommand::Study(length);
                context.commands.push(study.into());
            }
        }
    });
}

/// Numbers of outages all along the flight.
fn studied(ui: &mut Ui, context: &ViewContext<'_>, report: &StudyReport) {
    let tokens = context.tokens;
    let studies = &report.studies;
    let count = studies.first().map_or(0, |s| s.outages.len());
    let (factor, unit) = context.units.length();
    let small = |text: &str| {
        RichText::new(text)
            .size(tokens.text_sizes[0])
            .color(tokens.muted)
    };
    let titles = ["median", "90 %", "inside"].map(str::to_owned);
    table::heads(ui, tokens, &titles, |ui| {
        let outages = counted(count, "outage", "outages");
        ui.label(small(&format!("{outages}, end error, {unit}")));
    });
    for row in studies {
        let cells = [
            error_text(factor * row.error_quantile(0.5)),
            error_text(factor * row.error_quantile(0.9)),
            format!("{:.0} %", 100.0 * row.covered()),
        ];
        table::named_row(ui, tokens, &cells, (&row.label, 0.0), |ui| {
            let label = RichText::new(&row.label).color(tokens.text);
            ui.add(egui::Label::new(label).truncate());
        });
    }
    wrapped(
        ui,
        tokens.muted,
        "90 %: nine of ten end nearer than that. Inside: how often the 95\u{a0}% ellipse held the truth; an honest one \
         does in about 95\u{a0}% of outages.",
    );
}
