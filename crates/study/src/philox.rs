//! Random numbers by counter: Philox 4x32 with ten rounds (Salmon, Moraes, Dror and Shaw 2011, "Parallel random numbers:
//! as easy as 1, 2, 3").
//!
//! A number is a function of the key and the place that is asked for, so that no run of a study depends on another.

use serde::{Deserialize, Serialize};

/// Multipliers of a round.
const MULTIPLIERS: [u32; 2] = [0xd251_1f53, 0xcd9e_8d57];
/// Steps of the key from round to round.
const WEYL: [u32; 2] = [0x9e37_79b9, 0xbb67_ae85];
/// Rounds.
const ROUNDS: usize = 10;

/// Uses of random numbers; those of one are independent of all others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub(crate) enum Stream {
    /// Seeds of flights.
    Flight = 1,
    /// Seeds of what the detector finds.
    Detection = 2,
    /// Seeds of walking errors.
    Walk = 3,
    /// Seeds of the readings of aids.
    Aid = 4,
    /// Seeds of estimators that draw.
    Estimator = 5,
    /// Values of settings.
    Setting = 6,
    /// Keys of scrambles.
    Scramble = 7,
    /// Weights of the bootstrap.
    Weight = 8,
    /// Seeds of winds.
    Wind = 9,
    /// Bits of a scramble, under a key of their own.
    Bit = 10,
}

/// Random numbers under one key.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Philox {
    key: [u32; 2],
}

impl Philox {
    /// The numbers under the key `seed`.
    pub fn new(seed: u64) -> Self {
        Self {
            key: [seed as u32, (seed >> 32) as u32],
        }
    }

    /// The block of four numbers at `counter`.
    ///
    /// ```
    /// use pilotage_study::Philox;
    ///
    /// assert_eq!(Philox::new(0).block([0; 4])[0], 0x6627_e8d5);
    /// ```
    pub fn block(self, counter: [u32; 4]) -> [u32; 4] {
        let (mut words, mut key) = (counter, self.key);
        for _ in 0..ROUNDS {
            let [first, second] = [(0, 0), (1, 2)]
                .map(|(which, word)| u64::from(MULTIPLIERS[which]) * u64::from(words[word]));
            words = [
                (second >> 32) as u32 ^ words[1] ^ key[0],
                second as u32,
                (first >> 32) as u32 ^ words[3] ^ key[1],
                first as u32,
            ];
            key = [key[0].wrapping_add(WEYL[0]), key[1].wrapping_add(WEYL[1])];
        }
        words
    }

    /// The block number `index` of what is drawn for `number` in a stream.
    pub(crate) fn of(self, stream: Stream, number: u64, index: u32) -> [u32; 4] {
        self.block([number as u32, (number >> 32) as u32, index, stream as u32])
    }

    /// A whole number of 64 bits.
    pub(crate) fn word(self, stream: Stream, number: u64, index: u32) -> u64 {
        let [low, high, ..] = self.of(stream, number, index);
        u64::from(high) << 32 | u64::from(low)
    }

    /// A number in (0, 1), never an end.
    pub(crate) fn unit(self, stream: Stream, number: u64, index: u32) -> f64 {
        ((self.word(stream, number, index) >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `tests/kat_vectors` of Random123, the three lines "philox4x32 10".
    #[test]
    fn the_published_answers_are_given() {
        let digits = [
            (
                [0; 4],
                [0; 2],
                [0x6627_e8d5, 0xe169_c58d, 0xbc57_ac4c, 0x9b00_dbd8],
            ),
            (
                [u32::MAX; 4],
                [u32::MAX; 2],
                [0x408f_276d, 0x41c8_3b0e, 0xa20b_c7c6, 0x6d54_51fd],
            ),
            (
                [0x243f_6a88, 0x85a3_08d3, 0x1319_8a2e, 0x0370_7344],
                [0xa409_3822, 0x299f_31d0],
                [0xd16c_fe09, 0x94fd_cceb, 0x5001_e420, 0x2412_6ea1],
            ),
        ];
        for (counter, key, answer) in digits {
            assert_eq!(Philox { key }.block(counter), answer);
        }
        let seeded = Philox::new(0x299f_31d0_a409_3822);
        assert_eq!(seeded.key, [0xa409_3822, 0x299f_31d0]);
    }

    #[test]
    fn units_have_the_mean_and_variance_of_a_uniform_number_and_never_meet_an_end() {
        let random = Philox::new(7);
        let count = 20_000;
        let units: Vec<f64> = (0..count)
            .map(|n| random.unit(Stream::Setting, n, 3))
            .collect();
        let mean = units.iter().sum::<f64>() / count as f64;
        let variance = units.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / count as f64;
        // Three standard errors: 1 / √(12 n) of the mean, 1 / √(180 n) of the variance.
        assert!(
            (mean - 0.5).abs() < 3.0 / (12.0 * count as f64).sqrt(),
            "{mean}"
        );
        assert!((variance - 1.0 / 12.0).abs() < 3.0 / (180.0 * count as f64).sqrt());
        assert!(units.iter().all(|u| *u > 0.0 && *u < 1.0));
    }
}
