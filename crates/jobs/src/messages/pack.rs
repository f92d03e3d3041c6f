//! Content of a mission file.

use pilotage_core::mission::Mission;
use serde::{Deserialize, Serialize};

use super::{Beside, MapSource};

/// Content of a mission file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PackOrder {
    /// The mission.
    pub mission: Mission,
    /// Simulation, bookmarks and measurements open beside the mission.
    pub beside: Beside,
    /// The map, whose files go with it.
    pub map: MapSource,
}
