//! A map of another date: brightness against the directions of edges.

use nalgebra::vector;
use pilotage_raster::raster::{
    ChannelSearch, ChannelTemplate, Gray, OrientationField, Peak, Template, highest_peak,
};

use crate::figure::{Svg, TextAnchor};
use crate::lesson::{Check, Lesson, LessonOutcome, Value};
use crate::models::{DrawnDay, DrawnGround, House, draw_box, draw_picture, pictured};
use crate::setting::{LessonControl, Setting};
use crate::text::Words;

/// Size of map and picture, pixels of a metre; side of the patch and its corner.
const SIZE: [usize; 2] = [48, 40];
const PATCH: usize = 24;
const CORNER: [usize; 2] = [12, 8];
/// Noise of the picture, grey levels, and its seed.
const NOISE: (f64, u64) = (5.0, 9);
/// Shadows on the map, metres right and down: of a summer noon.
const SUMMER: [f64; 2] = [0.0, -1.0];

/// The lesson.
pub(super) const LESSON: Lesson = Lesson {
    name: "another-date",
    text: include_str!("../../texts/en/another-date.md"),
    controls: &[
        LessonControl::choice("features", 2),
        LessonControl::slider("snow", [0.0, 100.0], 10.0, 100.0, "%"),
        LessonControl::slider("shadow", [0.0, 8.0], 1.0, 1.0, "m"),
    ],
    compute,
};

fn village() -> DrawnGround {
    DrawnGround {
        houses: vec![
            House::new(18.0, 15.0, [2.5, 4.0]),
            House::new(27.0, 13.0, [3.5, 2.0]),
            House::new(25.0, 26.0, [2.0, 3.0]),
            House::new(8.0, 10.0, [3.0, 2.5]),
            House::new(40.0, 12.0, [2.5, 4.0]),
            House::new(39.0, 30.0, [3.5, 2.0]),
            House::new(9.0, 31.0, [2.0, 3.0]),
        ],
        trees: vec![
            ([32.0, 22.0], 2.2),
            ([16.0, 26.0], 1.8),
            ([44.0, 22.0], 2.0),
        ],
        roads: vec![[[-10.0, 24.0], [60.0, 18.0]]],
        texture: 8.0,
        seed: 33,
    }
}

fn by_brightness(map: &Gray, picture: &Gray) -> Option<Gray> {
    let patch = map.crop(CORNER[0], CORNER[1], PATCH, PATCH)?;
    Some(Template::new(&patch)?.correlate(picture))
}

fn by_directions(map: &Gray, picture: &Gray) -> Option<Gray> {
    let field = |gray: &Gray| {
        let whole = Gray::filled(gray.width(), gray.height(), 1.0);
        OrientationField::new(gray, &whole)
    };
    let (map, picture) = (field(map), field(picture));
    let cut = |gray: &Gray| gray.crop(CORNER[0], CORNER[1], PATCH, PATCH);
    let channels: Option<Vec<Gray>> = map.channels.iter().map(cut).collect();
    let template = ChannelTemplate::new(&channels?, &Gray::filled(PATCH, PATCH, 1.0))?;
    let search = ChannelSearch::new(&picture.channels, &picture.covered);
    Some(search.correlate(&template)?.score)
}

fn compute(setting: &Setting, words: &Words) -> LessonOutcome {
    let ground = village();
    let length = setting.get("shadow");
    let day = DrawnDay {
        snow: setting.get("snow") / 100.0,
        shadow: [0.8 * length, -0.6 * length],
    };
    let summer = DrawnDay {
        snow: 0.0,
        shadow: SUMMER,
    };
    let map = pictured(SIZE, (0.0, 0), ground.on(summer));
    let picture = pictured(SIZE, NOISE, ground.on(day));
    let surfaces = [by_brightness(&map, &picture), by_directions(&map, &picture)];
    let there = surfaces.each_ref().map(|surface| {
        let at = |surface: &Gray| f64::from(surface.get(CORNER[0], CORNER[1]));
        surface.as_ref().map_or(0.0, at)
    });
    let peaks = surfaces
        .each_ref()
        .map(|surface| surface.as_ref().and_then(highest_peak));
    let errors = peaks.map(|peak| {
        let off = |peak: Peak| (peak.x - CORNER[0] as f64).hypot(peak.y - CORNER[1] as f64);
        peak.map_or(0.0, off)
    });
    let chosen = setting.chosen("features");
    LessonOutcome {
        figure: draw(&map, &picture, peaks[chosen].as_ref(), words),
        values: vec![
            Value::new("snow", setting.get("snow"), "%"),
            Value::new("shadow", length, "m"),
            Value::new("bright-there", there[0], ""),
            Value::new("directed-there", there[1], ""),
            Value::new("bright-off", errors[0], "m"),
            Value::new("directed-off", errors[1], "m"),
            Value::new("off", errors[chosen], "m"),
        ],
        checks: vec![Check::at_most("off", 1.0), Check::at_least("snow", 80.0)],
    }
}

fn draw(map: &Gray, picture: &Gray, peak: Option<&Peak>, words: &Words) -> Svg {
    const PIXEL: f64 = 12.0;
    let mut svg = Svg::new(640.0, 400.0);
    let side = PATCH as f64 / 2.0;
    let [left, top] = CORNER.map(|edge| edge as f64 / 2.0);
    let places = [vector![16.0, 60.0], vector![336.0, 60.0]];
    svg.text(
        vector![16.0, 44.0],
        TextAnchor::Start,
        "small",
        &words.get("map"),
    );
    svg.text(
        vector![336.0, 44.0],
        TextAnchor::Start,
        "small",
        &words.get("picture"),
    );
    // Half as many pixels are shown as are compared.
    svg.part("map", |svg| {
        draw_picture(svg, &map.halved(), places[0], PIXEL, [20.0, 240.0]);
        draw_box(svg, places[0], PIXEL, [left, top, side, side], "look");
    });
    svg.part("picture", |svg| {
        draw_picture(svg, &picture.halved(), places[1], PIXEL, [20.0, 240.0]);
    });
    svg.part("true", |svg| {
        draw_box(svg, places[1], PIXEL, [left, top, side, side], "truth");
    });
    svg.part("found", |svg| {
        if let Some(peak) = peak {
            draw_box(
                svg,
                places[1],
                PIXEL,
                [peak.x / 2.0, peak.y / 2.0, side, side],
                "estimate",
            );
        }
    });
    let lines = [
        ("patch", 16.0, 330.0, "look"),
        ("true", 336.0, 330.0, "truth"),
        ("found", 336.0, 350.0, "estimate"),
    ];
    for (name, x, y, colour) in lines {
        let class = format!("small word-{colour}");
        svg.text(vector![x, y], TextAnchor::Start, &class, &words.get(name));
    }
    svg
}
