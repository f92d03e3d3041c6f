//! Pictures of views alone, so that tests can write what people look at.

use egui::{Context, Rect, Ui, Vec2, pos2};

use crate::testing::canvas::ScreenTextures;

pub(crate) use crate::testing::canvas::folder;

/// Runs `draw` for four frames and returns the last one, at two pixels per point.
pub(crate) fn picture(
    size: Vec2,
    prepare: impl FnOnce(&Context),
    mut draw: impl FnMut(&mut Ui),
) -> image::RgbImage {
    let context = Context::default();
    prepare(&context);
    let scale = 2.0;
    context.set_pixels_per_point(scale);
    let mut textures = ScreenTextures::default();
    let mut shapes = Vec::new();
    for frame in 0..4 {
        let input = egui::RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), size)),
            time: Some(f64::from(frame) * 0.5),
            ..egui::RawInput::default()
        };
        let mut output = context.run_ui(input, &mut draw);
        textures.take(&mut output.textures_delta);
        shapes = output.shapes;
    }
    textures.draw(&context, shapes, size, scale)
}
