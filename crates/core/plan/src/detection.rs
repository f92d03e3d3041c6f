//! Expected detection of a landmark before it was ever looked for.

use nalgebra::Matrix4;
use serde::{Deserialize, Serialize};

use super::LookTally;

/// Expected detection of one landmark while it lies wholly in the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExpectedDetection {
    /// Probability that it can be recognised at all on the day of the flight: what the season and the
    /// sun make of it is the same in every frame.
    pub recognised: f64,
    /// Probability that it is accepted in a frame, if it can be recognised.
    pub per_frame: f64,
    /// Mean covariance of the detected (north, east, rotation, log scale) from the shape of the peak,
    /// metres and radians.
    pub covariance: Matrix4<f64>,
}

impl ExpectedDetection {
    /// Probability that it is accepted in a frame of any day.
    pub fn probability(&self) -> f64 {
        self.recognised * self.per_frame
    }
}

/// Expected detections of one landmark by height above ground.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DetectionStatistics {
    /// Heights above ground, metres, ascending, and what is expected there.
    pub by_height: Vec<(f64, ExpectedDetection)>,
    /// Tallies of the landmark's rehearsals, on the days in the order in which all landmarks of the map were
    /// rehearsed; empty if they are not known.
    #[serde(default)]
    pub by_day: Vec<LookTally>,
}

impl DetectionStatistics {
    /// The same at every height.
    pub fn everywhere(expected: ExpectedDetection) -> Self {
        Self {
            by_height: vec![(0.0, expected)],
            by_day: Vec::new(),
        }
    }

    /// Expected detection at `height` metres above ground: linear between the heights that were tried, and as
    /// at the nearest beyond them. `None` if none was tried.
    ///
    /// ```
    /// use nalgebra::Matrix4;
    /// use pilotage_plan::{DetectionStatistics, ExpectedDetection};
    ///
    /// let found = |per_frame| ExpectedDetection {
    ///     recognised: 0.5,
    ///     per_frame,
    ///     covariance: Matrix4::identity(),
    /// };
    /// let by_height = vec![(100.0, found(0.8)), (200.0, found(0.4))];
    /// let statistics = DetectionStatistics { by_height, by_day: Vec::new() };
    /// let between = statistics.at(150.0).ok_or("never tried")?;
    /// assert!((between.per_frame - 0.6).abs() < 1e-12);
    /// assert!((between.probability() - 0.3).abs() < 1e-12);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn at(&self, height: f64) -> Option<ExpectedDetection> {
        let after = self.by_height.partition_point(|(h, _)| *h <= height);
        let Some((low, below)) = after.checked_sub(1).and_then(|i| self.by_height.get(i)) else {
            return self.by_height.first().map(|(_, expected)| *expected);
        };
        let Some((high, above)) = self.by_height.get(after) else {
            return Some(*below);
        };
        let share = (height - low) / (high - low);
        let between = |a: f64, b: f64| a + share * (b - a);
        Some(ExpectedDetection {
            recognised: between(below.recognised, above.recognised),
            per_frame: between(below.per_frame, above.per_frame),
            covariance: below.covariance * (1.0 - share) + above.covariance * share,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_two_heights_the_expectation_is_between_theirs() {
        let expected = |p: f64| ExpectedDetection {
            recognised: 1.0,
            per_frame: p,
            covariance: Matrix4::identity() * p,
        };
        let statistics = DetectionStatistics {
            by_height: vec![(100.0, expected(0.8)), (200.0, expected(0.4))],
            by_day: Vec::new(),
        };
        let at = |height| statistics.at(height).unwrap().per_frame;
        assert_eq!(
            [at(50.0), at(100.0), at(200.0), at(900.0)],
            [0.8, 0.8, 0.4, 0.4]
        );
        assert!((at(150.0) - 0.6).abs() < 1e-12);
        assert_eq!(DetectionStatistics::default().at(100.0), None);
    }
}
