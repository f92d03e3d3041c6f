//! The app as it is drawn, so that people can look at it.

use std::cell::RefCell;
use std::rc::Rc;

use egui::{Context, FullOutput, TexturesDelta, Vec2};
use egui_kittest::TestRenderer;

use super::painted::ScreenTextures;

pub(crate) use super::painted::folder;

/// The textures that egui has made so far.
#[derive(Clone, Default)]
pub struct Textures(Rc<RefCell<ScreenTextures>>);

impl TestRenderer for Textures {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        self.0.borrow_mut().take(delta);
    }
}

impl Textures {
    /// The last frame as a picture, one pixel per point.
    pub fn draw(&self, context: &Context, output: &FullOutput, size: Vec2) -> image::RgbImage {
        let shapes = output.shapes.clone();
        self.0.borrow().draw(context, shapes, size, 1.0)
    }
}
