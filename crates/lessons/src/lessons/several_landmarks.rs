//! Several landmarks: two directions fix a place as well as they cross.

use nalgebra::{Matrix1, Matrix1x2, Matrix2, Vector1, Vector2, vector};
use pilotage_base::frames::wrap_pi;
use pilotage_estimation::filter::{CramerRao, Gaussian, Ukf, UnscentedSettings};

use crate::figure::{FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Distance of both landmarks, metres.
const AWAY: f64 = 500.0;
/// Deviation of a direction, radians: 1.15°, 10 m at that distance.
const DIRECTION: f64 = 0.02;
/// Deviation of the place before both looks, metres on each axis.
const BEFORE: f64 = 1000.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "several-landmarks",
    text: include_str!("../../texts/en/several-landmarks.md"),
    controls: &[
        LessonControl::slider("angle", [10.0, 170.0], 5.0, 10.0, "°"),
        LessonControl::slider("compass", [0.0, 5.0], 0.5, 0.0, "°"),
    ],
    compute,
};

/// The landmarks, north and east of the aircraft, as far to the right of north as to the left.
fn landmarks(angle: f64) -> [Vector2<f64>; 2] {
    [-0.5, 0.5].map(|side| vector![(side * angle).cos(), (side * angle).sin()] * AWAY)
}

/// Direction from a place to a landmark, radians clockwise from north.
fn direction(place: &Vector2<f64>, landmark: &Vector2<f64>) -> f64 {
    let to = landmark - place;
    to.y.atan2(to.x)
}

/// Least covariance that any estimate can have by both directions.
fn bound(angle: f64) -> Option<Matrix2<f64>> {
    let before = Matrix2::from_diagonal_element(BEFORE * BEFORE);
    let mut bound = CramerRao::<2>::from_prior(&before).ok()?;
    for landmark in landmarks(angle) {
        let far = landmark.norm_squared();
        let slope = Matrix1x2::new(landmark.y / far, -landmark.x / far);
        bound
            .update(&slope, &Matrix1::new(DIRECTION * DIRECTION))
            .ok()?;
    }
    bound.covariance().ok()
}

/// Place that the filter has if the compass is turned, north and east: the truth is (0, 0).
fn estimate(angle: f64, compass: f64) -> Option<Vector2<f64>> {
    let mut mean = Vector2::zeros();
    // A direction is no linear measurement: the filter begins again around its own answer until that stays.
    for _ in 0..12 {
        let belief = Gaussian::from_standard_deviations(mean, &Vector2::repeat(1.0));
        let mut filter = Ukf::new(belief, UnscentedSettings::default()).ok()?;
        for landmark in landmarks(angle) {
            let measured = direction(&Vector2::zeros(), &landmark) + compass;
            let noise = Matrix1::new(1e-10);
            let model = |x: &Vector2<f64>| {
                let off = direction(x, &landmark) - measured;
                Some(Vector1::new(measured + wrap_pi(off)))
            };
            let predicted = filter.predict_measurement(model, &noise).ok()?;
            filter.correct(&predicted, &Vector1::new(measured)).ok()?;
        }
        mean = *filter.mean();
    }
    Some(mean)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (angle, compass) = (
        setting.get("angle").to_radians(),
        setting.get("compass").to_radians(),
    );
    let covariance = bound(angle).unwrap_or_else(|| Matrix2::repeat(f64::NAN));
    let axes = covariance.symmetric_eigenvalues().map(f64::sqrt);
    let found = estimate(angle, compass).unwrap_or_else(|| Vector2::repeat(f64::NAN));
    LessonOutcome {
        figure: draw(angle, compass, &covariance, &found, words),
        values: vec![
            Value::new("angle", setting.get("angle"), "°"),
            Value::new("one", AWAY * DIRECTION, "m"),
            Value::new("long", axes.max(), "m"),
            Value::new("short", axes.min(), "m"),
            Value::new("together", covariance.trace().sqrt(), "m"),
            // To the centimetre: the filter ends a little beside the crossing.
            Value::new("moved", (100.0 * found.norm()).round() / 100.0, "m"),
        ],
        checks: vec![
            Check::at_most("together", 15.0),
            Check::at_most("moved", 1.0),
        ],
    }
}

fn draw(
    angle: f64,
    compass: f64,
    covariance: &Matrix2<f64>,
    found: &Vector2<f64>,
    words: &Words,
) -> Svg {
    let mut svg = Svg::new(640.0, 440.0);
    let plot = FigurePlot::whole_map(
        &mut svg,
        vector![0.0, 210.0],
        440.0,
        [&words.get("east"), &words.get("north")],
    );
    svg.part("directions", |svg| {
        for landmark in landmarks(angle) {
            // The strip in which the place lies by this look alone, to one deviation at the aircraft.
            let back = direction(&Vector2::zeros(), &landmark) + compass;
            let along = vector![back.cos(), back.sin()];
            let across = vector![-along.y, along.x];
            for side in [-1.0, 1.0] {
                let end =
                    landmark - along * (AWAY + 60.0) + across * (side * DIRECTION * (AWAY + 60.0));
                plot.line(svg, &[[landmark.y, landmark.x], [end.y, end.x]], "look");
            }
        }
    });
    svg.part("landmarks", |svg| {
        for landmark in landmarks(angle) {
            svg.circle(plot.at(landmark.y, landmark.x), 7.0, "landmark");
        }
    });
    svg.part("ellipse", |svg| {
        let own = covariance;
        let turned = Matrix2::new(own[(1, 1)], own[(0, 1)], own[(0, 1)], own[(0, 0)]);
        plot.ellipse(svg, [found.y, found.x], &turned, 2.4477, "belief");
        plot.dot(svg, [found.y, found.x], 3.0, "dot-estimate");
    });
    plot.dot(&mut svg, [0.0, 0.0], 4.0, "dot-truth");
    let names = [
        ("landmark", ""),
        ("strip", "word-look"),
        ("ellipse", "word-estimate"),
        ("truth", "word-truth"),
    ];
    for (row, (key, class)) in names.into_iter().enumerate() {
        let at = vector![614.0, 314.0 + 17.0 * row as f64];
        svg.text(at, TextAnchor::End, class, &words.get(key));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_directions_know_the_place_as_their_crossing_says() {
        // s √2 / sin γ together, s / √(1 ± cos γ) along the axes.
        for degrees in [20.0f64, 90.0, 150.0] {
            let (angle, s) = (degrees.to_radians(), AWAY * DIRECTION);
            let own = bound(angle).unwrap();
            let wanted = s * 2.0f64.sqrt() / angle.sin();
            assert!((own.trace().sqrt() / wanted - 1.0).abs() < 0.01);
        }
    }

    #[test]
    fn a_turned_compass_moves_the_place_along_the_circle_through_both_landmarks() {
        // The landmarks are seen under the same angle from everywhere on that circle.
        let (angle, compass) = (1.0, 0.05);
        let found = estimate(angle, compass).unwrap();
        let [left, right] = landmarks(angle).map(|it| direction(&found, &it));
        assert!((right - left - angle).abs() < 1e-5);
        // The place lies where the turned directions are the true ones.
        assert!((left + 0.5 * angle - compass).abs() < 1e-5);
    }
}
