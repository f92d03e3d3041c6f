//! Fields of a log over time, several panels below each other over one time axis.

use std::collections::BTreeSet;

use egui::{ScrollArea, Ui};

use super::arrangement::PanelContent;
use super::panel::LogPanel;
use super::picture::PlotScene;
use super::preset_menu::PresetMenu;
use super::presets::OwnPresets;
use super::scene::{PanelScene, axes, mode_bands};
use super::{LogCommand, OpenLog};
use crate::command::Command;
use crate::context::ViewContext;
use crate::tokens::Tokens;
use crate::views::{TimeAxis, parts};
use pilotage_jobs::SeriesName;

/// Least height of a panel's curves, points.
const LEAST_HEIGHT: f32 = 64.0;

/// Panels of fields over one time axis.
#[derive(Default)]
pub struct LogPlots {
    panels: Vec<LogPanel>,
    /// The panel that was touched last.
    active: usize,
    axis: TimeAxis,
    presets: PresetMenu,
    /// Width of the plots and height of the curves of each, as they were drawn last, points.
    drawn_size: (f32, f32),
}

impl LogPlots {
    /// Plots these fields and no others.
    pub fn begin(&mut self, panels: Vec<Vec<SeriesName>>) {
        *self = Self::default();
        let panels = panels.into_iter().map(PanelContent::over_time);
        self.arrange(panels.collect());
    }

    /// Shows these panels and no others, over the time that is shown.
    pub fn arrange(&mut self, panels: Vec<PanelContent>) {
        self.panels = panels.into_iter().map(LogPanel::of).collect();
        self.active = 0;
    }

    /// Contents of the panels.
    pub fn arrangement(&self) -> Vec<PanelContent> {
        let contents = self.panels.iter().map(|panel| panel.content.clone());
        contents.collect()
    }

    /// Whether nothing is plotted.
    pub fn is_empty(&self) -> bool {
        self.panels.is_empty()
    }

    /// Whether a field is plotted.
    pub fn has(&self, series: &SeriesName) -> bool {
        self.panels
            .iter()
            .any(|p| p.content.fields.contains(series))
    }

    /// Every field that is plotted.
    pub fn fields(&self) -> BTreeSet<&SeriesName> {
        let contents = self.panels.iter().map(|panel| &panel.content);
        contents
            .flat_map(|it| it.fields.iter().chain(&it.against))
            .collect()
    }

    /// Every field that is plotted, each once, in the order of the panels.
    pub fn fields_in_order(&self) -> Vec<SeriesName> {
        let mut fields: Vec<SeriesName> = Vec::new();
        for panel in &self.panels {
            for field in panel.content.against.iter().chain(&panel.content.fields) {
                if !fields.contains(field) {
                    fields.push(field.clone());
                }
            }
        }
        fields
    }

    /// The fields of each panel from the top.
    pub fn panels(&self) -> impl Iterator<Item = &[SeriesName]> {
        self.panels.iter().map(|p| p.content.fields.as_slice())
    }

    /// Does what concerns the plots of what was asked.
    pub fn execute(&mut self, command: LogCommand) {
        match command {
            LogCommand::Toggle(series) if self.has(&series) => {
                for panel in &mut self.panels {
                    panel.content.fields.retain(|field| *field != series);
                }
                self.panels.retain(|panel| !panel.content.fields.is_empty());
            }
            LogCommand::Toggle(series) | LogCommand::Plot(series) => {
                match self.panels.get_mut(self.active) {
                    Some(panel) if panel.content.fields.contains(&series) => {}
                    Some(panel) => panel.content.fields.push(series),
                    None => self.add(series),
                }
            }
            LogCommand::PlotAlone(series) => self.add(series),
            LogCommand::Remove { panel, series } => {
                if let Some(panel) = self.panels.get_mut(panel) {
                    panel.content.fields.retain(|field| *field != series);
                }
                self.panels.retain(|panel| !panel.content.fields.is_empty());
            }
            LogCommand::ClosePanel(panel) => {
                if panel < self.panels.len() {
                    self.panels.remove(panel);
                }
            }
            LogCommand::PlotAgainst { panel, against } => {
                if let Some(panel) = self.panels.get_mut(panel) {
                    panel.content.against = against;
                }
            }
            LogCommand::JoinPoints { panel, joined } => {
                if let Some(panel) = self.panels.get_mut(panel) {
                    panel.content.joined = joined;
                }
            }
            // Nothing about the plots that are shown.
            LogCommand::ShowPreset(_)
            | LogCommand::Presets(_)
            | LogCommand::SaveSvg
            | LogCommand::SavePng
            | LogCommand::ColourTrack(_)
            | LogCommand::ShowTab(_)
            | LogCommand::SaveTable
            | LogCommand::FlyVehicle(_)
            | LogCommand::ReadAgain => {}
        }
        self.active = self.active.min(self.panels.len().saturating_sub(1));
    }

    fn add(&mut self, series: SeriesName) {
        let content = PanelContent::over_time(vec![series]);
        self.panels.push(LogPanel::of(content));
        self.active = self.panels.len() - 1;
    }

    /// The selected span of time, or else the one that is shown; `None` without any time.
    pub fn span_of_interest(
        &self,
        log: &OpenLog,
        selected: Option<(f64, f64)>,
    ) -> Option<(f64, f64)> {
        selected.or_else(|| Some(self.axis.span(log.span()?)))
    }

    /// The plots as they are shown, as an SVG drawing with its size in points.
    pub fn picture(
        &self,
        log: &OpenLog,
        tokens: &Tokens,
        selected: Option<(f64, f64)>,
        clock_zero: f64,
    ) -> Option<(String, (f32, f32))> {
        let span = self.axis.span(log.span()?);
        let picture = PlotScene {
            log,
            tokens,
            panels: self.panels.iter().map(|panel| &panel.content).collect(),
            span,
            clock_zero,
            selected,
            size: self.drawn_size,
        };
        let is_drawn = self.drawn_size.0 > 0.0 && !self.panels.is_empty();
        is_drawn.then(|| (picture.draw(), picture.extent()))
    }

    /// Chips for arrangements, for less time, more, and all of it.
    pub fn chips(
        &mut self,
        ui: &mut Ui,
        context: &mut ViewContext<'_>,
        log: &OpenLog,
        own: &OwnPresets,
    ) {
        self.presets.show(ui, context, log, own);
        save_chips(ui, context);
        if let Some(whole) = log.span().filter(|(a, b)| b > a) {
            self.axis.chips(ui, context, whole);
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
        let header = if tokens.touch {
            tokens.target()
        } else {
            3.0 * tokens.space
        };
        let count = self.panels.len() as f32;
        // What does not fit makes the panel grow with every frame.
        let room = ui.available_height() - axis - ui.spacing().item_spacing.y;
        let free = room - (header + gap) * count;
        let height = (free / count).max(LEAST_HEIGHT);
        let span = self.axis.span(whole);
        let modes = mode_bands(log, whole);
        let mut hover = None;
        let mut asked = Vec::new();
        ScrollArea::vertical()
            .id_salt("log plots")
            .max_height(room.max(LEAST_HEIGHT))
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
                    let shown = panel.show(ui, context, &scene, &mut asked);
                    let response = shown.response;
                    if response.clicked() || response.dragged() {
                        self.active = number;
                    }
                    self.drawn_size = (response.rect.width(), response.rect.height());
                    hover = hover.or(shown.hover);
                    if panel.content.against.is_none() {
                        let axes = axes(&response, tokens, span);
                        let found = self.axis.interact(ui, context, &response, &axes, whole);
                        hover = hover.or(found);
                    }
                    ui.add_space(gap);
                }
            });
        self.axis.hover = hover;
        TimeAxis::draw(ui, context, self.axis.span(whole));
        context
            .commands
            .extend(asked.into_iter().map(Command::from));
    }
}

/// Chips that save the plots.
fn save_chips(ui: &mut Ui, context: &mut ViewContext<'_>) {
    let tokens = context.tokens;
    let choices = [
        ("SVG", "Save the plots as SVG", LogCommand::SaveSvg),
        ("PNG", "Save the plots as PNG", LogCommand::SavePng),
        (
            "CSV",
            "Save the plotted fields as CSV",
            LogCommand::SaveTable,
        ),
    ];
    let chip = parts::chip(ui, tokens, false, "Save", "Save the plots");
    egui::Popup::menu(&chip).show(|ui| {
        for (text, name, command) in choices {
            let button = egui::Button::new(text).frame(false);
            let response = ui.add(button);
            response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
            if response.clicked() {
                context.commands.push(Command::from(command));
                ui.close();
            }
        }
    });
}
