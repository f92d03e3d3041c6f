//! Where the log stands in the window: its column at the right, its plots below the map.

use egui::Ui;

use super::Views;
use crate::context::ViewContext;
use crate::jobs::SeriesName;
use crate::log::{OpenLog, overview_panel};
use crate::views::parts;

/// The overview of a log, and its fields.
pub(super) fn log_column(
    ui: &mut Ui,
    context: &mut ViewContext<'_>,
    views: &mut Views,
    log: &OpenLog,
    progress: Option<f32>,
) {
    let Views {
        log_fields,
        log_plots,
        ..
    } = views;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 0.5 * context.tokens.space;
        for (is_list, title) in [(false, "Overview"), (true, "Fields")] {
            let on = log_fields.is_open == is_list;
            if parts::chip(
                ui,
                context.tokens,
                on,
                title,
                &format!("{title} of the log"),
            )
            .clicked()
            {
                log_fields.is_open = is_list;
            }
        }
    });
    if log_fields.is_open {
        let plotted = |series: &SeriesName| log_plots.has(series);
        log_fields.show(ui, context, log, &plotted);
        return;
    }
    let width = ui.available_width();
    egui::ScrollArea::vertical()
        .id_salt("log")
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.set_max_width(width);
            overview_panel(ui, context, log, progress);
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
            views.log_plots.chips(ui, context, log);
        }
    });
    if views.shows_log_plots {
        views.log_plots.show(ui, context, log);
    } else {
        views.plots.show(ui, context);
    }
}
