//! Rectification: a tilted picture is laid flat before it is compared.

use nalgebra::{Point3, Vector2, vector};
use pilotage_base::frames::{Attitude, Pose};
use pilotage_raster::camera::CameraModel;
use pilotage_raster::imagery::Window;
use pilotage_raster::raster::{Gray, Peak, Pyramid, Template, highest_peak};
use pilotage_vision::landmark::{FrameView, GroundView, rectify};

use crate::figure::{Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{DrawnDay, DrawnGround, House, draw_box, draw_picture, pictured};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Size of the camera's picture, pixels, and its horizontal angle of view, degrees.
const PICTURE: [usize; 2] = [40, 32];
const VIEW: f64 = 60.0;
/// Height above the ground, metres.
const HEIGHT: f64 = 34.0;
/// Ground that is laid flat: metres of its sides, a pixel each.
const GROUND: [usize; 2] = [36, 30];
/// Side of the map's patch in its middle, metres.
const PATCH: usize = 15;

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "laying-flat",
    text: include_str!("../../texts/en/laying-flat.md"),
    controls: &[
        LessonControl::slider("tilt", [0.0, 40.0], 5.0, 30.0, "°"),
        LessonControl::slider("assumed", [0.0, 40.0], 2.5, 0.0, "°"),
    ],
    compute,
};

fn village() -> DrawnGround {
    DrawnGround {
        houses: vec![
            House::new(16.0, 13.0, [2.5, 3.5]),
            House::new(22.0, 17.5, [2.0, 1.8]),
            House::new(6.0, 6.0, [3.0, 2.0]),
            House::new(30.0, 7.0, [2.0, 3.0]),
            House::new(29.0, 25.0, [3.0, 2.0]),
            House::new(7.0, 22.0, [2.0, 2.5]),
        ],
        trees: vec![([14.0, 20.0], 1.7), ([21.0, 9.5], 1.5), ([33.0, 16.0], 2.0)],
        roads: vec![[[-20.0, 30.0], [60.0, 24.0]]],
        texture: 6.0,
        seed: 21,
    }
}

/// Camera above such a place that the middle of its picture shows the middle of the ground.
fn pose(tilt: f64) -> Pose {
    Pose {
        position_in_world: Point3::new(-HEIGHT * tilt.tan(), 0.0, -HEIGHT),
        attitude: Attitude {
            pitch: tilt,
            ..Attitude::default()
        },
    }
}

/// Picture of the village by a camera that is tilted by so many radians.
fn taken(tilt: f64) -> Gray {
    let [width, height] = PICTURE;
    let camera = CameraModel::pinhole(width, height, VIEW.to_radians());
    let (ground, pose) = (village(), pose(tilt));
    let brightness = ground.on(DrawnDay::default());
    let [across, down] = GROUND.map(|side| side as f64 / 2.0);
    pictured(PICTURE, (3.0, 4), |x, y| {
        let seen = camera.ground_at(&pose, &nalgebra::Point2::new(x, y), 0.0);
        seen.map_or(230.0, |at| brightness(across + at.east, down - at.north))
    })
}

fn laid_flat(picture: Gray, assumed: f64) -> GroundView {
    let [width, height] = PICTURE;
    let camera = CameraModel::pinhole(width, height, VIEW.to_radians());
    let luminance = Pyramid::new(picture, 1);
    let window = Window {
        north_edge: GROUND[1] as f64 / 2.0,
        west_edge: -(GROUND[0] as f64) / 2.0,
        gsd: 1.0,
        width: GROUND[0],
        height: GROUND[1],
    };
    let view = FrameView {
        camera: &camera,
        pose: pose(assumed),
        ground_down: 0.0,
        luminance: &luminance,
    };
    rectify(&view, &window)
}

/// Corner of the patch on the ground, metres right and down.
fn corner_of_patch() -> [usize; 2] {
    GROUND.map(|side| (side - PATCH) / 2)
}

fn searched(flat: &Gray) -> Option<Peak> {
    let map = pictured(GROUND, (0.0, 0), village().on(DrawnDay::default()));
    let [left, top] = corner_of_patch();
    let template = Template::new(&map.crop(left, top, PATCH, PATCH)?)?;
    highest_peak(&template.correlate(flat))
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let [tilt, assumed] = ["tilt", "assumed"].map(|name| setting.get(name).to_radians());
    let picture = taken(tilt);
    let flat = laid_flat(picture.clone(), assumed);
    let peak = searched(&flat.luminance);
    let [left, top] = corner_of_patch();
    let off = peak.map_or(0.0, |peak| {
        (peak.x - left as f64).hypot(peak.y - top as f64)
    });
    LessonOutcome {
        figure: draw(&picture, &flat.luminance, peak.as_ref(), words),
        values: vec![
            Value::new("tilt", setting.get("tilt"), "°"),
            Value::new("assumed", setting.get("assumed"), "°"),
            Value::new("across", tilt.cos(), ""),
            Value::new("along", tilt.cos().powi(2), ""),
            Value::new("score", peak.map_or(0.0, |peak| peak.value), ""),
            Value::new("off", off, "m"),
        ],
        checks: vec![
            Check::at_least("score", 0.95),
            Check::at_least("tilt", 30.0),
        ],
    }
}

fn draw(picture: &Gray, flat: &Gray, peak: Option<&Peak>, words: &Words) -> Svg {
    let mut svg = Svg::new(640.0, 400.0);
    let corner = |x: f64| -> Vector2<f64> { vector![x, 60.0] };
    svg.text(
        vector![10.0, 44.0],
        TextAnchor::Start,
        "small",
        &words.get("picture"),
    );
    svg.text(
        vector![342.0, 44.0],
        TextAnchor::Start,
        "small",
        &words.get("flat"),
    );
    svg.part("picture", |svg| {
        draw_picture(svg, picture, corner(10.0), 8.0, [40.0, 210.0]);
    });
    svg.part("flat", |svg| {
        draw_picture(svg, flat, corner(342.0), 8.0, [40.0, 210.0]);
    });
    let side = PATCH as f64;
    let [left, top] = corner_of_patch().map(|edge| edge as f64);
    svg.part("true", |svg| {
        draw_box(svg, corner(342.0), 8.0, [left, top, side, side], "truth");
    });
    svg.part("found", |svg| {
        if let Some(peak) = peak {
            draw_box(
                svg,
                corner(342.0),
                8.0,
                [peak.x, peak.y, side, side],
                "estimate",
            );
        }
    });
    svg.text(
        vector![342.0, 330.0],
        TextAnchor::Start,
        "small word-truth",
        &words.get("true"),
    );
    svg.text(
        vector![342.0, 350.0],
        TextAnchor::Start,
        "small word-estimate",
        &words.get("found"),
    );
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilted_camera_shortens_by_the_cosine_across_and_by_its_square_along() {
        let camera = CameraModel::pinhole(640, 480, 1.0);
        let (tilt, step) = (0.5_f64, 1e-3);
        let at = |north: f64, east: f64, tilt: f64| {
            camera
                .project(&pose(tilt), &Point3::new(north, east, 0.0))
                .unwrap()
        };
        let moved =
            |north: f64, east: f64, tilt: f64| (at(north, east, tilt) - at(0.0, 0.0, tilt)).norm();
        let across = moved(0.0, step, tilt) / moved(0.0, step, 0.0);
        let along = moved(step, 0.0, tilt) / moved(step, 0.0, 0.0);
        assert!((across - tilt.cos()).abs() < 1e-4, "{across}");
        assert!((along - tilt.cos().powi(2)).abs() < 1e-4, "{along}");
    }
}
