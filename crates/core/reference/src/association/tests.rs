use nalgebra::{Matrix2, Matrix2x4, Matrix4, Point2, Point3, Vector2, Vector4};
use pilotage_base::frames::{Attitude, Pose};
use pilotage_raster::camera::CameraModel;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::GenericClass;

/// Height above ground, metres.
const HEIGHT: f64 = 305.0;
/// Half the ground in view, metres north and east: a picture of 60° from 1000 ft.
const VIEW: [f64; 2] = [132.0, 176.0];
/// Half the side of the ground of which the table is looked up, metres.
const AROUND: f64 = 320.0;

const CORNERS: [Vector2<f64>; 4] = [
    Vector2::new(VIEW[0], VIEW[1]),
    Vector2::new(VIEW[0], -VIEW[1]),
    Vector2::new(-VIEW[0], -VIEW[1]),
    Vector2::new(-VIEW[0], VIEW[1]),
];

/// A picture with known pairs.
struct Drawn {
    observed: Vec<ObservedLandmark>,
    possible: Vec<PossibleLandmark>,
    common: CommonError,
    /// For each observed landmark the possible one that it is.
    truth: Vec<Option<usize>>,
    /// True error of the believed position.
    offset: Vector2<f64>,
    /// True errors of roll, pitch, yaw and height.
    pose: Vector4<f64>,
}

impl Drawn {
    fn problem(&self) -> AssociationProblem<'_> {
        AssociationProblem {
            observed: &self.observed,
            possible: &self.possible,
            common: self.common,
            view: &CORNERS,
        }
    }
}

/// Change of a place with assumed roll, pitch, yaw and height, of a camera that looks down and heads north.
fn by_pose(place: Vector2<f64>) -> Matrix2x4<f64> {
    let (n, e) = (place.x, place.y);
    Matrix2x4::from_columns(&[
        Vector2::new(-n * e / HEIGHT, -HEIGHT - e * e / HEIGHT),
        Vector2::new(HEIGHT + n * n / HEIGHT, n * e / HEIGHT),
        Vector2::new(-e, n),
        place / HEIGHT,
    ])
}

/// A table of 200 landmarks of which the camera saw 80 %, and 40 % of what it saw is not in the table; the believed
/// position is off by 60 m (one sigma per axis).
fn drawn(seed: u64) -> Drawn {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let normal = |random: &mut ChaCha8Rng, sigma: f64| -> f64 {
        let z: f64 = StandardNormal.sample(random);
        sigma * z
    };
    let class = |random: &mut ChaCha8Rng| match random.random_range(0..20) {
        0..6 => GenericClass::Building,
        6..15 => GenericClass::Tree,
        15..18 => GenericClass::Field,
        _ => GenericClass::Water,
    };
    let (own, map) = (2.0_f64, 1.0);
    let angle = 1.05_f64.to_radians();
    let deviations = Vector4::new(angle, angle, 1.2_f64.to_radians(), 0.6);
    let offset = Vector2::new(normal(&mut random, 60.0), normal(&mut random, 60.0));
    let pose = deviations.map(|sigma| normal(&mut random, sigma));
    let possible: Vec<PossibleLandmark> = (0..200)
        .map(|_| PossibleLandmark {
            class: class(&mut random),
            place: Vector2::from_fn(|_, _| random.random_range(-AROUND..AROUND)),
            covariance: Matrix2::identity() * map * map,
            size: 9.0 * normal(&mut random, 0.6).exp(),
            detection: 0.8,
        })
        .collect();
    let (mut observed, mut truth) = (Vec::new(), Vec::new());
    for (index, thing) in possible.iter().enumerate() {
        let error = Vector2::from_fn(|_, _| normal(&mut random, own.hypot(map)));
        let place = thing.place - offset;
        let is_in_view = place.x.abs() < VIEW[0] && place.y.abs() < VIEW[1];
        if is_in_view && random.random_range(0.0..1.0) < 0.8 {
            observed.push(ObservedLandmark {
                class: thing.class,
                place: place + by_pose(place) * pose + error,
                covariance: Matrix2::identity() * own * own,
                size: thing.size * normal(&mut random, 0.25).exp(),
                by_pose: by_pose(place),
            });
            truth.push(Some(index));
        }
    }
    for _ in 0..observed.len() * 2 / 3 {
        let place = Vector2::new(
            random.random_range(-VIEW[0]..VIEW[0]),
            random.random_range(-VIEW[1]..VIEW[1]),
        );
        observed.push(ObservedLandmark {
            class: class(&mut random),
            place,
            covariance: Matrix2::identity() * own * own,
            size: 9.0 * normal(&mut random, 0.6).exp(),
            by_pose: by_pose(place),
        });
        truth.push(None);
    }
    Drawn {
        observed,
        possible,
        common: CommonError {
            position: Matrix2::identity() * 3600.0,
            pose: Matrix4::from_diagonal(&deviations.component_mul(&deviations)),
        },
        truth,
        offset,
        pose,
    }
}

/// Counts over many pictures.
#[derive(Debug, Default)]
struct Counts {
    pictures: usize,
    with_fix: usize,
    /// Observed landmarks that the table has.
    there: usize,
    right: usize,
    wrong: usize,
    /// Sum of the probabilities of accepted pairs.
    stated: f64,
    /// Sum of normalized squares of the errors of fixes, two degrees each.
    squares: f64,
    observed: usize,
}

impl Counts {
    fn of_consistent(pictures: impl Iterator<Item = Drawn>) -> Self {
        let mut counts = Self::default();
        for picture in pictures {
            let found = associate(&picture.problem(), &AssociationSettings::default());
            let accepted = found.pairs.iter().filter(|pair| pair.accepted);
            for pair in accepted {
                counts.stated += pair.probability;
                counts.judge(&picture, pair.observed, pair.possible);
            }
            counts.add(&picture);
            if let Some(fix) = found.fix {
                counts.with_fix += 1;
                let error = fix.offset - picture.offset;
                let weight = fix.covariance.try_inverse().unwrap();
                counts.squares += (weight * error).dot(&error);
            }
        }
        counts
    }

    fn of_scoreboard(pictures: impl Iterator<Item = Drawn>) -> Self {
        let mut counts = Self::default();
        for picture in pictures {
            let settings = ScoreboardSettings::of_thesis(2.0 * VIEW[1] / 1280.0);
            let board = Scoreboard::of(&picture.observed, &picture.possible, None, &settings);
            for (observed, row) in board.rows.iter().enumerate() {
                if let Some(possible) = row.chosen {
                    counts.judge(&picture, observed, possible);
                }
            }
            counts.add(&picture);
        }
        counts
    }

    fn add(&mut self, picture: &Drawn) {
        self.pictures += 1;
        self.there += picture.truth.iter().flatten().count();
        self.observed += picture.observed.len();
    }

    fn judge(&mut self, picture: &Drawn, observed: usize, possible: usize) {
        if picture.truth[observed] == Some(possible) {
            self.right += 1;
        } else {
            self.wrong += 1;
        }
    }

    fn accepted_wrong(&self) -> f64 {
        self.wrong as f64 / (self.right + self.wrong).max(1) as f64
    }

    fn found(&self) -> f64 {
        self.right as f64 / self.there as f64
    }
}

#[test]
fn pairs_that_agree_are_found_sixty_metres_off_among_clutter_and_few_are_wrong() {
    let counts = Counts::of_consistent((0..60).map(drawn));
    println!("{counts:?}");
    assert!(counts.accepted_wrong() <= 0.01, "{counts:?}");
    assert!(counts.found() >= 0.9, "{counts:?}");
    // The mean of chi-square over its degrees, 120 of them: three standard deviations.
    let nis = counts.squares / (2.0 * counts.with_fix as f64);
    assert!((0.6..1.4).contains(&nis), "{nis}");
}

#[test]
fn the_ground_in_a_corner_lies_where_the_fix_has_it_within_its_covariance() {
    let by_pose = by_pose(CORNERS[0]);
    let (mut squares, mut fixes) = (0.0, 0);
    for picture in (0..60).map(drawn) {
        let found = associate(&picture.problem(), &AssociationSettings::default());
        let Some(fix) = found.fix else { continue };
        let (shift, covariance) = fix.shift(&by_pose);
        let error = shift - (picture.offset - by_pose * picture.pose);
        assert!(covariance.trace() < 0.5 * fix.covariance.trace());
        squares += (covariance.try_inverse().unwrap() * error).dot(&error);
        fixes += 1;
    }
    let nis = squares / f64::from(2 * fixes);
    assert!(fixes > 50 && (0.6..1.4).contains(&nis), "{nis} of {fixes}");
}

#[test]
fn the_scoreboard_takes_more_wrong_pairs_than_right_ones_sixty_metres_off() {
    let pictures = || (0..10).map(drawn);
    let (board, agreed) = (
        Counts::of_scoreboard(pictures()),
        Counts::of_consistent(pictures()),
    );
    println!("{board:?}");
    assert!(board.found() < agreed.found());
    assert!(board.accepted_wrong() > agreed.accepted_wrong());
}

#[test]
fn observations_of_another_place_give_no_fix() {
    let mut wrong_fixes = 0;
    for seed in 0..30 {
        let (seen, elsewhere) = (drawn(seed), drawn(1000 + seed));
        let problem = AssociationProblem {
            observed: &seen.observed,
            ..elsewhere.problem()
        };
        let found = associate(&problem, &AssociationSettings::default());
        wrong_fixes += usize::from(found.fix.is_some());
    }
    assert!(wrong_fixes == 0, "{wrong_fixes} of 30");
}

/// The ground around the point below a level camera of 1280 by 960 pixels whose lens bends as barrels do.
fn barrel_outline(k1: f64) -> (CameraModel, Pose, Vec<Vector2<f64>>) {
    let mut camera = CameraModel::of_focal(1280, 960, 800.0);
    camera.distortion.k1 = k1;
    let pose = Pose {
        position_in_world: Point3::new(0.0, 0.0, -HEIGHT),
        attitude: Attitude::level(0.0),
    };
    let corners = camera.footprint(&pose, 0.0);
    let corners = corners.iter().map(|corner| corner.to_vector()).collect();
    (camera, pose, corners)
}

#[test]
fn all_that_a_lens_of_the_barrel_kind_shows_is_in_view() {
    let picture = drawn(0);
    for k1 in [-0.05, -0.1, -0.2] {
        let (camera, pose, view) = barrel_outline(k1);
        let problem = AssociationProblem {
            view: &view,
            ..picture.problem()
        };
        // A tenth of the picture: the outline has straight pieces where the side is bent.
        for (x, y) in (1..10).flat_map(|x| (1..10).map(move |y| (x, y))) {
            let pixel = Point2::new(128.0 * f64::from(x), 96.0 * f64::from(y));
            let ground = camera.ground_at(&pose, &pixel, 0.0).unwrap();
            assert!(problem.is_in_view(ground.to_vector()), "{k1}: {pixel}");
        }
        for beside in [Point2::new(-40.0, 480.0), Point2::new(640.0, 1000.0)] {
            let ground = camera.ground_at(&pose, &beside, 0.0).unwrap();
            assert!(!problem.is_in_view(ground.to_vector()), "{k1}: {beside}");
        }
    }
}

#[test]
fn observations_of_another_place_are_not_believed_through_a_lens_of_the_barrel_kind() {
    let (.., view) = barrel_outline(-0.2);
    let mut believed = 0;
    for seed in 0..30 {
        let (seen, elsewhere) = (drawn(seed), drawn(1000 + seed));
        let problem = AssociationProblem {
            observed: &seen.observed,
            view: &view,
            ..elsewhere.problem()
        };
        let found = associate(&problem, &AssociationSettings::default());
        believed += usize::from(found.probability > 0.5);
    }
    assert!(believed == 0, "{believed} of 30");
}

#[test]
fn a_scoreboard_without_error_pairs_everything_with_itself() {
    let mut picture = drawn(3);
    picture.observed = picture
        .possible
        .iter()
        .map(|possible| ObservedLandmark {
            class: possible.class,
            place: possible.place,
            covariance: possible.covariance,
            size: possible.size,
            by_pose: by_pose(possible.place),
        })
        .collect();
    let road = NearestRoad {
        from: Vector2::new(-300.0, 10.0),
        to: Vector2::new(300.0, -20.0),
    };
    let settings = ScoreboardSettings::of_thesis(0.275);
    let roads = Some((road, road));
    let board = Scoreboard::of(&picture.observed, &picture.possible, roads, &settings);
    let itself = |(i, row): &(usize, &ScoreboardRow)| row.chosen == Some(*i);
    let right = board.rows.iter().enumerate().filter(itself).count();
    // The road alone parts those whose surroundings lie in the same directions.
    assert!(right >= 150, "{right} of 200");
    for row in &board.rows {
        assert_eq!(row.terms.iter().filter(|t| t.road > 0.0).count(), 1);
    }
}

/// Prints the figures of docs/results.md; `cargo test -p pilotage-reference -- --ignored --nocapture study`.
#[test]
#[ignore = "a study: two thousand pictures"]
fn study_of_pairs_over_two_thousand_pictures() {
    let pictures: Vec<Drawn> = (10_000..12_000).map(drawn).collect();
    let problems: Vec<AssociationProblem<'_>> = pictures.iter().map(Drawn::problem).collect();
    let settings = AssociationSettings::default();
    let mut accepted = 0;
    let mut seconds = Vec::new();
    for problem in &problems {
        let start = std::time::Instant::now();
        let found = associate(problem, &settings);
        seconds.push(start.elapsed().as_secs_f64());
        accepted += found.pairs.iter().filter(|pair| pair.accepted).count();
    }
    seconds.sort_by(f64::total_cmp);
    println!(
        "{accepted} accepted; median {:.2} ms, 95 % {:.2} ms",
        1e3 * seconds[1000],
        1e3 * seconds[1900]
    );
    let counts = Counts::of_consistent(pictures.into_iter());
    println!(
        "consistent: {counts:?}; found {:.4}, wrong {:.5}, NIS {:.3}",
        counts.found(),
        counts.accepted_wrong(),
        counts.squares / (2.0 * counts.with_fix as f64)
    );
    let counts = Counts::of_scoreboard((10_000..12_000).map(drawn));
    println!(
        "scoreboard: {counts:?}; found {:.4}, wrong {:.5}",
        counts.found(),
        counts.accepted_wrong()
    );
}
