//! Pairs of landmarks seen on other days with those of the map: how many are right.

use std::fmt;

use nalgebra::{Matrix2, Matrix4, Point3, Vector2, Vector4};
use rand_distr::{Distribution, StandardNormal};

use super::looks::GeneratedLooks;
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_reference::association::CommonError;
use pilotage_reference::seeing::PictureView;
use pilotage_vision::ground_class::CoverNetwork;

/// Distance of the two landmarks of a right pair at the true pose, at most, metres.
const SAME: f64 = 8.0;
/// Believed errors of roll, pitch and yaw (radians) and height (metres).
const DEVIATIONS: [f64; 4] = [0.0183, 0.0183, 0.0201, 0.6];

/// Counts over pictures.
#[derive(Clone, Debug, Default)]
pub struct PairCounts {
    /// Pictures.
    pub pictures: usize,
    /// Landmarks seen in them.
    pub seen: usize,
    /// Pictures with a fix.
    pub fixes: usize,
    /// Accepted pairs.
    pub accepted: usize,
    /// Accepted pairs whose landmarks are not the same thing.
    pub wrong: usize,
    /// Sum of the probabilities of the accepted pairs.
    pub stated: f64,
    /// Sum of the normalized squares of the fixes' errors, two degrees of freedom each.
    pub squares: f64,
    /// Fixes whose error is not explained by its covariance at one in a million.
    pub wild: usize,
}

impl PairCounts {
    /// Looks at `pictures` places of the country of `country` on a day drawn by `day`, the position believed being
    /// off by `deviation` metres per axis and the attitude as instruments err.
    pub fn look(
        &mut self,
        (country, day): (u64, u64),
        pictures: usize,
        deviation: f64,
        network: &CoverNetwork,
    ) {
        let mut looks = GeneratedLooks::of(country, day, network);
        let variances = Vector4::from(DEVIATIONS).map(|sd| sd * sd);
        for _ in 0..pictures {
            let (pose, picture) = looks.take();
            let mut normal = || -> f64 { StandardNormal.sample(&mut looks.random) };
            let off = Vector2::from_fn(|_, _| deviation * normal());
            let errors = DEVIATIONS.map(|sd| sd * normal());
            let mut believed: Pose = pose;
            believed.position_in_world.x += off.x;
            believed.position_in_world.y += off.y;
            believed.position_in_world.z -= errors[3];
            believed.attitude.roll += errors[0];
            believed.attitude.pitch += errors[1];
            believed.attitude.yaw += errors[2];
            let model = looks.camera.model().clone();
            self.pictures += 1;
            let Some(view) = PictureView::of(&model, &believed, 0.0, &picture, network) else {
                continue;
            };
            self.seen += view.seen.len();
            let seen = view.seen.iter();
            let told = seen.filter_map(|landmark| {
                let told = view.observed(landmark)?;
                // Where it lies by the true pose.
                let point = Point3::new(landmark.place.north, landmark.place.east, 0.0);
                let pixel = model.project(&believed, &point)?;
                Some((told, model.ground_at(&pose, &pixel, 0.0)?))
            });
            let (observed, places): (Vec<_>, Vec<GroundPoint>) = told.unzip();
            let around = view.around(&mut looks.known, 230.0 + 3.5 * deviation);
            let common = CommonError {
                position: Matrix2::identity() * deviation * deviation,
                pose: Matrix4::from_diagonal(&variances),
            };
            let found = view.associated(&observed, &around, common);
            for pair in found.pairs.iter().filter(|pair| pair.accepted) {
                self.accepted += 1;
                self.stated += pair.probability;
                let apart = places[pair.observed].distance(&around[pair.possible].place);
                self.wrong += usize::from(apart > SAME);
            }
            if let Some(fix) = found.fix {
                self.fixes += 1;
                let error = fix.offset + off;
                let weight = fix.covariance.try_inverse().unwrap_or_default();
                let squared = (weight * error).dot(&error);
                self.squares += squared;
                self.wild += usize::from(squared > 27.6);
            }
        }
    }
}

impl fmt::Display for PairCounts {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seen = self.seen as f64 / self.pictures.max(1) as f64;
        writeln!(
            to,
            "{} pictures with {seen:.1} landmarks each, {} fixes, {} of them wild, NIS per degree {:.3}",
            self.pictures,
            self.fixes,
            self.wild,
            self.squares / (2 * self.fixes).max(1) as f64
        )?;
        writeln!(
            to,
            "{} accepted pairs, {} wrong ({:.5}), expected by their probabilities {:.1}",
            self.accepted,
            self.wrong,
            self.wrong as f64 / self.accepted.max(1) as f64,
            self.accepted as f64 - self.stated
        )
    }
}
