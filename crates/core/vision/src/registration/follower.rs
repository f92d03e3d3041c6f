//! Knowledge that one frame passes on to the next.

use serde::{Deserialize, Serialize};

use super::limits::{deviation_within, limit_of, log_deviation_within, share_of};
use super::prior::{HeadingPrior, PosePrior, StoredTurn};
use super::register::Registration;
use super::shape::MapShape;
use pilotage_base::frames::GroundPoint;

/// Deviation per axis of the place of a map that somebody already had, a satellite's or an aerial one, metres.
pub const USUAL_MAP_DEVIATION: f64 = 3.0;

/// Assumptions about a flight over a map; deviations are standard ones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FollowSettings {
    /// Height above the ground before anything is known of it, metres.
    pub height: f64,
    /// Standard deviation of its natural logarithm.
    pub log_height_deviation: f64,
    /// Standard deviation of the logarithm of a measured height: the ground is not level, and barometers drift.
    pub measured_log_height_deviation: f64,
    /// Random walk of the logarithm of the height, 1/√s.
    pub log_height_walk: f64,
    /// Standard deviation of a measured heading against the camera, the mount's error included, radians.
    pub heading_deviation: f64,
    /// Whether pictures may have been stored turned by quarter turns against the measured heading.
    pub may_be_turned: bool,
    /// Standard deviation of roll and pitch, measured or, where nothing measures them, assumed level, radians.
    pub tilt_deviation: f64,
    /// Standard deviation of the slope of the ground in view, along each axis: to a camera it looks like a tilt.
    pub slope_deviation: f64,
    /// Standard deviation of how the map is stretched, before a frame has shown it.
    pub shape_deviation: f64,
    /// Standard deviation of the map's own place per axis, metres: of satellite and aerial maps some 3, of an orthophoto
    /// made with ground control or by the flight itself near 0.
    #[serde(default)]
    pub map_deviation: f64,
    /// Farthest to each side of where the aircraft is believed to be that a frame is searched, metres; as far as the
    /// filter is uncertain where it is `None`.
    #[serde(default)]
    pub farthest: Option<f64>,
}

impl FollowSettings {
    /// Farthest to each side of a measured heading that frames are searched, radians.
    pub fn heading_limit(&self) -> f64 {
        limit_of(self.heading_deviation)
    }

    /// Searches headings no farther than `limit` (radians) to each side of a measured one.
    ///
    /// ```
    /// use pilotage_vision::registration::FollowSettings;
    ///
    /// let mut settings = FollowSettings::default();
    /// settings.limit_heading(25_f64.to_radians());
    /// // Searched is up to 2.5 standard deviations.
    /// assert!((settings.heading_deviation - 10_f64.to_radians()).abs() < 1e-12);
    /// assert!((settings.heading_limit() - 25_f64.to_radians()).abs() < 1e-12);
    /// ```
    pub fn limit_heading(&mut self, limit: f64) {
        self.heading_deviation = deviation_within(limit);
    }

    /// Largest share of a measured height that it may be exceeded by: 0.2 is 20 %.
    pub fn height_limit(&self) -> f64 {
        share_of(self.measured_log_height_deviation)
    }

    /// Searches heights up to `share` of a measured one above it, and down by the same factor.
    pub fn limit_height(&mut self, share: f64) {
        self.measured_log_height_deviation = log_deviation_within(share);
    }
}

impl Default for FollowSettings {
    fn default() -> Self {
        Self {
            height: 60.0,
            log_height_deviation: 0.4,
            measured_log_height_deviation: 0.05,
            log_height_walk: 0.03,
            heading_deviation: 3_f64.to_radians(),
            may_be_turned: true,
            tilt_deviation: 1.05_f64.to_radians(),
            slope_deviation: 3_f64.to_radians(),
            shape_deviation: 0.1,
            map_deviation: 0.0,
            farthest: None,
        }
    }
}

/// The least deviation of the shape of the map in view of one frame: relief stretches it as well.
const LEAST_SHAPE_DEVIATION: f64 = 0.01;
/// Information against that of the prior below which there is none.
const LEAST_INFORMATION: f64 = 1e-6;

/// Readings of the instruments when a frame is taken; radians and metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InstrumentReadings {
    /// Heading of the body, clockwise from north.
    pub heading: Option<f64>,
    /// Roll of the body.
    pub roll: Option<f64>,
    /// Pitch of the body.
    pub pitch: Option<f64>,
    /// Height above the ground.
    pub height: Option<f64>,
}

/// A mean with its variance.
#[derive(Clone, Copy, Debug)]
struct ScalarBelief {
    mean: f64,
    variance: f64,
}

impl ScalarBelief {
    fn corrected(self, by: Self) -> Self {
        let gain = self.variance / (self.variance + by.variance);
        Self {
            mean: self.mean + gain * (by.mean - self.mean),
            variance: (1.0 - gain) * self.variance,
        }
    }

    /// Measurement that makes it of `prior`; `None` if there was none.
    fn beyond(self, prior: Self) -> Option<Self> {
        let (own, before) = (self.variance.recip(), prior.variance.recip());
        let information = own - before;
        (information > LEAST_INFORMATION * before).then(|| Self {
            mean: (own * self.mean - before * prior.mean) / information,
            variance: information.recip(),
        })
    }
}

/// Remembers of the frames of a flight that were laid on the map how high it flew and how the map is
/// stretched. Where the aircraft is the caller says, who has a filter for that.
#[derive(Clone, Debug)]
pub struct Follower {
    settings: FollowSettings,
    /// Natural logarithm of the height, when.
    height: Option<(ScalarBelief, f64)>,
    along: ScalarBelief,
    across: ScalarBelief,
    /// Stored turn of the frame that was laid last, radians clockwise.
    stored_turn: f64,
}

impl Follower {
    /// Before the first frame.
    pub fn new(settings: FollowSettings) -> Self {
        let unknown = ScalarBelief {
            mean: 0.0,
            variance: settings.shape_deviation.powi(2),
        };
        Self {
            settings,
            height: None,
            along: unknown,
            across: unknown,
            stored_turn: 0.0,
        }
    }

    /// Height above the ground at `time`, metres, and the standard deviation of its natural logarithm.
    pub fn height(&self, time: f64, measured: &InstrumentReadings) -> (f64, f64) {
        let s = &self.settings;
        match (measured.height, self.height) {
            (Some(height), _) => (height, s.measured_log_height_deviation),
            (None, Some((belief, then))) => {
                let wander = s.log_height_walk.powi(2) * (time - then).abs();
                let deviation = (belief.variance + wander).sqrt();
                (belief.mean.exp(), deviation.min(s.log_height_deviation))
            }
            (None, None) => (s.height, s.log_height_deviation),
        }
    }

    /// Prior of the pose at `time` when the vehicle is believed to be at `position`, with this standard
    /// deviation per axis in metres.
    pub fn prior(
        &self,
        time: f64,
        position: GroundPoint,
        position_deviation: f64,
        measured: &InstrumentReadings,
    ) -> PosePrior {
        let s = &self.settings;
        let (height, log_height_deviation) = self.height(time, measured);
        let heading = match measured.heading {
            None => HeadingPrior::Unknown,
            Some(heading) => HeadingPrior::Around {
                heading,
                deviation: s.heading_deviation,
                stored: if s.may_be_turned {
                    StoredTurn::Quarters {
                        first: self.stored_turn,
                    }
                } else {
                    StoredTurn::None
                },
            },
        };
        let most = s.farthest.map_or(f64::INFINITY, deviation_within);
        PosePrior {
            position,
            position_deviation: position_deviation.min(most),
            anywhere_on: None,
            height,
            log_height_deviation,
            heading,
            roll: measured.roll.unwrap_or(0.0),
            pitch: measured.pitch.unwrap_or(0.0),
            tilt_deviation: s.tilt_deviation,
            slope_deviation: s.slope_deviation,
            shape: self.shape(),
            map_deviation: s.map_deviation,
            shape_deviation: self.along.variance.max(self.across.variance).sqrt(),
        }
    }

    /// Remembers what a frame showed that was laid on the map with this prior: of the map's shape what the frame says beyond
    /// it, which is nothing where it was laid as a whole.
    pub fn learn(&mut self, time: f64, ground_down: f64, prior: &PosePrior, found: &Registration) {
        let fit = &found.fit;
        let height = ground_down - fit.at.pose.position_in_world.z;
        let variance = fit.covariance[(2, 2)] / (height * height);
        self.height = Some((
            ScalarBelief {
                mean: height.ln(),
                variance,
            },
            time,
        ));
        let of_prior = prior.shape_deviation.powi(2);
        let [own, before] = [fit.at.shape, prior.shape].map(|shape| [shape.along, shape.across]);
        for (axis, belief) in [&mut self.along, &mut self.across].into_iter().enumerate() {
            let found = ScalarBelief {
                mean: own[axis],
                variance: fit.covariance[(6 + axis, 6 + axis)],
            };
            let told = found.beyond(ScalarBelief {
                mean: before[axis],
                variance: of_prior,
            });
            if let Some(mut told) = told {
                told.variance += LEAST_SHAPE_DEVIATION.powi(2);
                *belief = belief.corrected(told);
            }
        }
        self.stored_turn = found.stored_turn;
    }

    /// Stretch of the map, as far as the frames have shown.
    pub fn shape(&self) -> MapShape {
        MapShape {
            along: self.along.mean,
            across: self.across.mean,
        }
    }

    /// Standard deviations of the shape's two numbers.
    pub fn shape_deviations(&self) -> [f64; 2] {
        [self.along.variance.sqrt(), self.across.variance.sqrt()]
    }
}

#[cfg(test)]
mod tests {
    use super::super::laid_for_tests::laid_at;
    use super::*;

    #[test]
    fn a_lost_filter_searches_no_farther_than_the_settings_allow() {
        let mut settings = FollowSettings::default();
        let searched = |settings: FollowSettings, believed: f64| {
            let follower = Follower::new(settings);
            let at = GroundPoint::new(0.0, 0.0);
            let prior = follower.prior(0.0, at, believed, &InstrumentReadings::default());
            limit_of(prior.position_deviation)
        };
        assert!((searched(settings, 200.0) - 500.0).abs() < 1e-9);
        settings.farthest = Some(80.0);
        assert!((searched(settings, 200.0) - 80.0).abs() < 1e-9);
        assert!((searched(settings, 10.0) - 25.0).abs() < 1e-9);
    }

    #[test]
    fn limits_of_heading_and_height_are_what_is_searched() {
        let mut settings = FollowSettings::default();
        settings.limit_heading(0.4);
        settings.limit_height(0.25);
        let measured = InstrumentReadings {
            heading: Some(1.0),
            height: Some(100.0),
            ..InstrumentReadings::default()
        };
        let at = GroundPoint::new(0.0, 0.0);
        let prior = Follower::new(settings).prior(0.0, at, 10.0, &measured);
        let headings = prior.heading.candidates(0.05);
        let greatest = headings.iter().copied().fold(f64::MIN, f64::max);
        assert!((greatest - 1.4).abs() < 1e-9, "{greatest}");
        let highest = prior.heights(0.05).into_iter().fold(f64::MIN, f64::max);
        assert!((highest - 125.0).abs() < 1e-9, "{highest}");
        assert!((settings.heading_limit() - 0.4).abs() < 1e-12);
        assert!((settings.height_limit() - 0.25).abs() < 1e-12);
    }

    #[test]
    fn a_frame_teaches_of_the_maps_shape_what_it_says_beyond_the_prior() {
        let mut follower = Follower::new(FollowSettings::default());
        let at = GroundPoint::new(0.0, 0.0);
        let prior =
            |follower: &Follower| follower.prior(0.0, at, 10.0, &InstrumentReadings::default());
        // Laid as a whole, a frame has the prior's variance of the shape.
        for _ in 0..10 {
            let prior = prior(&follower);
            let mut laid = laid_at(0.0, 0.0, 0.99);
            for axis in [6, 7] {
                laid.fit.covariance[(axis, axis)] = prior.shape_deviation.powi(2);
            }
            follower.learn(0.0, 0.0, &prior, &laid);
        }
        for deviation in follower.shape_deviations() {
            assert!((deviation - 0.1).abs() < 1e-9, "{deviation}");
        }
        // A measurement of 0.05 with the variance 0.0016 makes of 0 and 0.01 a mean of 0.05 · 0.01 / 0.0116 and a
        // variance of 0.01 · 0.0016 / 0.0116; relief adds 0.0001 to the measurement's.
        let mut laid = laid_at(0.0, 0.0, 0.99);
        laid.fit.at.shape.along = 0.05 * 0.01 / 0.0116;
        laid.fit.covariance[(6, 6)] = 0.01 * 0.0016 / 0.0116;
        laid.fit.covariance[(7, 7)] = 0.01;
        follower.learn(0.0, 0.0, &prior(&follower), &laid);
        let shape = follower.shape();
        assert!((shape.along - 0.05 * 0.01 / 0.0117).abs() < 1e-9 && shape.across == 0.0);
        let variance = follower.shape_deviations()[0].powi(2);
        assert!(
            (variance - 0.01 * 0.0017 / 0.0117).abs() < 1e-9,
            "{variance}"
        );
    }
}
