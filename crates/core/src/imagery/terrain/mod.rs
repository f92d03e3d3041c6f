//! The height of the ground.

mod dem;
mod grid;
mod hgt;
#[cfg(test)]
mod tests;

pub use dem::{Dem, TerrainError};
pub use grid::HeightGrid;

use serde::{Deserialize, Serialize};

use crate::frames::GroundPoint;

/// Height at place (x, y) in posts, bilinear between the four around it, of which none lies beyond the
/// `last` column and row; `None` where a post that counts is unknown.
fn between_posts(
    (x, y): (f64, f64),
    last: (usize, usize),
    post: impl Fn(usize, usize) -> Option<f64>,
) -> Option<f64> {
    let (column, row) = (x as usize, y as usize);
    let (fx, fy) = (x - column as f64, y - row as f64);
    let mut sum = 0.0;
    for (dc, dr, weight) in [
        (0, 0, (1.0 - fx) * (1.0 - fy)),
        (1, 0, fx * (1.0 - fy)),
        (0, 1, (1.0 - fx) * fy),
        (1, 1, fx * fy),
    ] {
        if weight > 1e-9 {
            sum += weight * post((column + dc).min(last.0), (row + dr).min(last.1))?;
        }
    }
    Some(sum)
}

/// What heights count from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum HeightDatum {
    /// Mean sea level, by the geoid or levelling that is named.
    MeanSeaLevel(String),
    /// The ellipsoid of WGS 84, as satellite navigation counts.
    Ellipsoid,
    /// The file does not say; usually mean sea level.
    NotStated,
}

impl HeightDatum {
    /// The datum with that EPSG code.
    fn from_epsg(code: Option<u32>) -> Self {
        match code {
            Some(5773) => Self::MeanSeaLevel("EGM96".to_owned()),
            Some(3855) => Self::MeanSeaLevel("EGM2008".to_owned()),
            Some(5798) => Self::MeanSeaLevel("EGM84".to_owned()),
            Some(5703) => Self::MeanSeaLevel("NAVD88".to_owned()),
            Some(5714) => Self::MeanSeaLevel("mean sea level".to_owned()),
            Some(4979 | 4326 | 5030 | 5019) => Self::Ellipsoid,
            Some(other) => Self::MeanSeaLevel(format!("EPSG:{other}")),
            None => Self::NotStated,
        }
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

    /// What heights count from.
    fn datum(&self) -> &HeightDatum;

    /// Height of the ground in metres above the [`datum`](Self::datum); `None` where it is not known.
    fn height_at(&self, place: &GroundPoint) -> Option<f64>;
}

/// Level ground, for where nothing better is known.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatGround {
    /// Metres above the datum.
    pub height: f64,
    /// What they count from.
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
