//! Looks at one landmark after the other, whose errors have something in common.
//!
//! Another sun and season move what a landmark looks like in the same way in every frame. A filter that takes such
//! errors for as many independent ones believes the landmark too much, the more often it looks. Of `k` looks with a
//! variance `B` that lasts and `C` that is each one's own, the mean has `B + C/k`. So the `k`-th look is taken for as
//! much as it adds to that: as if it had, by itself, the variance `(kB + C)((k-1)B + C)/C`.

use std::collections::BTreeMap;

use nalgebra::{Matrix4, Vector4};
use pilotage_mission::settings::SensorNoise;

/// Time out of view after which a landmark is looked at anew, seconds: what the filter knew by it has become old.
const OUT_OF_VIEW: f64 = 10.0;

/// Looks at each landmark that were taken in since it came into view.
#[derive(Clone, Debug, Default)]
pub struct LooksAtLandmarks(BTreeMap<u32, (u32, f64)>);

impl LooksAtLandmarks {
    /// Number of the next look at a landmark, from one on.
    pub fn next(&self, landmark: u32) -> u32 {
        self.0.get(&landmark).map_or(1, |(looks, _)| looks + 1)
    }

    /// Notes that a look at each of the `landmarks` was taken in at `time`, seconds.
    pub fn note(&mut self, landmarks: impl Iterator<Item = u32>, time: f64) {
        for landmark in landmarks {
            let look = (self.next(landmark), time);
            self.0.insert(landmark, look);
        }
    }

    /// Forgets, at `time` in seconds, the landmarks that are out of view for long.
    pub fn forget(&mut self, time: f64) {
        self.0.retain(|_, (_, last)| time - *last <= OUT_OF_VIEW);
    }
}

/// Variance that look number `look` has by itself, where errors of variance `lasting` are the same in all looks and
/// those of variance `own` are not.
pub fn variance_of_look(look: u32, lasting: f64, own: f64) -> f64 {
    if lasting <= 0.0 || own <= 0.0 {
        return lasting + own;
    }
    let with = |looks: f64| looks * lasting + own;
    let look = f64::from(look);
    with(look) * with(look - 1.0) / own
}

/// Part of the variances of an appearance that every look at the landmark has in common: the error `on_ground` that the
/// place has, as a covariance in the picture, and the biases in `noise` of the camera's pose, with which the appearance
/// changes by `jacobian` (roll, pitch, yaw, radians; height, metres).
pub fn lasting_variances(
    on_ground: &Matrix4<f64>,
    noise: &SensorNoise,
    jacobian: &Matrix4<f64>,
) -> Vector4<f64> {
    let tilt = noise.tilt_bias.powi(2);
    let biases = Vector4::new(
        tilt,
        tilt,
        noise.yaw_bias.powi(2),
        noise.height_bias.powi(2),
    );
    on_ground.diagonal() + jacobian.component_mul(jacobian) * biases
}

/// Covariance of an appearance as that of a look with nothing in common with others.
///
/// It is the `covariance` of look number `look`, beside what an error of the camera's pose does to it, whose covariance is
/// `of_pose`; the variances `lasting` of the two together are the same in all looks.
pub fn weakened(
    look: u32,
    covariance: &Matrix4<f64>,
    of_pose: &Matrix4<f64>,
    lasting: &Vector4<f64>,
) -> Matrix4<f64> {
    let mut weakened = *covariance;
    for (i, lasting) in lasting.iter().enumerate() {
        let together = covariance[(i, i)] + of_pose[(i, i)];
        weakened[(i, i)] += variance_of_look(look, *lasting, together - lasting) - together;
    }
    weakened
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_looks_tell_no_more_than_the_error_leaves_that_they_share() {
        let (lasting, own) = (0.25, 4.0);
        let mut information = 0.0;
        for look in 1..=200 {
            information += 1.0 / variance_of_look(look, lasting, own);
            let mean = lasting + own / f64::from(look);
            assert!((information * mean - 1.0).abs() < 1e-9, "look {look}");
        }
        assert!(1.0 / information > lasting);
        assert_eq!(variance_of_look(7, 0.0, own), own);
        assert_eq!(variance_of_look(7, lasting, 0.0), lasting);
    }

    #[test]
    fn looks_are_counted_as_long_as_a_landmark_comes_into_view_again() {
        let mut looks = LooksAtLandmarks::default();
        looks.note([3, 5].into_iter(), 10.0);
        looks.note([3].into_iter(), 10.5);
        looks.forget(20.2);
        assert_eq!([3, 5, 7].map(|landmark| looks.next(landmark)), [3, 1, 1]);
    }
}
