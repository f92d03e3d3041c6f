//! Expected detection of a landmark that nobody tested: that of boxes anywhere on the same map.
//!
//! Until a landmark is tested, it is worth what a box at random is worth on its map, which is less than most that are
//! chosen with care achieve: boxes on fields are hardly ever found again, whatever catches the eye in them.

use nalgebra::{Matrix4, Vector4};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::assess::expectation;
use super::{ExpectedDetection, ViewResult};
use pilotage_base::frames::{GroundPoint, GroundRect};

/// Share of looks in which boxes at random are found on a map that was not tried, and of the frames of a day on which
/// they are: as on the worse of the two places whose maps of other dates were flown over, fields (57 of 324 looks; 194
/// of 329 in the town).
const ANY_MAP: (f64, f64) = (0.18, 0.9);
/// Deviations of a place that is found (metres north and east), of the rotation (radians) and of the logarithm of the
/// scale, where no box was found that would tell.
const SPREAD: Vector4<f64> = Vector4::new(0.5, 0.5, 0.01, 0.01);
/// Boxes that must have been looked at on a map for a statement about it.
const LEAST: usize = 8;

/// Expected detection of a landmark that nobody tested, and the number of boxes on which it rests.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UntestedDetection {
    /// Expected detection of one that is drawn at random.
    pub expected: ExpectedDetection,
    /// Number of boxes of this map that were looked at; zero where the statement is about any map.
    pub boxes: usize,
}

impl UntestedDetection {
    /// Number of boxes to look at.
    pub const BOXES: usize = 24;
    /// Number of looks at each, all on one day.
    pub const LOOKS: usize = 2;

    /// Statement about a map of which nothing is known.
    pub fn of_any_map() -> Self {
        let (found, per_frame) = ANY_MAP;
        Self {
            expected: ExpectedDetection {
                recognised: found / per_frame,
                per_frame,
                covariance: Matrix4::from_diagonal(&SPREAD.map(|deviation| deviation * deviation)),
            },
            boxes: 0,
        }
    }

    /// Statement about a map by the looks at each of some boxes of it; `None` if they are too few.
    ///
    /// A box is recognised or not as a landmark is on a day, so that a landmark drawn at random on a day drawn at
    /// random is one draw of both.
    pub fn of(boxes: &[Vec<ViewResult>]) -> Option<Self> {
        let seen: Vec<&Vec<ViewResult>> = boxes.iter().filter(|looks| !looks.is_empty()).collect();
        if seen.len() < LEAST {
            return None;
        }
        let tally = |looks: &Vec<ViewResult>| {
            let found = looks.iter().filter(|look| look.found()).count();
            (found as f64, looks.len() as f64)
        };
        let trials: Vec<(f64, f64)> = seen.iter().map(|looks| tally(looks)).collect();
        let told = seen.iter().zip(&trials);
        let told = told.map(|(looks, (found, all))| looks[0].lasting.unwrap_or(found / all));
        let lasts = seen.iter().any(|looks| looks[0].lasting.is_some());
        let lasting = lasts.then(|| told.sum::<f64>() / seen.len() as f64);
        let mut expected = expectation(&trials, lasting, seen.iter().copied().flatten());
        if trials.iter().all(|(found, _)| *found == 0.0) {
            expected.covariance = Self::of_any_map().expected.covariance;
        }
        Some(Self {
            expected,
            boxes: seen.len(),
        })
    }
}

/// So many square boxes anywhere in `within`, `side` metres wide, drawn by `seed`; none where it is too small.
pub fn random_boxes(within: &GroundRect, side: f64, count: usize, seed: u64) -> Vec<GroundRect> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let inner = within.grown(-0.5 * side);
    if inner.north <= inner.south || inner.east <= inner.west {
        return Vec::new();
    }
    let mut between = |low: f64, high: f64| low + (high - low) * random.random::<f64>();
    let mut place = |_| {
        let middle = GroundPoint::new(
            between(inner.south, inner.north),
            between(inner.west, inner.east),
        );
        GroundRect::centered(middle, side, side)
    };
    (0..count).map(&mut place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pilotage_vision::landmark::{Detection, Refusal, Sighting};

    fn look(found: bool, lasting: Option<f64>) -> ViewResult {
        let detection = Detection {
            ground: GroundPoint::new(0.0, 0.0),
            covariance: Matrix4::identity() * 0.04,
            score: 0.9,
            second_score: 0.1,
            probability: None,
            rotation: 0.0,
            scale: 1.0,
        };
        let refused = Sighting::Refused(Refusal::LowScore, None);
        let sighting = if found {
            Sighting::Found(detection)
        } else {
            refused
        };
        ViewResult {
            day: 0,
            heading: 0.0,
            height: 120.0,
            tilt: 0.0,
            attitude_error: 0.0,
            off_centre: 0.0,
            sighting,
            error: found.then_some(0.1),
            wrong: false,
            lasting,
        }
    }

    /// Looks at boxes of which every `of`-th is found in both.
    fn boxes(count: usize, of: usize, lasting: Option<f64>) -> Vec<Vec<ViewResult>> {
        let looks = |index: usize| vec![look(index.is_multiple_of(of), lasting); 2];
        (0..count).map(looks).collect()
    }

    #[test]
    fn a_box_is_worth_the_share_of_the_boxes_that_were_found() {
        let fourth = UntestedDetection::of(&boxes(24, 4, None)).unwrap();
        assert_eq!(fourth.boxes, 24);
        assert!((fourth.expected.probability() - 0.25).abs() < 0.02);
        // Those that were found were found in both looks: what is not found is not for the chance of a frame.
        assert!(fourth.expected.per_frame > 0.9, "{:?}", fourth.expected);
        assert!((fourth.expected.covariance[(0, 0)] - 0.04).abs() < 1e-12);
        let never = UntestedDetection::of(&boxes(24, 100, None).split_off(1)).unwrap();
        assert!(never.expected.probability() < 0.02);
        assert!(never.expected.covariance[(0, 0)] > 0.04);
    }

    #[test]
    fn on_maps_of_another_date_it_is_worth_what_real_ones_tell() {
        let said = UntestedDetection::of(&boxes(24, 1, Some(0.35))).unwrap();
        assert!((said.expected.probability() - 0.35).abs() < 1e-12);
    }

    #[test]
    fn a_few_boxes_say_nothing() {
        assert_eq!(UntestedDetection::of(&boxes(7, 1, None)), None);
        let mut empty = boxes(7, 1, None);
        empty.extend(vec![Vec::new(); 17]);
        assert_eq!(UntestedDetection::of(&empty), None);
    }

    #[test]
    fn boxes_lie_in_the_area_and_are_the_same_for_a_seed() {
        let area = GroundRect::centered(GroundPoint::new(100.0, -50.0), 300.0, 200.0);
        let drawn = random_boxes(&area, 30.0, 50, 3);
        assert_eq!(drawn.len(), 50);
        assert_eq!(drawn, random_boxes(&area, 30.0, 50, 3));
        for one in &drawn {
            assert!((one.width() - 30.0).abs() < 1e-9 && (one.height() - 30.0).abs() < 1e-9);
            assert!(one.south >= area.south && one.north <= area.north);
            assert!(one.west >= area.west && one.east <= area.east);
        }
        let middles = drawn.iter().filter(|b| b.center().east > -50.0).count();
        assert!((15..=35).contains(&middles), "{middles} of 50 in one half");
        assert_eq!(random_boxes(&area, 250.0, 5, 3), []);
    }
}
