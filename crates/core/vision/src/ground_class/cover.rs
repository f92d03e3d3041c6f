//! Classes of the ground.

use serde::{Deserialize, Serialize};

/// Class of a cell of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum GroundCover {
    /// Grass, crops or bare soil.
    Open,
    /// The crown of a tree.
    Tree,
    /// A roof.
    Building,
    /// A road, a yard or a place where cars are parked.
    Paved,
    /// Water.
    Water,
}

impl GroundCover {
    /// All classes, in the order of probabilities.
    pub const ALL: [Self; 5] = [
        Self::Open,
        Self::Tree,
        Self::Building,
        Self::Paved,
        Self::Water,
    ];

    /// Its place in the order of probabilities.
    pub fn index(self) -> usize {
        self as usize
    }

    /// Name of folders with labelled tiles of it.
    pub fn key(self) -> &'static str {
        match self {
            Self::Open => "field",
            Self::Tree => "tree",
            Self::Building => "building",
            Self::Paved => "paved",
            Self::Water => "water",
        }
    }

    /// The class of that name.
    pub fn named(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|cover| cover.key() == key)
    }
}
