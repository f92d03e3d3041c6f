//! The two sets that are to be associated, and what is known of their errors.

use nalgebra::{Matrix2, Matrix2x4, Matrix4, Vector2};

use crate::GenericClass;
use pilotage_base::frames::inside;

/// A landmark that the camera saw.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservedLandmark {
    /// Its class.
    pub class: GenericClass,
    /// Its middle relative to the ground below the aircraft, by the assumed attitude and height: metres north, east.
    pub place: Vector2<f64>,
    /// Covariance of its own error in that place, square metres.
    pub covariance: Matrix2<f64>,
    /// Side of a square of its area, metres.
    pub size: f64,
    /// Change of `place` with the errors that all landmarks of the picture share: metres per radian of assumed roll,
    /// pitch, yaw, and per metre of assumed height.
    pub by_pose: Matrix2x4<f64>,
}

/// A landmark of the table, around where the aircraft is believed to be.
#[derive(Clone, Debug, PartialEq)]
pub struct PossibleLandmark {
    /// Its class.
    pub class: GenericClass,
    /// Its middle relative to the ground below the believed position: metres north, east.
    pub place: Vector2<f64>,
    /// Covariance of its error in the map, square metres.
    pub covariance: Matrix2<f64>,
    /// Side of a square of its area, metres.
    pub size: f64,
    /// Probability that it is observed where it is in view, more than 0 and less than 1.
    pub detection: f64,
}

/// Errors that all landmarks of a picture share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommonError {
    /// Covariance of the believed position (north, east), square metres.
    pub position: Matrix2<f64>,
    /// Covariance of the assumed roll, pitch, yaw (radians) and height (metres).
    pub pose: Matrix4<f64>,
}

/// Association to be found.
#[derive(Clone, Copy, Debug)]
pub struct AssociationProblem<'a> {
    /// Landmarks that the camera saw.
    pub observed: &'a [ObservedLandmark],
    /// Landmarks of the table that it may have seen.
    pub possible: &'a [PossibleLandmark],
    /// Errors that they share.
    pub common: CommonError,
    /// Corners of the ground in the picture, in order around it: metres north and east of the ground below the aircraft.
    /// The sides bend inward where the lens is of the barrel kind.
    pub view: &'a [Vector2<f64>],
}

impl AssociationProblem<'_> {
    /// Area of the ground in the picture, square metres.
    pub(super) fn area(&self) -> f64 {
        let twice: f64 = self.edges().map(|(a, b)| a.perp(&b)).sum();
        0.5 * twice.abs()
    }

    /// Whether a place is in view.
    pub(super) fn is_in_view(&self, place: Vector2<f64>) -> bool {
        inside(self.view, &place.into())
    }

    fn edges(&self) -> impl Iterator<Item = (Vector2<f64>, Vector2<f64>)> + '_ {
        let next = self.view.iter().cycle().skip(1);
        self.view.iter().copied().zip(next.copied())
    }
}

/// Numbers of the association.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssociationSettings {
    /// Share of the observed landmarks that the table does not have.
    pub clutter: f64,
    /// Standard deviation of the logarithm of an observed size over that in the table.
    pub log_size: f64,
    /// Probability that a right pair lies inside its gate.
    pub gate: f64,
    /// Least probability of a pair that is accepted.
    pub least_probability: f64,
    /// Least number of accepted pairs.
    pub least_pairs: usize,
}

impl Default for AssociationSettings {
    fn default() -> Self {
        Self {
            clutter: 0.4,
            log_size: 0.25,
            gate: 0.999,
            least_probability: 0.9,
            least_pairs: 4,
        }
    }
}
