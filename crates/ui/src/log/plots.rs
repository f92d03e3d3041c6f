//! Fields of a log over time, several panels below each other over one time axis.

use std::collections::BTreeSet;

use egui::{ScrollArea, Ui};

use super::panel::{self, LogPanel, PanelScene};
use super::{LogCommand, OpenLog};
use crate::command::Command;
use crate::context::ViewContext;
use crate::jobs::SeriesName;
use crate::views::{TimeAxis, parts};

/// Least height of a panel's curves, points.
const LEAST_HEIGHT: f32 = 64.0;

/// Panels of fields over one time axis.
#[derive(Default)]
pub struct LogPlots {
    panels: Vec<LogPanel>,
    /// The panel that was touched last.
    active: usize,
    axis: TimeAxis,
}

impl LogPlots {
    /// Plots these fields and no others.
    pub fn begin(&mut self, panels: Vec<Vec<SeriesName>>) {
        *self = Self {
            panels: panels.into_iter().map(LogPanel::of).collect(),
            ..Self::default()
        };
    }

    /// Whether nothing is plotted.
    pub fn is_empty(&self) -> bool {
        self.panels.is_empty()
    }

    /// Whether a field is plotted.
    pub fn has(&self, series: &SeriesName) -> bool {
        self.panels.iter().any(|p| p.fields.contains(series))
    }

    /// Every field that is plotted.
    pub fn fields(&self) -> BTreeSet<&SeriesName> {
        self.panels.iter().flat_map(|p| &p.fields).collect()
    }

    /// The fields of each panel from the top.
    pub fn panels(&self) -> impl Iterator<Item = &[SeriesName]> {
        self.panels.iter().map(|p| p.fields.as_slice())
    }

    /// Does what concerns the plots of what was asked.
    pub fn execute(&mut self, command: LogCommand) {
        match command {
            LogCommand::Toggle(series) if self.has(&series) => {
                for panel in &mut self.panels {
                    panel.fields.retain(|field| *field != series);
                }
                self.panels.retain(|panel| !panel.fields.is_empty());
            }
            LogCommand::Toggle(series) => match self.panels.get_mut(self.active) {
                Some(panel) => panel.fields.push(series),
                None => self.add(series),
            },
            LogCommand::PlotAlone(series) => self.add(series),
            LogCommand::Remove { panel, series } => {
                if let Some(panel) = self.panels.get_mut(panel) {
                    panel.fields.retain(|field| *field != series);
                }
                self.panels.retain(|panel| !panel.fields.is_empty());
            }
            LogCommand::ClosePanel(panel) if panel < self.panels.len() => {
                self.panels.remove(panel);
            }
            _ => {}
        }
        self.active = self.active.min(self.panels.len().saturating_sub(1));
    }

    fn add(&mut self, series: SeriesName) {
        self.panels.push(LogPanel::of(vec![series]));
        self.active = self.panels.len() - 1;
    }

    /// Chips for less time, more, and all of it.
    pub fn chips(&mut self, ui: &mut Ui, context: &ViewContext<'_>, log: &OpenLog) {
        if let Some(whole) = log.span().filter(|(a, b)| b > a) {
            self.axis.chips(ui, context.tokens, context.time, whole);
        }
    }

    /// Draws the panels into the space that `ui` has left.
    pub fn show(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, log: &OpenLog) {
        let tokens = context.tokens;
        let Some(whole) = log.span().filter(|(a, b)| b > a) else {
            parts::empty(
                ui,
                tokens,
                "Reading the log",
                "Its fields show here in a moment.",
            );
            return;
        };
        if self.panels.is_empty() {
            let hint = "Tick fields in the list at the right; + gives one a plot of its own.";
            parts::empty(ui, tokens, "No field is plotted", hint);
            return;
        }
        let gap = 0.5 * tokens.space;
        let axis = TimeAxis::height(tokens);
        let header = 3.0 * tokens.space;
        let count = self.panels.len() as f32;
        let free = ui.available_height() - axis - gap - (header + gap) * count;
        let height = (free / count).max(LEAST_HEIGHT);
        let span = self.axis.span(whole);
        let modes = panel::mode_bands(log, whole);
        let mut hover = None;
        let mut asked = Vec::new();
        ScrollArea::vertical()
            .id_salt("log plots")
            .max_height((ui.available_height() - axis - gap).max(LEAST_HEIGHT))
            .auto_shrink(false)
            .show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                for (number, panel) in self.panels.iter_mut().enumerate() {
                    let scene = PanelScene {
                        log,
                        number,
                        is_active: number == self.active,
                        size: (header, height),
                        span,
                        hover: self.axis.hover,
                        modes: &modes,
                    };
                    let response = panel.show(ui, context, &scene, &mut asked);
                    if response.clicked() || response.dragged() {
                        self.active = number;
                    }
                    let axes = panel::axes(&response, tokens, span);
                    let found = self.axis.interact(ui, context, &response, &axes, whole);
                    hover = hover.or(found);
                    ui.add_space(gap);
                }
            });
        self.axis.hover = hover;
        TimeAxis::draw(ui, tokens, self.axis.span(whole));
        context.commands.extend(asked.into_iter().map(Command::Log));
    }
}
