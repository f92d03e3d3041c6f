//! Fixes against poses that are known.

use nalgebra::{Vector2, Vector3};
use pilotage_base::frames::GroundPoint;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::course::{course_length, place_along};
use crate::{RoadFix, RoadFixSettings, RoadJoining, RoadLine, RoadMap, RoadSighting, fix_on_roads};

fn line(course: Vec<GroundPoint>) -> RoadLine {
    RoadLine {
        width: 6.0,
        course,
        ..RoadLine::default()
    }
}

fn straight(heading: f64) -> RoadLine {
    let reach = 400.0 * Vector2::new(heading.cos(), heading.sin());
    line(vec![(-reach).into(), reach.into()])
}

/// An arc of radius 120 m that passes the origin northward and bends to the right.
fn arc() -> RoadLine {
    let place = |i: i32| {
        let angle = 0.02 * f64::from(i);
        GroundPoint::new(120.0 * angle.sin(), 120.0 - 120.0 * angle.cos())
    };
    line((-60..=60).map(place).collect())
}

/// A bend to the right, and then one to the left that is tighter.
fn winding() -> RoadLine {
    let mut course: Vec<GroundPoint> = arc().course[..61].to_vec();
    let place = |i: i32| {
        let angle = 0.04 * f64::from(i);
        GroundPoint::new(70.0 * angle.sin(), 70.0 * angle.cos() - 70.0)
    };
    course.extend((1..=40).map(place));
    line(course)
}

/// Errors of a trial.
struct Trial {
    /// Shift (m) and turn (rad) that have to be added to the belief.
    truth: Vector3<f64>,
    /// Standard deviations of a point, and of what a road's points share, metres.
    point: f64,
    shared: f64,
    /// Relative error of the scale.
    scale: f64,
}

/// Points every 4 m within 90 m of the origin as seen from a pose that is off by the trial's truth.
fn sightings(map: &RoadMap, trial: &Trial, random: &mut ChaCha8Rng) -> Vec<RoadSighting> {
    let mut seen = Vec::new();
    for road in map.lines() {
        let gauss: f64 = StandardNormal.sample(random);
        let common = trial.shared * gauss;
        let mut along = 0.0;
        while along < course_length(&road.course) {
            let on = place_along(&road.course, along).unwrap();
            along += 4.0;
            let gauss: f64 = StandardNormal.sample(random);
            let across = common + trial.point * gauss;
            let to_right = Vector2::new(-on.heading.sin(), on.heading.cos());
            let point = on.point.to_vector() + across * to_right;
            if point.norm() > 90.0 {
                continue;
            }
            // The belief puts it there from where the correction leads to the truth.
            let (sin, cos) = trial.truth.z.sin_cos();
            let from = (point - trial.truth.xy()) / (1.0 + trial.scale);
            let place = Vector2::new(cos * from.x + sin * from.y, cos * from.y - sin * from.x);
            seen.push(RoadSighting {
                place: place.into(),
                direction: on.heading - trial.truth.z,
            });
        }
    }
    seen
}

fn fix(map: &RoadMap, trial: &Trial, seed: u64) -> Option<RoadFix> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let seen = sightings(map, trial, &mut random);
    let settings = RoadFixSettings {
        point: trial.point.max(0.1),
        shared: trial.shared,
        ..RoadFixSettings::default()
    };
    fix_on_roads(map, &seen, GroundPoint::default(), &settings)
}

fn map(lines: Vec<RoadLine>) -> RoadMap {
    RoadMap::new(
        lines,
        RoadJoining {
            snap: 0.1,
            crossings: true,
            reach: 0.0,
        },
    )
}

fn exact(truth: Vector3<f64>) -> Trial {
    Trial {
        truth,
        point: 0.0,
        shared: 0.5,
        scale: 0.0,
    }
}

#[test]
fn a_straight_road_tells_the_place_across_and_the_heading_alone() {
    let heading = 0.6_f64;
    let map = map(vec![straight(heading)]);
    let truth = Vector3::new(7.0, -4.0, 0.03);
    let fix = fix(&map, &exact(truth), 1).unwrap();
    let across = Vector2::new(-heading.sin(), heading.cos());
    let along = Vector2::new(heading.cos(), heading.sin());
    assert_eq!(fix.components.len(), 2);
    let seen = fix.correction.xy();
    // Half a metre of common error, its own seed's.
    assert!(
        (across.dot(&seen) - across.dot(&truth.xy())).abs() < 1.0,
        "{fix:?}"
    );
    assert!(along.dot(&seen).abs() < 1e-6, "{fix:?}");
    assert!((fix.correction.z - 0.03).abs() < 1e-3);
    for component in &fix.components {
        assert!(along.dot(&component.weights.xy()).abs() < 1e-6);
    }
}

#[test]
fn two_roads_or_a_winding_one_tell_everything() {
    let truth = Vector3::new(-6.0, 5.0, -0.04);
    for lines in [vec![straight(0.2), straight(1.7)], vec![winding()]] {
        let map = map(lines);
        let trial = Trial {
            shared: 0.0,
            ..exact(truth)
        };
        let fix = fix(&map, &trial, 1).unwrap();
        assert_eq!(fix.components.len(), 3);
        assert!((fix.correction - truth).norm() < 0.15, "{fix:?}");
        assert!(fix.residual < 0.05);
    }
}

#[test]
fn a_bend_leaves_the_turn_about_its_middle_open() {
    let map = map(vec![arc()]);
    let fix = fix(&map, &exact(Vector3::new(3.0, 2.0, 0.01)), 1).unwrap();
    assert_eq!(fix.components.len(), 2);
    // A turn clockwise about a place 120 m to the right: so far north for a radian.
    let about_the_middle = Vector3::new(120.0, 0.0, 1.0);
    for component in &fix.components {
        let told = component.weights.dot(&about_the_middle) / component.weights.norm();
        assert!(told.abs() < 1.0, "{component:?}");
    }
}

#[test]
fn points_of_a_road_that_runs_otherwise_are_not_matched() {
    let map = map(vec![straight(0.0)]);
    let seen: Vec<_> = (-20..20)
        .map(|i| RoadSighting {
            place: GroundPoint::new(4.0 * f64::from(i), 3.0),
            direction: 0.8,
        })
        .collect();
    let settings = RoadFixSettings::default();
    assert_eq!(
        fix_on_roads(&map, &seen, GroundPoint::default(), &settings),
        None
    );
}

#[test]
fn many_points_on_one_road_are_no_surer_than_what_they_share() {
    let map = map(vec![straight(0.0)]);
    let trial = Trial {
        truth: Vector3::zeros(),
        point: 0.5,
        shared: 2.0,
        scale: 0.0,
    };
    let fix = fix(&map, &trial, 4).unwrap();
    assert!(fix.matched > 40);
    let east = fix.components.iter().find(|c| c.weights.y.abs() > 0.9);
    let variance = east.unwrap().variance;
    assert!((4.0..4.1).contains(&variance), "{variance}");
}

#[test]
fn errors_are_as_large_as_they_are_said_to_be() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    for (name, lines) in [
        ("straight", vec![straight(1.1)]),
        ("bend", vec![arc()]),
        ("winding", vec![winding()]),
        ("crossing", vec![straight(0.3), straight(1.5)]),
    ] {
        let map = map(lines);
        let (mut squares, mut degrees) = (0.0, 0);
        for seed in 0..300 {
            let gauss = |random: &mut ChaCha8Rng| -> f64 { StandardNormal.sample(random) };
            let trial = Trial {
                truth: Vector3::new(
                    4.0 * gauss(&mut random),
                    4.0 * gauss(&mut random),
                    random.random_range(-0.05..0.05),
                ),
                point: 0.8,
                shared: 1.0,
                scale: RoadFixSettings::default().scale * gauss(&mut random),
            };
            let fix = fix(&map, &trial, 1000 + seed).unwrap();
            for component in &fix.components {
                let error = component.value - component.weights.dot(&trial.truth);
                squares += error.powi(2) / component.variance;
                degrees += 1;
            }
        }
        let ratio = squares / f64::from(degrees);
        println!("{name}: NEES per degree {ratio:.3} over {degrees}");
        // Errors of 600 degrees lie within 11 % with 95 %; the scatter widens the covariance a little at times.
        assert!((0.85..1.12).contains(&ratio), "{name}: {ratio}");
    }
}
