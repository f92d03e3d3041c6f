//! The sheet of shortcuts, made from the table of commands.

use egui::{Align2, Context, Frame, Id, Modal, RichText, Ui};

use super::catalog::{CommandEntry, CommandGroup};
use super::widgets::{caption, muted, title};
use crate::tokens::Tokens;

/// Draws the sheet of the commands of `catalog`; true when it is to be closed.
pub fn help_sheet(context: &Context, tokens: &Tokens, catalog: &[CommandEntry]) -> bool {
    let screen = context.content_rect();
    let wide = screen.width() >= 760.0;
    let response = Modal::new(Id::unique("help"))
        .frame(Frame::window(&context.global_style()).inner_margin(24))
        .show(context, |ui| {
            ui.set_width(720.0_f32.min(screen.width() - 96.0));
            let close = title(ui, tokens, "Shortcuts");
            ui.label(muted(
                tokens,
                "Drag on the map to move it, turn the wheel to zoom. Nothing you open leaves this machine.",
            ));
            ui.add_space(tokens.space);
            egui::ScrollArea::vertical()
                .max_height(screen.height() - 220.0)
                    .min_scrolled_height(screen.height() - 220.0)
                .show(ui, |ui| {
                    if wide {
                        ui.columns(2, |columns| {
                            // Columns of about the same length.
                            for group in [CommandGroup::Playback, CommandGroup::Edit, CommandGroup::Document] {
                                group_ui(&mut columns[0], tokens, catalog, group);
                            }
                            for group in [CommandGroup::View, CommandGroup::Plan] {
                                group_ui(&mut columns[1], tokens, catalog, group);
                            }
                        });
                    } else {
                        for group in CommandGroup::ALL {
                            group_ui(ui, tokens, catalog, group);
                        }
                    }
                });
            close
        });
    response.inner || response.should_close()
}

fn group_ui(ui: &mut Ui, tokens: &Tokens, catalog: &[CommandEntry], group: CommandGroup) {
    caption(ui, tokens, group.label());
    for entry in catalog.iter().filter(|e| e.group == group) {
        if entry.shortcuts.is_empty() {
            continue;
        }
        ui.horizontal(|ui| {
            ui.label(RichText::new(&*entry.label).color(tokens.text));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                ui.add_space(24.0);
                let (rect, _) =
                    ui.allocate_exact_size(egui::vec2(96.0, 20.0), egui::Sense::hover());
                ui.painter().text(
                    rect.right_center(),
                    Align2::RIGHT_CENTER,
                    entry.keys(),
                    tokens.small(),
                    tokens.accent,
                );
            });
        });
    }
    ui.add_space(tokens.space);
}
