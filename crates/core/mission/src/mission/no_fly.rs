//! Areas that must not be flown over.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;

/// An area that must not be flown over.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NoFlyZone {
    /// Name for people.
    pub name: String,
    /// Its corners, at least three, in either order; the last is not the first again.
    pub corners: Vec<GroundPoint>,
    /// Rings inside of it that are not part of it, each of at least three corners: one may fly there.
    #[serde(default)]
    pub holes: Vec<Vec<GroundPoint>>,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl NoFlyZone {
    /// Its outline, and then its holes.
    pub fn rings(&self) -> impl Iterator<Item = &Vec<GroundPoint>> {
        std::iter::once(&self.corners).chain(&self.holes)
    }

    /// The ring of that number, to change it: 0 is the outline, 1 the first hole.
    pub fn ring_mut(&mut self, number: usize) -> Option<&mut Vec<GroundPoint>> {
        match number {
            0 => Some(&mut self.corners),
            _ => self.holes.get_mut(number - 1),
        }
    }
}
