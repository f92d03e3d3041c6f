//! The ways in which roads are detected.

use pilotage_raster::raster::{Raster, Rgba};
use serde::{Deserialize, Serialize};

use super::seen::RoadsSeen;
use super::yellow::YellowLineRule;

/// A way of detecting roads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RoadDetection {
    /// The two longest straight lines of yellow paint (`DeAngelo` 2016, eqs 1-4).
    YellowLines,
}

impl RoadDetection {
    /// All of them.
    pub const ALL: [Self; 1] = [Self::YellowLines];

    /// Word for files and the terminal.
    pub fn key(self) -> &'static str {
        match self {
            Self::YellowLines => "yellow-lines",
        }
    }

    /// Roads in a picture of the ground; pixels of coverage 0 show nothing.
    pub fn roads_seen(self, picture: &Raster<Rgba>) -> RoadsSeen {
        match self {
            Self::YellowLines => YellowLineRule::default().lines(picture).roads(),
        }
    }
}
