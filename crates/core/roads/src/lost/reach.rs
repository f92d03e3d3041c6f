//! Ground around a place that its views show: its bound, and the distance from a place to all that is compared there.

use std::error::Error;
use std::fmt;

use super::view::{RoadView, ViewMotion};

/// Greatest distance from below the camera that a view may show, metres: the views that taught the odds show 0.4 km.
const FARTHEST: f64 = 5000.0;
/// Ground beyond the outermost point of a view that its pose may ask for, metres: merged crossings, arms of crossings,
/// the reach of the field of distances, and what poses are moved by.
const BEYOND: f64 = 120.0;
/// Standard deviations of the scale by which a view may be larger.
const OF_SCALE: f64 = 3.0;
/// Standard deviations of dead reckoning within which a view may be off.
pub(super) const SLACK: f64 = 3.0;
/// Standard deviations of a fitted pose: place (m) and heading (rad).
pub(super) const FITTED: (f64, f64) = (4.0, 0.02);

/// Reason why a view cannot be looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RoadViewError {
    /// It shows ground too far from below the camera.
    TooWide {
        /// Distance of the farthest, kilometres.
        reach: f64,
    },
}

impl fmt::Display for RoadViewError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::TooWide { reach } = self;
        let most = 1e-3 * FARTHEST;
        write!(
            f,
            "it shows roads {reach:.1} km from its middle, and at most {most:.0} km can be looked for; leave out the roads \
             that lie elsewhere, or exchange map and view"
        )
    }
}

impl Error for RoadViewError {}

impl RoadView {
    /// The view itself, if all that it shows lies within 5 km of the point below its camera.
    pub fn checked(&self) -> Result<&Self, RoadViewError> {
        let reach = self.reach();
        if reach > FARTHEST {
            return Err(RoadViewError::TooWide {
                reach: 1e-3 * reach,
            });
        }
        Ok(self)
    }

    /// Distance of the farthest place of the view from below the camera, metres; no end where one is no number.
    fn reach(&self) -> f64 {
        let points = self.points.iter().map(|point| point.place);
        let crossings = self.crossings.iter().map(|crossing| crossing.place);
        let places = points.chain(crossings).chain(self.outline.iter().copied());
        let far = |norm: f64| if norm.is_nan() { f64::INFINITY } else { norm };
        places.fold(0.0, |reach, place| far(place.norm()).max(reach))
    }
}

/// Length that a way between two views has at most, metres.
pub(super) fn way_at_most(motion: &ViewMotion) -> f64 {
    motion.way.norm() + SLACK * motion.way_deviation.hypot(FITTED.0)
}

/// Distance from the place that the last of several views shows within which all ground lies that is compared with them,
/// metres; `scale` is the standard deviation of their scale as a share.
pub fn reach_of_views(first: &RoadView, then: &[(ViewMotion, RoadView)], scale: f64) -> f64 {
    let views = std::iter::once(first).chain(then.iter().map(|t| &t.1));
    let widest = views.fold(0.0, |reach: f64, view| reach.max(view.reach()));
    let ways: f64 = then.iter().map(|(motion, _)| way_at_most(motion)).sum();
    widest * (1.0 + OF_SCALE * scale) + ways + BEYOND
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    #[test]
    fn a_view_has_a_bound_and_so_has_what_is_no_number() {
        let view = |north: f64| RoadView {
            outline: vec![Vector2::new(0.0, 10.0), Vector2::new(north, 0.0)],
            ..RoadView::default()
        };
        assert_eq!(view(4999.0).checked(), Ok(&view(4999.0)));
        let why = view(300e3).checked().unwrap_err();
        assert_eq!(why, RoadViewError::TooWide { reach: 300.0 });
        assert!(
            why.to_string().starts_with("it shows roads 300.0 km"),
            "{why}"
        );
        assert!(view(f64::NAN).checked().is_err());
        assert_eq!(reach_of_views(&view(500.0), &[], 0.02), 530.0 + BEYOND);
    }
}
