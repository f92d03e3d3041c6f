//! Room for the views until they are joined in.

use crate::context::ViewContext;

macro_rules! stand_in {
    ($name:ident, $text:literal) => {
        #[derive(Default)]
        pub struct $name;

        impl $name {
            pub fn show(&mut self, ui: &mut egui::Ui, _context: &mut ViewContext<'_>) {
                ui.weak($text);
            }
        }
    };
}

stand_in!(CameraView, "Camera picture");
stand_in!(MatchView, "Match");
stand_in!(PlotsView, "Plots");
stand_in!(InspectorView, "Filter");
stand_in!(Tour, "Tour");
