//! What goes into a mission file.

use pilotage_core::mission::Mission;
use serde::{Deserialize, Serialize};

use super::{Beside, MapSource};

/// What goes into a mission file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PackOrder {
    /// The mission.
    pub mission: Mission,
    /// What is open beside it.
    pub beside: Beside,
    /// The map, whose files go with it.
    pub map: MapSource,
}
