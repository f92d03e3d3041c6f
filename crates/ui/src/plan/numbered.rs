//! No-fly areas and rally points, which are named by their numbers while the map and the column show them.

use pilotage_core::mission::{Mission, NoFlyZone};

/// Meaning of the numbers of areas, of their corners and holes, and of rally points when it was noted.
#[derive(Debug, Default, PartialEq)]
pub struct NumberedPlaces {
    /// Name of each area, with the count of corners of its outline and of each hole.
    areas: Vec<(String, Vec<usize>)>,
    rally: Vec<String>,
}

impl NumberedPlaces {
    /// Whether the numbers of a mission stand for the same.
    pub fn is_as_in(&self, mission: &Mission) -> bool {
        let is_same_area = |((name, counts), area): (&(String, Vec<usize>), &NoFlyZone)| {
            let rings = area.rings().map(Vec::len);
            *name == area.name && rings.eq(counts.iter().copied())
        };
        self.areas.len() == mission.no_fly.len()
            && self.areas.iter().zip(&mission.no_fly).all(is_same_area)
            && self
                .rally
                .iter()
                .eq(mission.rally.iter().map(|it| &it.name))
    }

    /// Notes what the numbers of a mission stand for.
    pub fn keep(&mut self, mission: &Mission) {
        if self.is_as_in(mission) {
            return;
        }
        let areas = mission.no_fly.iter();
        let areas = areas.map(|it| (it.name.clone(), it.rings().map(Vec::len).collect()));
        self.areas = areas.collect();
        self.rally = mission.rally.iter().map(|it| it.name.clone()).collect();
    }
}
