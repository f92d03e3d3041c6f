//! Names of things of the scenery, and the records that tell of them.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::{GroundPoint, GroundRect};

/// Kind of a labelled thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum SceneKind {
    /// A large building, or a part of one.
    Building,
    /// A dwelling house or a small outbuilding.
    House,
    /// Tree crown.
    Tree,
    /// A field or meadow.
    Field,
    /// A parcel of woodland.
    Wood,
    /// A sealed road.
    Road,
    /// An unsealed track.
    Track,
    /// A pedestrian crossing.
    Crossing,
    /// A swimming pool.
    Pool,
    /// A pond.
    Pond,
    /// A stream.
    Stream,
    /// A parked car.
    Car,
    /// A car park.
    CarPark,
    /// A farm or works yard.
    Yard,
    /// A tank or silo.
    Tank,
    /// A playing field, cemetery, quarry or other open place.
    Place,
}

/// Labelled outline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SceneLabel {
    /// Kind of the thing.
    pub kind: SceneKind,
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Its outline on the ground, world metres, in order.
    pub polygon: Vec<GroundPoint>,
}

/// A place that can serve as a landmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DistinctFeature {
    /// Plain English name, the same for every seed.
    pub name: String,
    /// Kind of the feature.
    pub kind: SceneKind,
    /// Outline of the feature itself, world metres.
    pub outline: Vec<GroundPoint>,
    /// The box to use as a landmark: the feature with its surroundings.
    pub landmark_box: GroundRect,
}
