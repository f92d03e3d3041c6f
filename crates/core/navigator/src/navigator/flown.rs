//! The estimated track of a run, for other programs.

use pilotage_base::frames::LocalFrame;
use pilotage_mission::exchange::{FlownPoint, FlownTrack};

use super::Run;

impl Run {
    /// The estimated places of the flight of that name, whose world `frame` is: after each step, without heights, a date or
    /// values beside them.
    pub fn estimated_track(
        &self,
        flight: &str,
        frame: &LocalFrame,
        utc_at_zero: Option<f64>,
    ) -> FlownTrack {
        let points = self.steps.iter().map(|step| FlownPoint {
            time: step.time,
            place: frame.geodetic_from_ground(&step.after.position()),
            value: None,
        });
        FlownTrack {
            name: format!("{flight}, estimate"),
            utc_at_zero,
            has_height: false,
            values: None,
            points: points.collect(),
        }
    }
}
