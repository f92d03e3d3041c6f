//! Ground as it is known before a flight.

use std::sync::Arc;

use pilotage_mission::mission::Mission;
use pilotage_raster::imagery::Imagery;
use pilotage_roads::RoadLine;
use pilotage_vision::landmark::Landmark;

/// Everything that is known of the ground, and by which an aircraft may find its way.
#[derive(Clone)]
pub struct KnownGround {
    /// Picture of it.
    pub map: Arc<dyn Imagery>,
    /// Landmarks on it.
    pub landmarks: Vec<Landmark>,
    /// Roads on it; shared points join them.
    pub roads: Vec<RoadLine>,
}

impl KnownGround {
    /// Nothing but a picture.
    pub fn new(map: Arc<dyn Imagery>) -> Self {
        Self {
            map,
            landmarks: Vec::new(),
            roads: Vec::new(),
        }
    }

    /// All that `mission` knows, over its map.
    pub fn of(mission: &Mission, map: Arc<dyn Imagery>) -> Self {
        Self {
            roads: mission.roads.to_vec(),
            ..Self::new(map).with_landmarks(&mission.landmarks)
        }
    }

    /// The same with these landmarks.
    #[must_use]
    pub fn with_landmarks(mut self, landmarks: &[Landmark]) -> Self {
        self.landmarks = landmarks.to_vec();
        self
    }
}
