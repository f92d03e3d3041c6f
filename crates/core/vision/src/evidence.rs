//! Evidence of a correlation for a place.
//!
//! A frame that does not belong to a place correlates with it by chance, with a standard deviation σ that the
//! frame itself tells (laid on the same ground turned by half a turn). 1 / σ² is the number of independent
//! numbers N in which it is compared, and a Gaussian model of both pictures gives the place the likelihood
//! (1 - ρ²)^(-N/2) against chance. Ground repeats itself and pictures differ by more than noise, so that
//! logarithm is tempered: with the temperature below, probabilities hold on real pairs of dates.

use pilotage_raster::raster::ChannelSurface;

/// Share of the logarithm of the likelihood that is believed.
///
/// Of 0.35, 0.45, 0.5 and 0.6 the one by which the probabilities of 90 photos anywhere on their own maps of other
/// dates and of the same on a map of another country, no heading known, are likeliest: 0.45 and 0.5 are alike,
/// 0.6 is sure of other ground in 2 of 90, 0.35 doubts half of what is right.
pub const TEMPERED: f64 = 0.5;
/// Correlation beyond which pictures are not more alike.
const MOST: f64 = 0.999;

/// Evidence that correlations of a frame give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Standard deviation of the correlation with ground that is not the frame's, where all of it lies over the
    /// map.
    pub chance: f64,
}

impl Evidence {
    /// From surfaces of the frame over ground that is not its own.
    pub fn from_chance(surfaces: impl Iterator<Item = ChannelSurface>) -> Option<Self> {
        let (mut count, mut squares) = (0.0_f64, 0.0_f64);
        for surface in surfaces {
            for (index, value) in surface.score.pixels().iter().enumerate() {
                let share = surface.share_at(index);
                squares += f64::from(share * value * value);
                count += f64::from(u8::from(share > 0.0));
            }
        }
        let chance = (squares / count.max(1.0)).sqrt();
        (chance > 0.0).then_some(Self { chance })
    }

    /// Natural logarithm of the tempered likelihood of a place with this correlation against chance, where a
    /// `share` of the frame lies over the map.
    pub fn log_likelihood(&self, score: f64, share: f64) -> f64 {
        let independent = share * self.chance.powi(-2);
        let square = score.clamp(0.0, MOST).powi(2);
        // Under chance the mean of the likelihood is one.
        -0.5 * TEMPERED * independent * (1.0 - square).ln() + 0.5 * (1.0 - TEMPERED).ln()
    }

    /// Derivative of [`Self::log_likelihood`] by the correlation.
    pub fn slope(&self, score: f64, share: f64) -> f64 {
        let score = score.clamp(0.0, MOST);
        share * TEMPERED * self.chance.powi(-2) * score / (1.0 - score * score)
    }
}
