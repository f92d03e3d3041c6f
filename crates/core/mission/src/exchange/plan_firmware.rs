//! The autopilot for which a plan is. PX4 takes neither heights above ground nor circles that are counted.
//!
//! <https://github.com/PX4/PX4-Autopilot/blob/main/src/modules/mavlink/mavlink_mission.cpp>

use super::item::{LOITER_TURNS, MissionItem, command_name, counted, frame_of_number};
use super::plan_terrain;
use super::route_items::RouteStep;
use crate::mission::Route;
use pilotage_base::frames::{AltitudeFrame, LocalFrame};

/// Prefix of a route's properties that are members of a plan's mission.
pub(super) const MISSION: &str = "plan.mission:";
/// Member of a plan's mission with the autopilot, and its numbers (`MAV_AUTOPILOT`).
pub(super) const MEMBER: &str = "firmwareType";
const PX4: &str = "12";
const ARDUPILOT: &str = "3";

/// An autopilot as a plan names it.
pub(super) struct PlanFirmware {
    /// Whether it is PX4.
    pub is_px4: bool,
    /// Its number, as JSON text.
    pub number: String,
    /// Notes on it and on what it refuses.
    pub notes: Vec<String>,
}

impl PlanFirmware {
    /// The autopilot that a plan said before, or else one that flies these steps.
    pub(super) fn of(
        kept: Option<&String>,
        steps: &[RouteStep<'_>],
        route: &Route,
        frame: &LocalFrame,
    ) -> Self {
        let mut notes = Vec::new();
        let refused = refused(steps, kept.is_some());
        let others = "choose another vehicle in QGroundControl if need be";
        let number = match kept {
            Some(number) => number.as_str(),
            None if refused.is_empty() => {
                notes.push(format!("the plan says PX4 and fixed wing; {others}"));
                PX4
            }
            None => {
                let names = counted(&refused);
                notes.push(format!(
                    "the plan says ArduPilot and fixed wing, since PX4 refuses this: {names}; {others}"
                ));
                ARDUPILOT
            }
        };
        let is_px4 = number.trim() == PX4;
        if is_px4 && !refused.is_empty() {
            notes.push(format!(
                "PX4, for which the plan is, refuses this: {}",
                counted(&refused)
            ));
        }
        let open = |way_point| {
            let height = plan_terrain::height(way_point, frame, is_px4);
            height.is_above_sea && height.above_sea.is_none()
        };
        let open = route.way_points.iter().filter(|w| open(w)).count();
        if open > 0 {
            notes.push(format!(
                "{open} × height above ground: its height above the sea is left for QGroundControl to compute over its terrain"
            ));
        }
        Self {
            is_px4,
            number: number.to_owned(),
            notes,
        }
    }
}

/// Note for other formats, which name no autopilot: that a route out of a plan for PX4 has in these commands what PX4 refuses.
pub(super) fn refused_note<'a>(
    route: &Route,
    items: impl Iterator<Item = &'a MissionItem>,
) -> Option<String> {
    let kept = route.properties.get(&format!("{MISSION}{MEMBER}"))?;
    let refused: Vec<String> = items.flat_map(refused_of).flatten().collect();
    (kept.trim() == PX4 && !refused.is_empty()).then(|| {
        format!(
            "PX4, for which the plan was that the route comes from, refuses this: {}",
            counted(&refused)
        )
    })
}

/// Names of what PX4 refuses in a command.
fn refused_of(item: &MissionItem) -> [Option<String>; 2] {
    let is_above_ground = frame_of_number(item.frame) == Some(AltitudeFrame::AboveGround);
    let height = is_above_ground.then(|| "height above ground".to_owned());
    let turns = (item.command == LOITER_TURNS).then(|| command_name(LOITER_TURNS));
    [height, turns]
}

/// Names of what PX4 refuses among the steps of a plan; heights of way-points are none where they are stated above the sea.
fn refused(steps: &[RouteStep<'_>], is_above_sea: bool) -> Vec<String> {
    let names = steps.iter().map(|step| match step {
        RouteStep::WayPoint(item, _) => {
            let [height, turns] = refused_of(item);
            [height.filter(|_| !is_above_sea), turns]
        }
        RouteStep::Kept(piece) => {
            MissionItem::of_json(piece.get()).map_or([None, None], |item| refused_of(&item))
        }
        RouteStep::Speed(..) | RouteStep::Return(_) => [None, None],
    });
    names.flatten().flatten().collect()
}
