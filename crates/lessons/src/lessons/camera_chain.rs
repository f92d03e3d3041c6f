//! The thesis' measurement chain from the world to the body: translate, yaw, pitch, roll.

use nalgebra::{Point3, Vector3, vector};
use pilotage_base::frames::Attitude;

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{HEIGHT, LANDMARK, pose_at, seen_from};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "camera-chain",
    text: include_str!("../../texts/en/camera-chain.md"),
    controls: &[
        LessonControl::choice("step", 5),
        LessonControl::slider("yaw", [0.0, 350.0], 10.0, 50.0, "°"),
        LessonControl::slider("pitch", [-20.0, 20.0], 1.0, 5.0, "°"),
        LessonControl::slider("roll", [-30.0, 30.0], 1.0, 10.0, "°"),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let step = setting.chosen("step");
    let frame = Frame::at(
        step,
        ["roll", "pitch", "yaw"].map(|angle| setting.get(angle)),
    );
    let [north, east, down] = LANDMARK;
    let landmark = frame.of(Point3::new(north, east, down));
    LessonOutcome {
        figure: draw(&frame, step, words),
        values: vec![
            Value::new("first", landmark.x, "m"),
            Value::new("second", landmark.y, "m"),
            Value::new("third", landmark.z, "m"),
            Value::new("aside", landmark.x.hypot(landmark.y), "m"),
        ],
        checks: vec![Check::at_most("aside", 5.0)],
    }
}

/// Axes after so many steps of the chain.
struct Frame {
    pose: pilotage_base::frames::Pose,
    attitude: Attitude,
    translated: bool,
    /// Direction of the aircraft's nose in the world, whatever was turned so far.
    nose: Vector3<f64>,
}

impl Frame {
    fn at(step: usize, [roll, pitch, yaw]: [f64; 3]) -> Self {
        let kept = |angle: f64, from: usize| if step >= from { angle } else { 0.0 };
        let turns = [kept(roll, 4), kept(pitch, 3), kept(yaw, 2)];
        let pose = pose_at(HEIGHT, turns);
        Self {
            attitude: pose.attitude,
            pose,
            translated: step >= 1,
            nose: pose_at(HEIGHT, [roll, pitch, yaw])
                .attitude
                .world_from_body()
                * Vector3::x(),
        }
    }

    fn of(&self, point: Point3<f64>) -> Vector3<f64> {
        if self.translated {
            seen_from(&self.pose, &self.attitude, &point)
        } else {
            point.coords
        }
    }
}

fn draw(frame: &Frame, step: usize, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 460.0);
    let names = |axis: &str| words.get(&format!("{axis}.{}", step.min(2)));
    let (first, second, third) = (names("first"), names("second"), names("third"));
    let square = [vector![0.0, 24.0], vector![330.0, 460.0]];
    let above = FigurePlot::map(
        &mut svg,
        square,
        vector![0.0, 0.0],
        420.0,
        [&second, &first],
    );
    let ends = [above_span(&above, -1.0), above_span(&above, 1.0)];
    let behind = FigurePlot::new(
        &mut svg,
        [vector![325.0, 24.0], vector![640.0, 460.0]],
        Axis::new(ends, second),
        Axis::new([420.0, -340.0], third),
    );
    for (key, x) in [("above", 190.0), ("behind", 515.0)] {
        svg.text(vector![x, 20.0], TextAnchor::Middle, "", &words.get(key));
    }
    let from_above = |v: Vector3<f64>| [v.y, v.x];
    let from_behind = |v: Vector3<f64>| [v.y, v.z];
    svg.part("ground", |svg| {
        for offset in [0.0, 50.0, 100.0, 150.0, 200.0] {
            for ends in [
                [[100.0 + offset, 0.0], [100.0 + offset, 200.0]],
                [[100.0, offset], [300.0, offset]],
            ] {
                let seen = ends.map(|[north, east]| frame.of(Point3::new(north, east, 0.0)));
                above.line(svg, &seen.map(from_above), "truth");
                behind.line(svg, &seen.map(from_behind), "truth");
            }
        }
    });
    let [north, east, down] = LANDMARK;
    let landmark = frame.of(Point3::new(north, east, down));
    let position = frame.pose.position_in_world;
    let aircraft = frame.of(position);
    let nose = frame.of(position + 70.0 * frame.nose);
    svg.part("aircraft", |svg| {
        above.line(svg, &[from_above(aircraft), from_above(nose)], "estimate");
        above.dot(svg, from_above(aircraft), 6.0, "dot-estimate");
        behind.dot(svg, from_behind(aircraft), 6.0, "dot-estimate");
    });
    svg.part("ray", |svg| {
        above.line(svg, &[from_above(aircraft), from_above(landmark)], "limit");
        behind.line(
            svg,
            &[from_behind(aircraft), from_behind(landmark)],
            "limit",
        );
    });
    svg.part("landmark", |svg| {
        above.dot(svg, from_above(landmark), 6.0, "landmark");
        behind.dot(svg, from_behind(landmark), 6.0, "landmark");
    });
    let key = [
        ("ground", "word-truth"),
        ("aircraft", "word-estimate"),
        ("landmark", "word-look"),
    ];
    for (line, (words_of, class)) in key.into_iter().enumerate() {
        let at = vector![62.0, 376.0 + 17.0 * line as f64];
        svg.text(at, TextAnchor::Start, class, &words.get(words_of));
    }
    svg
}

/// Metres at the left (-1) or right (1) end of the map's axis to the right.
fn above_span(above: &FigurePlot, side: f64) -> f64 {
    let width = 330.0 - 56.0 - 14.0;
    side * 0.5 * width / above.length(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chain_meets_a_calculation_with_the_matrices_of_the_thesis() {
        // The matrices (33)-(37) as printed, with a world of east, south and down, in numpy: camera coordinates
        // 125.747, -85.208, 1004.703 for a place 1000 up, with the landmark 100 east and 150 north of it.
        let frame = Frame::at(4, [10.0, 5.0, 50.0]);
        let [north, east, down] = LANDMARK;
        let body = frame.of(Point3::new(north, east, down));
        let camera = vector![125.747, -85.208, 1004.703] * (HEIGHT / 1000.0);
        assert!(
            (body - vector![-camera.y, camera.x, camera.z]).norm() < 1e-3,
            "{body}"
        );
    }

    #[test]
    fn each_step_turns_about_one_axis() {
        let [north, east, down] = LANDMARK;
        let at = |step| Frame::at(step, [10.0, 5.0, 50.0]).of(Point3::new(north, east, down));
        assert!((at(1) - vector![45.0, 30.0, 300.0]).norm() < 1e-9);
        assert!((at(2).z - at(1).z).abs() < 1e-9, "yaw keeps down");
        assert!((at(3).y - at(2).y).abs() < 1e-9, "pitch keeps right");
        assert!((at(4).x - at(3).x).abs() < 1e-9, "roll keeps ahead");
    }
}
