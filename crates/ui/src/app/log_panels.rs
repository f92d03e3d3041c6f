//! Panels of the log in the window: its column at the right, its plots below the map.

use egui::Ui;
use pilotage_core::flight::overview::Finding;

use super::Views;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::log::{LogTab, OpenLog, overview_panel, statistics_panel};
use crate::views::parts;
use pilotage_jobs::SeriesName;

/// The overview of the log that is open, and its fields.
pub(super) fn log_column(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    views: &mut Views,
    documents: &Documents,
    noticed: &[Finding],
    progress: Option<f32>,
) {
    let Some(log) = &documents.log else {
        return;
    };
    let tokens = context.tokens;
    let Views {
        log_tab,
        log_fields,
        log_plots,
        presets,
        ..
    } = views;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
        for tab in LogTab::ALL {
            let title = tab.label();
            let name = format!("{title} of the log");
            if parts::chip(ui, tokens, *log_tab == tab, title, &name).clicked() {
                *log_tab = tab;
            }
        }
    });
    match log_tab {
        LogTab::Overview => {}
        LogTab::Fields => {
            let plotted = |series: &SeriesName| log_plots.has(series);
            log_fields.show(ui, context, log, presets, &plotted);
            return;
        }
        LogTab::Statistics => {
            statistics_panel(ui, context, log, log_plots);
            return;
        }
    }
    let width = ui.available_width();
    egui::ScrollArea::vertical()
        .id_salt("log")
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.set_max_width(width);
            overview_panel(ui, context, log, noticed, progress);
        });
}

/// The plots of the log or of the run, and the chips that choose.
pub(super) fn log_or_run_plots(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    views: &mut Views,
    log: &OpenLog,
) {
    let tokens = context.tokens;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
        let of_log = &mut views.shows_log_plots;
        if parts::chip(ui, tokens, *of_log, "Log", "Plots of the log").clicked() {
            *of_log = true;
        }
        if parts::chip(ui, tokens, !*of_log, "Run", "Plots of the run").clicked() {
            *of_log = false;
        }
        if views.shows_log_plots {
            ui.add_space(tokens.space);
            views.log_plots.chips(ui, context, log, &views.presets);
        }
    });
    if views.shows_log_plots {
        views.log_plots.show(ui, context, log);
    } else {
        views.plots.show(ui, context);
    }
}
