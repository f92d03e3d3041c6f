//! The height of the ground.

mod dem;
mod grid;
mod hgt;
mod highest;
#[cfg(test)]
mod made_tiffs;
mod terrain_error;
#[cfg(test)]
mod tests;
mod text_grid;
#[cfg(test)]
mod tiff_place_tests;
mod tiff_posts;
#[cfg(test)]
mod tiff_tests;
mod units;

pub use dem::Dem;
pub use grid::HeightGrid;
pub use terrain_error::TerrainError;

use serde::{Deserialize, Serialize};

use crate::GeoKeys;
use crate::systems::flat_code;
use pilotage_base::frames::GroundPoint;

/// Height at place (x, y) in posts, bilinear between the four around it, of which none lies beyond the
/// `last` column and row; `None` where a post that counts is unknown.
fn between_posts(
    (x, y): (f64, f64),
    last: (usize, usize),
    post: impl Fn(usize, usize) -> Option<f64>,
) -> Option<f64> {
    let (column, row) = (x as usize, y as usize);
    let (fx, fy) = (x - column as f64, y - row as f64);
    let (mut sum, mut weights) = (0.0, 0.0);
    for (dc, dr, weight) in [
        (0, 0, (1.0 - fx) * (1.0 - fy)),
        (1, 0, fx * (1.0 - fy)),
        (0, 1, (1.0 - fx) * fy),
        (1, 1, fx * fy),
    ] {
        if weight > 1e-9 {
            sum += weight * post((column + dc).min(last.0), (row + dr).min(last.1))?;
            weights += weight;
        }
    }
    // What is too little to count must not lower the height either.
    Some(sum / weights)
}

/// Datum that heights count from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum HeightDatum {
    /// Mean sea level, by the geoid or levelling that is named.
    MeanSeaLevel(String),
    /// The ellipsoid of WGS 84, as satellite navigation counts.
    Ellipsoid,
    /// The file does not say; usually mean sea level.
    NotStated,
}

/// Systems of heights above a geoid or from levelling: EPSG codes and names.
const LEVELS: [(u32, &str); 22] = [
    (3855, "EGM2008"),
    (5773, "EGM96"),
    (5798, "EGM84"),
    (5714, "mean sea level"),
    (5703, "NAVD88"),
    (6360, "NAVD88"),
    (8228, "NAVD88"),
    (5702, "NGVD29"),
    (6647, "CGVD2013"),
    (5713, "CGVD28"),
    (5621, "EVRF2007"),
    (5730, "EVRF2000"),
    (9389, "EVRF2019"),
    (7837, "DHHN2016"),
    (5783, "DHHN92"),
    (5728, "LN02"),
    (5701, "ODN"),
    (5709, "NAP"),
    (5720, "NGF-IGN69"),
    (5613, "RH2000"),
    (5941, "NN2000"),
    (5711, "AHD"),
];

/// Codes of heights above the ellipsoid of WGS 84 or GRS 80, which differ by a tenth of a millimetre.
/// Systems of longitude, latitude and height are such as well.
const ABOVE_ELLIPSOID: [u32; 3] = [4326, 5030, 5019];

impl HeightDatum {
    /// The datum that the keys of a `GeoTIFF` name, by an EPSG code or in words.
    pub fn of(keys: &GeoKeys) -> Self {
        let Some(code) = keys.vertical_system else {
            return match &keys.vertical_name {
                Some(name) if name.to_lowercase().contains("ellipsoid") => Self::Ellipsoid,
                Some(name) => Self::MeanSeaLevel(name.clone()),
                None => Self::NotStated,
            };
        };
        if ABOVE_ELLIPSOID.contains(&code) || flat_code(code).is_some() {
            return Self::Ellipsoid;
        }
        let known = LEVELS.iter().find(|(known, _)| *known == code);
        let name = known.map_or_else(|| format!("EPSG:{code}"), |(_, name)| (*name).to_owned());
        Self::MeanSeaLevel(name)
    }

    /// Name for people, to stand behind "metres above".
    pub fn name(&self) -> &str {
        match self {
            Self::MeanSeaLevel(name) => name,
            Self::Ellipsoid => "WGS 84 ellipsoid",
            Self::NotStated => "a datum that is not stated",
        }
    }

    /// Name of the frame of such heights, to stand behind a number with its unit.
    pub fn frame(&self) -> &'static str {
        match self {
            Self::MeanSeaLevel(_) => "AMSL",
            Self::Ellipsoid => "above the ellipsoid",
            Self::NotStated => "above an unstated datum",
        }
    }
}

/// The height of the ground at every place.
pub trait Terrain: Send + Sync {
    /// A short name for people.
    fn name(&self) -> &str;

    /// Datum that heights count from.
    fn datum(&self) -> &HeightDatum;

    /// Height of the ground in metres above the [`datum`](Self::datum); `None` where it is not known.
    fn height_at(&self, place: &GroundPoint) -> Option<f64>;
}

/// Level ground, for where nothing better is known.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatGround {
    /// Metres above the datum.
    pub height: f64,
    /// Datum that the height counts from.
    pub datum: HeightDatum,
}

impl Terrain for FlatGround {
    fn name(&self) -> &'static str {
        "level ground"
    }

    fn datum(&self) -> &HeightDatum {
        &self.datum
    }

    fn height_at(&self, _: &GroundPoint) -> Option<f64> {
        Some(self.height)
    }
}
