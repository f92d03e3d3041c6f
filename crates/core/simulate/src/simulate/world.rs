//! A world to fly in: how menus, links and files know it, and what a program that flies in it needs.

use std::fmt::Debug;
use std::sync::Arc;

use super::flight_frames::SimulatedFlight;
use super::scenario::{Overrides, Wind};
use super::scenery::Scenery;
use pilotage_base::frames::{Altitude, AltitudeFrame, GroundPoint};
use pilotage_mission::mission::{Mission, Route, WayPoint};
use pilotage_mission::settings::NavigatorSettings;
use pilotage_raster::imagery::Imagery;

/// A world as menus, links and files know it: a program that only names worlds links no more of them.
pub trait World: Debug + Sync {
    /// Key of its map in sessions and orders.
    fn key(&self) -> &'static str;

    /// Words for it in a sentence: "The flight in …".
    fn place(&self) -> &'static str;

    /// Flights in it, in the order in which people read them.
    fn flights(&self) -> Vec<SimulationChoice>;

    /// Settings of the navigation of one of its flights unless people want otherwise.
    fn navigator(&self, flight: &str) -> NavigatorSettings;

    /// Places over which one of its flights was planned, if it was.
    fn route(&self, flight: &str) -> Option<Vec<GroundPoint>>;

    /// Whether people may choose the day, the wind and the height of its flights.
    fn is_variable(&self) -> bool;

    /// Whether it is so small that a view shows all of it at first.
    fn is_shown_whole(&self) -> bool;
}

/// A world that can be laid out, for programs that fly in it.
pub trait LayOut: World {
    /// The world, laid out once for all flights in it.
    fn lay_out(&self) -> Arc<dyn LaidWorld>;
}

/// A world that is laid out.
pub trait LaidWorld {
    /// The map of it.
    fn map(&self) -> Arc<dyn Imagery>;

    /// Scenery on its ground, if the generator of scenery drew it, which knows every day's looks.
    fn scenery(&self) -> Option<Scenery>;

    /// The flight of that name with its pictures, which are made when they are asked for; `None` if it has no such
    /// flight. The same seed gives the same flight to the bit.
    fn fly(&self, flight: &str, seed: u64, overrides: &Overrides) -> Option<SimulatedFlight>;

    /// Missions for the flight of that name, each under the name of its file, the usual one first.
    fn missions(&self, flight: &str, overrides: &Overrides) -> Vec<(&'static str, Mission)>;
}

/// A flight to be chosen by its name.
#[derive(Clone, Debug)]
pub struct SimulationChoice {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Title for people.
    pub title: &'static str,
    /// Description of what happens in the flight.
    pub description: &'static str,
    /// Height above ground, metres.
    pub height: f64,
    /// Mean wind, or the draught.
    pub wind: Wind,
    /// The world that it is flown in.
    pub world: &'static dyn World,
}

impl SimulationChoice {
    /// Settings of the navigation unless people want otherwise.
    pub fn navigator(&self) -> NavigatorSettings {
        self.world.navigator(self.name)
    }

    /// The route as people plan one, at `height` above ground, metres, or the flight's own; `None` if it was not
    /// planned.
    pub fn route(&self, height: Option<f64>) -> Option<Route> {
        let height = height.unwrap_or(self.height);
        let altitude = Altitude::new(height, AltitudeFrame::AboveGround);
        let places = self.world.route(self.name)?.into_iter();
        Some(Route {
            id: 1,
            name: "Route of the flight".to_owned(),
            way_points: places.map(|p| WayPoint::new(p, altitude)).collect(),
            ..Route::default()
        })
    }
}
