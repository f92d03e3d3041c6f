//! A road tells the place across, a bend the place along as well.

use nalgebra::{Matrix1, Matrix2, Point2, Point3, Vector1, Vector3, vector};
use pilotage_base::frames::{Attitude, GroundPoint, Pose};
use pilotage_estimation::filter::{Gaussian, Ukf, UnscentedSettings};
use pilotage_raster::camera::CameraModel;
use pilotage_roads::{
    RoadFixSettings, RoadJoining, RoadLine, RoadMap, RoadSighting, StraightRoad, course_length,
    fix_on_roads, place_along,
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use crate::figure::{FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Belief before the look: metres north and east, degrees of heading.
const BEFORE: [f64; 3] = [15.0, 15.0, 1.0];
/// Place of the aircraft by the truth, metres north and east of where it is believed to be.
const TRUTH: [f64; 2] = [9.0, 7.0];
/// Distance from one point of a road to the next, and farthest seen, metres.
const STEP: f64 = 4.0;
const SEEN: f64 = 90.0;
/// Seed of the errors of the points.
const SEED: u64 = 2;
/// Aircraft beside a road, and above it, metres: 30 and 1000 feet.
const BESIDE: [f64; 2] = [9.144, 304.8];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "straight-road",
    text: include_str!("../../texts/en/straight-road.md"),
    controls: &[
        LessonControl::slider("bend", [0.0, 60.0], 5.0, 0.0, "°"),
        LessonControl::slider("shared", [0.0, 4.0], 0.5, 1.0, "m"),
    ],
    compute,
};

/// Northward road that bends to the right by so many radians within the middle 60 m of what is drawn.
fn road(bend: f64) -> RoadLine {
    let mut course = vec![vector![-150.0, 0.0]];
    for piece in 0..=60 {
        let heading = bend * f64::from(piece).clamp(0.0, 60.0) / 60.0;
        let last = course[course.len() - 1];
        let length = if piece == 0 { 120.0 } else { 1.0 };
        course.push(last + length * vector![heading.cos(), heading.sin()]);
    }
    let last = course[course.len() - 1];
    course.push(last + 150.0 * vector![bend.cos(), bend.sin()]);
    RoadLine {
        width: 6.0,
        course: course.into_iter().map(GroundPoint::from).collect(),
        ..RoadLine::default()
    }
}

/// Points of the road as the believed position puts them on the ground.
fn sightings(road: &RoadLine, shared: f64) -> Vec<RoadSighting> {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
    let common = shared * normal();
    let truth = vector![TRUTH[0], TRUTH[1]];
    let count = (course_length(&road.course) / STEP) as usize;
    (0..count)
        .filter_map(|index| {
            let on = place_along(&road.course, index as f64 * STEP)?;
            let across = common + normal();
            let right = vector![-on.heading.sin(), on.heading.cos()];
            let point = on.point.to_vector() + across * right - truth;
            (point.norm() <= SEEN).then(|| RoadSighting {
                place: GroundPoint::from(point),
                direction: on.heading,
            })
        })
        .collect()
}

/// Belief (north, east, heading) after the look, the number of points that were used, and their root mean square
/// distance across about their mean, metres.
fn looked(bend: f64, shared: f64) -> Option<(Gaussian<3>, usize, f64)> {
    let line = road(bend);
    let seen = sightings(&line, shared);
    let map = RoadMap::new(vec![line], RoadJoining::SHARED_POINTS);
    let settings = RoadFixSettings {
        shared,
        ..RoadFixSettings::default()
    };
    let deviations = Vector3::new(BEFORE[0], BEFORE[1], BEFORE[2].to_radians());
    let prior = Gaussian::from_standard_deviations(Vector3::zeros(), &deviations);
    let Some(fix) = fix_on_roads(&map, &seen, GroundPoint::default(), &settings) else {
        return Some((prior, 0, 0.0));
    };
    let mut filter = Ukf::new(prior, UnscentedSettings::default()).ok()?;
    for component in &fix.components {
        let noise = Matrix1::new(component.variance);
        let told = |x: &Vector3<f64>| Some(Vector1::new(component.weights.dot(x)));
        let expected = filter.predict_measurement(told, &noise).ok()?;
        filter
            .correct(&expected, &Vector1::new(component.value))
            .ok()?;
    }
    Some((filter.state(), fix.matched, fix.residual))
}

/// Distance of a road in the picture of an aircraft beside it, pixels: DeAngelo 2016, eqs 47 and 48.
fn in_the_picture() -> Option<f64> {
    let camera = CameraModel::pinhole(640, 480, 60_f64.to_radians());
    let pose = Pose {
        position_in_world: Point3::new(0.0, BESIDE[0], -BESIDE[1]),
        attitude: Attitude::default(),
    };
    let end = |north: f64| camera.project(&pose, &Point3::new(north, 0.0, 0.0));
    let road = StraightRoad::of(end(-50.0)?, end(50.0)?, Point2::new(320.0, 240.0))?;
    Some(road.distance.abs())
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (bend, shared) = (setting.get("bend").to_radians(), setting.get("shared"));
    let (after, points, scatter) = looked(bend, shared).unwrap_or_else(|| {
        let deviations = Vector3::from(BEFORE);
        (
            Gaussian::from_standard_deviations(Vector3::zeros(), &deviations),
            0,
            0.0,
        )
    });
    let deviations = after.standard_deviations();
    let count = points.max(1) as f64;
    LessonOutcome {
        figure: draw(bend, shared, &after, words),
        values: vec![
            Value::new("bend", setting.get("bend"), "°"),
            Value::new("shared", shared, "m"),
            Value::new("points", points as f64, ""),
            Value::new("along", deviations[0], "m"),
            Value::new("across", deviations[1], "m"),
            Value::new("scatter", scatter, "m"),
            Value::new("no-better", shared.hypot(1.0 / count.sqrt()), "m"),
            Value::new("pixels", in_the_picture().unwrap_or(0.0), "px"),
        ],
        checks: vec![Check::at_most("along", 3.0), Check::at_least("shared", 1.0)],
    }
}

fn draw(bend: f64, shared: f64, after: &Gaussian<3>, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 440.0);
    let corners = [vector![0.0, 0.0], vector![640.0, 440.0]];
    let labels = [words.get("east"), words.get("north")];
    let plot = FigurePlot::map(
        &mut svg,
        corners,
        vector![20.0, 0.0],
        95.0,
        [&labels[0], &labels[1]],
    );
    let line = road(bend);
    let course: Vec<[f64; 2]> = line
        .course
        .iter()
        .map(|at| [at.east, at.north.clamp(-95.0, 95.0)])
        .collect();
    svg.part("road", |svg| plot.line(svg, &course, "look"));
    svg.part("points", |svg| {
        for seen in sightings(&line, shared) {
            plot.dot(svg, [seen.place.east, seen.place.north], 2.5, "dot-look");
        }
    });
    let before = Matrix2::from_diagonal(&vector![BEFORE[1].powi(2), BEFORE[0].powi(2)]);
    svg.part("before", |svg| {
        plot.ellipse(svg, [0.0, 0.0], &before, 2.0, "prior");
    });
    let own = after.covariance;
    let turned = Matrix2::new(own[(1, 1)], own[(0, 1)], own[(0, 1)], own[(0, 0)]);
    svg.part("after", |svg| {
        let middle = [after.mean[1], after.mean[0]];
        plot.ellipse(svg, middle, &turned, 2.0, "belief");
        plot.dot(svg, middle, 4.0, "dot-estimate");
    });
    svg.part("truth", |svg| {
        plot.dot(svg, [TRUTH[1], TRUTH[0]], 5.0, "dot-truth");
    });
    // On the left, since the road bends to the right.
    for (row, (name, colour)) in [
        ("road", "look"),
        ("before", "reckoning"),
        ("after", "estimate"),
        ("truth", "truth"),
    ]
    .into_iter()
    .enumerate()
    {
        let at = vector![64.0, 30.0 + 17.0 * row as f64];
        let class = format!("small word-{colour}");
        svg.text(at, TextAnchor::Start, &class, &words.get(name));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_road_leaves_the_place_along_as_it_was() {
        let (after, points, _) = looked(0.0, 1.0).unwrap();
        let deviations = after.standard_deviations();
        assert!(points > 30);
        assert!((deviations[0] - BEFORE[0]).abs() < 0.1, "{deviations:?}");
        assert!(deviations[1] < 1.3, "{deviations:?}");
    }

    #[test]
    fn thirty_feet_beside_a_road_are_as_many_pixels_as_the_focal_length_says() {
        // 320 px / tan 30° = 554.26 px; 554.26 × 30 / 1000.
        assert!((in_the_picture().unwrap() - 16.628).abs() < 1e-3);
    }
}
