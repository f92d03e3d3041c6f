//! Arguments that name the map, the mission on it and the camera.

use std::path::PathBuf;

use super::planned_flight::PlanSource;

/// Arguments that name the map, the mission on it and the camera.
#[derive(clap::Args)]
pub struct SourceArguments {
    /// A built-in scenario: its map, aircraft, camera and route.
    #[arg(long, conflicts_with_all = ["mission", "map"])]
    pub scenario: Option<String>,
    /// A mission file (zip or GeoJSON); its first route is flown.
    #[arg(long)]
    pub mission: Option<PathBuf>,
    /// The map of the mission, if the file does not hold it.
    #[arg(long, requires = "mission")]
    pub map: Option<PathBuf>,
    /// A flight folder whose camera is flown, if the mission states none.
    #[arg(long)]
    pub flight: Option<PathBuf>,
    /// Height above ground, metres, in place of those of the route or scenario.
    #[arg(long)]
    pub height: Option<f64>,
    /// An elevation model of the ground below the mission's route, level where it says nothing; a route that is found
    /// keeps clear of the ground in it.
    #[arg(long, value_name = "FILE", requires = "mission")]
    pub dem: Option<PathBuf>,
}

impl SourceArguments {
    /// The source that they name.
    pub fn to_source(&self) -> PlanSource {
        PlanSource {
            scenario: self.scenario.clone(),
            mission: self.mission.clone(),
            map: self.map.clone(),
            flight: self.flight.clone(),
            height: self.height,
            dem: self.dem.clone(),
        }
    }
}
