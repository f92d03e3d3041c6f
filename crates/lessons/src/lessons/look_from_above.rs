//! A look from above: how a pixel becomes metres, and what a tilt does to them.

use nalgebra::{Point2, Point3, Vector2, vector};
use pilotage_base::frames::{Attitude, Pose};
use pilotage_raster::camera::CameraModel;

use crate::figure::{Axis, FigurePlot, Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Columns and rows of the picture, and its angle of view from left to right, degrees.
const SIZE: [usize; 2] = [640, 480];
const VIEW: f64 = 60.0;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "look-from-above",
    text: include_str!("../../texts/en/look-from-above.md"),
    controls: &[
        LessonControl::slider("height", [50.0, 600.0], 10.0, 300.0, "m"),
        LessonControl::slider("tilt", [0.0, 12.0], 0.5, 1.0, "°"),
    ],
    compute,
};

fn camera() -> CameraModel {
    CameraModel::pinhole(SIZE[0], SIZE[1], VIEW.to_radians())
}

/// Metres to the right of the aircraft, which flies north, at which a column of the middle row meets level ground.
fn right_of(camera: &CameraModel, height: f64, roll: f64, column: f64) -> f64 {
    let attitude = Attitude {
        roll,
        ..Attitude::level(0.0)
    };
    let pose = Pose {
        position_in_world: Point3::new(0.0, 0.0, -height),
        attitude,
    };
    let pixel = Point2::new(column, camera.principal.y);
    camera
        .ground_at(&pose, &pixel, 0.0)
        .map_or(f64::NAN, |ground| ground.east)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let (height, tilt) = (setting.get("height"), setting.get("tilt").to_radians());
    let camera = camera();
    let middle = camera.principal.x;
    let level = |column: f64| right_of(&camera, height, 0.0, column);
    // A landmark is seen in the middle of the picture. It is believed to lie straight below; the left wing is up by the
    // tilt, so that it lies to the left.
    let moved = level(middle) - right_of(&camera, height, tilt, middle);
    LessonOutcome {
        figure: draw(&camera, height, tilt, words),
        values: vec![
            Value::new("height", height, "m"),
            Value::new("tilt", setting.get("tilt"), "°"),
            Value::new("focal", camera.focal, "px"),
            Value::new("pixel", 100.0 * (level(middle + 1.0) - level(middle)), "cm"),
            Value::new("moved", moved, "m"),
            Value::new("share", 100.0 * moved / height, "%"),
            Value::new("wide", level(SIZE[0] as f64) - level(0.0), "m"),
            Value::new("pixels", camera.focal * tilt.tan(), "px"),
        ],
        checks: vec![Check::at_most("moved", 3.0), Check::at_least("wide", 150.0)],
    }
}

fn draw(camera: &CameraModel, height: f64, tilt: f64, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 440.0);
    let plot = FigurePlot::whole(
        &mut svg,
        Axis::new([-500.0, 500.0], words.get("right")),
        Axis::new([0.0, 660.0], words.get("above")),
    );
    let view = |svg: &mut Svg, roll: f64, class: &str, middle: &str| {
        let ends = [0.0, SIZE[0] as f64].map(|column| right_of(camera, height, roll, column));
        let outline = [
            plot.at(0.0, height),
            plot.at(ends[0].max(-500.0), 0.0),
            plot.at(ends[1].min(500.0), 0.0),
        ];
        svg.path(&outline, true, class);
        let below = right_of(camera, height, roll, camera.principal.x);
        plot.line(svg, &[[0.0, height], [below, 0.0]], middle);
        below
    };
    svg.part("believed", |svg| {
        view(svg, 0.0, "prior", "reckoning");
    });
    let mut below = 0.0;
    svg.part("real", |svg| {
        below = view(svg, tilt, "shade", "truth");
    });
    svg.part("height", |svg| {
        // The wings.
        let middle: Vector2<f64> = plot.at(0.0, height);
        let wing = vector![tilt.cos(), tilt.sin()] * 34.0;
        svg.line(middle - wing, middle + wing, "truth");
        svg.circle(middle, 5.0, "dot-truth");
    });
    svg.part("moved", |svg| {
        let ends = [plot.at(below, 0.0), plot.at(0.0, 0.0)];
        svg.line(ends[0], ends[1], "estimate");
        svg.circle(ends[1], 5.0, "dot-estimate");
        svg.circle(ends[0], 6.0, "landmark");
    });
    for (row, (key, class)) in [
        ("believed", "word-reckoning"),
        ("real", "word-truth"),
        ("landmark", ""),
        ("moved", "word-estimate"),
    ]
    .into_iter()
    .enumerate()
    {
        let at = vector![616.0, 32.0 + 17.0 * row as f64];
        svg.text(at, TextAnchor::End, class, &words.get(key));
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilt_moves_the_middle_by_its_tangent() {
        let camera = camera();
        let moved = right_of(&camera, 300.0, 1f64.to_radians(), camera.principal.x);
        assert!((moved.abs() - 300.0 * 1f64.to_radians().tan()).abs() < 1e-9);
        // Roll is positive with the right wing down: the camera then looks to the left.
        assert!(moved < 0.0);
    }
}
