//! A distinct landmark: a box on the map with a name and a reference point.

use std::collections::BTreeMap;

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use pilotage_base::frames::{GroundPoint, GroundRect};

/// A place on the map that is to be recognised from the air.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Landmark {
    /// Identity within a mission; never used twice.
    pub id: u32,
    /// Name of the landmark, as shown to people.
    pub name: String,
    /// The box on the map whose pixels are the patch to look for.
    pub bounds: GroundRect,
    /// The point whose place is measured; usually the centre of the box.
    pub reference: GroundPoint,
    /// Height of the reference point above the ground plane, metres.
    pub height: f64,
    /// Whether the navigator looks for it.
    pub enabled: bool,
    /// Properties that a file brought and we do not know, by name, as JSON text.
    pub properties: BTreeMap<String, String>,
}

impl Landmark {
    /// A landmark with its reference point in the middle of `bounds`, on the ground.
    ///
    /// ```
    /// use nalgebra::Point3;
    /// use pilotage_base::frames::{GroundPoint, GroundRect};
    /// use pilotage_vision::landmark::Landmark;
    ///
    /// let bounds = GroundRect::centered(GroundPoint::new(200.0, -50.0), 40.0, 60.0);
    /// let mut landmark = Landmark::new(1, "Water tower", bounds);
    /// landmark.height = 30.0;
    /// // Down counts from the world's origin: the ground lies 5 m below it, the top 30 m above that.
    /// assert_eq!(landmark.reference_in_world(5.0), Point3::new(200.0, -50.0, -25.0));
    /// ```
    pub fn new(id: u32, name: impl Into<String>, bounds: GroundRect) -> Self {
        Self {
            id,
            name: name.into(),
            reference: bounds.center(),
            bounds,
            height: 0.0,
            enabled: true,
            properties: BTreeMap::new(),
        }
    }

    /// The reference point in the world, for ground at `ground_down` metres below the origin level.
    pub fn reference_in_world(&self, ground_down: f64) -> Point3<f64> {
        Point3::new(
            self.reference.north,
            self.reference.east,
            ground_down - self.height,
        )
    }
}
