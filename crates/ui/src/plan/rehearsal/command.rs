//! Commands of rehearsals.

/// Something about the rehearsal of the selected route.
#[derive(Clone, Debug, PartialEq)]
pub enum RehearseCommand {
    /// Fly it as often as is set.
    Start,
    /// Stop; what was flown stays.
    Stop,
    /// Forget what was flown.
    Dismiss,
    /// Fly it once in Replay: with that seed, or else with that of the worst flight, or the first.
    Watch(Option<u64>),
    /// Number of flights.
    Flights(usize),
    /// Let the camera take pictures, or let landmarks be found as often and as well as predicted.
    Pictures(bool),
}
