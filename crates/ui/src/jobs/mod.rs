//! Heavy work as messages: what to do, what came of it. Runs in a worker.

mod protocol;

pub use protocol::{
    Distinctness, FlightSource, Job, JobEvent, JobId, MapInfo, MapSource, MatchPictures, Opened,
    SimulationOptions,
};
