//! Context that a view is given to draw one frame.

use pilotage_core::flight::Flight;
use pilotage_core::mission::{Mission, Route};
use pilotage_core::navigator::Run;

use crate::command::Command;
use crate::tokens::Tokens;
use crate::units::Units;
use pilotage_jobs::MatchPictures;

/// The route of `mission` with that id.
pub fn route_of(mission: &Mission, id: u32) -> Option<&Route> {
    mission.routes.iter().find(|r| r.id == id)
}

/// Index of the frame of `flight` that is shown at a time (seconds in its time base); `None` before the first.
pub fn shown_frame(flight: &Flight, time: f64) -> Option<usize> {
    let after = flight.frames.partition_point(|f| f.time <= time + 1e-9);
    after.checked_sub(1)
}

/// Times that a view drew last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
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
    /// Run of the navigator so far.
    pub run: Option<&'a Run>,
    /// The run before the last change, for comparison.
    pub ghost: Option<&'a Run>,
    /// The time cursor, seconds in the flight's time base.
    pub time: f64,
    /// The span of time that is selected, seconds in the flight's time base: in order, not empty.
    pub selected_span: Option<(f64, f64)>,
    /// Whether the cursor is moving by itself.
    pub playing: bool,
    /// The selected landmark's id.
    pub selection: Option<u32>,
    /// The selected route's id.
    pub route: Option<u32>,
    /// Frame whose picture the frame of that index shows, if it was taken.
    pub pictures: &'a dyn Fn(usize) -> Option<usize>,
    /// The pictures that explain a match, last asked for by [`Command::ExplainMatch`]; check its
    /// time and landmark before showing it.
    pub match_pictures: Option<&'a MatchPictures>,
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
    /// The selected route.
    pub fn selected_route(&self) -> Option<&'a Route> {
        route_of(self.mission, self.route?)
    }

    /// Index of the frame at the time cursor; `None` before the first and without a flight.
    pub fn shown_frame(&self) -> Option<usize> {
        shown_frame(self.flight?, self.time)
    }

    /// That a view drew what is of time `content` for the cursor.
    pub fn drawn(&self, content: f64) -> Option<Drawn> {
        let cursor = self.time;
        Some(Drawn { cursor, content })
    }
}
