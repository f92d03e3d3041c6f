//! Heights above ground in plans: in a frame of their own, or as heights above the sea that `QGroundControl` computed over its
//! terrain (`AltitudeMode` 3), as it does for PX4, which takes no heights above ground.

use serde_json::Value;

use super::item::MissionItem;
use super::item_route::{AT_HOME, MEMBER};
use crate::mission::{WayPoint, globe};
use pilotage_base::frames::{Altitude, AltitudeFrame, LocalFrame};

/// Member of a command: the height above the sea that was computed.
pub(super) const COMPUTED: &str = "AMSLAltAboveTerrain";
/// Farthest from its place that a way-point counts as left there, metres.
const UNMOVED: f64 = 0.01;
/// `AltitudeMode` of such a command.
const OVER_TERRAIN: u8 = 3;
/// `MAV_FRAME` of heights above the sea.
const GLOBAL: u8 = 0;

/// The height above the sea of a command that was read in this mode, with the latitude, longitude and height above ground to
/// which it belongs, as JSON text; `None` of all others.
pub(super) fn kept(
    item: &MissionItem,
    mode: Option<f64>,
    altitude: Option<&Altitude>,
) -> Option<String> {
    let is_computed =
        mode? as i64 == i64::from(OVER_TERRAIN) && item.altitude()?.frame == AltitudeFrame::Amsl;
    let [.., latitude, longitude, height] = item.parameters;
    let numbers = vec![height?, latitude?, longitude?, altitude?.metres];
    is_computed.then(|| Value::from(numbers).to_string())
}

/// Height above the sea that was computed of a way-point, if it is where and as high above ground as it was then.
fn computed(way_point: &WayPoint, frame: &LocalFrame) -> Option<f64> {
    let kept = way_point.properties.get(&format!("{MEMBER}{COMPUTED}"))?;
    let [height, latitude, longitude, metres]: [f64; 4] = serde_json::from_str(kept).ok()?;
    let place = globe::ground(frame, longitude, latitude);
    let is_at_home = way_point.properties.contains_key(AT_HOME);
    let is_there = is_at_home || place.distance(&way_point.position) < UNMOVED;
    let altitude = &way_point.altitude;
    let is_same =
        altitude.frame == AltitudeFrame::AboveGround && altitude.metres.total_cmp(&metres).is_eq();
    (is_there && is_same).then_some(height)
}

/// Height of a way-point as a plan states it.
pub(super) struct PlanHeight {
    /// `QGroundControl`'s number for what the altitude counts from.
    pub mode: u8,
    /// Whether the command states the height above the sea instead.
    pub is_above_sea: bool,
    /// That height, metres; `None` is left for `QGroundControl` to compute.
    pub above_sea: Option<f64>,
}

/// The height of a way-point in a plan, for PX4 or for others.
pub(super) fn height(way_point: &WayPoint, frame: &LocalFrame, is_px4: bool) -> PlanHeight {
    let computed = computed(way_point, frame);
    let mode = match way_point.altitude.frame {
        AltitudeFrame::AboveTakeOff => 1,
        AltitudeFrame::Amsl => 2,
        AltitudeFrame::AboveGround if is_px4 || computed.is_some() => OVER_TERRAIN,
        AltitudeFrame::AboveGround => 4,
    };
    PlanHeight {
        mode,
        is_above_sea: mode == OVER_TERRAIN,
        above_sea: computed,
    }
}

impl PlanHeight {
    /// States it in the command of the way-point.
    pub(super) fn state(&self, item: &mut MissionItem) {
        if self.is_above_sea {
            item.frame = GLOBAL;
            item.parameters[6] = self.above_sea;
        }
    }
}
