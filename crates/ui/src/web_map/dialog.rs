//! The dialog that opens a map of the web: by a template of tiles, or a file read by pieces.

use egui::{Frame, Id, Modal, ScrollArea, TextEdit, Ui};
use pilotage_core::frames::{Geodetic, GroundRect};
use pilotage_core::imagery::web_tiles::TileTemplate;
use pilotage_core::place_text::place_of_text;

use super::WebMapCommand;
use super::address::{check, host_of, is_file};
use super::services::{SERVICES, WebService, service_at};
use crate::command::Command;
use crate::host::Download;
use crate::shell::{NumberField, caption, muted, text_button, title};
use crate::tokens::Tokens;
use pilotage_jobs::WebMap;

/// Most tiles that an area may have.
const MOST_TILES: u64 = 20_000;
/// Bytes of a usual tile, for an estimate.
const USUAL_TILE: f64 = 22_000.0;
/// Latitude up to which there are tiles, degrees.
const NORTHERNMOST: f64 = 85.0;

/// Scene of the dialog: the open map and the ground in sight.
pub struct WebMapScene<'a> {
    /// Origin of the world frame.
    pub origin: Option<Geodetic>,
    /// The map of the web that is open.
    pub open: Option<&'a WebMap>,
    /// The ground in sight.
    pub visible: Option<GroundRect>,
    /// The download under way or just over.
    pub download: Option<Download>,
}

/// Dialog with the typed address, zooms and place.
#[derive(Clone, Debug)]
pub struct WebMapDialog {
    open: bool,
    address: String,
    attribution: String,
    zooms: (u8, u8),
    place: String,
    /// Whether the map begins at that place even though a world is open.
    is_elsewhere: bool,
    deepest: Option<u8>,
    wrong: Option<String>,
    /// Server that the page comes from.
    pub(super) own_server: String,
}

impl Default for WebMapDialog {
    fn default() -> Self {
        Self {
            open: false,
            address: String::new(),
            attribution: String::new(),
            zooms: (0, 18),
            place: String::new(),
            is_elsewhere: false,
            deepest: None,
            wrong: None,
            own_server: String::new(),
        }
    }
}

impl WebMapDialog {
    /// Opens or closes the dialog.
    pub fn toggle(&mut self) {
        self.open = !self.open;
        self.is_elsewhere = false;
        self.wrong = None;
    }

    /// Opens the dialog for a map that begins at a place, whatever world is open.
    pub fn begin_at(&mut self, place: &Geodetic) {
        let [latitude, longitude] = [place.latitude, place.longitude].map(f64::to_degrees);
        self.place = format!("{latitude:.6}, {longitude:.6}");
        (self.open, self.is_elsewhere, self.wrong) = (true, true, None);
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Draws the dialog.
    pub fn show(
        &mut self,
        context: &egui::Context,
        tokens: &Tokens,
        scene: &WebMapScene<'_>,
        commands: &mut Vec<Command>,
    ) {
        if !self.open {
            return;
        }
        let screen = context.content_rect();
        let response = Modal::new(Id::unique("web map"))
            .frame(Frame::window(&context.global_style()).inner_margin(24))
            .show(context, |ui| {
                ui.set_width(560.0_f32.min(screen.width() - 96.0));
                let mut close = title(ui, tokens, "Map from the web");
                let height = (screen.height() - 160.0).max(120.0);
                ScrollArea::vertical()
                    .min_scrolled_height(height)
                    .max_height(height)
                    .show(ui, |ui| {
                        self.services(ui, tokens);
                        close |= self.source(ui, tokens, scene, commands);
                        if let Some(map) = scene.open {
                            ui.add_space(2.0 * tokens.space);
                            ui.separator();
                            self.offline(ui, tokens, scene, map, commands);
                        }
                    });
                close
            });
        if response.inner || response.should_close() {
            self.open = false;
        }
    }

    /// Lists the public services; one that is chosen fills the fields below.
    fn services(&mut self, ui: &mut Ui, tokens: &Tokens) {
        caption(ui, tokens, "Public services");
        for service in &SERVICES {
            let is_chosen = self.address == service.address;
            let words = format!("{}: {}, {}", service.name, service.area, service.shows);
            if ui.selectable_label(is_chosen, words).clicked() {
                self.choose(service);
            }
            if is_chosen {
                let not = if service.is_downloadable { "" } else { "not " };
                let (finest, terms) = (service.finest, service.terms);
                let words = format!("Down to zoom {finest}. {terms} Areas may {not}be downloaded.");
                ui.label(muted(tokens, words));
            }
        }
        ui.add_space(tokens.space);
    }

    fn choose(&mut self, service: &WebService) {
        service.address.clone_into(&mut self.address);
        service.attribution.clone_into(&mut self.attribution);
        self.zooms = (0, service.finest);
        self.wrong = None;
    }

    fn source(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        scene: &WebMapScene<'_>,
        commands: &mut Vec<Command>,
    ) -> bool {
        caption(ui, tokens, "Address");
        let hint = "https://tiles.example.org/{z}/{x}/{y}.png, or of a GeoTIFF or PMTiles";
        text(ui, &mut self.address, "Address", hint);
        let is_file = is_file(&self.address);
        if !is_file {
            caption(ui, tokens, "Attribution, shown on the map");
            text(
                ui,
                &mut self.attribution,
                "Attribution",
                "© whoever made the map",
            );
            ui.horizontal(|ui| {
                ui.label("Zooms from");
                let (least, most) = &mut self.zooms;
                let zoom = || NumberField::new(0.0..=22.0).speed(0.25);
                zoom().show(ui, least).accessible_name("Coarsest zoom");
                ui.label("to");
                zoom().show(ui, most).accessible_name("Deepest zoom");
            });
            if scene.origin.is_none() || self.is_elsewhere {
                caption(ui, tokens, "Where to begin");
                let hint = "latitude, longitude; UTM, MGRS or a plus code";
                text(ui, &mut self.place, "Where to begin", hint);
            }
            if scene.origin.is_some() && self.is_elsewhere {
                let words =
                    "A mission of its own begins there. Undo brings back the one that is open.";
                ui.label(muted(tokens, words));
            }
        }
        let host = host_of(&self.address).unwrap_or("its server");
        ui.label(muted(
            tokens,
            format!(
                "Whatever part of the map you look at is requested from {host}, which so learns where you \
                 look. Nothing else leaves this machine. Tiles that came are kept here, 200 MB of them at most; those \
                 of areas that you download stay."
            ),
        ));
        if let Some(why) = &self.wrong {
            ui.label(muted(tokens, why.clone()).color(tokens.warning));
        }
        let mut close = false;
        ui.horizontal(|ui| {
            if text_button(ui, tokens, None, "Open the map", true).clicked() {
                match self.order(scene.origin, is_file) {
                    Ok(command) => {
                        commands.push(Command::from(command));
                        close = true;
                    }
                    Err(why) => self.wrong = Some(why),
                }
            }
            close |= text_button(ui, tokens, None, "Cancel", false).clicked();
        });
        close
    }

    fn order(&self, origin: Option<Geodetic>, is_file: bool) -> Result<WebMapCommand, String> {
        let address = self.address.trim().to_owned();
        if is_file {
            check(&address, &self.own_server)?;
            return Ok(WebMapCommand::OpenFile(address));
        }
        let template = TileTemplate {
            name: host_of(&address).unwrap_or_default().to_owned(),
            address,
            attribution: self.attribution.trim().to_owned(),
            least_zoom: self.zooms.0,
            most_zoom: self.zooms.1,
            side: 256,
        };
        let template = template.checked().map_err(|cause| cause.to_string())?;
        check(&template.address, &self.own_server)?;
        if template.attribution.is_empty() {
            return Err("say whose map it is: makers of maps ask for it".to_owned());
        }
        let origin = match origin.filter(|_| !self.is_elsewhere) {
            Some(origin) => origin,
            None => place(&self.place)?,
        };
        Ok(WebMapCommand::OpenTiles(Box::new(WebMap {
            template,
            origin,
        })))
    }

    fn offline(
        &mut self,
        ui: &mut Ui,
        tokens: &Tokens,
        scene: &WebMapScene<'_>,
        map: &WebMap,
        commands: &mut Vec<Command>,
    ) {
        caption(ui, tokens, "Without a network");
        if let Some(download) = scene.download.filter(|d| !d.over) {
            let part = download.done as f32 / download.all.max(1) as f32;
            ui.add(
                egui::ProgressBar::new(part)
                    .text(format!("{} of {} tiles", download.done, download.all)),
            );
            if text_button(ui, tokens, None, "Stop the download", false).clicked() {
                commands.push(Command::from(WebMapCommand::StopDownload));
            }
            return;
        }
        let service = service_at(&map.template.address);
        if let Some(service) = service.filter(|service| !service.is_downloadable) {
            let (name, terms) = (service.name, service.terms);
            let words = format!("{name} may not be downloaded by the area. {terms}");
            ui.label(muted(tokens, words));
            return;
        }
        let Some(visible) = scene.visible else { return };
        let (least, most) = (map.template.least_zoom, map.template.most_zoom);
        let deepest = self.deepest.get_or_insert(most);
        *deepest = (*deepest).clamp(least, most);
        ui.horizontal(|ui| {
            ui.label("What is in sight, down to zoom");
            let field = NumberField::whole(least..=most).show(ui, deepest);
            field.accessible_name("Deepest zoom to download");
        });
        let zooms = (least, *deepest);
        let count = map.count_over(&visible, zooms);
        let size = count as f64 * USUAL_TILE / 1e6;
        let words = if count > MOST_TILES {
            format!(
                "{count} tiles; at most {MOST_TILES} at a time, zoom in or choose a coarser zoom."
            )
        } else {
            format!(
                "{count} tiles, about {size:.0} MB. What is here already is not fetched again; a download that was stopped goes on where it was."
            )
        };
        ui.label(muted(tokens, words));
        ui.add_enabled_ui(count <= MOST_TILES, |ui| {
            if text_button(ui, tokens, None, "Download what is in sight", false).clicked() {
                commands.push(Command::from(WebMapCommand::Download(visible, zooms)));
            }
        });
        if let Some(download) = scene.download.filter(|d| d.over && d.all > 0) {
            let got = download.got();
            ui.label(muted(
                tokens,
                format!("The last download brought {got} of {} tiles.", download.all),
            ));
        }
    }
}

fn text(ui: &mut Ui, value: &mut String, label: &str, hint: &str) {
    let field = TextEdit::singleline(value)
        .align(egui::Align2::LEFT_CENTER)
        .desired_width(f32::INFINITY)
        .hint_text(hint);
    ui.add(field).accessible_name(label);
}

/// The place where a map begins, by what was typed.
fn place(text: &str) -> Result<Geodetic, String> {
    if text.trim().is_empty() {
        return Err(
            "say where to begin: a latitude and a longitude, like 46.86, -92.08".to_owned(),
        );
    }
    let place = place_of_text(text).map_err(|why| why.to_string())?;
    if place.latitude.abs() > NORTHERNMOST.to_radians() {
        return Err("Maps of the web end at 85° of latitude.".to_owned());
    }
    Ok(place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_template_without_its_numbers_or_its_makers_is_refused_with_what_is_missing() {
        let mut dialog = WebMapDialog {
            address: "https://example.org/{z}/{x}.png".to_owned(),
            ..WebMapDialog::default()
        };
        let origin = Some(Geodetic::from_degrees(46.0, -92.0, 0.0));
        assert!(dialog.order(origin, false).unwrap_err().contains("{y}"));
        dialog.address = "https://example.org/{z}/{x}/{y}.png".to_owned();
        assert!(
            dialog
                .order(origin, false)
                .unwrap_err()
                .contains("whose map")
        );
        dialog.attribution = "© someone".to_owned();
        assert!(dialog.order(origin, false).is_ok());
        assert!(dialog.order(None, false).unwrap_err().contains("latitude"));
        dialog.address = "http://192.168.1.5:8080/{z}/{x}/{y}.png".to_owned();
        assert!(dialog.order(origin, false).unwrap_err().contains("https"));
        dialog.own_server = "http://192.168.1.5:8080".to_owned();
        assert!(dialog.order(origin, false).is_ok());
        dialog.address = "example.org/map.tif".to_owned();
        assert!(dialog.order(origin, true).unwrap_err().contains("https"));
    }

    #[test]
    fn a_map_begins_elsewhere_only_where_there_are_tiles() {
        let mut dialog = WebMapDialog::default();
        dialog.choose(&SERVICES[0]);
        let origin = Some(Geodetic::from_degrees(46.0, -92.0, 0.0));
        dialog.begin_at(&Geodetic::from_degrees(47.5, 8.25, 0.0));
        let Ok(WebMapCommand::OpenTiles(map)) = dialog.order(origin, false) else {
            panic!("no map");
        };
        assert!((map.origin.latitude.to_degrees() - 47.5).abs() < 1e-9);
        dialog.place = "32TMT48".to_owned();
        assert!(dialog.order(origin, false).is_ok());
        dialog.place = "86, 10".to_owned();
        assert!(dialog.order(origin, false).unwrap_err().contains("85°"));
        dialog.place = "32TAT48".to_owned();
        assert!(dialog.order(origin, false).unwrap_err().contains("column"));
    }
}
