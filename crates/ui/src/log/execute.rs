//! Commands about the log carried out: arrangements and pictures of its plots.

use super::answers::file_name;
use super::work::LogFeature;
use super::{LogCommand, PanelContent, PresetCommand};
use crate::feature::FeatureContext;
use crate::tokens::Tokens;

/// Pixels of a saved picture per point of the screen.
const PIXELS_PER_POINT: f32 = 2.0;

impl LogFeature {
    /// Does what was asked about the log.
    pub(super) fn carry_out(&mut self, command: LogCommand, context: &mut FeatureContext<'_>) {
        match command {
            LogCommand::ColourTrack(series) => self.track_field = series,
            LogCommand::ShowTab(tab) => {
                self.tab = tab;
                context.show();
            }
            LogCommand::SaveTable => self.save_table(context),
            LogCommand::SaveSvg => self.save_plots(false, context),
            LogCommand::SavePng => self.save_plots(true, context),
            LogCommand::ShowPreset(preset) => {
                let panels = self.log.as_ref().map(|log| preset.panels(log));
                self.arrange(panels.unwrap_or_default(), context);
            }
            LogCommand::Presets(PresetCommand::Show(name)) => {
                let preset = self.presets.named(&name);
                let panels = preset.map(|it| it.panels.clone());
                self.arrange(panels.unwrap_or_default(), context);
            }
            LogCommand::Presets(command) => {
                let shown = self.plots.arrangement();
                self.presets.execute(command, shown);
            }
            LogCommand::ReadAgain => self.read_again(context),
            LogCommand::FlyVehicle(system) => self.fly_vehicle(system, context),
            LogCommand::Toggle(_)
            | LogCommand::Plot(_)
            | LogCommand::PlotAlone(_)
            | LogCommand::Remove { .. }
            | LogCommand::ClosePanel(_)
            | LogCommand::PlotAgainst { .. }
            | LogCommand::JoinPoints { .. } => {
                self.shows_plots = true;
                context.view.plots_open = Some(true);
                self.plots.execute(command);
            }
        }
    }

    /// Shows these panels in place of what is plotted; nothing happens without any.
    fn arrange(&mut self, panels: Vec<PanelContent>, context: &mut FeatureContext<'_>) {
        if panels.is_empty() {
            return;
        }
        self.shows_plots = true;
        context.view.plots_open = Some(true);
        self.plots.arrange(panels);
    }

    /// Offers the plots as they are shown, as a drawing or as a picture.
    fn save_plots(&self, as_pixels: bool, context: &mut FeatureContext<'_>) {
        let picture = self.log.as_ref().and_then(|log| {
            let selected = context.playback.selected_span;
            let tokens = Tokens::of(context.view.dark);
            let zero = context.documents.clock_zero();
            let drawn = self.plots.picture(log, &tokens, selected, zero)?;
            let span = self.plots.span_of_interest(log, None)?;
            Some((drawn, &log.file, span))
        });
        let Some(((svg, size), file, span)) = picture else {
            let text = "Open a log and plot some of its fields first.";
            return context.note("No plots to save", text);
        };
        let name = file_name(file, span, if as_pixels { "png" } else { "svg" });
        if as_pixels {
            let size = [size.0, size.1].map(|side| (PIXELS_PER_POINT * side).round() as u32);
            context.host.save_picture(&name, &svg, size);
        } else {
            context.host.save_file(&name, svg.as_bytes());
        }
        context.note("Plots saved", name);
    }
}
