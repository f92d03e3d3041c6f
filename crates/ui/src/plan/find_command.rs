//! Commands of the search for a route.

use pilotage_core::frames::GroundPoint;
use pilotage_jobs::RouteWishes;

/// Meaning of the next click on the map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FindPick {
    /// Nothing.
    #[default]
    Nothing,
    /// Start of the route.
    From,
    /// End of the route.
    To,
}

/// Commands of the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FindCommand {
    /// Choose both ends on the map, one after the other.
    Begin,
    /// Say what the next click means.
    Pick(FindPick),
    /// A click on the map.
    Click(GroundPoint),
    /// Look for other things.
    Set(RouteWishes),
    /// Search.
    Start,
    /// Stop searching.
    Stop,
    /// Make a route of what was found.
    Accept,
    /// Forget what was found.
    Dismiss,
}
