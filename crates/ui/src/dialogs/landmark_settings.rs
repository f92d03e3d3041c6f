//! Settings by which landmarks are recognised, in the sheet of filter settings.

use egui::Ui;
use pilotage_core::landmark::{TemplateFeatures, TemplateSettings};
use pilotage_core::registration::USUAL_MAP_DEVIATION;

use super::setting_rows::{linear, meaning};
use crate::shell::caption;
use crate::tokens::Tokens;
use crate::units::Units;

/// Draws the rows.
pub(super) fn landmarks(
    ui: &mut Ui,
    tokens: &Tokens,
    settings: &mut TemplateSettings,
    units: Units,
) {
    caption(ui, tokens, "Landmarks");
    let before = settings.features;
    egui::ComboBox::from_id_salt("landmark features")
        .selected_text(label(before))
        .width(ui.available_width() - 8.0)
        .show_ui(ui, |ui| {
            for choice in TemplateFeatures::ALL {
                ui.selectable_value(&mut settings.features, choice, label(choice));
            }
        })
        .response
        .accessible_name("Landmarks are recognised by");
    meaning(ui, tokens, description(settings.features));
    if settings.features != TemplateFeatures::Orientation {
        return;
    }
    if before != settings.features && settings.map_deviation == 0.0 {
        settings.map_deviation = USUAL_MAP_DEVIATION;
    }
    let (length, length_unit) = units.length();
    let map = &mut settings.map_deviation;
    linear(
        ui,
        "Map of the landmarks is good to, σ",
        length_unit,
        map,
        length,
        0.0..=20.0,
    );
    meaning(
        ui,
        tokens,
        "How far off the map itself may be, per axis: some 3 m for satellite and aerial maps of the web.",
    );
}

fn label(features: TemplateFeatures) -> &'static str {
    match features {
        TemplateFeatures::Brightness => "Brightness: the map is of the flight’s own time",
        TemplateFeatures::Orientation => "Edges: the map is of another date",
    }
}

fn description(features: TemplateFeatures) -> &'static str {
    match features {
        TemplateFeatures::Brightness => {
            "Compares how bright the ground is. Right for an orthophoto of about the day of the flight."
        }
        TemplateFeatures::Orientation => {
            "Compares which way edges run, which seasons and shadows change less, and judges by probability. Right for \
             satellite and aerial maps of other years."
        }
    }
}
