//! The sheet of photos on the map: how they are looked for, what came of each, and the chosen one in full.

use egui::{Label, RichText, ScrollArea, Ui};

use super::PhotosCommand as Do;
use super::scene::{PhotosScene, send};
use super::state::PhotosState;
use super::{chosen, list, search};
use crate::command::Command;
use crate::context::ViewContext;
use crate::feature_command::{AMONG_ROADS, FIND_AMONG_ROADS, FeatureCommand};
use crate::shell::{at_work, counted, heading, muted, of_before, text_button, title};

/// Draws the sheet.
pub(super) fn photos_sheet(ui: &mut Ui, context: &mut ViewContext<'_>, scene: &PhotosScene<'_>) {
    let tokens = context.tokens;
    let photos = scene.photos;
    if title(ui, tokens, "Photos on the map") {
        send(context, Do::Close);
    }
    ScrollArea::vertical()
        .id_salt("photos on the map")
        .auto_shrink(false)
        .show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.75 * tokens.space;
            let words = "Each photo is compared with the map by itself, wherever it may have been taken by what is \
                         known of it.";
            ui.add(Label::new(muted(tokens, words)).wrap());
            if !scene.has_map {
                let words = "There is no map to lay photos on: open a georeferenced map of the ground first, or \
                             drop it together with the photos.";
                ui.add(Label::new(RichText::new(words).color(tokens.warning)).wrap());
            }
            begin(ui, context, scene);
            if let Some((share, words)) = &photos.at_work {
                let words = format!("{words}: {:.0} %", 100.0 * share);
                if at_work(ui, tokens, &words) {
                    send(context, Do::Stop);
                }
            }
            if let Some(trouble) = &photos.trouble {
                ui.add(Label::new(RichText::new(trouble).color(tokens.warning)).wrap());
            }
            search::limits(ui, context, &photos.search);
            search::known(ui, context, scene);
            if photos.reports.is_empty() {
                return;
            }
            ui.add_space(0.5 * tokens.space);
            heading(ui, tokens, &summary(photos));
            let words = "Of another map than the one that is open: lay them again to see where they lie on this one.";
            let words = scene.are_of_another_map.then_some(words);
            of_before(ui, tokens, words, |ui| {
                list::list(ui, context, photos);
                chosen::chosen(ui, context, scene);
            });
        });
}

/// Buttons that open photos and lay them.
fn begin(ui: &mut Ui, context: &mut ViewContext<'_>, scene: &PhotosScene<'_>) {
    let (tokens, photos) = (context.tokens, scene.photos);
    let count = photos.reports.len();
    ui.horizontal_wrapped(|ui| {
        if count > 0 && scene.has_map && photos.at_work.is_none() {
            let is_new = photos.searched.is_none();
            let is_changed =
                photos.searched.is_some_and(|s| s != photos.search) || scene.are_of_another_map;
            let words = match (is_new, count) {
                (true, 1) => "Lay the photo".to_owned(),
                (true, _) => format!("Lay {count} photos"),
                (false, _) => "Lay again".to_owned(),
            };
            if text_button(ui, tokens, None, &words, is_new || is_changed).clicked() {
                send(context, Do::Lay);
            }
        }
        let has_roads = !context.mission.roads.is_empty();
        let words = FIND_AMONG_ROADS;
        if count > 0 && has_roads && text_button(ui, tokens, None, words, false).clicked() {
            let find = FeatureCommand::show(AMONG_ROADS);
            context.commands.push(Command::Feature(find));
        }
        let words = "Open photos …";
        if scene.has_map && text_button(ui, tokens, None, words, count == 0).clicked() {
            context.commands.push(Command::Open);
        }
    });
    if count == 0 && scene.has_map {
        let words = "Or drop them on the page: JPEG, TIFF or PNG of a camera that looks down. Nothing leaves this machine.";
        ui.add(Label::new(muted(tokens, words)).wrap());
    }
}

fn summary(photos: &PhotosState) -> String {
    let (laid, known) = photos.counts();
    let all = photos.reports.len();
    let words = match (known, photos.searched) {
        (_, None) => counted(all, "photo", "photos"),
        (known, _) if known == all => format!("{laid} of {all} laid"),
        _ => {
            let left = match photos.at_work {
                Some(_) => "to come",
                None => "not laid",
            };
            let (refused, others) = (known - laid, all - known);
            format!("{laid} laid, {refused} refused, {others} {left}")
        }
    };
    match photos.mean_seconds() {
        Some(seconds) => format!("{words} · {seconds:.1} s each"),
        None => words,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photos_that_were_not_laid_before_it_was_stopped_are_not_to_come() {
        let mut photos = PhotosState::default();
        photos.reports.resize(2, None);
        photos.searched = Some(photos.search);
        photos.at_work = Some((0.5, "Laying photos".to_owned()));
        assert_eq!(summary(&photos), "0 laid, 0 refused, 2 to come");
        photos.at_work = None;
        assert_eq!(summary(&photos), "0 laid, 0 refused, 2 not laid");
    }
}
