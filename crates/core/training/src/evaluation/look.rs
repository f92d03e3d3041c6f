//! Looks of which an evaluation is made: pictures in which one landmark was searched.

use serde::{Deserialize, Serialize};

use pilotage_base::frames::GroundPoint;
use pilotage_vision::landmark::trained::Mark;

/// Picture in which one landmark was searched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluatedLook {
    /// The day it shows. Looks of one day have light, season and weather in common and are not
    /// independent: the intervals draw whole days.
    pub day: usize,
    /// Height of the camera above the ground, metres.
    pub height: f64,
    /// Angle between the optical axis and straight down, radians.
    pub tilt: f64,
    /// Assumed heading less the true one, radians.
    pub heading_error: f64,
    /// Logarithm of the size in which the ground appears under the assumed pose: assumed height over
    /// the true one.
    #[serde(default)]
    pub log_scale: f64,
    /// A real frame, not a render.
    pub real: bool,
    /// Whether the landmark is whole in the searched picture. Where it is not, every mark is a
    /// false alarm.
    pub present: bool,
    /// Everything the detector marked, with scores down to far below any threshold of use.
    pub marks: Vec<EvaluatedMark>,
}

/// Place that the detector marked in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluatedMark {
    /// The detector's score: the higher, the surer. Its unit is the detector's own.
    pub score: f64,
    /// From the landmark to the mark on the ground under the assumed pose: north, east, metres.
    pub offset: [f64; 2],
    /// Whether it is the landmark.
    pub right: bool,
    /// Turn in which it was found, radians clockwise.
    #[serde(default)]
    pub rotation: f64,
    /// Logarithm of the size in which it was found.
    #[serde(default)]
    pub log_scale: f64,
}

impl EvaluatedMark {
    /// A mark where the landmark `appears`; it is right within `near` metres, and never without.
    pub(super) fn of(mark: &Mark, appears: &GroundPoint, near: Option<f64>) -> Self {
        Self {
            score: mark.score,
            offset: [
                mark.ground.north - appears.north,
                mark.ground.east - appears.east,
            ],
            right: near.is_some_and(|near| mark.ground.distance(appears) <= near),
            rotation: mark.rotation,
            log_scale: mark.log_scale,
        }
    }
}

impl EvaluatedLook {
    /// Turn in which the ground appears under the assumed pose, radians clockwise.
    pub fn rotation(&self) -> f64 {
        -self.heading_error
    }

    /// The right mark with the highest score.
    pub fn best_right(&self) -> Option<&EvaluatedMark> {
        best(self.marks.iter().filter(|mark| self.present && mark.right))
    }

    /// The highest score of a right mark, `None` where the landmark was not marked.
    ///
    /// ```
    /// use pilotage_training::evaluation::EvaluatedLook;
    /// # use pilotage_training::evaluation::EvaluatedMark;
    /// # let mark = |score, right| EvaluatedMark {
    /// #     score,
    /// #     right,
    /// #     offset: [0.0; 2],
    /// #     rotation: 0.0,
    /// #     log_scale: 0.0,
    /// # };
    ///
    /// // Marks with their scores, right or wrong.
    /// let look = EvaluatedLook {
    ///     present: true,
    ///     marks: vec![mark(2.0, true), mark(3.0, false), mark(1.0, true)],
    /// #     day: 0, height: 100.0, tilt: 0.0, heading_error: 0.0, log_scale: 0.0, real: false,
    /// };
    /// assert_eq!((look.found_at(), look.deceived_at()), (Some(2.0), Some(3.0)));
    /// // Where the landmark is not, every mark is wrong.
    /// let elsewhere = EvaluatedLook { present: false, ..look };
    /// assert_eq!(elsewhere.found_at(), None);
    /// ```
    pub fn found_at(&self) -> Option<f64> {
        self.best_right().map(|mark| mark.score)
    }

    /// The highest score of a wrong mark, `None` where there is none.
    pub fn deceived_at(&self) -> Option<f64> {
        best(self.wrong_marks()).map(|mark| mark.score)
    }

    /// Everything marked that is not the landmark.
    pub fn wrong_marks(&self) -> impl Iterator<Item = &EvaluatedMark> {
        let right = |mark: &EvaluatedMark| self.present && mark.right;
        self.marks.iter().filter(move |mark| !right(mark))
    }
}

fn best<'a>(marks: impl Iterator<Item = &'a EvaluatedMark>) -> Option<&'a EvaluatedMark> {
    marks.max_by(|a, b| a.score.total_cmp(&b.score))
}
