//! Kinds of transforms from pixels to the ground.

use serde::{Deserialize, Serialize};

/// A kind of transform from pixels to the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum TransformKind {
    /// Shift, turn, one scale: two points. For pictures that look straight down.
    Similarity,
    /// Also other scales and a skew: three points.
    Affine,
    /// Also perspective: four points. For pictures of a plane that look askew.
    Projective,
}

impl TransformKind {
    /// All kinds, from the stiffest to the softest.
    pub const ALL: [Self; 3] = [Self::Similarity, Self::Affine, Self::Projective];

    /// Points that it takes at least.
    pub fn least_points(&self) -> usize {
        match self {
            Self::Similarity => 2,
            Self::Affine => 3,
            Self::Projective => 4,
        }
    }

    /// Name for people.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Similarity => "similarity",
            Self::Affine => "affine",
            Self::Projective => "projective",
        }
    }
}
