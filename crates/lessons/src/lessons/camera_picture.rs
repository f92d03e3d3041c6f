//! The thesis' measurement chain from the body to the pixel: camera axes, perspective, corner.

use nalgebra::{Point2, Point3, Vector2, vector};
use pilotage_base::frames::Pose;
use pilotage_raster::camera::{CameraModel, Lens};

use crate::figure::{Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{HEIGHT, LANDMARK, pose_at};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Roll, pitch, yaw, degrees.
const ANGLES: [f64; 3] = [10.0, 5.0, 50.0];
/// Pixels of the picture.
const SIZE: [usize; 2] = [640, 480];
/// Size of a pixel in the drawing, and where the picture's corner lies in it.
const SCALE: f64 = 0.86;
const CORNER: [f64; 2] = [46.0, 36.0];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "camera-picture",
    text: include_str!("../../texts/en/camera-picture.md"),
    controls: &[
        LessonControl::slider("height", [250.0, 600.0], 10.0, HEIGHT, "m"),
        LessonControl::slider("view", [30.0, 100.0], 5.0, 60.0, "°"),
        LessonControl::choice("lens", 3),
    ],
    compute,
};

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let height = setting.get("height");
    let pinhole = CameraModel::pinhole(SIZE[0], SIZE[1], setting.get("view").to_radians());
    let focal = pinhole.focal;
    // The λ that agrees with the pinhole straight down from the usual height.
    let lambda = focal * HEIGHT / (focal + HEIGHT);
    let lens = match setting.chosen("lens") {
        0 => Lens::Pinhole,
        1 => Lens::Lambda { lambda },
        _ => Lens::Angular,
    };
    let camera = CameraModel {
        lens,
        ..pinhole.clone()
    };
    let pose = pose_at(height, ANGLES);
    let [north, east, down] = LANDMARK;
    let landmark = Point3::new(north, east, down);
    let seen = camera.camera_from_world(&pose) * (landmark - pose.position_in_world);
    let middle = camera.principal;
    let pixel = camera.project(&pose, &landmark).unwrap_or(middle);
    let ideal = pinhole.project(&pose, &landmark).unwrap_or(middle);
    let [wide, high] = SIZE.map(|size| size as f64);
    let edge = [pixel.x, wide - pixel.x, pixel.y, high - pixel.y];
    LessonOutcome {
        figure: draw(&camera, &pose, [pixel, ideal], words),
        values: vec![
            Value::new("right", seen.x, "m"),
            Value::new("back", seen.y, "m"),
            Value::new("depth", seen.z, "m"),
            Value::new("focal", focal, "px"),
            Value::new("lambda", lambda, ""),
            Value::new("across", pixel.x, "px"),
            Value::new("down", pixel.y, "px"),
            Value::new("moved", (pixel - ideal).norm(), "px"),
            Value::new("metre", height / focal, "m"),
            Value::new("edge", edge.into_iter().fold(f64::INFINITY, f64::min), "px"),
        ],
        checks: vec![Check::at_most("metre", 0.3), Check::at_least("edge", 40.0)],
    }
}

/// Place of a pixel in the drawing.
fn drawn(pixel: Point2<f64>) -> Vector2<f64> {
    pixel.coords * SCALE + Vector2::from(CORNER)
}

fn draw(camera: &CameraModel, pose: &Pose, pixels: [Point2<f64>; 2], words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 480.0);
    let [pixel, ideal] = pixels;
    let ends = SIZE.map(|size| size as f64);
    svg.part("grid", |svg| grid(svg, camera, pose));
    svg.part("frame", |svg| {
        let corners = [[0.0, 0.0], [ends[0], 0.0], ends, [0.0, ends[1]]];
        let outline = corners.map(|[x, y]| drawn(Point2::new(x, y)));
        svg.path(&outline, true, "axis");
        let zero = drawn(Point2::origin());
        svg.circle(zero, 5.0, "sigma");
        svg.text(
            zero + vector![8.0, -10.0],
            TextAnchor::Start,
            "small",
            &words.get("corner"),
        );
        for step in 1..=6 {
            let x = 100.0 * f64::from(step);
            let at = drawn(Point2::new(x, ends[1]));
            svg.text(
                at + vector![0.0, 16.0],
                TextAnchor::Middle,
                "small",
                &format!("{x}"),
            );
            if step <= 4 {
                let at = drawn(Point2::new(0.0, x)) + vector![-5.0, 4.0];
                svg.text(at, TextAnchor::End, "small", &format!("{x}"));
            }
        }
    });
    svg.part("principal", |svg| {
        let at = drawn(camera.principal);
        svg.line(at - vector![8.0, 0.0], at + vector![8.0, 0.0], "axis");
        svg.line(at - vector![0.0, 8.0], at + vector![0.0, 8.0], "axis");
    });
    svg.part("offset", |svg| {
        svg.line(drawn(camera.principal), drawn(pixel), "limit");
    });
    svg.part("ideal", |svg| {
        if camera.in_picture(&ideal, 0.0) {
            svg.circle(drawn(ideal), 9.0, "truth");
        }
    });
    svg.part("pixel", |svg| {
        if camera.in_picture(&pixel, 0.0) {
            svg.circle(drawn(pixel), 5.0, "landmark");
        }
    });
    let below = drawn(Point2::new(ends[0], 0.0)) + vector![0.0, -10.0];
    svg.text(below, TextAnchor::End, "small", &words.get("key"));
    svg
}

/// Lines of the ground, 50 m apart, as the camera sees them.
fn grid(svg: &mut Svg, camera: &CameraModel, pose: &Pose) {
    for line in -20..=20 {
        let fixed = 50.0 * f64::from(line);
        for along_north in [true, false] {
            let mut before: Option<Point2<f64>> = None;
            for step in -40..=40 {
                let moving = 25.0 * f64::from(step);
                let [north, east] = if along_north {
                    [200.0 + moving, 100.0 + fixed]
                } else {
                    [200.0 + fixed, 100.0 + moving]
                };
                let pixel = camera.project(pose, &Point3::new(north, east, 0.0));
                let inside = pixel.filter(|pixel| camera.in_picture(pixel, 0.0));
                if let (Some(from), Some(to)) = (before, inside) {
                    svg.line(drawn(from), drawn(to), "grid");
                }
                before = inside;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pinhole_and_lambda_meet_a_calculation_with_the_matrices_of_the_thesis() {
        // The printed chain (32)-(46) in numpy for the same view 1000 high, scaled by 0.3; the λ chain there had λ in the
        // unit of the height, 356.6055 for 1000, so that only the pinhole can be compared at another height.
        let words = crate::text::LessonText::read(LESSON.text)
            .unwrap()
            .words()
            .unwrap();
        let shown = compute(&Setting::usual(LESSON.controls), &words);
        let number = |name: &str| shown.value(name).unwrap().number;
        assert!((number("across") - 389.370).abs() < 2e-3);
        assert!((number("down") - 192.994).abs() < 2e-3);
        // And the λ chain at its own height of 1000.
        let focal = 554.256_258;
        let lambda = focal * 1000.0 / (focal + 1000.0);
        let camera = CameraModel {
            lens: Lens::Lambda { lambda },
            ..CameraModel::pinhole(640, 480, 60_f64.to_radians())
        };
        let pixel = camera
            .pixel_from_camera(&vector![125.747, -85.208, 1004.703])
            .unwrap();
        assert!(
            (pixel.x - 389.191).abs() < 2e-3 && (pixel.y - 193.115).abs() < 2e-3,
            "{pixel}"
        );
    }
}
