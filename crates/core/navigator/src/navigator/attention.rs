//! Choice of the landmarks to look for in a frame when more may be in view than there is time for.
//!
//! A filter that knows where it is looks for the most central ones. To one that is lost all of a county's
//! villages may be in view, each with a small probability: were it to look for the same ones in every
//! frame, it could fly over the next without ever looking for it.

use nalgebra::{Matrix2, Point2};

use pilotage_base::statistics::normal_probability;
use pilotage_raster::camera::CameraModel;

/// Probability from which on a landmark is taken to be in view.
const LIKELY: f64 = 0.5;
/// Landmarks whose probabilities differ by less than this factor are looked for in turn.
const ALIKE: f64 = 2.0;

/// Probability that the middle of a landmark, expected at `pixel` with `covariance` (pixels²), lies in the
/// picture.
pub fn probability_of_view(
    camera: &CameraModel,
    pixel: &Point2<f64>,
    covariance: &Matrix2<f64>,
) -> f64 {
    let within = |middle: f64, variance: f64, size: usize| {
        let deviation = variance.max(1e-12).sqrt();
        normal_probability((size as f64 - middle) / deviation)
            - normal_probability(-middle / deviation)
    };
    within(pixel.x, covariance[(0, 0)], camera.width)
        * within(pixel.y, covariance[(1, 1)], camera.height)
}

/// Landmarks to look for in frame number `frame`, chosen by these probabilities of being in view, the most
/// central first: at most `most`, as indices in that order.
///
/// Those that are likely in view, the most central of them first; then those that are less likely, where
/// such as are about as likely take turns from frame to frame.
pub fn attended(probabilities: &[f64], most: usize, frame: usize) -> Vec<usize> {
    let count = probabilities.len();
    if count <= most {
        return (0..count).collect();
    }
    let (mut chosen, mut rest): (Vec<usize>, Vec<usize>) =
        (0..count).partition(|i| probabilities[*i] >= LIKELY);
    chosen.truncate(most);
    let left = most - chosen.len();
    if left > 0 {
        rest.sort_by(|a, b| probabilities[*b].total_cmp(&probabilities[*a]));
        let last = probabilities[rest[left - 1]];
        let sure = rest.partition_point(|i| probabilities[*i] > ALIKE * last);
        let alike = rest.partition_point(|i| probabilities[*i] >= last / ALIKE);
        chosen.extend(&rest[..sure]);
        let turns = &rest[sure..alike];
        let first = frame * (left - sure);
        chosen.extend((0..left - sure).map(|i| turns[(first + i) % turns.len()]));
        chosen.sort_unstable();
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_that_is_expected_in_the_middle_is_in_view_and_a_lost_filter_is_not_sure_of_any() {
        let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
        let at = |x: f64, sigma: f64| {
            let covariance = Matrix2::identity() * (sigma * sigma);
            probability_of_view(&camera, &Point2::new(x, 240.0), &covariance)
        };
        assert!(at(320.0, 10.0) > 0.999);
        assert!((at(0.0, 10.0) - 0.5).abs() < 1e-6);
        assert!(at(-100.0, 10.0) < 1e-6);
        // A picture among very many: its area times the density.
        let lost = 640.0 * 480.0 / (std::f64::consts::TAU * 9000.0 * 9000.0);
        assert!((at(320.0, 9000.0) / lost - 1.0).abs() < 0.01);
    }

    #[test]
    fn the_most_central_of_those_in_view_are_looked_for_in_every_frame() {
        let sure = [1.0, 0.9, 1.0, 0.8, 0.7];
        assert_eq!(attended(&sure, 3, 0), [0, 1, 2]);
        assert_eq!(attended(&sure, 3, 7), [0, 1, 2]);
        assert_eq!(attended(&sure, 9, 7), [0, 1, 2, 3, 4]);
    }

    #[test]
    fn of_many_that_are_as_unlikely_none_is_left_out_for_long_and_the_likelier_ones_stay() {
        let mut probabilities = vec![0.02; 20];
        probabilities[7] = 0.9;
        probabilities[3] = 0.1;
        probabilities[19] = 0.001;
        let mut looked = [0; 20];
        for frame in 0..9 {
            let chosen = attended(&probabilities, 4, frame);
            assert_eq!(chosen.len(), 4);
            assert!(chosen.is_sorted() && chosen.windows(2).all(|w| w[0] != w[1]));
            for i in chosen {
                looked[i] += 1;
            }
        }
        assert_eq!((looked[7], looked[3], looked[19]), (9, 9, 0));
        let others = (0..19).filter(|i| ![3, 7].contains(i));
        assert!(others.clone().all(|i| looked[i] >= 1), "{looked:?}");
    }
}
