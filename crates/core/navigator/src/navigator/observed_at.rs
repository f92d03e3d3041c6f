//! When observations hold.

use super::engine::Engine;
use super::onlooker::Onlooker;
use pilotage_estimation::vehicle::ControlInput;

/// When an observation holds.
#[derive(Clone, Copy)]
pub enum ObservedAt<'a> {
    /// Now, when the vehicle's own instruments read this.
    Now(&'a ControlInput),
    /// When the picture was taken that came now.
    Picture(Onlooker<'a>),
}

impl ObservedAt<'_> {
    /// Turns `engine` to it, which assumes that pictures come `lag` seconds late.
    pub fn turn(&self, engine: &mut dyn Engine, lag: f64) {
        match self {
            Self::Now(input) => engine.look_now(input),
            Self::Picture(onlooker) => engine.look_back(onlooker.past(lag)),
        }
    }
}
