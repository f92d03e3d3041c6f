//! Maps of the web as a feature: its dialog, and the download that goes on behind it.

use std::time::Duration;

use egui::{Key, Ui};
use pilotage_core::frames::{GroundPoint, GroundRect};
use pilotage_jobs::{FileContent, MapSource, WebMap};
use serde_json::Value;

use super::dialog::{WebMapDialog, WebMapScene};
use super::{ID, WebMapCommand};
use crate::command::{Command, Workspace};
use crate::context::ViewContext;
use crate::documents::Documents;
use crate::feature::{Feature, FeatureCommand, FeatureContext, FeatureInfo, FeaturePlace};
use crate::host::{Download, OpenedFile};
use crate::shell::catalog::{BarMenu, CommandEntry, CommandGroup, entry, shift};
use crate::state_json::object;

/// Interval at which the progress of a download is looked at.
const LOOK_AGAIN: Duration = Duration::from_millis(200);

/// Description of the feature.
const INFO: FeatureInfo = FeatureInfo {
    id: ID,
    tab: "Map from the web",
    place: FeaturePlace::Dialog,
    commands,
};

fn commands() -> Vec<CommandEntry> {
    vec![
        entry(
            CommandGroup::Document,
            "Map from the web: tiles, GeoTIFF, PMTiles…",
            vec![shift(Key::M)],
            Command::Feature(FeatureCommand::show(ID)),
        )
        .also("openstreetmap osm satellite imagery base basemap orthophoto xyz")
        .under(BarMenu::Open),
    ]
}

/// Map of the web that is open, if one is.
fn open_map(documents: &Documents) -> Option<&WebMap> {
    match &documents.map.source {
        MapSource::Web(map) => Some(map),
        _ => None,
    }
}

/// Maps of the web.
#[derive(Default)]
pub struct WebMapFeature {
    dialog: WebMapDialog,
    /// Ground in sight, while the dialog is open.
    visible: Option<GroundRect>,
    /// Progress of a download, if one was ever begun.
    download: Option<Download>,
    /// Whether it was begun here and is not over.
    is_downloading: bool,
}

impl WebMapFeature {
    /// Shows a map of tiles, in a world of its own unless its own is open.
    fn open_tiles(map: &WebMap, context: &mut FeatureContext<'_>) {
        let name = &map.template.name;
        if context.documents.world_origin() != Some(map.origin) {
            context.stop_flying();
            *context.selection = None;
            context.documents.begin_world(map.origin, name);
            context.map.camera.center = GroundPoint::default();
            context.view.workspace = Workspace::Plan;
        }
        let text = format!("Its tiles are requested from {name} as you look at them.");
        context.change_map(MapSource::Web(map.clone()));
        context.document_changed();
        context.note("The map comes from the web", text);
    }

    /// Looks how far a download is, and says when it is over.
    fn watch_download(&mut self, context: &mut FeatureContext<'_>) {
        self.download = context.host.download_state();
        if !self.is_downloading {
            return;
        }
        context.egui.request_repaint_after(LOOK_AGAIN);
        let Some(download) = self.download.filter(|d| d.over) else {
            return;
        };
        self.is_downloading = false;
        let got = download.got();
        if download.is_full {
            let text = format!(
                "The browser has no room for more than {got} of {} tiles. Make room on this machine, or \
                 choose a smaller area or a coarser zoom.",
                download.all
            );
            context.trouble("The area is not whole", text);
        } else if download.failed == 0 {
            let text = match got {
                1 => "The tile is here and needs no network.".to_owned(),
                _ => format!("{got} tiles are here and need no network."),
            };
            context.note("The area is downloaded", text);
        } else {
            let text = format!(
                "{} of {} tiles could not be had. Start it again to ask for those.",
                download.failed, download.all
            );
            context.trouble("The area is not whole", text);
        }
    }
}

impl Feature for WebMapFeature {
    fn info(&self) -> &'static FeatureInfo {
        &INFO
    }

    fn execute(&mut self, command: &FeatureCommand, context: &mut FeatureContext<'_>) -> bool {
        let Some(command) = command.action::<WebMapCommand>() else {
            return false;
        };
        match command {
            WebMapCommand::BeginAt(place) => self.dialog.begin_at(place),
            WebMapCommand::OpenTiles(map) => Self::open_tiles(map, context),
            WebMapCommand::OpenFile(address) => {
                let path = address.split(['?', '#']).next().unwrap_or_default();
                context.open(vec![OpenedFile {
                    path: path.to_owned(),
                    content: FileContent::Address(address.clone()),
                }]);
            }
            WebMapCommand::Download(area, zooms) => {
                if let Some(map) = open_map(context.documents) {
                    context.host.download(map.addresses_over(area, *zooms));
                    self.is_downloading = true;
                }
            }
            WebMapCommand::StopDownload => {
                context.host.stop_download();
                self.is_downloading = false;
                let text = "What has come stays here; start it again to go on.";
                context.note("The download was stopped", text);
            }
        }
        true
    }

    fn panel(&mut self, ui: &mut Ui, context: &mut ViewContext<'_>, documents: &Documents) {
        let scene = WebMapScene {
            origin: documents.world_origin(),
            open: open_map(documents),
            visible: self.visible,
            download: self.download,
        };
        let tokens = context.tokens;
        self.dialog.show(ui.ctx(), tokens, &scene, context.commands);
    }

    fn tend(&mut self, context: &mut FeatureContext<'_>) {
        if self.dialog.is_open() {
            self.dialog.own_server = context.host.own_server();
            let map = &*context.map;
            let sight = map.rect().zip(map.screen_from_world());
            self.visible = sight.map(|(rect, view)| view.visible(rect));
        }
        self.watch_download(context);
    }

    /// Opens the dialog, or closes it if it is open.
    fn on_shown(&mut self, _context: &mut FeatureContext<'_>) {
        self.dialog.toggle();
    }

    fn is_open_over(&self) -> bool {
        self.dialog.is_open()
    }

    fn state(&self, _documents: &Documents) -> Value {
        object!({
            "open": self.dialog.is_open(),
            "download": self.download.map(|d| {
                object!({"done": d.done, "all": d.all, "failed": d.failed, "over": d.over})
            }),
        })
    }
}
