//! A vehicle over a map that is not quite where it says.

use super::extended::{Extended, PairChange, StatePair};
use super::noise::GaussMarkov;
use super::{AirData, StateComponent};

/// Error of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapError {
    /// Standard deviation of the map's own place per axis, metres.
    pub deviation: f64,
    /// Way over ground after which the error has changed but for a share of 1/e, metres.
    pub reach: f64,
    /// Speed over ground, m/s, of a vehicle whose model knows no velocity: it flies, too, though its mean stays where it is.
    pub speed: f64,
}

impl MapError {
    /// A map that is off by `deviation` metres per axis.
    ///
    /// Two maps of one place that were made by different dates' pictures are shifted against each other by the same
    /// 2.5 m over 600 m, to within the metre to which that can be measured; over kilometres it may change.
    pub fn of(deviation: f64) -> Self {
        Self {
            deviation,
            reach: 2000.0,
            speed: AirData::default().cruise_airspeed,
        }
    }
}

/// A vehicle of `M` states over a map. State: that of the vehicle, then how far north and how far east of the truth the
/// map shows things where the vehicle is, metres: a Gauss-Markov process of the way flown.
///
/// What is seen on the map tells the sum of the two, so that no number of frames tells the position better than the
/// map is known; what tells the position itself tells the map's error as well.
pub type OverMap<const M: usize> = Extended<M, MapError>;

impl StatePair for MapError {
    const COMPONENTS: [StateComponent; 2] =
        [StateComponent::MapErrorNorth, StateComponent::MapErrorEast];

    fn change(&self, way: impl FnOnce() -> Option<f64>, dt: f64) -> PairChange {
        let way = way().unwrap_or(self.speed * dt.abs());
        let change = GaussMarkov::over(self.deviation, self.reach, way);
        PairChange {
            left: change.persistence,
            added: [change.value_variance; 2],
        }
    }

    fn prior_variances(&self) -> [f64; 2] {
        [self.deviation.powi(2); 2]
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use nalgebra::{Matrix2, SVector, Vector2};
    use pilotage_base::frames::GroundPoint;

    use super::*;
    use crate::filter::{Gaussian, Ukf, UnscentedSettings};
    use crate::vehicle::{
        ConstantVelocity, ControlInput, RandomWalk, VehicleModel as _, VelocityDriven,
    };

    fn over_map() -> OverMap<4> {
        OverMap::new(Arc::new(ConstantVelocity::default()), MapError::of(3.0))
    }

    /// A filter after `frames` frames a second apart that the map shows 2 m north and 1 m east of the truth, each good to
    /// half a metre, and after fixes of the position itself where `fixes` says so.
    fn flown(frames: usize, fixes: bool) -> Gaussian<6> {
        let model = over_map();
        let prior = model.prior(GroundPoint::new(0.0, 0.0), 20.0);
        let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
        let noise = Matrix2::from_diagonal_element(0.25);
        for frame in 0..frames {
            let truth = Vector2::new(0.0, frame as f64 * 0.5);
            let input = ControlInput::default();
            let dt = if frame == 0 { 0.0 } else { 1.0 };
            let of_motion = model.process_noise(&filter.state().mean, &input, dt);
            filter
                .predict(|x| model.propagate(x, &input, dt), &of_motion)
                .unwrap();
            let on_map = |x: &SVector<f64, 6>| Some(Vector2::new(x[0] + x[4], x[1] + x[5]));
            let expected = filter.predict_measurement(on_map, &noise).unwrap();
            filter
                .correct(&expected, &(truth + Vector2::new(2.0, 1.0)))
                .unwrap();
            if fixes {
                let place = |x: &SVector<f64, 6>| Some(Vector2::new(x[0], x[1]));
                let expected = filter.predict_measurement(place, &noise).unwrap();
                filter.correct(&expected, &truth).unwrap();
            }
        }
        filter.state()
    }

    #[test]
    fn a_hundred_frames_do_not_tell_the_position_better_than_the_map_is_known() {
        let belief = flown(100, false);
        let deviation = belief.covariance[(0, 0)].sqrt();
        assert!((2.8..3.2).contains(&deviation), "{deviation}");
        // The sum is known as well as the frames tell it.
        let sum =
            belief.covariance[(0, 0)] + belief.covariance[(4, 4)] + 2.0 * belief.covariance[(0, 4)];
        assert!(sum.sqrt() < 0.5, "{sum}");
    }

    #[test]
    fn fixes_of_the_position_tell_how_far_the_map_is_off() {
        let belief = flown(100, true);
        assert!((belief.mean[4] - 2.0).abs() < 0.3, "{}", belief.mean);
        assert!((belief.mean[5] - 1.0).abs() < 0.3, "{}", belief.mean);
        assert!(belief.covariance[(4, 4)].sqrt() < 0.3);
    }

    #[test]
    fn far_away_the_map_is_off_by_something_else() {
        let model = over_map();
        let mut state = SVector::<f64, 6>::zeros();
        (state[3], state[4]) = (20.0, 3.0);
        let input = ControlInput::default();
        let later = model.propagate(&state, &input, 100.0);
        assert!(
            (later[4] - 3.0 / std::f64::consts::E).abs() < 1e-9,
            "{later}"
        );
        let added = model.process_noise(&state, &input, 100.0)[(4, 4)];
        // Together with what is left it is as far off as anywhere.
        let left = (-2.0_f64).exp() * 9.0;
        assert!((added + left - 9.0).abs() < 1e-9, "{added}");
    }
    #[test]
    fn the_map_changes_under_a_vehicle_whose_model_knows_no_velocity() {
        let error = MapError {
            speed: 20.0,
            ..MapError::of(3.0)
        };
        let input = ControlInput::default();
        // 2 km at 20 m/s: 1/e is left, and 9 m² (1 - 1/e²) are new.
        let (left, added) = ((-1.0_f64).exp(), 9.0 * (1.0 - (-2.0_f64).exp()));
        let walk = OverMap::<2>::new(Arc::new(RandomWalk::default()), error);
        let state = nalgebra::Vector4::new(50.0, 60.0, 2.0, 0.0);
        let later = walk.propagate(&state, &input, 100.0);
        assert!((later[2] - 2.0 * left).abs() < 1e-9, "{later}");
        let noise = walk.process_noise(&state, &input, 100.0)[(2, 2)];
        assert!((noise - added).abs() < 1e-9, "{noise}");
        // The same while a velocity is not measured; one of zero is one that is known.
        let driven = OverMap::<4>::new(Arc::new(VelocityDriven::default()), error);
        let noise = |input| driven.process_noise(&SVector::zeros(), &input, 100.0)[(4, 4)];
        assert!((noise(input) - added).abs() < 1e-9, "{}", noise(input));
        let standing = ControlInput {
            ground_velocity: Some(Vector2::zeros()),
            ..input
        };
        assert_eq!(noise(standing), 0.0);
    }
}
