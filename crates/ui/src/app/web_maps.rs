//! Maps of the web: opened, and downloaded for use without a network.

use super::App;
use crate::dialogs::{WebMapCommand, WebMapScene};
use crate::host::{Host, OpenedFile};
use pilotage_jobs::{FileContent, MapSource, WebMap};

impl App {
    /// Carries a command out.
    pub(super) fn web_map(
        &mut self,
        command: WebMapCommand,
        egui: &egui::Context,
        host: &mut dyn Host,
    ) {
        match command {
            WebMapCommand::OpenTiles(map) => {
                if self.documents.world_origin().is_none() {
                    self.documents.begin_world(map.origin, &map.template.name);
                    self.views.map.camera.center = pilotage_core::frames::GroundPoint::default();
                    self.show_workspace(crate::command::Workspace::Plan);
                }
                let text = format!(
                    "Its tiles are requested from {} as you look at them.",
                    map.template.name
                );
                self.change_map(host, MapSource::Web(*map));
                self.jobs.document_changed = true;
                self.toasts
                    .note(host.now(), "The map comes from the web", text);
            }
            WebMapCommand::OpenFile(address) => {
                let file = OpenedFile {
                    path: address
                        .split(['?', '#'])
                        .next()
                        .unwrap_or_default()
                        .to_owned(),
                    content: FileContent::Address(address),
                };
                self.open_files(egui, host, vec![file]);
            }
            WebMapCommand::Download(area, zooms) => {
                if let MapSource::Web(map) = &self.documents.map_source {
                    host.download(map.addresses_over(&area, zooms));
                    self.jobs.downloading = true;
                }
            }
            WebMapCommand::StopDownload => {
                host.stop_download();
                self.jobs.downloading = false;
                let text = "What has come stays here; start it again to go on.";
                self.toasts
                    .note(host.now(), "The download was stopped", text);
            }
        }
    }

    /// Looks how far a download is, and says when it is over.
    pub(super) fn watch_download(&mut self, context: &egui::Context, host: &mut dyn Host) {
        self.jobs.download = host.download_state();
        if !self.jobs.downloading {
            return;
        }
        context.request_repaint_after(std::time::Duration::from_millis(200));
        let Some(download) = self.jobs.download.filter(|d| d.over) else {
            return;
        };
        self.jobs.downloading = false;
        let got = download.all - download.failed;
        let now = host.now();
        if download.failed == 0 {
            let text = format!("{got} tiles are here and need no network.");
            self.toasts.note(now, "The area is downloaded", text);
        } else {
            let text = format!(
                "{} of {} tiles could not be had. Start it again to ask for those.",
                download.failed, download.all
            );
            self.toasts.trouble(now, "The area is not whole", text);
        }
    }

    /// Draws the dialog.
    pub(super) fn web_map_dialog(
        &mut self,
        ui: &egui::Ui,
        commands: &mut Vec<crate::command::Command>,
    ) {
        let mut dialog = std::mem::take(&mut self.dialogs.web_map);
        let map = &self.views.map;
        let scene = WebMapScene {
            origin: self.documents.world_origin(),
            open: self.open_web_map(),
            visible: map
                .rect()
                .zip(map.screen_from_world())
                .map(|(rect, view)| view.visible(rect)),
            gsd: map.camera.metres_per_point,
            download: self.jobs.download,
        };
        dialog.show(ui.ctx(), &self.tokens, &scene, commands);
        self.dialogs.web_map = dialog;
    }

    fn open_web_map(&self) -> Option<&WebMap> {
        match &self.documents.map_source {
            MapSource::Web(map) => Some(map),
            _ => None,
        }
    }
}
