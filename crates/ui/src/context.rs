//! Context that a view is given to draw one frame.

use pilotage_core::flight::Flight;
use pilotage_core::mission::{Mission, Route};
use pilotage_core::navigator::Run;

use crate::command::Command;
use crate::tokens::Tokens;
use crate::units::Units;

/// Frames at most so long after the cursor are shown at it, seconds: times are computed in several ways.
const SAME_TIME: f64 = 1e-9;

/// The route of `mission` with that id.
pub fn route_of(mission: &Mission, id: u32) -> Option<&Route> {
    mission.routes.iter().find(|r| r.id == id)
}

/// Index of the frame of `flight` that is shown at a time (seconds in its time base); `None` before the first.
pub fn shown_frame(flight: &Flight, time: f64) -> Option<usize> {
    let after = flight
        .frames
        .partition_point(|f| f.time <= time + SAME_TIME);
    after.checked_sub(1)
}

/// Index of the frame `count` frames after the one that is shown at a time (seconds), before it for negative counts;
/// between two frames the one before is the first step back. The first or last where there are no more.
pub fn frame_after(flight: &Flight, time: f64, count: i32) -> usize {
    let frames = &flight.frames;
    let here = if count > 0 {
        shown_frame(flight, time).map_or(-1, |index| index as i64)
    } else {
        frames.partition_point(|f| f.time < time - SAME_TIME) as i64
    };
    let last = frames.len() as i64 - 1;
    (here + i64::from(count)).clamp(0, last.max(0)) as usize
}

/// Times that a view drew last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnTimes {
    /// Time of the cursor, seconds in the flight's time base.
    pub cursor: f64,
    /// Time of what was shown for it: of the step, or of the picture, seconds.
    pub content: f64,
}

/// Everything a view may query, and where it sends its commands. Views keep only their own zoom,
/// scroll and textures; documents are never copied into them.
pub struct ViewContext<'a> {
    /// Mission that people author.
    pub mission: &'a Mission,
    /// Measured flight.
    pub flight: Option<&'a Flight>,
    /// Whether it was recorded: what is known of its true track is what a receiver said.
    pub is_recorded: bool,
    /// Run of the navigator so far.
    pub run: Option<&'a Run>,
    /// The run before the last change, for comparison.
    pub ghost: Option<&'a Run>,
    /// The time cursor, seconds in the flight's time base.
    pub time: f64,
    /// Time at which every clock on the page stands at zero: the timeline's start, seconds in the flight's time base.
    pub clock_zero: f64,
    /// The span of time that is selected, seconds in the flight's time base: in order, not empty.
    pub selected_span: Option<(f64, f64)>,
    /// Whether the cursor is moving by itself.
    pub playing: bool,
    /// Seconds of the flight that pass in a second, for what moves by itself; 0 while the cursor stands still, and where
    /// people want no motion.
    pub motion: f64,
    /// The selected landmark's id.
    pub selection: Option<u32>,
    /// The selected route's id.
    pub route: Option<u32>,
    /// Frame whose picture the frame of that index shows, if it was taken.
    pub pictures: &'a dyn Fn(usize) -> Option<usize>,
    /// The look.
    pub tokens: &'a Tokens,
    /// The user's units.
    pub units: Units,
    /// Progress of the flight that is being flown, in words.
    pub flying: Option<&'a str>,
    /// Commands that the view sends.
    pub commands: &'a mut Vec<Command>,
}

impl<'a> ViewContext<'a> {
    /// Track that counts as where the aircraft was: a log tells where its receiver or its autopilot had it, a simulation
    /// where it was.
    pub fn known_track(&self) -> &'static str {
        if self.is_recorded {
            "recorded track"
        } else {
            "true track"
        }
    }

    /// The selected route.
    pub fn selected_route(&self) -> Option<&'a Route> {
        route_of(self.mission, self.route?)
    }

    /// Index of the frame at the time cursor; `None` before the first and without a flight.
    pub fn shown_frame(&self) -> Option<usize> {
        shown_frame(self.flight?, self.time)
    }

    /// Says something before all else of this frame. What a field is left with is about the thing that it showed, and not
    /// about the one that is selected, or has that number, once what was pressed instead is done.
    pub fn say_first(&mut self, command: impl Into<Command>) {
        self.commands.insert(0, command.into());
    }

    /// That a view drew what is of time `content` for the cursor.
    pub fn drawn(&self, content: f64) -> Option<DrawnTimes> {
        let cursor = self.time;
        Some(DrawnTimes { cursor, content })
    }
}

#[cfg(test)]
mod tests {
    use pilotage_core::camera::CameraModel;
    use pilotage_core::flight::{Frame, StartFix};
    use pilotage_core::frames::GroundPoint;

    use super::*;

    #[test]
    fn a_step_begins_from_the_frame_that_is_shown() {
        let frame = |time| Frame {
            time,
            name: String::new(),
            stored_turn: 0.0,
        };
        let position = GroundPoint::new(0.0, 0.0);
        let flight = Flight {
            name: String::new(),
            camera: CameraModel::pinhole(640, 480, 1.0),
            channels: Vec::new(),
            frames: [1.0, 2.0, 3.0].map(frame).to_vec(),
            start: StartFix {
                time: 0.0,
                position,
                standard_deviation: 5.0,
            },
            frame_on_globe: None,
            ground_down: 0.0,
            truth: None,
        };
        // Half a microsecond before the second frame the first one is shown.
        for (time, shown, next, before) in [
            (0.5, None, 0, 0),
            (1.0, Some(0), 1, 0),
            (1.5, Some(0), 1, 0),
            (2.0 - 5e-7, Some(0), 1, 0),
            (2.0 - 1e-12, Some(1), 2, 0),
            (2.0, Some(1), 2, 0),
            (2.5, Some(1), 2, 1),
            (9.0, Some(2), 2, 2),
        ] {
            assert_eq!(shown_frame(&flight, time), shown, "{time}");
            assert_eq!(frame_after(&flight, time, 1), next, "{time}");
            assert_eq!(frame_after(&flight, time, -1), before, "{time}");
        }
        assert_eq!(frame_after(&flight, 1.0, 2), 2);
    }
}
