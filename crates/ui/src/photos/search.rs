//! Search of photos: the prior of their pose, and the range around it.

use egui::Ui;
use pilotage_core::flight::photo::PhotoSearch;

use super::PhotosCommand as Do;
use super::scene::{PhotosScene, send};
use crate::context::ViewContext;
use crate::shell::{NumberField, muted, text_button};
use crate::views::parts;

/// A number that is edited: its name, its unit, and how many units one of it is.
struct EditedNumber<'a> {
    name: &'a str,
    unit: &'a str,
    factor: f64,
    range: std::ops::RangeInclusive<f64>,
    hint: &'a str,
}

impl EditedNumber<'_> {
    /// A row: the name at the left, the value at the right. Whether it was changed.
    fn edit(&self, ui: &mut Ui, value: &mut f64) -> bool {
        ui.horizontal(|ui| {
            let label = ui.label(self.name).on_hover_text(self.hint);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                self.field(ui, value, label.id)
            })
            .inner
        })
        .inner
    }

    fn field(&self, ui: &mut Ui, value: &mut f64, label: egui::Id) -> bool {
        let reach = self.factor * (self.range.end() - self.range.start());
        let field = NumberField::new(self.range.clone()).unit((self.factor, self.unit));
        let field = field.speed(0.005 * reach.min(200.0)).decimals(1);
        let field = field.show(ui, value).labelled_by(label);
        field.on_hover_text(self.hint).changed()
    }

    /// A row that says nothing better is known than the photo tells until it is ticked; then `usual` is begun with.
    fn edit_known(&self, ui: &mut Ui, value: &mut Option<f64>, usual: f64) {
        ui.horizontal(|ui| {
            let mut is_known = value.is_some();
            let tick = ui.checkbox(&mut is_known, self.name);
            let tick = tick.on_hover_text(self.hint);
            if tick.changed() {
                *value = is_known.then_some(usual);
            }
            ui.with_layout(
                egui::Layout::right_to_left(egui::Align::Center),
                |ui| match value {
                    Some(value) => {
                        self.field(ui, value, tick.id);
                    }
                    None => {
                        ui.weak("as the photo says");
                    }
                },
            );
        });
    }
}

const DEGREE: f64 = 180.0 / std::f64::consts::PI;

/// Draws how far is searched.
pub(super) fn limits(ui: &mut Ui, context: &mut ViewContext<'_>, before: &PhotoSearch) {
    let tokens = context.tokens;
    let mut search = *before;
    let (length, unit) = context.units.length();
    parts::section(ui, tokens, "How far is searched", true, |ui| {
        let number = |name, unit, factor: f64, range: [f64; 2], hint| EditedNumber {
            name,
            unit,
            factor,
            range: range[0]..=range[1],
            hint,
        };
        number(
            "Place, to each side",
            unit,
            length,
            [1.0, 2000.0],
            "How far from where the photo says it was taken it may have been. A wider search takes longer and finds \
             more look-alikes.",
        )
        .edit(ui, &mut search.within);
        number(
            "Heading, to each side",
            "°",
            DEGREE,
            [0.02, std::f64::consts::PI],
            "How wrong the heading may be; 180 is all around. Compasses of small drones are up to 30° off.",
        )
        .edit(ui, &mut search.heading_within);
        number(
            "Height, up and down",
            "%",
            100.0,
            [0.01, 3.0],
            "How wrong the height above the ground may be: photos count it from where the aircraft took off.",
        )
        .edit(ui, &mut search.height_within);
        number(
            "The map is good to, σ",
            unit,
            length,
            [0.0, 50.0],
            "How far off the map itself may be, per axis: some 3 m for satellite and aerial maps of the web, near \
             0 for an orthophoto made with ground control. No place is known better than its map.",
        )
        .edit(ui, &mut search.map_deviation);
    });
    if search != *before {
        send(context, Do::Search(Box::new(search)));
    }
}

/// Draws what is known better than by the photos themselves.
pub(super) fn known(ui: &mut Ui, context: &mut ViewContext<'_>, scene: &PhotosScene<'_>) {
    let tokens = context.tokens;
    let before = &scene.photos.search;
    let mut search = *before;
    let (length, unit) = context.units.length();
    let mut is_around_view = false;
    parts::section(ui, tokens, "Known better than by the photos", false, |ui| {
        place(ui, context, scene, &mut search, &mut is_around_view);
        let number = |name, unit, factor: f64, range: [f64; 2], hint| EditedNumber {
            name,
            unit,
            factor,
            range: range[0] / factor..=range[1] / factor,
            hint,
        };
        let hint =
            "Height above the ground, for photos that do not say it or count it from elsewhere.";
        let heights = [1.0, 5000.0].map(|metres| length * metres);
        number("Height", unit, length, heights, hint).edit_known(ui, &mut search.height, 100.0);
        let hint = "Direction in which the top of the picture points, clockwise from north.";
        let heading = number("Heading", "°", DEGREE, [-360.0, 360.0], hint);
        heading.edit_known(ui, &mut search.heading, 0.0);
        let hint = "How far ahead of straight down the camera looks.";
        let ahead = number("Looks ahead", "°", DEGREE, [-80.0, 80.0], hint);
        ahead.edit_known(ui, &mut search.ahead, 0.0);
        let hint = "Focal length in pixels of the stored picture, for photos that say nothing of their lens.";
        let focal = number("Focal length", "px", 1.0, [50.0, 50_000.0], hint);
        focal.edit_known(ui, &mut search.focal, 1000.0);
    });
    if is_around_view {
        send(context, Do::AroundView);
    } else if search != *before {
        send(context, Do::Search(Box::new(search)));
    }
}

fn place(
    ui: &mut Ui,
    context: &ViewContext<'_>,
    scene: &PhotosScene<'_>,
    search: &mut PhotoSearch,
    is_around_view: &mut bool,
) {
    let tokens = context.tokens;
    ui.horizontal_wrapped(|ui| {
        ui.label("Place");
        let words = match &search.at {
            Some(at) => format!(
                "{:.5}°, {:.5}°",
                at.latitude.to_degrees(),
                at.longitude.to_degrees()
            ),
            None => "as the photo says, else anywhere".to_owned(),
        };
        ui.label(muted(tokens, words));
    });
    ui.horizontal(|ui| {
        let can = scene.frame.is_some();
        let words = "Around the middle of the map view";
        ui.add_enabled_ui(can, |ui| {
            *is_around_view = text_button(ui, tokens, None, words, false).clicked();
        });
        if search.at.is_some() && text_button(ui, tokens, None, "Clear", false).clicked() {
            search.at = None;
        }
    });
}
