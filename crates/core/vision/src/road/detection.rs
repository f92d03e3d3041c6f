//! The ways in which roads are detected.

use pilotage_raster::raster::{Raster, Rgba};
use serde::{Deserialize, Serialize};

use super::probability::roads_seen;
use super::seen::RoadsSeen;
use super::yellow::YellowLineRule;

/// A way of detecting roads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum RoadDetection {
    /// The two longest straight lines of yellow paint (`DeAngelo` 2016, eqs 1-4).
    YellowLines,
    /// A small network that knows roads of any colour.
    Network,
}

impl RoadDetection {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::YellowLines, Self::Network];

    /// Word for files and the terminal.
    pub fn key(self) -> &'static str {
        match self {
            Self::YellowLines => "yellow-lines",
            Self::Network => "network",
        }
    }

    /// Roads in a picture of the ground; pixels of coverage 0 show nothing. The limits of the yellow lines are pixels of
    /// the picture, whatever they measure.
    pub fn roads_seen(self, picture: &Raster<Rgba>, metres_per_pixel: f64) -> RoadsSeen {
        match self {
            Self::YellowLines => YellowLineRule::default().lines(picture).roads(),
            Self::Network => roads_seen(picture, metres_per_pixel),
        }
    }
}
