//! Source of the map, the mission on it and the camera.

use std::path::PathBuf;

/// Source of the map, the mission on it and the camera.
#[derive(clap::Args)]
pub struct PlanSource {
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
    /// Height above ground, metres, where neither route nor scenario states one.
    #[arg(long)]
    pub height: Option<f64>,
}
