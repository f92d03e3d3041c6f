//! Random numbers of a prediction: each has a place of its own.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Numbers that are kept for what is drawn at one place, of 32 bits each.
const WORDS: u128 = 64;

/// Random numbers by what they are for: those for one landmark are the same whichever others there are, and those of a
/// frame whatever was drawn before (common random numbers), so that predictions of two plans differ by the plans.
pub(super) struct PredictionDraws(ChaCha8Rng);

impl PredictionDraws {
    /// Numbers of a seed.
    pub(super) fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Numbers for all landmarks together in a world, from the start of a frame on.
    pub(super) fn of_all(&mut self, world: usize, frame: usize) -> &mut ChaCha8Rng {
        self.at(world, 0, frame)
    }

    /// Numbers for a landmark in a world, from the start of a frame on.
    pub(super) fn of_landmark(&mut self, world: usize, id: u32, frame: usize) -> &mut ChaCha8Rng {
        self.at(world, u64::from(id) + 1, frame)
    }

    fn at(&mut self, world: usize, purpose: u64, frame: usize) -> &mut ChaCha8Rng {
        self.0.set_stream((world as u64) << 33 | purpose);
        self.0.set_word_pos(frame as u128 * WORDS);
        &mut self.0
    }
}
