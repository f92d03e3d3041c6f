//! Edits of areas that must not be flown over, each one undo step; a drag is one.

use pilotage_core::frames::{GroundPoint, inside};
use pilotage_core::mission::NoFlyZone;

use super::command::AreaChange;
use super::routes::EditStep;
use crate::documents::Documents;

impl Documents {
    /// Adds an area that must not be flown over.
    pub fn add_no_fly(&mut self, corners: Vec<GroundPoint>) {
        self.mission.remember();
        self.mission.is_edited = true;
        let number = self.mission.no_fly.len() + 1;
        self.mission.no_fly.push(NoFlyZone {
            name: format!("No-fly area {number}"),
            corners,
            ..NoFlyZone::default()
        });
    }

    /// Cuts a hole into the area that all of `corners` lie in; false if there is none.
    pub fn cut_hole(&mut self, corners: Vec<GroundPoint>) -> bool {
        let holds = |area: &NoFlyZone| corners.iter().all(|at| inside(&area.corners, at));
        let Some(index) = self.mission.no_fly.iter().position(holds) else {
            return false;
        };
        self.mission.remember();
        self.mission.is_edited = true;
        self.mission.no_fly[index].holes.push(corners);
        true
    }

    /// Changes an area that must not be flown over.
    pub fn edit_no_fly(&mut self, index: usize, step: EditStep, change: AreaChange) {
        let Some(zone) = self.mission.no_fly.get(index) else {
            return;
        };
        let mut zone = zone.clone();
        match change {
            AreaChange::Name(name) => zone.name = name,
            AreaChange::Corner { ring, corner, to } => {
                let corners = zone.ring_mut(ring);
                if let Some(place) = corners.and_then(|it| it.get_mut(corner)) {
                    *place = to;
                }
            }
            AreaChange::FillHole(hole) if hole < zone.holes.len() => {
                zone.holes.remove(hole);
            }
            AreaChange::FillHole(_) => {}
        }
        if zone != self.mission.no_fly[index] {
            self.mission.history.begin_drag(&self.mission.content);
            self.mission.no_fly[index] = zone;
            self.mission.is_edited = true;
        }
        if step == EditStep::Whole {
            self.mission.history.finish_drag(&self.mission.content);
        }
    }

    /// Deletes an area that must not be flown over; false if there is none of that number.
    pub fn delete_no_fly(&mut self, index: usize) -> bool {
        if index >= self.mission.no_fly.len() {
            return false;
        }
        self.mission.remember();
        self.mission.is_edited = true;
        self.mission.no_fly.remove(index);
        true
    }
}
