//! The hall as a world with one flight.

use std::sync::Arc;

use super::super::flight_frames::SimulatedFlight;
use super::super::scenario::{Overrides, Wind};
use super::super::scenery::Scenery;
use super::super::world::{LaidWorld, LayOut, SimulationChoice, World};
use super::IndoorHall;
use pilotage_base::frames::GroundPoint;
use pilotage_mission::mission::Mission;
use pilotage_mission::settings::{NavigatorSettings, VehicleChoice};
use pilotage_raster::imagery::Imagery;

/// The hall, which has a day, a draught and a height of its own.
#[derive(Debug)]
pub(in super::super) struct Hall;

impl World for Hall {
    fn key(&self) -> &'static str {
        "hall"
    }

    fn place(&self) -> &'static str {
        "the hall"
    }

    fn flights(&self) -> Vec<SimulationChoice> {
        let hall = IndoorHall::default();
        vec![SimulationChoice {
            name: IndoorHall::NAME,
            title: IndoorHall::TITLE,
            description: IndoorHall::DESCRIPTION,
            height: hall.height,
            wind: Wind::of_velocity(&hall.draught),
            world: &Self,
        }]
    }

    fn navigator(&self, _: &str) -> NavigatorSettings {
        IndoorHall::default().navigator(VehicleChoice::Multirotor)
    }

    fn route(&self, _: &str) -> Option<Vec<GroundPoint>> {
        None
    }

    fn is_variable(&self) -> bool {
        false
    }

    fn is_shown_whole(&self) -> bool {
        true
    }
}

impl LayOut for Hall {
    fn lay_out(&self) -> Arc<dyn LaidWorld> {
        Arc::new(IndoorHall::default())
    }
}

impl LaidWorld for IndoorHall {
    fn map(&self) -> Arc<dyn Imagery> {
        Arc::new(Self::map())
    }

    fn scenery(&self) -> Option<Scenery> {
        None
    }

    fn fly(&self, flight: &str, seed: u64, _: &Overrides) -> Option<SimulatedFlight> {
        (flight == Self::NAME).then(|| self.simulate(seed))
    }

    fn missions(&self, flight: &str, _: &Overrides) -> Vec<(&'static str, Mission)> {
        if flight != Self::NAME {
            return Vec::new();
        }
        vec![
            ("mission.geojson", self.mission(VehicleChoice::Multirotor)),
            (
                "mission-velocity.geojson",
                self.mission(VehicleChoice::VelocityDriven),
            ),
        ]
    }
}
