//! Pairs of landmarks seen on other days with those of the map: how many are right.

use std::fmt;

use nalgebra::{Matrix2, Matrix4, Point3, Vector2, Vector4};
use rand_distr::{Distribution, StandardNormal};

use super::looks::GeneratedLooks;
use pilotage_base::frames::{GroundPoint, Pose};
use pilotage_reference::GenericClass;
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
    /// Sum of what the pairs of the fixes leave, normalized, and its degrees of freedom.
    pub left: (f64, usize),
    /// Right ones of the accepted pairs, by class and by the error that is stated of their place.
    pub right: Vec<RightPairs>,
    /// Fixes whose error is not explained by its covariance at one in a million.
    pub wild: usize,
}

/// Right pairs of a class whose places are stated to be equally sure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RightPairs {
    /// Their class.
    pub class: GenericClass,
    /// Stated error of their place per axis, metres.
    pub stated: f64,
    /// Number of them.
    pub count: usize,
    /// Sum of the squares of their distances at the true pose, square metres.
    pub squares: f64,
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
                if apart > SAME {
                    self.wrong += 1;
                } else {
                    let seen = &observed[pair.observed];
                    self.note_right(seen.class, seen.covariance[(0, 0)].sqrt(), apart);
                }
            }
            if let Some(fix) = found.fix {
                self.fixes += 1;
                self.left.0 += fix.chi_square;
                self.left.1 += fix.degrees;
                let error = fix.offset + off;
                let weight = fix.covariance.try_inverse().unwrap_or_default();
                let squared = (weight * error).dot(&error);
                self.squares += squared;
                self.wild += usize::from(squared > 27.6);
            }
        }
    }

    fn note_right(&mut self, class: GenericClass, stated: f64, apart: f64) {
        let is_alike = |pairs: &RightPairs| pairs.class == class && pairs.stated == stated;
        let index = self.right.iter().position(is_alike).unwrap_or_else(|| {
            self.right.push(RightPairs {
                class,
                stated,
                count: 0,
                squares: 0.0,
            });
            self.right.len() - 1
        });
        self.right[index].count += 1;
        self.right[index].squares += apart * apart;
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
        )?;
        writeln!(
            to,
            "squares that the pairs of a fix leave, per degree {:.3}",
            self.left.0 / self.left.1.max(1) as f64
        )?;
        for pairs in &self.right {
            let measured = (pairs.squares / (2 * pairs.count) as f64).sqrt();
            let RightPairs {
                class,
                stated,
                count,
                ..
            } = pairs;
            let class = format!("{class:?}");
            writeln!(
                to,
                "{class:<9} {count:5} right pairs, place per axis {measured:.2} m, stated {stated:.2} m"
            )?;
        }
        Ok(())
    }
}
