//! Seeds of runs, by counter.

use serde::{Deserialize, Serialize};

use super::philox::{Philox, Stream};

/// Seeds of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Seeds {
    random: Philox,
    draw: u64,
}

impl Seeds {
    /// Those of draw number `draw`, which all its cells share.
    pub fn new(random: Philox, draw: u64) -> Self {
        Self { random, draw }
    }

    pub fn of(&self, stream: Stream) -> u64 {
        self.random.word(stream, self.draw, 0)
    }
}
