//! Pictures of what is on the screen, saved as files.

use std::sync::{Arc, OnceLock};

use egui::ColorImage;

use crate::command::Command;
use crate::feature::{
    Feature, FeatureCommand, FeatureContext, FeatureId, FeatureInfo, FeaturePlace,
};
use crate::host::stem;
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry};
use crate::units::clock;

/// Identity of the feature.
const ID: FeatureId = "screenshot";

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Picture of the view",
    place: FeaturePlace::Nowhere,
    commands,
};

/// Save a picture of the next frame.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Save;

fn commands() -> Vec<CommandEntry> {
    let label = "Save a picture of the view (PNG)";
    let save = Command::Feature(FeatureCommand::new(ID, Save));
    let entry = entry(CommandGroup::Document, label, Vec::new(), save);
    let entry = entry.also("screenshot screen capture snapshot image");
    vec![entry.under(BarMenu::Save)]
}

/// Picture that was asked for.
#[derive(Debug, Default)]
pub struct Screenshot {
    /// Name of its file, and the picture itself once the frame is drawn.
    awaited: Option<(String, Arc<OnceLock<Arc<ColorImage>>>)>,
}

/// Name of the file for the view of what is open: the flight with the time of the cursor, or the mission.
fn file_name(context: &FeatureContext<'_>) -> String {
    let documents = &*context.documents;
    let (name, span) = (documents.subject(), documents.span());
    let time = span.map(|(first, _)| clock(context.playback.time, first));
    let time = time.map_or_else(String::new, |time| format!("-{time}"));
    format!("{}.png", stem(&format!("{name}{time}")))
}

impl Feature for Screenshot {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        if command.action::<Save>().is_none() {
            return false;
        }
        let taken = Arc::<OnceLock<_>>::default();
        self.awaited = Some((file_name(context), taken.clone()));
        let egui = context.egui.clone();
        context.egui.request_screenshot(move |picture| {
            // One that is told of twice is the same.
            let _ = taken.set(picture);
            egui.request_repaint();
        });
        true
    }

    /// Saves the picture once it is taken.
    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        let taken = self.awaited.as_ref();
        let Some(picture) = taken.and_then(|(_, taken)| taken.get().cloned()) else {
            return;
        };
        let Some((name, _)) = self.awaited.take() else {
            return;
        };
        let size = picture.size.map(|side| side as u32);
        // Whatever shines through the page, the picture has nothing behind it.
        let pixels = picture
            .pixels
            .iter()
            .flat_map(|it| [it.r(), it.g(), it.b(), u8::MAX]);
        let pixels: Vec<u8> = pixels.collect();
        context.host.save_pixels(&name, size, &pixels);
        context.note("Picture saved", name);
    }
}
