//! Differences between two days over the same ground.

use serde::{Deserialize, Serialize};

/// The time of year.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Season {
    /// Fresh leaves, young crops.
    Spring,
    /// Full leaves, ripening crops.
    Summer,
    /// Coloured leaves, stubble and ploughed fields.
    Autumn,
    /// Bare broadleaved trees, pale grass, no snow.
    LateWinter,
}

/// Light, air, season and movable things of one day.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Day {
    /// The time of year.
    pub season: Season,
    /// Azimuth of the sun, radians clockwise from north.
    pub sun_azimuth: f64,
    /// Elevation of the sun above the horizon, radians.
    pub sun_elevation: f64,
    /// Share of veiling light, 0 (clear) to about 0.4.
    pub haze: f64,
    /// Brightness relative to a normal exposure.
    pub exposure: f64,
    /// White balance: gains of red, green and blue.
    pub tint: [f64; 3],
    /// Seed of the parked cars: which of them stand where.
    pub cars_seed: u64,
    /// Seed of the growth: which crops grow, are mown or ploughed, and how the grass stands.
    pub growth_seed: u64,
}

impl Day {
    /// The day on which the map was flown: a clear summer noon.
    pub fn map_day() -> Self {
        Self {
            season: Season::Summer,
            sun_azimuth: 158_f64.to_radians(),
            sun_elevation: 52_f64.to_radians(),
            haze: 0.045,
            exposure: 1.0,
            tint: [1.0, 1.0, 1.0],
            cars_seed: 1,
            growth_seed: 1,
        }
    }

    /// Another day: early autumn, afternoon light, some haze, other cars, other crops.
    pub fn other_day() -> Self {
        Self {
            season: Season::Autumn,
            sun_azimuth: 222_f64.to_radians(),
            sun_elevation: 37_f64.to_radians(),
            haze: 0.13,
            exposure: 0.95,
            tint: [1.05, 1.0, 0.94],
            cars_seed: 2,
            growth_seed: 2,
        }
    }

    /// A day of late winter, early in March: bare trees, pale grass, a low sun of the forenoon, other cars and fields.
    pub fn late_winter() -> Self {
        Self {
            season: Season::LateWinter,
            sun_azimuth: 148_f64.to_radians(),
            sun_elevation: 38_f64.to_radians(),
            haze: 0.1,
            exposure: 0.97,
            tint: [1.02, 1.0, 0.98],
            cars_seed: 3,
            growth_seed: 3,
        }
    }

    /// A day of early spring, early in April: first leaves, young crops, the sun of the afternoon, other cars and fields.
    pub fn early_spring() -> Self {
        Self {
            season: Season::Spring,
            sun_azimuth: 205_f64.to_radians(),
            sun_elevation: 46_f64.to_radians(),
            haze: 0.11,
            exposure: 1.02,
            tint: [0.98, 1.0, 1.02],
            cars_seed: 4,
            growth_seed: 4,
        }
    }
}
