//! A vehicle whose camera is tilted otherwise than its instruments say.

use super::StateComponent;
use super::extended::{Extended, PairChange, StatePair};

/// Error of a camera's roll and of its pitch that stays the same over a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiltBias {
    /// Standard deviation of each of the two, radians.
    pub deviation: f64,
}

/// A vehicle of `M` states whose camera reads a wrong tilt. State: that of the vehicle, then the biases of roll and pitch,
/// radians: reading minus truth.
///
/// From a height h a bias b moves what is seen by h b, in every picture alike, and turns with the heading: as noise that is
/// new in each picture it would be averaged away. A straight flight tells the sum of it and the position; from the first
/// turn on the two part.
pub type Tilted<const M: usize> = Extended<M, TiltBias>;

impl StatePair for TiltBias {
    const COMPONENTS: [StateComponent; 2] = [StateComponent::RollBias, StateComponent::PitchBias];

    fn change(&self, _way: impl FnOnce() -> Option<f64>, _dt: f64) -> PairChange {
        PairChange {
            left: 1.0,
            added: [0.0; 2],
        }
    }

    fn prior_variances(&self) -> [f64; 2] {
        [self.deviation.powi(2); 2]
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};
    use std::sync::Arc;

    use nalgebra::{Matrix2, Matrix2x4, Matrix4, Rotation2, SVector, Vector2, Vector4};
    use pilotage_base::frames::GroundPoint;

    use super::*;
    use crate::filter::{Gaussian, Ukf, UnscentedSettings};
    use crate::vehicle::{ControlInput, RandomWalk, VehicleModel as _};

    const HEIGHT: f64 = 300.0;
    const BIAS: f64 = 0.0026;
    const START: f64 = 20.0;
    const NOISE: f64 = 1.6;

    /// Change of the place that is seen with the state (north, east, roll bias, pitch bias) at a heading, radians.
    fn slope(heading: f64) -> Matrix2x4<f64> {
        let turned = Rotation2::new(heading).into_inner() * HEIGHT;
        Matrix2x4::from_columns(&[
            Vector2::x(),
            Vector2::y(),
            -turned.column(1).into_owned(),
            turned.column(0).into_owned(),
        ])
    }

    /// Places that are seen in ten frames at each of the headings, of a vehicle that stands at the origin.
    fn seen(headings: &[f64]) -> Vec<(Matrix2x4<f64>, Vector2<f64>)> {
        let biases = Vector4::new(0.0, 0.0, 1.5 * BIAS, -0.8 * BIAS);
        let frames = headings.iter().flat_map(|heading| [*heading; 10]);
        let frames = frames.enumerate().map(|(k, heading)| {
            let off = Vector2::new((3.0 * k as f64).sin(), (5.0 * k as f64).cos());
            (slope(heading), slope(heading) * biases + NOISE * off)
        });
        frames.collect()
    }

    /// Belief of a filter after all of them.
    fn filtered(headings: &[f64]) -> Gaussian<4> {
        let still = RandomWalk {
            position_noise_density: 0.0,
        };
        let model = Tilted::<2>::new(Arc::new(still), TiltBias { deviation: BIAS });
        let prior = model.prior(GroundPoint::new(0.0, 0.0), START);
        let mut filter = Ukf::new(prior, UnscentedSettings::default()).unwrap();
        let noise = Matrix2::from_diagonal_element(NOISE * NOISE);
        let input = ControlInput::default();
        for (slope, place) in seen(headings) {
            let of_motion = model.process_noise(&filter.state().mean, &input, 0.5);
            filter
                .predict(|x| model.propagate(x, &input, 0.5), &of_motion)
                .unwrap();
            let expected = |x: &SVector<f64, 4>| Some(slope * x);
            let expected = filter.predict_measurement(expected, &noise).unwrap();
            filter.correct(&expected, &place).unwrap();
        }
        filter.state()
    }

    #[test]
    fn all_frames_together_tell_what_the_least_squares_of_position_and_tilt_tell() {
        for headings in [&[0.4][..], &[0.4, 0.4 + FRAC_PI_2, 0.4 + PI]] {
            let [place, tilt] = [START, BIAS].map(|deviation| deviation.powi(-2));
            let mut information = Matrix4::from_diagonal(&Vector4::new(place, place, tilt, tilt));
            let mut weighed = Vector4::zeros();
            for (slope, place) in seen(headings) {
                information += slope.transpose() * slope / (NOISE * NOISE);
                weighed += slope.transpose() * place / (NOISE * NOISE);
            }
            let covariance = information.try_inverse().unwrap();
            let belief = filtered(headings);
            let unit = Vector4::new(1.0, 1.0, HEIGHT, HEIGHT);
            let off = (belief.mean - covariance * weighed).component_mul(&unit);
            assert!(off.norm() < 1e-6, "{off}");
            let units = Matrix4::from_diagonal(&unit);
            let off = units * (belief.covariance - covariance) * units;
            assert!(off.norm() < 1e-6, "{off}");
        }
    }

    #[test]
    fn a_straight_flight_knows_its_place_no_better_than_the_tilt_and_a_turn_parts_the_two() {
        let spread = |headings: &[f64]| filtered(headings).covariance[(0, 0)].sqrt();
        let by_tilt = HEIGHT * BIAS;
        let straight = spread(&[0.4; 20]);
        assert!(straight > 0.95 * by_tilt, "{straight} {by_tilt}");
        let there_and_back = spread(&[[0.4; 10], [0.4 + PI; 10]].concat());
        assert!(there_and_back < 0.3 * by_tilt, "{there_and_back}");
    }
}
