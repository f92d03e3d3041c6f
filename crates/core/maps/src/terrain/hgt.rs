//! .hgt: a degree by a degree of heights, as the shuttle's radar mission left them.

use super::highest::may_be_height;
use pilotage_base::frames::ReferenceSystem;
use pilotage_base::{
    bytes::ByteSource,
    georeference::{Georeference, WorldFile},
};

/// The heights of one file: rows from the north, the outermost posts on whole degrees.
pub(super) struct Hgt {
    name: String,
    south: f64,
    west: f64,
    side: usize,
    heights: Vec<i16>,
}

impl Hgt {
    /// Reads a file; the error says in words what is wrong.
    pub fn read(source: &dyn ByteSource) -> Result<Self, String> {
        let (south, west) = corner(source.name())
            .ok_or("the name has to say the south-west corner, like N46W092.hgt")?;
        let side = match source.length() {
            2_884_802 => 1201,
            25_934_402 => 3601,
            other => {
                return Err(format!(
                    "{other} bytes; one with 1201² or 3601² heights has 2884802 or 25934402"
                ));
            }
        };
        let bytes = source.read(0, side * side * 2)?;
        let heights: Vec<i16> = (bytes.as_chunks::<2>().0.iter())
            .map(|pair| i16::from_be_bytes(*pair))
            .collect();
        if heights.len() != side * side {
            return Err("the file ends early".to_owned());
        }
        Ok(Self {
            name: source.name().to_owned(),
            south,
            west,
            side,
            heights,
        })
    }

    /// Name of the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Posts along a side.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Georeference of the posts.
    pub fn georeference(&self) -> Georeference {
        let step = 1.0 / (self.side - 1) as f64;
        Georeference::Projected {
            system: ReferenceSystem::Geographic,
            file: WorldFile {
                a: step,
                d: 0.0,
                b: 0.0,
                e: -step,
                c: self.west,
                f: self.south + 1.0,
            },
        }
    }

    /// Height at a post, metres; panics outside.
    pub fn post(&self, column: usize, row: usize) -> Option<f64> {
        let height = self.heights[row * self.side + column];
        // Marks for missing heights are -32768, and others that programs put there.
        Some(f64::from(height)).filter(|height| may_be_height(*height))
    }
}

/// South and west edge in degrees from a name like `N46W092.hgt`.
fn corner(name: &str) -> Option<(f64, f64)> {
    let stem = name.rsplit(['/', '\\']).next()?.to_ascii_uppercase();
    let stem = stem.get(..7)?;
    let part = |range: std::ops::Range<usize>, plus: &str, minus: &str, most: f64| {
        let (sign, digits) = stem.get(range)?.split_at(1);
        let degrees: f64 = digits.parse().ok().filter(|d| (0.0..=most).contains(d))?;
        if sign == plus {
            Some(degrees)
        } else {
            (sign == minus).then_some(-degrees)
        }
    };
    Some((part(0..3, "N", "S", 90.0)?, part(3..7, "E", "W", 180.0)?))
}
