//! Probability that a landmark is found on a real other date, by what of it lasts.
//!
//! Generated days are easier than real ones: an own place scores 0.78 on them and 0.45 in photos of another date,
//! while the strongest look-alike scores the same on both (0.23 and 0.22). So the share of real looks that are
//! accepted is taken from real pairs of dates: by logistic regression on the look-alike's score, and on the colour
//! and the brightness of the ground, by which roofs and paved ground, which last, differ from woods, crops and
//! shadows, which do not. 1,011 looks at boxes of 35 m of two places, one of them on maps of two dates; the rehearsed
//! score of the own place added nothing to that, and on a blurred map it misled.

use pilotage_base::frames::GroundRect;
use pilotage_raster::imagery::{Imagery, Window};
use pilotage_vision::landmark::RehearsalFit;

/// Logarithm of the odds where everything else is zero.
const OFFSET: f64 = -6.92;
/// Per unit of the look-alike's score.
const PER_RIVAL: f64 = -6.90;
/// Per unit of colour, of which grey has none and a pure colour one.
const PER_COLOUR: f64 = 18.0;
/// Per grey level of mean brightness.
const PER_BRIGHTNESS: f64 = 0.058;
/// Standard deviation, from one pair of dates to another, of the logarithm of the odds: what was fitted to one of
/// the two places was 0.9 and -1.2 off at the other.
const BETWEEN_DATES: f64 = 1.0;
/// Standard deviations of a range that holds nine in ten.
const NINE_IN_TEN: f64 = 1.645;
/// Ground sample distance at which colours are averaged, metres per pixel.
const GSD: f64 = 0.5;

/// Probability that a landmark is found in pictures of a real other date that show it whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Survival {
    /// Probability in a picture.
    pub probability: f64,
    /// Range of the probability for nine in ten pairs of dates.
    pub range: [f64; 2],
}

/// Looks of the ground, which tell what of it lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GroundLooks {
    /// 0 (grey) to 1.
    colour: f64,
    /// Mean of red, green and blue, 0 to 255.
    brightness: f64,
}

impl GroundLooks {
    /// Of a box of the map.
    pub fn of(map: &dyn Imagery, bounds: &GroundRect) -> Self {
        let gsd = GSD.max(map.native_gsd());
        let pixels = map.window(&Window::covering(bounds, gsd));
        let (mut colour, mut brightness) = (0.0, 0.0);
        for [red, green, blue, _] in pixels.pixels().iter().map(|p| p.map(f64::from)) {
            let sum = red + green + blue;
            let most = red.max(green).max(blue);
            colour += (most - red.min(green).min(blue)) / sum.max(1.0);
            brightness += sum / 3.0;
        }
        let count = pixels.pixels().len().max(1) as f64;
        Self {
            colour: colour / count,
            brightness: brightness / count,
        }
    }

    /// With what was rehearsed of it on several days.
    pub fn survival(&self, days: &[RehearsalFit]) -> Survival {
        let rivals = days.iter().map(|day| day.rival);
        self.with(rivals.sum::<f64>() / days.len().max(1) as f64)
    }

    /// With the mean score of its strongest look-alike on rehearsed days.
    fn with(&self, rival: f64) -> Survival {
        let at = OFFSET
            + PER_RIVAL * rival
            + PER_COLOUR * self.colour
            + PER_BRIGHTNESS * self.brightness;
        let off = NINE_IN_TEN * BETWEEN_DATES;
        Survival {
            probability: logistic(at),
            range: [logistic(at - off), logistic(at + off)],
        }
    }
}

fn logistic(at: f64) -> f64 {
    1.0 / (1.0 + (-at).exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roofs_last_longer_than_woods_and_what_has_no_look_alike_longer_than_what_has() {
        let roofs = GroundLooks {
            colour: 0.13,
            brightness: 125.0,
        };
        let wood = GroundLooks {
            colour: 0.07,
            brightness: 75.0,
        };
        let said = roofs.with(0.2);
        assert!((0.7..0.85).contains(&said.probability), "{said:?}");
        assert!(said.range[0] < 0.45 && said.range[1] > 0.9, "{said:?}");
        assert!(wood.with(0.2).probability < 0.1);
        assert!(roofs.with(0.5).probability < 0.5 * said.probability);
    }
}
