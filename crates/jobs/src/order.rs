//! Orders: pieces of heavy work that a page, a terminal or a test asks for in the same way.
//!
//! A new one is a type that implements [`Order`], in a file of its own, and a line in `lib.rs`.

use pilotage_core::frames::GroundRect;
use pilotage_core::imagery::Window;

use super::{FlightSource, MapSource, RunningJob, WorkerState};

/// Urgency of a job among those of its worker. Smaller is sooner: people who wait with a finger on the map come
/// before a flight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Urgency {
    /// Files that other jobs name.
    Files,
    /// Answers that a view waits for to show anything.
    First,
    /// Answers to something that was just clicked or dragged.
    Asked,
    /// Work of seconds whose end people wait for.
    Awaited,
    /// Flights and what is told along them.
    Flight,
    /// Preparations that nothing waits for yet.
    Ahead,
    /// Work of a minute of which nobody waits for a second.
    Slow,
    /// Letting go of files: jobs that were asked for before may still need them.
    Leaving,
}

/// Role of a worker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkerRole {
    /// Flies and measures.
    Flight,
    /// Shows the map.
    Map,
    /// Answers questions.
    Questions,
}

impl WorkerRole {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Flight, Self::Map, Self::Questions];
}

/// Parts of its map that a job reads.
pub enum Reads {
    /// These pictures of it.
    Windows(Vec<Window>),
    /// All that there is of these areas.
    Areas(Vec<GroundRect>),
}

/// Piece of heavy work that a worker is asked for, with everything it depends on.
pub trait Order {
    /// Urgency among the jobs of its worker.
    const URGENCY: Urgency;

    /// Role of the worker that does it.
    fn role(&self) -> WorkerRole;

    /// Keys of the provided files that it names.
    fn files(&self) -> Vec<&str> {
        Vec::new()
    }

    /// Map of which the worker needs tiles beforehand, and the parts of it.
    fn reads(&self) -> Option<(&MapSource, Reads)> {
        None
    }

    /// Whether the small program does it, if it is among that program's orders.
    fn is_small(&self) -> bool {
        false
    }

    /// Makes it ready to advance.
    fn begin(self, worker: &mut WorkerState) -> Box<dyn RunningJob>;
}

impl<O: Order> Order for Box<O> {
    const URGENCY: Urgency = O::URGENCY;

    fn role(&self) -> WorkerRole {
        (**self).role()
    }

    fn files(&self) -> Vec<&str> {
        (**self).files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        (**self).reads()
    }

    fn is_small(&self) -> bool {
        (**self).is_small()
    }

    fn begin(self, worker: &mut WorkerState) -> Box<dyn RunningJob> {
        (*self).begin(worker)
    }
}

/// Order that is done in another way than by itself: it needs what that needs.
pub struct VariantOrder<O> {
    order: O,
    begin: Box<dyn FnOnce(O) -> Box<dyn RunningJob> + Send>,
}

impl<O: Order> VariantOrder<O> {
    /// The order, made ready to advance by `begin`.
    pub fn new(order: O, begin: impl FnOnce(O) -> Box<dyn RunningJob> + Send + 'static) -> Self {
        let begin = Box::new(begin);
        Self { order, begin }
    }
}

impl<O: Order> Order for VariantOrder<O> {
    const URGENCY: Urgency = O::URGENCY;

    fn role(&self) -> WorkerRole {
        self.order.role()
    }

    fn files(&self) -> Vec<&str> {
        self.order.files()
    }

    fn reads(&self) -> Option<(&MapSource, Reads)> {
        self.order.reads()
    }

    fn begin(self, _: &mut WorkerState) -> Box<dyn RunningJob> {
        (self.begin)(self.order)
    }
}

/// Margin around a landmark within which pixels are needed to look for it, metres.
const AROUND_LANDMARK: f64 = 80.0;

/// Ground that is read to look for a landmark in that box.
pub fn around(bounds: &GroundRect) -> GroundRect {
    bounds.grown(AROUND_LANDMARK)
}

/// Keys of the files that a flight and a map are made of.
pub fn keys_of<'a>(flight: Option<&'a FlightSource>, map: Option<&'a MapSource>) -> Vec<&'a str> {
    let flight = flight.and_then(FlightSource::key);
    flight
        .into_iter()
        .chain(map.and_then(MapSource::key))
        .collect()
}
