//! Assessment of a landmark by rehearsal: the order and the result.

use pilotage_core::camera::CameraModel;
use pilotage_core::landmark::Landmark;
use pilotage_core::navigator::NavigatorSettings;
use pilotage_core::plan::{DetectionStatistics, ExpectedDetection, Rehearsal, ViewBreakdown};
use serde::{Deserialize, Serialize};

use super::MapSource;

/// Landmark to be measured, and the circumstances under which it will be looked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AssessmentOrder {
    /// The map.
    pub map: MapSource,
    /// The landmark.
    pub landmark: Landmark,
    /// The camera.
    pub camera: CameraModel,
    /// Height of the camera above ground, metres.
    pub height: f64,
    /// Settings of the navigator of the planned flight.
    pub navigator: NavigatorSettings,
    /// Down coordinate of the ground plane, metres.
    pub ground_down: f64,
    /// Seed of the other days and of the looks; [`Self::SEED`], so that the same landmark has the same measurement.
    pub seed: u64,
}

impl AssessmentOrder {
    /// Seed of all measurements that are kept.
    pub const SEED: u64 = 11;
}

/// Single look at a landmark.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Glance {
    /// Heading of the camera, radians.
    pub heading: f64,
    /// Distance from the middle of the picture, pixels.
    pub off_centre: f64,
    /// Index of the day of the look.
    pub day: usize,
    /// Whether it was accepted and right.
    pub found: bool,
    /// Whether a wrong place was accepted.
    pub wrong: bool,
}

/// Assessment of a landmark: its detection probability and the views behind it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Assessment {
    /// The landmark as it was measured.
    pub landmark: Landmark,
    /// Height above ground, metres.
    pub height: f64,
    /// Expected detection of the landmark.
    pub expected: ExpectedDetection,
    /// Share of the views in which a wrong place was accepted.
    pub false_matches: f64,
    /// Every view.
    pub views: Vec<Glance>,
    /// Views counted by heading, attitude error and day.
    pub breakdown: ViewBreakdown,
}

impl Assessment {
    /// Statistics for a prediction: what was measured at that height holds for all.
    pub fn statistics(&self) -> DetectionStatistics {
        DetectionStatistics {
            by_height: vec![(self.height, self.expected)],
            by_day: self.breakdown.day.clone(),
        }
    }
}

/// A share of the looks at a landmark: those on every `of`-th day, so that several workers draw the
/// ground of one day each.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// Index of this share, from 0.
    pub part: usize,
    /// Number of shares.
    pub of: usize,
}

impl Share {
    /// Everything.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether a look is of this share.
    pub(crate) fn has(&self, look: usize) -> bool {
        look % Rehearsal::DAYS % self.of == self.part
    }

    /// Number of looks in the share.
    pub(crate) fn count(&self) -> usize {
        (0..Rehearsal::VIEWS).filter(|look| self.has(*look)).count()
    }
}
