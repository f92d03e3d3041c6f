//! Panels of the log in the window: its column at the right, its plots below the map.

use egui::Ui;
use pilotage_jobs::SeriesName;

use super::LogTab;
use super::overview::overview_panel;
use super::statistics::statistics_panel;
use super::work::LogFeature;
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::views::parts;

impl LogFeature {
    /// Draws the overview of the log that is open, and its fields.
    pub(super) fn column(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        documents: &Documents,
    ) {
        let Some(log) = &self.log else {
            return;
        };
        let tokens = context.tokens;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
            for tab in LogTab::ALL {
                let title = tab.label();
                let name = format!("{title} of the log");
                if parts::chip(ui, tokens, self.tab == tab, title, &name).clicked() {
                    self.tab = tab;
                }
            }
        });
        match self.tab {
            LogTab::Overview => {}
            LogTab::Fields => {
                let plotted = |series: &SeriesName| self.plots.has(series);
                let own = &mut self.presets;
                self.fields.show(ui, context, log, own, &plotted);
                return;
            }
            LogTab::Statistics => {
                statistics_panel(ui, context, log, &self.plots);
                return;
            }
        }
        let progress = self.reading.as_ref().map(|reading| reading.progress);
        let width = ui.available_width();
        egui::ScrollArea::vertical()
            .id_salt("log")
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.set_max_width(width);
                overview_panel(ui, context, log, &documents.noticed(), progress);
            });
    }

    /// Draws the chips that choose between the plots of the log and those of the run, and the former.
    pub(super) fn draw_plots(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>) {
        let Some(log) = &self.log else {
            return;
        };
        let tokens = context.tokens;
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.5 * tokens.space;
            let of_log = &mut self.shows_plots;
            if parts::chip(ui, tokens, *of_log, "Log", "Plots of the log").clicked() {
                *of_log = true;
            }
            if parts::chip(ui, tokens, !*of_log, "Run", "Plots of the run").clicked() {
                *of_log = false;
            }
            if self.shows_plots {
                ui.add_space(tokens.space);
                self.plots.chips(ui, context, log, &self.presets);
            }
        });
        if self.shows_plots {
            self.plots.show(ui, context, log);
        }
    }
}
