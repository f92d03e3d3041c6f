//! Errors of a camera's pose that all observations in one picture share, counted once.
//!
//! What is observed in a picture is z = h(x) + J e + v: the errors e of roll, pitch, yaw and height, of covariance P, are
//! the same for landmarks, roads and whatever else is seen in it, and v, of covariance D, is each observation's own. Taken
//! in one after the other as if their errors were independent, they would make the filter surer than they are. Together
//! they have the likelihood p(z₁ | x) p(z₂ | x, z₁), and at a given state the first ones tell of e:
//! e | x, z₁ has the mean P′ J₁ᵀ D₁⁻¹ (z₁ - h₁(x)) and the covariance P′ = (P⁻¹ + J₁ᵀ D₁⁻¹ J₁)⁻¹. So the second one is
//! expected to be h₂(x) + J₂ E[e | x, z₁], with the noise D₂ + J₂ P′ J₂ᵀ.

use nalgebra::{DVector, Matrix4, Matrix4xX, Vector4};

use super::engine::MeasurementModel;
use super::observation::{Observation, PicturePart};
use pilotage_estimation::vehicle::Kinematics;

/// Errors of the pose of one picture, as far as what was taken in of it tells them.
pub struct PictureErrors<'a> {
    /// Covariance before anything was observed, and after.
    prior: Matrix4<f64>,
    covariance: Matrix4<f64>,
    /// Observations that were taken in, with Jᵀ D⁻¹.
    taken: Vec<(Observation<'a>, Matrix4xX<f64>)>,
}

impl<'a> PictureErrors<'a> {
    /// Errors of the covariance `prior`, of which nothing is known yet.
    pub fn new(prior: Matrix4<f64>) -> Self {
        Self {
            prior,
            covariance: prior,
            taken: Vec::new(),
        }
    }

    /// Notes that an observation was taken in: it tells of the errors from here on.
    pub fn note(&mut self, observation: Observation<'a>) {
        let Some(PicturePart { by_pose, own }) = &observation.in_picture else {
            return;
        };
        // What the observation has in common with earlier pictures makes it tell less of this one, too.
        let own = match &observation.weakened {
            Some(weakened) => own + weakened - &observation.noise,
            None => own.clone(),
        };
        let across = by_pose * self.covariance;
        let spread = &own + &across * by_pose.transpose();
        if let (Some(own), Some(spread)) = (own.cholesky(), spread.cholesky()) {
            self.covariance -= across.transpose() * spread.solve(&across);
            let weights = own.solve(by_pose).transpose();
            self.taken.push((observation, weights));
        }
    }

    /// The observation as it is to be taken in after those that were; itself where it shares nothing with them.
    pub fn given<'b>(&'b self, observation: &'b Observation<'a>) -> Option<Observation<'b>> {
        let PicturePart { by_pose, own } = observation.in_picture.as_ref()?;
        if self.taken.is_empty() {
            return None;
        }
        let left = by_pose * self.covariance * by_pose.transpose();
        let known = by_pose * (self.prior - self.covariance) * by_pose.transpose();
        let of = move |seen: &Kinematics| {
            let expected = (observation.model.of)(seen)?;
            Some(expected + by_pose * self.at(seen)?)
        };
        Some(Observation {
            measured: observation.measured.clone(),
            noise: own + left,
            weakened: observation.weakened.as_ref().map(|noise| noise - known),
            model: MeasurementModel {
                of: Box::new(of),
                part: observation.model.part,
            },
            degrees: observation.degrees,
            in_picture: None,
        })
    }

    /// Mean of the errors if the vehicle moved so.
    fn at(&self, seen: &Kinematics) -> Option<Vector4<f64>> {
        let mut sum = Vector4::zeros();
        for (observation, weights) in &self.taken {
            let residual: DVector<f64> = &observation.measured - (observation.model.of)(seen)?;
            sum += weights * residual;
        }
        Some(self.covariance * sum)
    }
}

#[cfg(test)]
mod tests {
    use super::super::aids::take;
    use super::super::engine::{Engine, engine};
    use super::*;
    use nalgebra::{DMatrix, MatrixXx4, dvector};
    use pilotage_base::frames::GroundPoint;
    use pilotage_estimation::filter::Gate;
    use pilotage_mission::settings::NavigatorSettings;

    const GATE: Gate = Gate { confidence: 0.999 };

    /// Place of the aircraft as seen from 300 m, by whose errors of roll and pitch it is off.
    fn place(north: f64, east: f64, own: f64, pose: &Matrix4<f64>) -> Observation<'static> {
        let by_pose = MatrixXx4::from_row_slice(&[0.0, 300.0, 5.0, 0.1, -300.0, 0.0, -8.0, -0.2]);
        let own = DMatrix::identity(2, 2) * own * own;
        Observation {
            measured: dvector![north, east],
            noise: &own + &by_pose * pose * by_pose.transpose(),
            weakened: None,
            model: MeasurementModel::of_pose(|seen| {
                Some(dvector![seen.on_map.north, seen.on_map.east])
            }),
            degrees: 2,
            in_picture: Some(PicturePart { by_pose, own }),
        }
    }

    /// Both as one observation with all that they share.
    fn stacked(parts: [&Observation<'static>; 2], pose: &Matrix4<f64>) -> Observation<'static> {
        let [a, b] = parts.map(|part| part.in_picture.as_ref().unwrap());
        let mut by_pose = MatrixXx4::zeros(4);
        let mut own = DMatrix::zeros(4, 4);
        for (row, part) in [(0, a), (2, b)] {
            by_pose.rows_mut(row, 2).copy_from(&part.by_pose);
            own.view_mut((row, row), (2, 2)).copy_from(&part.own);
        }
        let all = parts.iter().flat_map(|part| part.measured.iter());
        Observation {
            measured: DVector::from_iterator(4, all.copied()),
            noise: own + &by_pose * pose * by_pose.transpose(),
            weakened: None,
            model: MeasurementModel::of_pose(|seen| {
                let GroundPoint { north, east } = seen.on_map;
                Some(dvector![north, east, north, east])
            }),
            degrees: 4,
            in_picture: None,
        }
    }

    fn filter() -> Box<dyn Engine> {
        engine(
            &NavigatorSettings::default(),
            GroundPoint::new(0.0, 0.0),
            4.0,
        )
        .unwrap()
    }

    #[test]
    fn two_sights_in_one_picture_tell_as_much_as_both_in_one_observation() {
        let pose = Matrix4::from_diagonal(&Vector4::new(0.018, 0.018, 0.02, 0.6).map(|s| s * s));
        let (first, second) = (place(3.0, -2.0, 0.5, &pose), place(4.0, -1.0, 1.5, &pose));
        let mut at_once = filter();
        let together = stacked([&first, &second], &pose);
        let taken = take(at_once.as_mut(), &together, GATE).unwrap().unwrap();
        let mut one_by_one = filter();
        let mut errors = PictureErrors::new(pose);
        assert!(errors.given(&first).is_none());
        let nis = take(one_by_one.as_mut(), &first, GATE).unwrap().unwrap();
        let before = one_by_one.state().position_covariance();
        errors.note(first);
        let given = errors.given(&second).unwrap();
        let then = take(one_by_one.as_mut(), &given, GATE).unwrap().unwrap();
        let after = one_by_one.state().position_covariance();
        // The second one is hardly news: most of what both err is the same.
        assert!(after.trace() > 0.97 * before.trace(), "{before} {after}");
        let off = (at_once.state().mean - one_by_one.state().mean).norm();
        assert!(off < 1e-9, "{off}");
        let covariances = at_once.state().covariance - one_by_one.state().covariance;
        assert!(covariances.norm() < 1e-9, "{covariances}");
        let sum = nis.verdict.nis + then.verdict.nis;
        assert!((sum - taken.verdict.nis).abs() < 1e-9);
    }
}
