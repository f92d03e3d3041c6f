//! Adjustment of a camera so that it goes with its log.

use serde::{Deserialize, Serialize};

use pilotage_flight::Flight;
use pilotage_raster::camera::CameraModel;

/// Fastest drift that a clock can be said to have, seconds per second.
const MOST_DRIFT: f64 = 0.1;

/// A camera's clock, mount and lens changed. Time by the log is t + `offset` + `drift` (t - `middle`) for a time
/// t of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CameraAdjustment {
    /// Seconds to add to the times of the frames at `middle`.
    #[serde(rename = "offset_s")]
    pub offset: f64,
    /// Seconds per second by which the camera's clock is slow.
    pub drift: f64,
    /// Time by the camera about which the drift counts, seconds.
    #[serde(rename = "middle_s")]
    pub middle: f64,
    /// To add to the mount's roll, radians.
    #[serde(rename = "roll_rad")]
    pub roll: f64,
    /// To add to the mount's pitch, radians.
    #[serde(rename = "pitch_rad")]
    pub pitch: f64,
    /// To add to the mount's yaw, radians.
    #[serde(rename = "yaw_rad")]
    pub yaw: f64,
    /// Natural logarithm of the factor on the focal length.
    pub log_focal: f64,
}

impl CameraAdjustment {
    /// Nothing changed, with the drift to be counted about `middle`, seconds.
    pub fn none(middle: f64) -> Self {
        Self {
            middle,
            ..Self::default()
        }
    }

    /// Whether it changes nothing.
    pub fn is_none(&self) -> bool {
        *self == Self::none(self.middle)
    }

    /// Whether all its numbers are finite, the clock runs forwards and the lens stays one.
    pub fn is_sound(&self) -> bool {
        let numbers = [
            self.offset,
            self.middle,
            self.roll,
            self.pitch,
            self.yaw,
            self.log_focal,
        ];
        numbers.iter().all(|n| n.is_finite())
            && self.drift.abs() <= MOST_DRIFT
            && self.log_focal.abs() <= 3.0
    }

    /// Time by the log, seconds, of a time by the camera.
    ///
    /// ```
    /// use pilotage_mission::settings::CameraAdjustment;
    ///
    /// // A clock that is 2 s behind the log's at its 100th second and loses 10 ms a second.
    /// let adjustment = CameraAdjustment { offset: 2.0, drift: 0.01, ..CameraAdjustment::none(100.0) };
    /// assert_eq!(adjustment.time(100.0), 102.0);
    /// assert!((adjustment.time(200.0) - 203.0).abs() < 1e-9);
    /// ```
    pub fn time(&self, camera_time: f64) -> f64 {
        camera_time + self.offset + self.drift * (camera_time - self.middle)
    }

    /// The same change of the clock told about another time by the camera, seconds.
    #[must_use]
    pub fn about(&self, middle: f64) -> Self {
        Self {
            offset: self.time(middle) - middle,
            middle,
            ..*self
        }
    }

    /// This and then `next`, as one: its times are those that this one gives.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            offset: next.time(self.time(self.middle)) - self.middle,
            drift: (1.0 + self.drift) * (1.0 + next.drift) - 1.0,
            middle: self.middle,
            roll: self.roll + next.roll,
            pitch: self.pitch + next.pitch,
            yaw: self.yaw + next.yaw,
            log_focal: self.log_focal + next.log_focal,
        }
    }

    /// Adjustment that is left after `done`: `done.then(&self.beyond(&done))` does what this one does.
    #[must_use]
    pub fn beyond(&self, done: &Self) -> Self {
        let middle = done.time(self.middle);
        Self {
            offset: self.time(self.middle) - middle,
            drift: (1.0 + self.drift) / (1.0 + done.drift) - 1.0,
            middle,
            roll: self.roll - done.roll,
            pitch: self.pitch - done.pitch,
            yaw: self.yaw - done.yaw,
            log_focal: self.log_focal - done.log_focal,
        }
    }

    /// Change of the focal length, percent of it.
    pub fn focal_percent(&self) -> f64 {
        100.0 * self.log_focal.exp_m1()
    }

    /// The flight with its frames at the log's times and its camera changed.
    pub fn apply(&self, flight: &Flight) -> Flight {
        let mut flight = flight.clone();
        for frame in &mut flight.frames {
            frame.time = self.time(frame.time);
        }
        self.change(&mut flight.camera);
        flight
    }

    /// Changes the mount and the focal length of a camera; a mount that was put right is stated from then on.
    pub fn change(&self, camera: &mut CameraModel) {
        if self.roll != 0.0 && self.pitch != 0.0 {
            camera.mount_deviation = 0.0;
        }
        camera.mount.roll += self.roll;
        camera.mount.pitch += self.pitch;
        camera.mount.yaw += self.yaw;
        camera.focal *= self.log_focal.exp();
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn any() -> impl Strategy<Value = CameraAdjustment> {
        let clock = (-5.0..5.0, -1e-2..1e-2, -500.0..500.0);
        let camera = (-0.3..0.3, -0.3..0.3, -0.3..0.3, -0.2..0.2);
        (clock, camera).prop_map(|((offset, drift, middle), (roll, pitch, yaw, log_focal))| {
            CameraAdjustment {
                offset,
                drift,
                middle,
                roll,
                pitch,
                yaw,
                log_focal,
            }
        })
    }

    proptest! {
        #[test]
        fn two_changes_one_after_the_other_are_one(a in any(), b in any(), t in 0.0..1000.0) {
            let both = a.then(&b);
            prop_assert!((both.time(t) - b.time(a.time(t))).abs() < 1e-9);
            prop_assert!((both.yaw - a.yaw - b.yaw).abs() < 1e-12);
        }

        #[test]
        fn what_is_left_completes_what_was_done(a in any(), b in any(), t in 0.0..1000.0) {
            let whole = a.then(&b.beyond(&a));
            prop_assert!((whole.time(t) - b.time(t)).abs() < 1e-9);
            prop_assert!((whole.pitch - b.pitch).abs() < 1e-12);
            prop_assert!((whole.log_focal - b.log_focal).abs() < 1e-12);
        }

        #[test]
        fn a_clock_told_about_another_time_is_the_same_clock(a in any(), middle in -500.0..500.0, t in 0.0..1000.0) {
            prop_assert!((a.about(middle).time(t) - a.time(t)).abs() < 1e-9);
        }
    }

    #[test]
    fn a_doubled_focal_length_is_a_hundred_percent_more() {
        let doubled = CameraAdjustment {
            log_focal: 2_f64.ln(),
            ..CameraAdjustment::default()
        };
        assert!((doubled.focal_percent() - 100.0).abs() < 1e-9);
    }

    #[test]
    fn a_clock_that_runs_backwards_is_not_sound() {
        assert!(CameraAdjustment::none(3.0).is_sound());
        let backwards = CameraAdjustment {
            drift: -1.5,
            ..CameraAdjustment::default()
        };
        assert!(!backwards.is_sound());
    }

    #[test]
    fn a_mount_that_was_put_right_is_stated_and_a_turned_lens_tells_nothing_of_it() {
        let after = |roll, pitch| {
            let mut camera = CameraModel::pinhole(320, 240, 1.0);
            camera.mount_deviation = 0.17;
            let adjustment = CameraAdjustment {
                roll,
                pitch,
                yaw: 0.1,
                ..CameraAdjustment::default()
            };
            adjustment.change(&mut camera);
            camera.mount_deviation
        };
        assert_eq!((after(0.02, -0.1), after(0.0, 0.0)), (0.0, 0.17));
    }
}
