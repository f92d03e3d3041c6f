//! Drawings of rehearsed flights, kept for as long as nothing about them changes.

use std::cell::{Ref, RefCell};

use egui::Color32;
use pilotage_core::frames::GroundPoint;

use crate::map::ScreenFromWorld;
use crate::still::Still;
use crate::views::chart::ChartAxes;

/// Version of the flights, and number of the prediction beside which they are.
pub(super) type FlightsKey = (u64, u64);

/// Drawings of flights, in the chart and on the map.
#[derive(Debug, Default)]
pub struct DrawnFlights {
    /// In the chart.
    pub(super) chart: RefCell<Still<(FlightsKey, ChartAxes, Color32)>>,
    /// On the map.
    pub(super) map: RefCell<Still<(FlightsKey, ScreenFromWorld, Color32)>>,
    /// Lines on the ground.
    placed: RefCell<(Option<FlightsKey>, Vec<Vec<GroundPoint>>)>,
}

impl DrawnFlights {
    /// Lines of flights on the ground, which `make` tells once for each version of them.
    pub(super) fn placed(
        &self,
        key: FlightsKey,
        make: impl FnOnce() -> Vec<Vec<GroundPoint>>,
    ) -> Ref<'_, Vec<Vec<GroundPoint>>> {
        if self.placed.borrow().0 != Some(key) {
            *self.placed.borrow_mut() = (Some(key), make());
        }
        Ref::map(self.placed.borrow(), |it| &it.1)
    }
}
